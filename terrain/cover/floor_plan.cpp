#include "terrain/cover/floor_plan.h"

#include <algorithm>
#include <cmath>

#include "base/filter.h"
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

}  // namespace belvedere
