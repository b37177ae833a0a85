#include "renderer/trace/terrain_model.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/filter.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "terrain/shape/derivatives.h"

namespace belvedere {
namespace {

// 1 where the known terrain ends: the border's own posts and the filled voids that reach the border. A void in the middle of known
// terrain is a flaw that filling has mended, no end of the world.
Grid<std::uint8_t> outside(const Dem& dem) {
  const int width = dem.width();
  const int height = dem.height();
  Grid<std::uint8_t> out(width, height, 0);
  std::vector<glm::ivec2> open;
  const auto mark = [&](int x, int y) {
    if (!out.contains(x, y) || out(x, y) != 0) return;
    out(x, y) = 1;
    open.emplace_back(x, y);
  };
  for (int x = 0; x < width; ++x) mark(x, 0), mark(x, height - 1);
  for (int y = 0; y < height; ++y) mark(0, y), mark(width - 1, y);
  if (dem.filled.empty()) return out;
  while (!open.empty()) {
    const glm::ivec2 at = open.back();
    open.pop_back();
    for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
      const glm::ivec2 next = at + step;
      if (dem.filled.contains(next.x, next.y) && dem.filled(next.x, next.y) != 0) mark(next.x, next.y);
    }
  }
  return out;
}

// Distance of every post to the nearest that lies outside.
Grid<float> rim_distance(const Dem& dem) {
  const int width = dem.width();
  const int height = dem.height();
  const Grid<std::int32_t> nearest = nearest_marked(outside(dem));
  Grid<float> distance(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const int at = nearest(x, y);
      const int across = at % width - x;
      const int down = at / width - y;
      distance(x, y) = static_cast<float>(exact::hypot(across * dem.transform.cell_x, down * dem.transform.cell_y));
    }
  });
  return distance;
}

// A logarithm, because areas run from a cell to a province and a picture can tell a rill from a brook, not 500 km² from 501. Where rivers
// enter at the rim they begin there.
Grid<float> log_upstream_area(Grid<float> area) {
  constexpr double m2_per_km2 = 1e6;
  parallel_rows(area.height(), [&](int y) {
    for (int x = 0; x < area.width(); ++x) area(x, y) = static_cast<float>(exact::log10(m2_per_km2 * static_cast<double>(area(x, y))));
  });
  return area;
}

}  // namespace

TerrainModel make_terrain_model(std::shared_ptr<const Dem> dem, Grid<float> generalized_m, std::shared_ptr<const LandCover> land_cover,
                                double exaggeration, Catchments* catchments) {
  if (!dem->altitude_m.same_size(generalized_m)) {
    throw Error(ErrorKind::bug, "terrain model",
                fmt::format("a generalized grid of {} × {} cells", generalized_m.width(), generalized_m.height()),
                fmt::format("the DEM's {} × {}", dem->width(), dem->height()));
  }
  if (land_cover == nullptr || land_cover->classes.cells.empty())
    throw Error(ErrorKind::bug, "terrain model", "land cover without cells", "classes for the DEM's ground");
  TerrainModel model;
  const double cell_m = dem->cell_m();
  const Grid<float>& z = dem->altitude_m;
  model.detail_smooth_m = gaussian_blur(z, 60.0 / cell_m);
  model.shape_smooth_m = gaussian_blur(generalized_m, 120.0 / cell_m);
  model.relief_s_m = relief(z, cell_m, 30.0, 180.0);
  model.relief_m_m = relief(z, cell_m, 30.0, 750.0);
  model.relief_l_m = relief(z, cell_m, 120.0, 1800.0);
  model.valley_height_m = height_above_valley(z, cell_m, 900.0);
  model.rim_m = rim_distance(*dem);
  Catchments own(*dem);
  model.flow = log_upstream_area((catchments != nullptr ? *catchments : own).take_km2());
  model.floor_plan = plan_floor(*land_cover, *dem);
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
