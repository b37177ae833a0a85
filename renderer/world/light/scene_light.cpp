#include "renderer/world/light/scene_light.h"

#include <fmt/core.h>

#include <utility>

#include "base/angle.h"
#include "base/error.h"
#include "base/math_exact.h"
#include "renderer/trace/sun.h"
#include "renderer/world/scene_position.h"
#include "terrain/io/features.h"

namespace belvedere {
namespace {

// Every pixel near a region needs its distance to the outline.
constexpr std::size_t max_corners = 20000;

std::vector<glm::dvec2> outline_of(const SceneLightRegion& given, const Dem& dem,
                                   const std::string& key) {
  std::vector<glm::dvec2> ring = given.points;
  for (const glm::dvec2 lonlat : given.points_lonlat)
    ring.push_back(position_of_lonlat(dem, lonlat, key + ".points_lonlat"));
  return ring;
}

// The areas of a region's file: one ring and its holes each; none if an optional file is missing.
std::vector<std::vector<std::vector<glm::dvec2>>> areas_of(const LoadedScene& loaded,
                                                           const SceneLightRegion& given,
                                                           const Dem& dem, const std::string& key,
                                                           Progress& progress) {
  VectorSource source = given.source;
  source.path = find_scene_file(loaded, given.file);
  if (source.path.empty()) {
    if (!given.optional) throw missing_scene_file(loaded, given.file);
    progress.note(fmt::format("{} is left out: {} is missing{}{}", key, given.file,
                              similar_scene_file_hint(loaded, given.file),
                              given.get_from.empty() ? "" : "; " + given.get_from));
    return {};
  }
  if (dem.crs.empty())
    throw Error(ErrorKind::usage, key + ".file", "a file of areas on a terrain without CRS",
                "points = [[E, N], …]");
  std::vector<std::vector<std::vector<glm::dvec2>>> areas;
  std::size_t corners = 0;
  for (MapFeature& feature :
       read_map_features(source, {.layer = given.layer, .where = given.where}, dem.crs).features) {
    if (feature.shape != MapShape::area) continue;
    for (const auto& ring : feature.parts) corners += ring.size();
    areas.push_back(std::move(feature.parts));
  }
  if (areas.empty())
    throw Error(ErrorKind::usage, given.file, "it has no areas for " + key,
                "a file, layer or filter with areas");
  if (corners > max_corners)
    throw Error(ErrorKind::limit, given.file, fmt::format("its areas have {} corners", corners),
                fmt::format("at most {}: light needs no finer outline", max_corners));
  return areas;
}

// The region's sun: the picture's, turned, or its own.
glm::dvec3 sun_of(const SceneLightRegion& given, const SunPosition& picture) {
  SunPosition sun = picture;
  if (given.azimuth_deg) sun.azimuth_deg = *given.azimuth_deg;
  if (given.turn_deg) sun.azimuth_deg += *given.turn_deg;
  if (given.altitude_deg) sun.altitude_deg = *given.altitude_deg;
  return sun_direction(sun);
}

}  // namespace

std::shared_ptr<const LightField> make_light_field(const LoadedScene& loaded, const Dem& dem,
                                                   const View& view, Progress& progress) {
  const Scene& scene = loaded.scene;
  if (scene.light_regions.empty() && scene.light_clouds.empty()) return nullptr;
  if (view.sun.altitude_deg <= 0.0)
    throw Error(
        ErrorKind::usage, scene.light_regions.empty() ? "light.clouds" : "light.regions",
        fmt::format("the scene's sun stands {:.1f}° below the horizon", -view.sun.altitude_deg),
        "a sun above it");
  std::vector<LightRegion> regions;
  for (std::size_t i = 0; i < scene.light_regions.size(); ++i) {
    const SceneLightRegion& given = scene.light_regions[i];
    const std::string key = fmt::format("light.regions.{}", i);
    LightRegion region{.blend_m = given.blend_m,
                       .sun_direction = sun_of(given, view.sun),
                       .strength = given.strength,
                       .warmth = given.warmth};
    if (!given.file.empty()) {
      for (auto& area : areas_of(loaded, given, dem, key, progress)) {
        region.rings = std::move(area);
        regions.push_back(region);
      }
      continue;
    }
    if (const std::vector<glm::dvec2> ring = outline_of(given, dem, key); !ring.empty()) {
      region.rings = {ring};
    } else {
      region.centre = resolve_place(dem, given.position, given.position_lonlat, key);
      region.radius_m = given.radius_m.value_or(0.0);
    }
    regions.push_back(std::move(region));
  }
  std::vector<CloudShadow> clouds;
  for (std::size_t i = 0; i < scene.light_clouds.size(); ++i) {
    const SceneLightCloud& given = scene.light_clouds[i];
    clouds.push_back({.centre = resolve_place(dem, given.position, given.position_lonlat,
                                              fmt::format("light.clouds.{}", i)),
                      .radius_m = given.radius_m,
                      .strength = given.strength,
                      .blend_m = given.blend_m.value_or(given.radius_m)});
  }
  if (regions.empty() && clouds.empty()) return nullptr;
  const exact::Turn towards = exact::turn(to_radians(view.camera.azimuth_deg));
  return std::make_shared<const LightField>(view.sun_direction,
                                            glm::dvec2(towards.cosine, -towards.sine),
                                            std::move(regions), std::move(clouds), scene.seed);
}

}  // namespace belvedere
