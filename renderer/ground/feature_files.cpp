#include "renderer/ground/feature_files.h"

#include <fmt/core.h>

#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/kept_files.h"
#include "terrain/io/crs.h"

namespace belvedere {
namespace {

// Whether features of a block can become ground; with a kind column they can.
bool may_be_ground(const FeatureStyle& style, const FeatureSource& source) {
  if (!source.kind_of.empty()) return true;
  const int kind = style.find(source.kind);
  return kind < 0 || becomes_ground(style.kinds[static_cast<std::size_t>(kind)]);
}

std::string extent_of(const MapBox& box) {
  return fmt::format("E {:.0f} … {:.0f}, N {:.0f} … {:.0f}", box.low.x, box.high.x, box.low.y,
                     box.high.y);
}

}  // namespace

MapBox box_of(const Dem& dem) {
  return {dem.transform.to_crs(-0.5, dem.height() - 0.5),
          dem.transform.to_crs(dem.width() - 0.5, -0.5)};
}

FeatureStyle read_scene_feature_style(const LoadedScene& loaded) {
  const std::string file = find_named_file(loaded, "features", loaded.scene.features_style);
  return *loaded.kept->get<FeatureStyle>("feature style " + file, {file},
                                         [&] { return load_feature_style(file); });
}

std::vector<FeatureSource> feature_sources(const LoadedScene& loaded) {
  std::vector<FeatureSource> sources;
  for (std::size_t i = 0; i < loaded.scene.features.size(); ++i) {
    const SceneFeatures& block = loaded.scene.features[i];
    if (!block.enabled) continue;
    VectorSource file = block.file;
    file.path = find_scene_file(loaded, block.source);
    if (file.path.empty()) continue;
    sources.push_back({.file = std::move(file),
                       .layer = block.layer,
                       .where = block.where,
                       .kind = block.kind,
                       .kind_of = block.kind_of,
                       .width_mm = block.width_mm,
                       .width_of = block.width_of,
                       .level_of = block.level_of,
                       .population_of = block.population_of,
                       .block = static_cast<int>(i),
                       .key = fmt::format("features.{}", i)});
  }
  return sources;
}

FeatureSet read_ground_features(const LoadedScene& loaded, const FeatureStyle& style,
                                const Dem& dem, Progress& progress) {
  const MapBox ground = box_of(dem);
  std::vector<FeatureSource> sources = feature_sources(loaded);
  std::erase_if(sources,
                [&](const FeatureSource& source) { return !may_be_ground(style, source); });
  FeatureSet set = read_feature_set(style, sources, dem.crs, ground);
  // With a kind column, the features outside the terrain may all be drawn kinds: the drawing code
  // reports those.
  std::vector<bool> all_ground;
  for (const FeatureSource& source : sources) all_ground.push_back(source.kind_of.empty());
  for (std::size_t r = 0; r < set.readings.size(); ++r) {
    const SourceReading& reading = set.readings[r];
    if (reading.at_zero > 0)
      progress.note(fmt::format("{}: {} features are at 0, 0", reading.file, reading.at_zero));
    if (reading.beside == 0) continue;
    if (all_ground[r] && reading.taken + reading.wrong_shape + reading.unknown.size() == 0)
      throw Error(
          ErrorKind::usage, reading.file,
          fmt::format("none of {} features lies on the terrain; their extent is {}", reading.beside,
                      extent_of({reading.low, reading.high})),
          fmt::format("coordinates within {} ({}), or a file that states its own coordinate system",
                      extent_of(ground), describe_crs(dem.crs)));
    progress.note(
        fmt::format("{}: {} features are outside the terrain", reading.file, reading.beside));
  }
  return set;
}

}  // namespace belvedere
