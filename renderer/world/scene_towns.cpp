#include "renderer/world/scene_towns.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "renderer/world/scene_position.h"
#include "terrain/cover/town_file.h"

#include "base/math_exact.h"

namespace belvedere {
namespace {

// From the terrain's border, 0 inside.
double distance_outside_m(const Dem& dem, glm::dvec2 position) {
  const glm::dvec2 low = dem.transform.to_crs(-0.5, dem.height() - 0.5);
  const glm::dvec2 high = dem.transform.to_crs(dem.width() - 0.5, -0.5);
  const double east = std::max({low.x - position.x, position.x - high.x, 0.0});
  const double north = std::max({low.y - position.y, position.y - high.y, 0.0});
  return exact::hypot(east, north);
}

void note_outside(const std::vector<std::string>& names, Progress& progress) {
  constexpr std::size_t max_named = 5;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), max_named); ++i)
    list += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > max_named) list += fmt::format(" and {} more", names.size() - max_named);
  progress.note(fmt::format(
      "{} outside the terrain: {}",
      names.size() == 1 ? "a town lies" : fmt::format("{} towns lie", names.size()), list));
}

}  // namespace

std::vector<KnownTown> make_scene_towns(const LoadedScene& loaded, const Dem& dem,
                                        Progress& progress) {
  const SceneLandCover& cover = loaded.scene.land_cover;
  std::vector<KnownTown> towns;
  for (std::size_t i = 0; i < cover.towns.size(); ++i) {
    const SceneTown& town = cover.towns[i];
    const std::string key = fmt::format("land_cover.towns.{}", i);
    towns.push_back({.position = resolve_place(dem, town.position, town.position_lonlat, key),
                     .radius_m = town.radius_m,
                     .name = town.name});
  }
  if (!cover.towns_file.empty()) {
    VectorSource source = cover.towns_source;
    source.path = find_scene_file(loaded, cover.towns_file);
    const std::vector<KnownTown> read = read_towns(source, dem.crs, progress);
    towns.insert(towns.end(), read.begin(), read.end());
  }

  constexpr double farthest_m = 20000.0;
  std::vector<std::string> outside;
  for (const KnownTown& town : towns)
    if (distance_outside_m(dem, town.position) > 0.0)
      outside.push_back(town.name.empty()
                            ? fmt::format("E {:.0f} N {:.0f}", town.position.x, town.position.y)
                            : town.name);
  if (!outside.empty()) note_outside(outside, progress);
  std::erase_if(towns, [&](const KnownTown& town) {
    return distance_outside_m(dem, town.position) > farthest_m + 5.0 * town.radius_m;
  });
  return towns;
}

}  // namespace belvedere
