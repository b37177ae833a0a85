#include "renderer/trace/terrain_model.h"

#include <fmt/core.h>

#include <utility>

#include "base/error.h"
#include "base/filter.h"
#include "base/parallel.h"
#include "renderer/trace/ground_surroundings.h"
#include "terrain/shape/derivatives.h"

namespace belvedere {
namespace {

void check_ground(const Dem& dem, const Grid<float>& generalized_m, const LandCover* land_cover) {
  if (!dem.altitude_m.same_size(generalized_m)) {
    throw Error(ErrorKind::bug, "terrain model",
                fmt::format("a generalized grid of {} × {} cells", generalized_m.width(),
                            generalized_m.height()),
                fmt::format("the DEM's {} × {}", dem.width(), dem.height()));
  }
  if (land_cover == nullptr || land_cover->classes.cells.empty())
    throw Error(ErrorKind::bug, "terrain model", "land cover without cells",
                "classes for the DEM's ground");
}

// relief() where the inner mean already exists.
Grid<float> relief_to(const Grid<float>& inner_m, const Grid<float>& altitude_m,
                      double outer_cells) {
  Grid<float> out = gaussian_blur(altitude_m, outer_cells);
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x) out(x, y) = inner_m(x, y) - out(x, y);
  });
  return out;
}

}  // namespace

TerrainModel make_terrain_model(std::shared_ptr<const Dem> dem, Grid<float> generalized_m,
                                std::shared_ptr<const LandCover> land_cover, double exaggeration,
                                Catchments* catchments) {
  check_ground(*dem, generalized_m, land_cover.get());
  GroundSurroundings surroundings = find_surroundings(*dem, *land_cover, catchments);
  return make_terrain_model(std::move(dem), std::move(generalized_m), std::move(land_cover),
                            exaggeration, std::move(surroundings));
}

TerrainModel make_terrain_model(std::shared_ptr<const Dem> dem, Grid<float> generalized_m,
                                std::shared_ptr<const LandCover> land_cover, double exaggeration,
                                GroundSurroundings surroundings) {
  check_ground(*dem, generalized_m, land_cover.get());
  TerrainModel model;
  const Grid<float>& z = dem->altitude_m;
  model.detail_smooth_m = gaussian_blur(z, dem->blur_cells(60.0));
  model.shape_smooth_m = gaussian_blur(generalized_m, dem->blur_cells(120.0));
  {
    const Grid<float> inner_m = gaussian_blur(z, dem->blur_cells(30.0));
    model.relief_s_m = relief_to(inner_m, z, dem->blur_cells(180.0));
    model.relief_m_m = relief_to(inner_m, z, dem->blur_cells(750.0));
  }
  model.relief_l_m = relief(z, 1.0, dem->blur_cells(120.0), dem->blur_cells(1800.0));
  model.valley_height_m = std::move(surroundings.valley_height_m);
  model.rim_m = std::move(surroundings.rim_m);
  model.flow = std::move(surroundings.flow);
  model.floor_plan = std::move(surroundings.floor_plan);
  model.dem = std::move(dem);
  model.generalized_m = std::move(generalized_m);
  model.land_cover = std::move(land_cover);
  model.exaggeration = exaggeration;
  return model;
}

const TerrainModel& ground_of(const TerrainModel& terrain, int window) {
  return window == 0 ? terrain : terrain.windows[static_cast<std::size_t>(window) - 1].ground;
}

}  // namespace belvedere
