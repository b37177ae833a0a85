#include "texture/sheet/synthesis_plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "texture/sheet/plan_data.h"
#include "texture/synthesis/synthesize.h"

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

// Of all bytes, eight at a time, in fixed chunks.
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

}  // namespace belvedere
