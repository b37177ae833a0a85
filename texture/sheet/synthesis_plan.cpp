#include "texture/sheet/synthesis_plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "texture/sheet/plan_data.h"
#include "texture/synthesis/synthesize.h"

// A plan as bytes: numbers of 8 bytes, little-endian; lists begin with their length; a checksum of
// everything at the end.

namespace belvedere {
namespace {

void check_sheet(const SynthesisSheet& sheet, const GuideStack& small_view) {
  if (sheet.width < 1 || sheet.height < 1 || sheet.level < 0 || sheet.level > max_levels_in_tiles ||
      sheet.tile_px < 1 || sheet.tile_px % (8 << sheet.level) != 0) {
    throw Error(ErrorKind::usage, "plan of synthesis",
                fmt::format("{} × {} pixels, level {}, tiles of {}", sheet.width, sheet.height,
                            sheet.level, sheet.tile_px),
                fmt::format("1 pixel or more, level 0 … {}, tiles of a multiple of 8 × 2^level",
                            max_levels_in_tiles));
  }
  if (small_view.width() != sheet.plan_width() || small_view.height() != sheet.plan_height()) {
    throw Error(ErrorKind::usage, "plan of synthesis",
                fmt::format("a view of {} × {}", small_view.width(), small_view.height()),
                fmt::format("{} × {}, the sheet at 1 / {}", sheet.plan_width(), sheet.plan_height(),
                            1 << sheet.level));
  }
}

// Hash of all bytes, eight at a time, in fixed chunks.
template <class T>
std::uint64_t digest_of_values(const std::vector<T>& values) {
  constexpr std::size_t chunk = std::size_t{1} << 20;
  const std::size_t bytes = values.size() * sizeof(T);
  const auto* first = reinterpret_cast<const unsigned char*>(values.data());
  std::vector<std::uint64_t> sums((bytes + chunk - 1) / chunk);
  parallel_ranges(sums.size(), std::size_t{1}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c != end; ++c) {
      for (std::size_t at = c * chunk; at < std::min(bytes, (c + 1) * chunk); at += 8) {
        std::uint64_t eight = 0;
        std::memcpy(&eight, first + at, std::min<std::size_t>(8, bytes - at));
        sums[c] = mix_bits(sums[c] ^ eight);
      }
    }
  });
  std::uint64_t digest = bytes;
  for (const std::uint64_t sum : sums) digest = mix_bits(digest ^ sum);
  return digest;
}

synth::Plane positions_of(const synth::Plane& plane) {
  synth::Plane positions;
  positions.stride = plane.stride;
  positions.parts = plane.parts;
  positions.guide_count = plane.guide_count;
  return positions;
}

}  // namespace

std::uint64_t digest_of(const synth::Plane& plane) {
  std::uint64_t digest = random_bits(static_cast<std::uint64_t>(plane.stride), plane.guide_count,
                                     static_cast<std::int64_t>(plane.words.size()));
  digest = mix_bits(digest ^ digest_of_values(plane.words));
  digest = mix_bits(digest ^ digest_of_values(plane.guides));
  return mix_bits(digest ^ digest_of_values(plane.cuts));
}

void make_sources(SynthesisPlanData& data, std::vector<synth::Plane> planes) {
  const std::size_t level = static_cast<std::size_t>(data.sheet.level);
  planes.resize(level + 1);
  data.exemplars = std::move(planes);
  data.exemplars[level] = positions_of(data.exemplars[level]);
  for (std::size_t l = 0; l < level && data.setup.classes.count > 0; ++l) {
    synth::TexelDemand demand = data.demand;
    demand.pixels_each = std::int64_t{1} << (2 * (level - l));
    demand.complete = false;
    data.sources.push_back(std::make_shared<synth::LevelSource>(
        data.setup.settings(static_cast<int>(l)), data.setup.roles, data.setup.classes.count,
        data.exemplars[l], demand, data.setup.around_price));
    data.exemplars[l].guides = {};  // contained in records and lists
    data.exemplars[l].cuts = {};
  }
}

SynthesisPlan::SynthesisPlan(std::unique_ptr<SynthesisPlanData> data) : data_(std::move(data)) {}
SynthesisPlan::SynthesisPlan(SynthesisPlan&&) noexcept = default;
SynthesisPlan& SynthesisPlan::operator=(SynthesisPlan&&) noexcept = default;
SynthesisPlan::~SynthesisPlan() = default;
const SynthesisSheet& SynthesisPlan::sheet() const { return data_->sheet; }

SynthesisPlan plan_synthesis(const std::vector<Exemplar>& exemplars, const GuideStack& small_view,
                             const SynthesisSheet& sheet, const SynthesisParameters& parameters,
                             Progress& progress) {
  check_sheet(sheet, small_view);
  auto data = std::make_unique<SynthesisPlanData>();
  data->sheet = sheet;
  data->setup = synth::make_setup(exemplars, small_view, parameters,
                                  std::size_t{1} << (2 * sheet.level), progress);
  const synth::Setup& setup = data->setup;
  const int levels = std::max(
      sheet.level + 1, synth::level_count(exemplars, sheet.width, sheet.height, parameters.levels));
  std::vector<synth::Plane> sources{synth::exemplar_plane(exemplars, setup)};
  data->digest = digest_of(sources[0]);
  for (int level = 1; level < levels; ++level) sources.push_back(synth::halve(sources.back()));
  std::vector<synth::Plane> targets{synth::target_plane(small_view, setup)};
  const synth::Plane::Part part = targets[0].parts[0];
  const std::uint32_t nowhere = sources[static_cast<std::size_t>(sheet.level)].nowhere();
  data->matches.assign(static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height),
                       nowhere);
  if (setup.classes.count > 0) {
    data->demand = synth::count_texel_demand(targets[0], setup.classes.count, setup.roles);
    synth::Plane sample = sheet.level > 0
                              ? targets[0]
                              : synth::Plane();  // synthesis removes classes that its level lacks
    const std::vector<std::uint32_t> matches = synth::synthesize_levels(
        setup, small_view, sheet.level, levels, sources, targets, progress);
    for (int y = 0; y < part.height; ++y) {
      const auto row = matches.begin() + targets[0].index(0, 0, y);
      std::copy(row, row + part.width,
                data->matches.begin() + static_cast<std::ptrdiff_t>(y) * part.width);
    }
    targets.clear();
    make_sources(*data, std::move(sources));
    for (int level = 0; level < sheet.level; ++level) {
      const std::shared_ptr<synth::LevelSource>& source =
          data->sources[static_cast<std::size_t>(level)];
      synth::LevelSettings settings = setup.settings(level);
      settings.surroundings_radius = setup.settings(sheet.level).surroundings_radius;
      data->usual_errors.push_back(
          synth::usual_errors_of_picks(synth::LevelState(settings, source, sample, {})));
      source->usual_error = data->usual_errors.back();
    }
  } else {
    make_sources(*data, std::move(sources));
  }
  return SynthesisPlan(std::move(data));
}

namespace {

constexpr std::string_view magic = "belvedere synthesis plan 2\n";

class Writer {
 public:
  template <class T>
  void number(T value) {
    const std::uint64_t bits = static_cast<std::uint64_t>(value);
    for (int i = 0; i < 8; ++i) bytes_.push_back(static_cast<std::uint8_t>(bits >> (8 * i)));
  }
  template <class T>
  void list(const std::vector<T>& values) {  // of 1 or 4 bytes, little-endian
    number(values.size());
    for (const T value : values)
      for (std::size_t i = 0; i < sizeof(T); ++i)
        bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  }
  void text(std::string_view value) { list(std::vector<std::uint8_t>(value.begin(), value.end())); }
  std::vector<std::uint8_t>& bytes() { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

[[noreturn]] void refuse(const std::string& found) {
  throw Error(ErrorKind::input, "plan of synthesis", found, "a complete plan of this version");
}

class Reader {
 public:
  explicit Reader(const std::vector<std::uint8_t>& bytes, std::size_t end)
      : bytes_(bytes), end_(end) {}
  std::uint64_t number() {
    need(8);
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits |= static_cast<std::uint64_t>(bytes_[at_++]) << (8 * i);
    return bits;
  }
  int small_number() {
    const std::uint64_t value = number();
    if (value > INT32_MAX) refuse("a number out of range");
    return static_cast<int>(value);
  }
  std::int64_t weight(std::uint64_t max) {
    const std::uint64_t value = number();
    if (value > max) refuse("a weight out of range");
    return static_cast<std::int64_t>(value);
  }
  template <class T>
  std::vector<T> list() {
    const std::uint64_t count = number();
    if (count > (end_ - at_) / sizeof(T)) refuse("the data end too early");
    std::vector<T> values(count, 0);
    for (T& value : values)
      for (std::size_t i = 0; i < sizeof(T); ++i)
        value = static_cast<T>(value | static_cast<T>(bytes_[at_++]) << (8 * i));
    return values;
  }
  std::string text() {
    const std::vector<std::uint8_t> values = list<std::uint8_t>();
    return {values.begin(), values.end()};
  }
  bool at_end() const { return at_ == end_; }

 private:
  void need(std::size_t count) const {
    if (end_ - at_ < count) refuse("the data end too early");
  }
  const std::vector<std::uint8_t>& bytes_;
  std::size_t end_;
  std::size_t at_ = 0;
};

std::uint64_t checksum(const std::vector<std::uint8_t>& bytes, std::size_t count) {
  std::uint64_t sum = count;
  for (std::size_t i = 0; i < count; ++i) sum = mix_bits(sum ^ bytes[i]);
  return sum;
}

std::vector<std::uint32_t> to_list(const std::array<std::uint32_t, 256>& values) {
  return {values.begin(), values.end()};
}

void read_classes(Reader& in, std::array<std::uint32_t, 256>& out, int count) {
  const std::vector<std::uint32_t> values = in.list<std::uint32_t>();
  if (values.size() != out.size()) refuse("the number of labels differs");
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (values[i] >= static_cast<std::uint32_t>(count) && values[i] != synth::no_class)
      refuse("an unknown class");
    out[i] = values[i];
  }
}

}  // namespace

std::vector<std::uint8_t> pack_plan(const SynthesisPlan& plan) {
  const SynthesisPlanData& data = plan.data();
  Writer out;
  out.text(magic);
  out.number(data.digest);
  for (const int value :
       {data.sheet.width, data.sheet.height, data.sheet.level, data.sheet.tile_px})
    out.number(value);
  const SynthesisParameters& parameters = data.setup.parameters;
  out.number(parameters.seed);
  out.number(parameters.neighbourhood);
  out.number(parameters.surroundings_of == "all" ? 1 : 0);
  out.number(parameters.copy_cap);
  out.number(std::bit_cast<std::uint64_t>(parameters.reuse));
  out.number(data.setup.roles.size());
  for (std::size_t g = 0; g < data.setup.roles.size(); ++g) {
    out.text(data.setup.guide_names[g]);
    out.number(data.setup.roles[g].weight_q4);
  }
  const synth::Classes& classes = data.setup.classes;
  out.number(classes.count);
  for (const auto* table : {&classes.of_exemplar, &classes.of_target, &classes.around})
    out.list(to_list(*table));
  out.number(data.setup.around_price.weight_q8());
  out.list(data.setup.around_price.pairs());
  out.list(data.matches);
  out.list(data.demand.counts);
  for (const std::vector<std::uint8_t>& errors : data.usual_errors) out.list(errors);
  out.number(checksum(out.bytes(), out.bytes().size()));
  return std::move(out.bytes());
}

SynthesisPlan unpack_plan(const std::vector<std::uint8_t>& bytes,
                          const std::vector<Exemplar>& exemplars) {
  if (bytes.size() < 8) refuse("the data end too early");
  Reader in(bytes, bytes.size() - 8);
  if (in.text() != magic) refuse("not a synthesis plan");
  std::uint64_t stored = 0;
  for (std::size_t i = 0; i < 8; ++i)
    stored |= static_cast<std::uint64_t>(bytes[bytes.size() - 8 + i]) << (8 * i);
  if (stored != checksum(bytes, bytes.size() - 8)) refuse("the data are damaged");
  auto data = std::make_unique<SynthesisPlanData>();
  data->digest = in.number();
  for (int* value :
       {&data->sheet.width, &data->sheet.height, &data->sheet.level, &data->sheet.tile_px})
    *value = in.small_number();
  if (data->sheet.width < 1 || data->sheet.height < 1 || data->sheet.level > max_levels_in_tiles ||
      data->sheet.tile_px < 1)
    refuse("the sheet is missing");
  SynthesisParameters& parameters = data->setup.parameters;
  parameters.seed = in.number();
  parameters.neighbourhood = in.small_number();
  if (parameters.neighbourhood % 2 == 0 || parameters.patch_radius() < 1 ||
      parameters.patch_radius() > synth::largest_patch_radius)
    refuse("a neighbourhood out of range");
  if (in.number() != 0) parameters.surroundings_of = "all";
  parameters.copy_cap = in.small_number();
  parameters.reuse = std::bit_cast<double>(in.number());
  const int guides = in.small_number();
  for (int g = 0; g < guides; ++g) {
    data->setup.guide_names.push_back(in.text());
    data->setup.roles.push_back(
        {in.weight(16 * static_cast<std::uint64_t>(synth::price::guide) * synth::max_weight)});
  }
  synth::Classes& classes = data->setup.classes;
  classes.count = in.small_number();
  for (auto* table : {&classes.of_exemplar, &classes.of_target, &classes.around})
    read_classes(in, *table, classes.count);
  const std::int64_t weight_q8 =
      in.weight(static_cast<std::uint64_t>(synth::price::surroundings_q8) * synth::max_weight);
  data->setup.around_price = {weight_q8, in.list<std::uint8_t>(), classes.count};
  if (data->setup.around_price.pairs().size() !=
      static_cast<std::size_t>(classes.count) * static_cast<std::size_t>(classes.count))
    refuse("the pairs of classes have another size");
  data->matches = in.list<std::uint32_t>();
  data->demand.counts = in.list<std::uint32_t>();
  data->demand.keys = synth::choose_list_keys(data->setup.roles);
  for (int level = 0; level < data->sheet.level && classes.count > 0; ++level)
    data->usual_errors.push_back(in.list<std::uint8_t>());
  if (!in.at_end()) refuse("there are data after the plan");
  const std::size_t pixels = static_cast<std::size_t>(data->sheet.plan_width()) *
                             static_cast<std::size_t>(data->sheet.plan_height());
  const std::size_t asked = static_cast<std::size_t>(classes.count) *
                            static_cast<std::size_t>(data->demand.keys.buckets()) * 256;
  if (data->matches.size() != pixels || data->demand.counts.size() != asked)
    refuse("the tables have another size");

  for (const Exemplar& exemplar : exemplars) check_exemplar(exemplar);
  std::vector<synth::Plane> planes{synth::exemplar_plane(exemplars, data->setup)};
  if (digest_of(planes[0]) != data->digest)
    throw Error(ErrorKind::input, "plan of synthesis", "the plan was made with other exemplars",
                "the same exemplars in the same order");
  for (int level = 0; level < data->sheet.level; ++level)
    planes.push_back(synth::halve(planes.back()));
  make_sources(*data, std::move(planes));
  for (std::size_t l = 0; l < data->sources.size(); ++l)
    data->sources[l]->usual_error = data->usual_errors[l];
  return SynthesisPlan(std::move(data));
}

}  // namespace belvedere
