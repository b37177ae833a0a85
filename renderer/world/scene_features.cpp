#include "renderer/world/scene_features.h"

#include <fmt/core.h>

#include <algorithm>
#include <glm/common.hpp>
#include <iterator>
#include <utility>
#include <vector>

#include "base/error.h"
#include "renderer/ground/laid_rivers.h"
#include "renderer/ground/scene_ground_map.h"
#include "terrain/io/crs.h"

namespace belvedere {
namespace {

std::string features_of(std::size_t count) {
  return count == 1 ? "a feature" : fmt::format("{} features", count);
}

// Counts and reasons of the features that a reading leaves out, in one line; empty if none.
std::string left_out(const SourceReading& reading) {
  std::string text;
  const auto add = [&](std::size_t count, const std::string& why) {
    if (count > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", features_of(count), why);
  };
  add(reading.without_shape, "without coordinates");
  add(reading.unplaceable, "outside the valid area of the terrain's coordinate system");
  add(reading.wrong_shape, "of a geometry type that does not fit their kind");
  std::size_t unknown = 0;
  std::vector<std::pair<std::size_t, std::string>> words;
  for (const auto& [word, count] : reading.unknown) {
    unknown += count;
    words.emplace_back(count, word);
  }
  std::sort(words.begin(), words.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  std::string named;
  for (std::size_t i = 0; i < words.size() && i < 5; ++i)
    named += fmt::format("{}\"{}\"", named.empty() ? "" : ", ", words[i].second);
  if (unknown > 0)
    add(unknown, fmt::format("of kinds that the style does not contain ({}{})", named,
                             words.size() > 5 ? " …" : ""));
  return text;
}

// From maps and inferred; windows of finer ground infer them again.
std::vector<CoverRiver> rivers_of(const World& world) {
  std::vector<CoverRiver> rivers;
  const auto add = [&](const std::shared_ptr<const MapCover>& map) {
    if (map == nullptr) return;
    std::copy_if(map->centrelines().begin(), map->centrelines().end(), std::back_inserter(rivers),
                 [](const CoverRiver& river) { return river.kind != shore_kind; });
  };
  add(world.land_cover->map);
  add(world.land_cover->inferred);
  for (const TerrainWindow& window : world.terrain.windows) add(window.ground.land_cover->inferred);
  return rivers;
}

}  // namespace

FeatureSet read_scene_features(const LoadedScene& loaded, const std::string& crs,
                               Progress& progress) {
  const Scene& scene = loaded.scene;
  if (!scene.any_features()) return {};
  for (const SceneFeatures& block : scene.features) {
    if (!block.enabled || !find_scene_file(loaded, block.source).empty()) continue;
    if (!block.optional) throw missing_scene_file(loaded, block.source);
    progress.note(fmt::format("{} is left out: file not found{}{}", block.source,
                              similar_scene_file_hint(loaded, block.source),
                              block.get_from.empty() ? "" : "; " + block.get_from));
  }
  FeatureSet set = read_feature_set(read_scene_feature_style(loaded), feature_sources(loaded), crs);
  for (const SourceReading& reading : set.readings)
    if (const std::string text = left_out(reading); !text.empty())
      progress.note(fmt::format("{}: left out {}", reading.file, text));
  return set;
}

bool lies_beside(const Feature& feature, const Dem& dem) {
  const MapBox ground = box_of(dem);
  MapBox extent{feature.parts[0][0], feature.parts[0][0]};
  for (const auto& part : feature.parts)
    for (const glm::dvec2 position : part) {
      extent.low = glm::min(extent.low, position);
      extent.high = glm::max(extent.high, position);
    }
  return extent.high.x < ground.low.x || extent.high.y < ground.low.y ||
         extent.low.x > ground.high.x || extent.low.y > ground.high.y;
}

void check_extents(const FeatureSet& set, const Dem& dem) {
  std::vector<std::size_t> outside(set.readings.size(), 0);
  std::vector<std::size_t> all(set.readings.size(), 0);
  for (const Feature& feature : set.features) {
    const auto s = static_cast<std::size_t>(feature.source);
    ++all[s];
    outside[s] += lies_beside(feature, dem) ? 1 : 0;
  }
  const MapBox ground = box_of(dem);
  const std::string allowed = fmt::format(
      "positions within E {:.0f} … {:.0f}, N {:.0f} … {:.0f}{}; a file that states its own "
      "coordinate system",
      ground.low.x, ground.high.x, ground.low.y, ground.high.y,
      dem.crs.empty() ? "" : " (" + describe_crs(dem.crs) + ")");
  for (std::size_t s = 0; s < set.readings.size(); ++s) {
    const SourceReading& reading = set.readings[s];
    if (all[s] == 0 && reading.unplaceable > 0 &&
        reading.taken + reading.wrong_shape + reading.unknown.size() == 0)
      throw Error(
          ErrorKind::usage, reading.file,
          fmt::format(
              "none of {} features lies in the valid area of the terrain's coordinate system",
              reading.unplaceable),
          allowed);
    if (all[s] == 0 || outside[s] < all[s]) continue;
    throw Error(ErrorKind::usage, reading.file,
                fmt::format("none of {} features lies on the terrain: they lie E {:.0f} … {:.0f}, "
                            "N {:.0f} … {:.0f}",
                            all[s], reading.low.x, reading.high.x, reading.low.y, reading.high.y),
                allowed);
  }
}

DrawnFeatures draw_scene_features(const LoadedScene& loaded, const World& world, bool winter,
                                  Progress& progress) {
  const std::vector<CoverRiver> rivers = rivers_of(world);
  if (!loaded.scene.any_features() && rivers.empty()) return {};
  FeatureSet set;
  if (!loaded.scene.any_features())
    set.style = read_scene_feature_style(loaded);
  else
    set = read_scene_features(loaded, world.dem->crs, progress);
  progress.begin("laying features on the ground", 0.0);
  const GroundSight sight(world.dem->transform, *world.surface, *world.camera, world.tracer,
                          world.terrain.goes_to);
  DrawnFeatures drawn =
      draw_features(set, sight,
                    {.winter = winter,
                     .px_per_mm = world.scene.output.width / world.scene.output.sheet_width_mm,
                     .seed = world.scene.seed,
                     .sun = world.view.sun_direction,
                     .light_field = world.light_field},
                    rivers);
  check_extents(set, *world.dem);
  return drawn;
}

}  // namespace belvedere
