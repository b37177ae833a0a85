#include "renderer/trace/terrain_model.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/error.h"
#include "base/filter.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "terrain/shape/derivatives.h"

namespace belvedere {
namespace {

constexpr double street_m = 110.0;  // houses along one street are one neighbourhood
constexpr double town_m = 450.0;    // larger than a village, smaller than a town
constexpr double edge_m =
    60.0;  // smoothing of banks and slope feet before their direction is computed
constexpr double grain_m = 340.0;      // distance over which a bank or slope foot aligns fields
constexpr float min_gradient = 1e-5F;  // squared, per cell; less is not an edge

Grid<float> class_mask(const LandCover& cover, const Dem& dem, LandCoverClass requested) {
  const Grid<LandCoverClass>& cells = cover.classes.cells;
  Grid<float> mask(dem.width(), dem.height());
  const bool own_cells =
      cover.classes.transform == dem.transform && cells.same_size(dem.altitude_m);
  parallel_rows(dem.height(), [&](int y) {
    if (own_cells) {  // almost always: each cell is its own nearest
      for (int x = 0; x < dem.width(); ++x) mask(x, y) = cells(x, y) == requested ? 1.F : 0.F;
      return;
    }
    for (int x = 0; x < dem.width(); ++x) {
      const glm::dvec2 position = dem.transform.to_crs(x, y);
      const glm::dvec2 at = cover.classes.transform.to_cell(position.x, position.y);
      mask(x, y) = cells.clamped(static_cast<int>(std::lround(at.x)),
                                 static_cast<int>(std::lround(at.y))) == requested
                       ? 1.F
                       : 0.F;
    }
  });
  return mask;
}

}  // namespace

FloorPlan plan_floor(const LandCover& land_cover, const Dem& dem) {
  const double cell = dem.cell_m();
  const int width = dem.width();
  const int height = dem.height();
  FloorPlan plan;
  const Grid<float> houses = class_mask(land_cover, dem, LandCoverClass::settlement);
  const Grid<float> street = gaussian_blur(houses, street_m / cell);
  const Grid<float> town = gaussian_blur(houses, town_m / cell);
  plan.built = Grid<float>(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x)
      plan.built(x, y) = std::clamp(street(x, y) * (0.35F + 0.65F * town(x, y)), 0.F, 1.F);
  });

  // Edges that align fields: banks, and the foot of the slopes. Their structure tensor gives the
  // direction.
  Grid<float> edges =
      gaussian_blur(class_mask(land_cover, dem, LandCoverClass::water), edge_m / cell);
  const Grid<float> slope = slope_deg(gaussian_blur(dem.altitude_m, edge_m / cell),
                                      dem.transform.cell_x, dem.transform.cell_y);
  Grid<float> rises(width, height);  // 0 on the floor, 1 on slopes
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) rises(x, y) = std::clamp((slope(x, y) - 3.F) / 6.F, 0.F, 1.F);
  });
  Grid<float> difference(width, height);  // g_x² - g_y²
  Grid<float> product(width, height);     // 2 g_x g_y
  Grid<float> sum(width, height);         // g_x² + g_y²
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const auto add = [&](float gx, float gy, float weight) {
        difference(x, y) += weight * (gx * gx - gy * gy);
        product(x, y) += weight * 2.F * gx * gy;
        sum(x, y) += weight * (gx * gx + gy * gy);
      };
      add(edges.clamped(x + 1, y) - edges.clamped(x - 1, y),
          edges.clamped(x, y - 1) - edges.clamped(x, y + 1), 2.F);
      add(rises.clamped(x + 1, y) - rises.clamped(x - 1, y),
          rises.clamped(x, y - 1) - rises.clamped(x, y + 1), slope(x, y) < 9.F ? 1.F : 0.F);
    }
  });
  const double sigma = grain_m / cell;
  difference = gaussian_blur(difference, sigma);
  product = gaussian_blur(product, sigma);
  sum = gaussian_blur(sum, sigma);
  plan.grain = Grid<glm::vec2>(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      // An edge is perpendicular to its gradient: the doubled angle is turned by half a circle.
      const float scale = 1.F / (sum(x, y) + min_gradient);
      plan.grain(x, y) = {-difference(x, y) * scale, -product(x, y) * scale};
    }
  });
  return plan;
}

namespace {

// Ground rises above the region from so many standard deviations above its mean altitude; each
// further one lifts it by this share of the region's shorter side. The default fade is about .03 of
// the side, so that a summit at four deviations keeps its own colour even at the edge.
constexpr double tall_deviations = 2.5;
constexpr double lift_of_side = 0.02;
constexpr double max_lift_of_side =
    0.03;  // such a body has lost nothing: more would only reach farther
// m of lift lost per m of ground. Below 1 ground straight before a mountain is never nearer to the
// end than the mountain; .25 allows lines of sight 75° off that direction, almost along the edge.
constexpr double lift_slope = 0.25;

// 1 where the known terrain ends: the border's own posts and the filled voids that reach the
// border. A filled void inside known terrain is not an edge.
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
    for (const glm::ivec2 step :
         {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
      const glm::ivec2 next = at + step;
      if (dem.filled.contains(next.x, next.y) && dem.filled(next.x, next.y) != 0)
        mark(next.x, next.y);
    }
  }
  return out;
}

// Every post of a grid raised to the cones that fall from all others by so much a column, a row and
// a diagonal. Two passes over the grid.
void raise_to_cones(Grid<float>& grid, float column, float row, float diagonal) {
  const int width = grid.width();
  const int height = grid.height();
  const auto pass = [&](int step) {
    for (int k = 0; k < height; ++k) {
      const int y = step > 0 ? k : height - 1 - k;
      const bool has_row = k > 0;
      for (int j = 0; j < width; ++j) {
        const int x = step > 0 ? j : width - 1 - j;
        float best = grid(x, y);
        if (j > 0) best = std::max(best, grid(x - step, y) - column);
        if (has_row) {
          best = std::max(best, grid(x, y - step) - row);
          if (x > 0) best = std::max(best, grid(x - 1, y - step) - diagonal);
          if (x < width - 1) best = std::max(best, grid(x + 1, y - step) - diagonal);
        }
        grid(x, y) = best;
      }
    }
  };
  pass(1);
  pass(-1);
}

// The lift of mountains far above the region, 0 elsewhere.
Grid<float> lift_of_mountains(const Dem& dem, const Grid<std::uint8_t>& beyond) {
  double count = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < beyond.size(); ++i) {
    if (beyond[i] != 0) continue;
    const auto altitude = static_cast<double>(dem.altitude_m[i]);
    count += 1.0;
    sum += altitude;
    squares += altitude * altitude;
  }
  Grid<float> lift(dem.width(), dem.height(), 0.0F);
  if (count == 0.0) return lift;
  const double mean = sum / count;
  const double deviation = std::sqrt(std::max(0.0, squares / count - mean * mean));
  if (deviation <= 0.0) return lift;
  const double cell_x = std::abs(dem.transform.cell_x);
  const double cell_y = std::abs(dem.transform.cell_y);
  const double side_m = std::min(dem.width() * cell_x, dem.height() * cell_y);
  bool any = false;
  for (std::size_t i = 0; i < lift.size(); ++i) {
    const double above =
        (static_cast<double>(dem.altitude_m[i]) - mean) / deviation - tall_deviations;
    if (above <= 0.0 || beyond[i] != 0) continue;
    lift[i] = static_cast<float>(side_m * std::min(lift_of_side * above, max_lift_of_side));
    any = true;
  }
  if (any)
    raise_to_cones(lift, static_cast<float>(lift_slope * cell_x),
                   static_cast<float>(lift_slope * cell_y),
                   static_cast<float>(lift_slope * exact::hypot(cell_x, cell_y)));
  return lift;
}

}  // namespace

Grid<float> rim_distance(const Dem& dem) {
  const int width = dem.width();
  const int height = dem.height();
  const Grid<std::uint8_t> beyond = outside(dem);
  const Grid<std::int32_t> nearest = nearest_marked(beyond);
  const Grid<float> lift = lift_of_mountains(dem, beyond);
  Grid<float> distance(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const int at = nearest(x, y);
      const int across = at % width - x;
      const int down = at / width - y;
      distance(x, y) = static_cast<float>(exact::hypot(across * dem.transform.cell_x,
                                                       down * dem.transform.cell_y)) +
                       lift(x, y);
    }
  });
  return distance;
}

namespace {

// A logarithm, because areas range from a cell to a province, and a picture can distinguish a rill
// from a brook, not 500 km² from 501. Rivers that enter at the edge begin there.
Grid<float> log_upstream_area(Grid<float> area) {
  constexpr double m2_per_km2 = 1e6;
  parallel_rows(area.height(), [&](int y) {
    for (int x = 0; x < area.width(); ++x)
      area(x, y) = static_cast<float>(exact::log10(m2_per_km2 * static_cast<double>(area(x, y))));
  });
  return area;
}

}  // namespace

GroundSurroundings find_surroundings(const Dem& dem, const LandCover& land_cover,
                                     Catchments* catchments) {
  GroundSurroundings found;
  found.valley_height_m = height_above_valley(dem.altitude_m, dem.cell_m(), 900.0);
  found.rim_m = rim_distance(dem);
  Catchments own(dem);
  found.flow = log_upstream_area((catchments != nullptr ? *catchments : own).take_km2());
  found.floor_plan = plan_floor(land_cover, dem);
  return found;
}

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
