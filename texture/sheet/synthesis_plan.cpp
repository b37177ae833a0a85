#include "texture/sheet/synthesis_plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "base/cache/bytes.h"
#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "texture/sheet/plan_data.h"
#include "texture/synthesis/synthesize.h"

// A plan as bytes: its fields, and a checksum of them at the end.

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
  digest = mix_bits(digest ^ digest_of_values(plane.cuts));
  return plane.known.empty() ? digest : mix_bits(digest ^ digest_of_values(plane.known));
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

constexpr std::string_view magic = "belvedere synthesis plan 4\n";

struct PackedGuide {
  std::string name;
  std::int64_t weight_q4 = 0;
};

struct PackedPlan {
  std::string magic;
  std::uint64_t digest = 0;
  SynthesisSheet sheet;
  std::uint64_t seed = 0;
  int neighbourhood = 0;
  std::uint8_t all_surroundings = 0;
  std::uint8_t normalized = 0;
  int copy_cap = 0;
  double reuse = 0.0;
  std::vector<PackedGuide> guides;
  synth::Classes classes;
  std::int64_t around_weight_q8 = 0;
  std::vector<std::uint8_t> around_pairs;
  std::vector<std::uint32_t> matches, demand;
  std::vector<std::vector<std::uint8_t>> usual_errors;
};

void each_field(auto& bytes, FieldsOf<PackedGuide> auto& guide) {
  auto& [name, weight_q4] = guide;
  bytes(name, weight_q4);
}

void each_field(auto& bytes, FieldsOf<PackedPlan> auto& plan) {
  auto& [title, digest, sheet, seed, neighbourhood, all_surroundings, normalized, copy_cap, reuse,
         guides, classes, around_weight_q8, around_pairs, matches, demand, usual_errors] = plan;
  bytes(title, digest, sheet, seed, neighbourhood, all_surroundings, normalized, copy_cap, reuse,
        guides, classes, around_weight_q8, around_pairs, matches, demand, usual_errors);
}

[[noreturn]] void refuse(const std::string& found) {
  throw Error(ErrorKind::input, "plan of synthesis", found, "a complete plan of this version");
}

void require_weight(std::int64_t weight, std::int64_t price) {
  if (weight < 0 || weight > price * synth::max_weight) refuse("a weight out of range");
}

std::uint64_t checksum(const std::vector<std::uint8_t>& bytes, std::size_t count) {
  std::uint64_t sum = count;
  for (std::size_t i = 0; i < count; ++i) sum = mix_bits(sum ^ bytes[i]);
  return sum;
}

void check_classes(const std::array<std::uint32_t, 256>& classes, int count) {
  for (const std::uint32_t id : classes)
    if (id >= static_cast<std::uint32_t>(count) && id != synth::no_class)
      refuse("an unknown class");
}

}  // namespace

std::vector<std::uint8_t> pack_plan(const SynthesisPlan& plan) {
  const SynthesisPlanData& data = plan.data();
  const SynthesisParameters& parameters = data.setup.parameters;
  PackedPlan packed{.magic = std::string(magic),
                    .digest = data.digest,
                    .sheet = data.sheet,
                    .seed = parameters.seed,
                    .neighbourhood = parameters.neighbourhood,
                    .all_surroundings = parameters.surroundings_of == "all",
                    .normalized = parameters.distance == "normalized",
                    .copy_cap = parameters.copy_cap,
                    .reuse = parameters.reuse,
                    .guides = {},
                    .classes = data.setup.classes,
                    .around_weight_q8 = data.setup.around_price.weight_q8(),
                    .around_pairs = data.setup.around_price.pairs(),
                    .matches = data.matches,
                    .demand = data.demand.counts,
                    .usual_errors = data.usual_errors};
  for (std::size_t g = 0; g < data.setup.roles.size(); ++g)
    packed.guides.push_back({data.setup.guide_names[g], data.setup.roles[g].weight_q4});
  ByteWriter writer;
  writer(packed);
  std::vector<std::uint8_t> out;
  for (const std::span<const std::byte> part : writer.parts())
    for (const std::byte byte : part) out.push_back(static_cast<std::uint8_t>(byte));
  const std::uint64_t sum = checksum(out, out.size());
  for (int i = 0; i < 8; ++i) out.push_back(static_cast<std::uint8_t>(sum >> (8 * i)));
  return out;
}

SynthesisPlan unpack_plan(const std::vector<std::uint8_t>& bytes,
                          const std::vector<Exemplar>& exemplars) {
  if (bytes.size() < 8) refuse("the data end too early");
  const std::size_t content = bytes.size() - 8;
  std::uint64_t stored = 0;
  for (std::size_t i = 0; i < 8; ++i)
    stored |= static_cast<std::uint64_t>(bytes[content + i]) << (8 * i);
  if (stored != checksum(bytes, content)) refuse("the data are damaged");
  PackedPlan packed;
  ByteReader reader(std::as_bytes(std::span(bytes).first(content)));
  reader(packed);
  if (!reader.is_done() || packed.magic != magic) refuse("not a synthesis plan");
  auto data = std::make_unique<SynthesisPlanData>();
  data->digest = packed.digest;
  data->sheet = packed.sheet;
  if (data->sheet.width < 1 || data->sheet.height < 1 || data->sheet.level < 0 ||
      data->sheet.level > max_levels_in_tiles || data->sheet.tile_px < 1)
    refuse("the sheet is missing");
  SynthesisParameters& parameters = data->setup.parameters;
  parameters.seed = packed.seed;
  parameters.neighbourhood = packed.neighbourhood;
  if (parameters.neighbourhood % 2 == 0 || parameters.patch_radius() < 1 ||
      parameters.patch_radius() > synth::largest_patch_radius)
    refuse("a neighbourhood out of range");
  if (packed.all_surroundings != 0) parameters.surroundings_of = "all";
  if (packed.normalized != 0) parameters.distance = "normalized";
  if (packed.copy_cap < 0) refuse("a number out of range");
  parameters.copy_cap = packed.copy_cap;
  parameters.reuse = packed.reuse;
  for (PackedGuide& guide : packed.guides) {
    require_weight(guide.weight_q4, std::int64_t{16} * synth::price::guide);
    data->setup.guide_names.push_back(std::move(guide.name));
    data->setup.roles.push_back({guide.weight_q4});
  }
  synth::Classes& classes = data->setup.classes;
  classes = packed.classes;
  if (classes.count < 0) refuse("a number out of range");
  for (const auto* table : {&classes.of_exemplar, &classes.of_target, &classes.around})
    check_classes(*table, classes.count);
  require_weight(packed.around_weight_q8, synth::price::surroundings_q8);
  data->setup.around_price = {packed.around_weight_q8, std::move(packed.around_pairs),
                              classes.count};
  if (data->setup.around_price.pairs().size() !=
      static_cast<std::size_t>(classes.count) * static_cast<std::size_t>(classes.count))
    refuse("the pairs of classes have another size");
  data->matches = std::move(packed.matches);
  data->demand.counts = std::move(packed.demand);
  data->demand.keys = synth::choose_list_keys(data->setup.roles);
  data->usual_errors = std::move(packed.usual_errors);
  if (data->usual_errors.size() !=
      (classes.count > 0 ? static_cast<std::size_t>(data->sheet.level) : 0))
    refuse("the errors are of other levels");
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
