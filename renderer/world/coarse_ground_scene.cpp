#include "renderer/world/coarse_ground_scene.h"

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

LoadedScene make_draft_scene(LoadedScene loaded) {
  require_scene_files(loaded);
  loaded.scene = make_draft(std::move(loaded.scene));
  loaded.scene.terrain.preview_mcells = draft_mcells;
  return loaded;
}

}  // namespace belvedere
