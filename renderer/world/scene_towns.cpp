#include "renderer/world/scene_towns.h"

#include <fmt/core.h>

#include <algorithm>

#include "renderer/world/view.h"
#include "renderer/world/viewer_check.h"

namespace belvedere {
namespace {

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
  const DataExtent ground = extent_of(dem);
  std::vector<std::string> outside;
  for (const KnownTown& town : towns)
    if (ground.distance_outside_m(town.position) > 0.0)
      outside.push_back(town.name.empty()
                            ? fmt::format("E {:.0f} N {:.0f}", town.position.x, town.position.y)
                            : town.name);
  if (!outside.empty()) note_outside(outside, progress);
  std::erase_if(towns, [&](const KnownTown& town) {
    return ground.distance_outside_m(town.position) > farthest_m + 5.0 * town.radius_m;
  });
  return towns;
}

}  // namespace belvedere
