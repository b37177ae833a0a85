#include "texture/statistical/clique_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>

#include "base/config.h"
#include "base/error.h"
#include "base/math_exact.h"
#include "base/text/json.h"
#include "base/text/text_encoding.h"

namespace belvedere {
namespace {

constexpr std::array<float, clique_knots / 2> lower_shares = {
    0.F, .004F, .012F, .03F, .06F, .10F, .15F, .21F, .275F, .34F, .40F, .465F};
constexpr int code_steps = 127;  // of each sign
constexpr double mu =
    255.0;  // of the companding: small differences in fine steps, large ones in coarse ones

// The part of a range for code `step` of mu-law.
const std::array<float, code_steps + 1>& code_parts() {
  static const std::array<float, code_steps + 1> parts = [] {
    std::array<float, code_steps + 1> out{};
    for (int step = 0; step <= code_steps; ++step)
      out[static_cast<std::size_t>(step)] = static_cast<float>(
          (exact::pow(1.0 + mu, static_cast<double>(step) / code_steps) - 1.0) / mu);
    return out;
  }();
  return parts;
}

float reach_of(const BandSpace& bands, const CliqueType& type) {
  const DifferenceRange range = difference_range(bands, type);
  return std::max(std::abs(range.low), std::abs(range.high));
}

float decoded(std::int8_t code, float reach) {
  const float part = code_parts()[static_cast<std::size_t>(std::abs(static_cast<int>(code)))];
  return (code < 0 ? -reach : reach) * part;
}

}  // namespace

float clique_knot_share(int k) {
  constexpr int half = clique_knots / 2;
  return k < half ? lower_shares[static_cast<std::size_t>(k)]
                  : 1.F - lower_shares[static_cast<std::size_t>(clique_knots - 1 - k)];
}

DifferenceRange difference_range(const BandSpace& bands, const CliqueType& type) {
  const auto head = static_cast<std::size_t>(type.head);
  const auto tail = static_cast<std::size_t>(type.tail);
  if (type.single()) return {bands.low[head], bands.high[head]};
  return {bands.low[head] - bands.high[tail], bands.high[head] - bands.low[tail]};
}

std::array<std::int8_t, clique_knots> encode_knots(const BandSpace& bands, const CliqueType& type,
                                                   const CliqueKnots& knots) {
  const float reach = reach_of(bands, type);
  std::array<std::int8_t, clique_knots> codes{};
  int last = -code_steps;
  for (std::size_t k = 0; k < knots.size(); ++k) {
    const double part =
        std::min(1.0, static_cast<double>(std::abs(knots[k])) / static_cast<double>(reach));
    const double step = code_steps * exact::log(1.0 + mu * part) / exact::log(1.0 + mu);
    const int code = static_cast<int>(std::floor(step + 0.5));
    last = std::max(last, knots[k] < 0.F ? -code : code);
    codes[k] = static_cast<std::int8_t>(last);
  }
  return codes;
}

CliqueKnots decode_knots(const BandSpace& bands, const Clique& clique) {
  const float reach = reach_of(bands, clique.type);
  CliqueKnots knots{};
  for (std::size_t k = 0; k < knots.size(); ++k) knots[k] = decoded(clique.codes[k], reach);
  return knots;
}

float value_at_share(const CliqueKnots& knots, float share) {
  int k = 1;
  while (k < clique_knots - 1 && clique_knot_share(k) < share) ++k;
  const float from = clique_knot_share(k - 1);
  const float t = std::clamp((share - from) / (clique_knot_share(k) - from), 0.F, 1.F);
  const auto at = static_cast<std::size_t>(k);
  return knots[at - 1] + (knots[at] - knots[at - 1]) * t;
}

float share_below(const CliqueKnots& knots, float value) {
  if (value <= knots.front()) return 0.F;
  if (value >= knots.back()) return 1.F;
  int k = 1;
  while (knots[static_cast<std::size_t>(k)] < value) ++k;
  const auto at = static_cast<std::size_t>(k);
  const float from = clique_knot_share(k - 1);
  const float width = std::max(1e-6F, knots[at] - knots[at - 1]);
  return from + (clique_knot_share(k) - from) * (value - knots[at - 1]) / width;
}

std::size_t model_bytes(const CliqueModel& model) {
  constexpr std::size_t header = 8 + 3 * 4 + 9 * 2 + 6 * 4;
  return header + model.cliques.size() * (4 + clique_knots);
}

Grid<std::uint8_t> widened(const Grid<std::uint8_t>& mask, int px) {
  const auto along = [px](const Grid<std::uint8_t>& from, bool rows) {
    Grid<std::uint8_t> to(from.width(), from.height());
    const int length = rows ? from.width() : from.height();
    for (int line = 0; line < (rows ? from.height() : from.width()); ++line) {
      const auto at = [&](int i) { return rows ? from.index(i, line) : from.index(line, i); };
      int last = -px - 1;  // marked pixel before
      for (int i = 0; i < length; ++i) {
        if (from[at(i)] != 0) last = i;
        if (i - last <= px) to[at(i)] = 1;
      }
      int next = length + px;
      for (int i = length - 1; i >= 0; --i) {
        if (from[at(i)] != 0) next = i;
        if (next - i <= px) to[at(i)] = 1;
      }
    }
    return to;
  };
  return along(along(mask, true), false);
}

PixelRect box_of(const Grid<std::uint8_t>& mask) {
  PixelRect box{mask.width(), mask.height(), 0, 0};
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x)
      if (mask(x, y) != 0)
        box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1),
               std::max(box.y1, y + 1)};
  return box;
}

Grid<std::uint8_t> near_borders(const Grid<std::uint8_t>& labels, int px) {
  Grid<std::uint8_t> border(labels.width(), labels.height());
  for (int y = 0; y < labels.height(); ++y)
    for (int x = 0; x < labels.width(); ++x) {
      const std::uint8_t own = labels(x, y);
      const auto other = [&](int u, int v) {
        const std::uint8_t label = labels.clamped(u, v);
        return label != own && label != no_label;
      };
      const bool is = own != no_label &&
                      (other(x - 1, y) || other(x + 1, y) || other(x, y - 1) || other(x, y + 1));
      border(x, y) = is ? 1 : 0;
    }
  return px <= 1 ? border : widened(border, px - 1);
}

namespace {

constexpr int version = 1;
constexpr std::size_t clique_bytes = 4 + clique_knots;
constexpr int max_levels = 4;
constexpr std::array<std::string_view, 3> seed_names = {"white", "streaks", "discs"};

template <class Values>
std::string numbers(const Values& values) {
  return fmt::format("[{}]", fmt::join(values, ", "));
}

std::string clique_text(const std::vector<Clique>& cliques) {
  std::string bytes;
  for (const Clique& clique : cliques) {
    const CliqueType& t = clique.type;
    for (const int value : {t.level, t.dx, t.dy, 3 * t.head + t.tail})
      bytes += static_cast<char>(value);
    for (const std::int8_t code : clique.codes) bytes += static_cast<char>(code);
  }
  return base64(bytes);
}

std::vector<Clique> read_cliques(const ConfigValue& at, const std::string& name, int levels) {
  const std::optional<std::string> bytes = base64_bytes(as_string(at, name));
  if (!bytes || bytes->empty() || bytes->size() % clique_bytes != 0)
    refuse_value(at, name, "the types are damaged", "the unchanged text");
  std::vector<Clique> cliques;
  for (std::size_t i = 0; i < bytes->size(); i += clique_bytes) {
    const auto byte = [&](std::size_t k) { return static_cast<std::int8_t>((*bytes)[i + k]); };
    Clique clique;
    clique.type = {byte(0), byte(1), byte(2), byte(3) / 3, byte(3) % 3};
    const CliqueType& t = clique.type;
    const bool known = t.level >= 0 && t.level <= levels && t.dy >= 0 && byte(3) >= 0 &&
                       byte(3) < 9 && std::abs(t.dx) <= 32 && t.dy <= 32;
    for (std::size_t k = 0; k < clique_knots; ++k) clique.codes[k] = byte(4 + k);
    bool rising = true;
    for (std::size_t k = 1; k < clique_knots; ++k)
      rising = rising && clique.codes[k] >= clique.codes[k - 1];
    if (!known || !rising || clique.codes[0] < -127)
      refuse_value(at, name, fmt::format("type {} is damaged", i / clique_bytes),
                   "the unchanged text");
    cliques.push_back(clique);
  }
  return cliques;
}

}  // namespace

std::string model_text(const CliqueModel& model) {
  std::vector<int> axes;
  for (const auto& axis : model.bands.axes) axes.insert(axes.end(), axis.begin(), axis.end());
  std::string out =
      "# A texture as statistics of pixel pairs; `belvedere texture make` paints with it.\n";
  out += fmt::format("belvedere_texture = {}\n", version);
  out += fmt::format("crop_size = [{}, {}]\ncrop_hash = {}\n", model.crop_width, model.crop_height,
                     json_quoted(model.crop_hash));
  out += fmt::format("seed = \"{}\"          # white, streaks or discs: what it begins with\n",
                     seed_names[static_cast<std::size_t>(model.seed)]);
  out += fmt::format("seed_px = {}\ndirection_deg = {}\ndirection_spread = {}\npolish = {}\n",
                     model.seed_px, model.direction_deg, model.direction_spread, model.polish);
  if (model.sampled) out += "method = \"paper\"     # sampled from noise, as published\n";
  out += fmt::format("levels = {}\nmean = {}\naxes = {}\nlow = {}\nhigh = {}\n", model.levels,
                     numbers(model.bands.mean), numbers(axes), numbers(model.bands.low),
                     numbers(model.bands.high));
  out += fmt::format("types = \"{}\"\n", clique_text(model.cliques));
  return out;
}

CliqueModel parse_model(const ConfigValue& root, const std::string& name) {
  const ConfigValue* of =
      root.is_table() ? find(as_table(root, name), "belvedere_texture") : nullptr;
  if (of == nullptr)
    throw Error(ErrorKind::usage, name, "not a texture model",
                "a file written by `belvedere texture learn`");
  if (const std::int64_t found = as_integer(*of, name); found != version)
    throw Error(ErrorKind::usage, config_where(name, of->position),
                fmt::format("version {} of texture models", found), fmt::format("{}", version));
  allow_only(
      as_table(root, name),
      {"belvedere_texture", "levels", "mean", "axes", "low", "high", "seed", "seed_px",
       "direction_deg", "direction_spread", "polish", "method", "crop_hash", "crop_size", "types"},
      name);
  const auto get = [&](const char* key) -> const ConfigValue& {
    return required(root, key, name, "a texture model written by `belvedere texture learn`");
  };
  const auto number = [&](const char* key, double min, double max) {
    return static_cast<float>(as_number(get(key), name, min, max));
  };
  CliqueModel model;
  model.levels = static_cast<int>(number("levels", 0, max_levels));
  const auto mean = as_numbers(get("mean"), name, 3, 0.0, 255.0);
  const auto axes = as_numbers(get("axes"), name, 9, -32767.0, 32767.0);
  const auto low = as_numbers(get("low"), name, 3, -1000.0, 1000.0);
  const auto high = as_numbers(get("high"), name, 3, -1000.0, 1000.0);
  for (std::size_t b = 0; b < 3; ++b) {
    model.bands.mean[b] = static_cast<float>(mean[b]);
    model.bands.low[b] = static_cast<float>(low[b]);
    model.bands.high[b] = static_cast<float>(high[b]);
    for (std::size_t c = 0; c < 3; ++c)
      model.bands.axes[b][c] = static_cast<std::int16_t>(axes[3 * b + c]);
    if (!(low[b] < high[b]))
      refuse_value(get("high"), name, fmt::format("{} is not above {}", high[b], low[b]),
                   "a range");
  }
  const std::string& seed = as_string(get("seed"), name);
  std::size_t kind = 0;
  while (kind < seed_names.size() && seed_names[kind] != seed) ++kind;
  if (kind == seed_names.size())
    refuse_value(get("seed"), name, json_quoted(seed),
                 fmt::format("{}", fmt::join(seed_names, ", ")));
  model.seed = static_cast<TextureSeed>(kind);
  model.seed_px = number("seed_px", 0.0, 256.0);
  model.direction_deg = number("direction_deg", 0.0, 180.0);
  model.direction_spread = number("direction_spread", 0.0, 1.0);
  model.polish = as_bool(get("polish"), name);
  if (const ConfigValue* method = find(as_table(root, name), "method")) {
    if (as_string(*method, name) != "paper")
      refuse_value(*method, name, json_quoted(as_string(*method, name)), "paper, or no method");
    model.sampled = true;
    if (model.levels != 0)
      refuse_value(*method, name, fmt::format("{} levels above the picture", model.levels),
                   "0 with this method");
  }
  const auto size = as_numbers(get("crop_size"), name, 2, 1.0, 1e6);
  model.crop_width = static_cast<int>(size[0]);
  model.crop_height = static_cast<int>(size[1]);
  model.crop_hash = as_string(get("crop_hash"), name);
  model.cliques = read_cliques(get("types"), name, model.levels);
  return model;
}

CliqueModel parse_model(const std::string& text, const std::string& name) {
  return parse_model(parse_config(text, name), name);
}
CliqueModel read_model(const std::string& path) { return parse_model(read_config(path), path); }

}  // namespace belvedere
