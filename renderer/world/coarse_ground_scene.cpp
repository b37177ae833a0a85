#include "renderer/world/coarse_ground_scene.h"

#include <cmath>
#include <utility>

#include "renderer/scene/draft.h"
#include "renderer/world/scene_dem.h"
#include "terrain/io/raster_io.h"

namespace belvedere {
namespace {

constexpr double draft_mcells = 2.5;

}  // namespace

GroundSize ground_size_of(const LoadedScene& loaded) {
  const SceneTerrain& terrain = loaded.scene.terrain;
  if (terrain.synthetic) {
    const SyntheticParameters& made = *terrain.synthetic;
    return {1e-6 * made.width * made.height, made.cell_m};
  }
  const RasterFrame frame = choose_frame(to_raster_sources(loaded, terrain.sources),
                                         terrain.dem.crs, terrain.dem.cell_m, terrain.dem.extent);
  return {1e-6 * frame.width * frame.height,
          0.5 * (frame.transform.cell_x + frame.transform.cell_y)};
}

LoadedScene with_coarse_ground(LoadedScene loaded, const GroundSize& ground, double max_mcells) {
  SceneTerrain& terrain = loaded.scene.terrain;
  if (terrain.synthetic || ground.mcells <= max_mcells) return loaded;
  constexpr double slightly_more = 0.05;  // of a cell's width
  terrain.dem.cell_m =
      ground.cell_m * std::ceil(std::sqrt(ground.mcells / max_mcells) - slightly_more);
  terrain.max_mcells = 0.0;
  return loaded;
}

LoadedScene make_draft_scene(LoadedScene loaded) {
  require_scene_files(loaded);
  loaded.scene = make_draft(std::move(loaded.scene));
  const GroundSize ground = ground_size_of(loaded);
  return with_coarse_ground(std::move(loaded), ground, draft_mcells);
}

}  // namespace belvedere
