#include "texture/composite/composite_model.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/config.h"
#include "base/error.h"
#include "base/math_exact.h"
#include "base/text/text_encoding.h"
#include "base/text/json.h"
#include "texture/statistical/model_file.h"

namespace belvedere {
namespace {

constexpr int version = 1;
constexpr double code_bits = 24.0;  // from the smallest share, 2^-24, to 1
constexpr double code_steps = 65534.0;

// A share as two bytes: its logarithm in steps of .025 %; 0 is 0.
std::uint16_t encode(float share) {
  if (!(share > 0.F)) return 0;
  const double step =
      1.0 + code_steps * (1.0 + exact::log2(static_cast<double>(share)) / code_bits);
  return static_cast<std::uint16_t>(std::clamp(std::floor(step + .5), 1.0, code_steps + 1.0));
}
float decode(std::uint16_t code) {
  return code == 0 ? 0.F
                   : static_cast<float>(exact::exp2(((code - 1.0) / code_steps - 1.0) * code_bits));
}

std::string shares_text(const std::vector<float>& shares) {
  std::string bytes;
  for (const float share : shares) {
    const std::uint16_t code = encode(share);
    bytes += static_cast<char>(code & 0xffU);
    bytes += static_cast<char>(code >> 8);
  }
  return base64(bytes);
}

class Reader {
 public:
  explicit Reader(const std::string& name) : name_(name) {}

  [[noreturn]] void refuse(const ConfigValue& at, const std::string& found,
                           const std::string& allowed) const {
    throw Error(ErrorKind::usage, config_where(name_, at.position), found, allowed);
  }
  const ConfigValue& get(const ConfigTable& table, const char* key) const {
    const ConfigValue* value = find(table, key);
    if (value == nullptr)
      throw Error(ErrorKind::usage, name_, fmt::format("\"{}\" is missing", key),
                  "a composite written by `belvedere composite learn`");
    return *value;
  }
  // As many shares as expected, in tables of `table` values that sum to 1.
  std::vector<float> shares(const ConfigTable& from, const char* key, std::size_t count,
                            std::size_t table) const {
    const ConfigValue& at = get(from, key);
    const std::optional<std::string> bytes = base64_bytes(as_string(at, name_));
    if (!bytes || bytes->size() != 2 * count)
      refuse(at, fmt::format("\"{}\" is damaged, or has another number of labels", key),
             "the unchanged text");
    std::vector<float> out(count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto low = static_cast<std::uint8_t>((*bytes)[2 * i]);
      const auto high = static_cast<std::uint8_t>((*bytes)[2 * i + 1]);
      out[i] = decode(static_cast<std::uint16_t>(low | high << 8));
    }
    for (std::size_t first = 0; first < count; first += table) {
      double sum = 0.0;
      for (std::size_t i = 0; i < table; ++i) sum += static_cast<double>(out[first + i]);
      if (!(std::abs(sum - 1.0) < .01))
        refuse(at, fmt::format("table {} of \"{}\" is damaged", first / table, key),
               "shares that sum to 1");
    }
    return out;
  }
  const std::string& name() const { return name_; }

 private:
  const std::string& name_;
};

CompositeModel composite_of(const ConfigValue& root, const std::string& name) {
  const ConfigValue* of =
      root.is_table() ? find(as_table(root, name), "belvedere_composite") : nullptr;
  if (of == nullptr)
    throw Error(ErrorKind::usage, name, "not a composite",
                "a file written by `belvedere composite learn`");
  if (const std::int64_t found = as_integer(*of, name); found != version)
    throw Error(ErrorKind::usage, config_where(name, of->position),
                fmt::format("version {} of composites", found), fmt::format("{}", version));
  const ConfigTable& table = as_table(root, name);
  allow_only(table,
             {"belvedere_composite", "crop_size", "crop_hash", "map", "labels", "transition"},
             name);
  const Reader read(name);
  CompositeModel out;
  out.crop_hash = as_string(read.get(table, "crop_hash"), name);
  const ConfigValue& size = read.get(table, "crop_size");
  const ConfigArray& sides = as_array(size, name);
  constexpr std::int64_t longest = 1 << 20;
  if (sides.size() != 2)
    read.refuse(size, fmt::format("{} numbers in \"crop_size\"", sides.size()), "2");
  for (const ConfigValue& side : sides)
    if (const std::int64_t n = as_integer(side, name); n < 1 || n > longest)
      read.refuse(side, fmt::format("{} in \"crop_size\"", n), fmt::format("1 to {}", longest));

  const ConfigValue& list = read.get(table, "labels");
  for (const ConfigValue& value : as_array(list, name)) {
    const ConfigTable& label = as_table(value, name);
    allow_only(label, {"name", "model"}, name);
    const std::string& called = as_string(read.get(label, "name"), name);
    if (std::any_of(out.labels.begin(), out.labels.end(),
                    [&](const CompositeLabel& l) { return l.name == called; }))
      read.refuse(value, fmt::format("the label {} is given twice", json_quoted(called)),
                  "each label once");
    out.labels.push_back({called, parse_model(read.get(label, "model"), name)});
  }
  if (out.labels.size() < 2 || out.labels.size() > max_labels)
    read.refuse(list, fmt::format("{} labels", out.labels.size()),
                fmt::format("2 to {}", max_labels));
  if (const ConfigValue* transition = find(table, "transition"))
    out.transition = parse_model(*transition, name);

  const std::size_t n = out.labels.size();
  out.map.labels = static_cast<int>(n);
  out.map.crop_width = static_cast<int>(as_integer(sides[0], name));
  out.map.crop_height = static_cast<int>(as_integer(sides[1], name));
  const ConfigTable& map = as_table(read.get(table, "map"), name);
  allow_only(map, {"pairs", "rings", "profile"}, name);
  out.map.pairs =
      read.shares(map, "pairs", std::size_t{label_scales} * label_offsets * n * n, n * n);
  out.map.rings =
      read.shares(map, "rings", std::size_t{label_scales} * ring_patterns, ring_patterns);
  out.map.profile = read.shares(map, "profile", label_strips * n, n);
  return out;
}

}  // namespace

std::string composite_text(const CompositeModel& model) {
  std::string out =
      "# A map of labels and a texture for each; `belvedere composite make` paints with it.\n";
  out += fmt::format("belvedere_composite = {}\n", version);
  out += fmt::format("crop_size = [{}, {}]\ncrop_hash = {}\n", model.map.crop_width,
                     model.map.crop_height, json_quoted(model.crop_hash));
  out +=
      "\n[map]  # shares, two bytes each: pairs of labels, patterns of borders, labels by height\n";
  out += fmt::format("pairs = \"{}\"\nrings = \"{}\"\nprofile = \"{}\"\n",
                     shares_text(model.map.pairs), shares_text(model.map.rings),
                     shares_text(model.map.profile));
  for (const CompositeLabel& label : model.labels)
    out += fmt::format("\n[[labels]]\nname = {}\n[labels.model]\n{}", json_quoted(label.name),
                       model_text(label.model));
  if (model.transition) out += "\n[transition]  # along borders\n" + model_text(*model.transition);
  return out;
}

CompositeModel parse_composite(const std::string& text, const std::string& name) {
  return composite_of(parse_config(text, name), name);
}
CompositeModel read_composite(const std::string& path) {
  return composite_of(read_config(path), path);
}

}  // namespace belvedere
