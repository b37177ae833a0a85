#include "terrain/synthetic/synthetic.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/vec2.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/filter.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"
#include "terrain/synthetic/synthetic_erosion.h"
#include "terrain/synthetic/synthetic_plan.h"
#include "terrain/synthetic/synthetic_valleys.h"

namespace belvedere {
namespace {

using namespace synthetic;

void check(const SyntheticParameters& p) {
  const auto refuse = [](const std::string& key, double found, const std::string& allowed) {
    throw Error(ErrorKind::usage, "synthetic." + key, std::to_string(found), allowed);
  };
  if (p.width < 16 || p.width > 16384) refuse("width", p.width, "16…16384 cells");
  if (p.height < 16 || p.height > 16384) refuse("height", p.height, "16…16384 cells");
  if (!(p.cell_m >= 1.0 && p.cell_m <= 1000.0)) refuse("cell_m", p.cell_m, "1…1000 m");
  if (!(std::abs(p.lowest_m) <= 9000.0)) refuse("lowest_m", p.lowest_m, "-9000…9000 m");
  if (!(p.highest_m > p.lowest_m && p.highest_m <= 20000.0))
    refuse("highest_m", p.highest_m, "above lowest_m, at most 20000 m");
}

// One resolution of the landscape.
struct Level {
  double cell_m = 0.0;
  Grid<float> altitude_m;  // above the lowest outlet
  Grid<float> uplift_m;    // per step
  Grid<float> softness;
  Grid<float> inflow_km2;
  std::vector<std::int32_t> outlets;
};

// Refines cells by a factor of two with Catmull-Rom; cell centres of both grids cover the same
// ground.
Grid<float> refine(const Grid<float>& coarse) {
  // Weights at the fractions 1/4 and 3/4 between two coarse cells.
  constexpr float quarter[4] = {-0.0703125F, 0.8671875F, 0.2265625F, -0.0234375F};
  Grid<float> wide(2 * coarse.width(), coarse.height());
  parallel_rows(coarse.height(), [&](int y) {
    for (int x = 0; x < coarse.width(); ++x) {
      float left = 0.F;
      float right = 0.F;
      for (int k = 0; k < 4; ++k) {
        right += quarter[k] * coarse.clamped(x - 1 + k, y);
        left += quarter[k] * coarse.clamped(x + 1 - k, y);
      }
      wide(2 * x, y) = left;
      wide(2 * x + 1, y) = right;
    }
  });
  Grid<float> fine(wide.width(), 2 * coarse.height());
  parallel_rows(coarse.height(), [&](int y) {
    for (int x = 0; x < wide.width(); ++x) {
      float upper = 0.F;
      float lower = 0.F;
      for (int k = 0; k < 4; ++k) {
        lower += quarter[k] * wide.clamped(x, y - 1 + k);
        upper += quarter[k] * wide.clamped(x, y + 1 - k);
      }
      fine(x, 2 * y) = upper;
      fine(x, 2 * y + 1) = lower;
    }
  });
  return fine;
}

// Refines a grid and distorts it by a few cells, because rivers of the coarse grid run straight
// along its eight directions.
Grid<float> bend(const Grid<float>& grid, std::uint64_t seed) {
  constexpr float reach = 3.2F;    // cells of the finer grid
  constexpr double length = 17.0;  // of the distortion
  Grid<float> bent(grid.width(), grid.height());
  parallel_rows(grid.height(), [&](int y) {
    for (int x = 0; x < grid.width(); ++x) {
      const int inside = std::min({x, y, grid.width() - 1 - x, grid.height() - 1 - y});
      const float strength = reach * smoothstep(0.F, 12.F, static_cast<float>(inside));
      const double dx =
          static_cast<double>(strength * fractal_noise(seed + 1, x / length, y / length, 2));
      const double dy =
          static_cast<double>(strength * fractal_noise(seed + 4, x / length, y / length, 2));
      bent(x, y) = sample_bilinear(grid, x + dx, y + dy);
    }
  });
  return bent;
}

float largest(const Grid<float>& grid) { return *std::max_element(grid.begin(), grid.end()); }

// A position on the border, `along` metres clockwise from the north-west corner.
std::int32_t rim_cell(const Level& level, double along) {
  const int w = level.altitude_m.width();
  const int h = level.altitude_m.height();
  int i = static_cast<int>(along / level.cell_m) % (2 * (w + h) - 4);
  if (i < w - 1) return i;
  i -= w - 1;
  if (i < h - 1) return i * w + w - 1;
  i -= h - 1;
  if (i < w - 1) return (h - 1) * w + (w - 1 - i);
  i -= w - 1;
  return (h - 1 - i) * w;
}

// Main valleys leave and enter the map; smaller valleys leave it all around, at levels of their
// own.
void open_rim(Level& level, const Plan& plan, bool set_levels) {
  const int w = level.altitude_m.width();
  const int h = level.altitude_m.height();
  level.outlets.clear();
  level.inflow_km2 = Grid<float>(w, h, 0.F);
  std::vector<std::int32_t> mouths;
  for (int k = 0; k < plan.valleys(); ++k) {
    const bool east = plan.flows_east(k);
    const auto row = [&](double x) {
      return std::clamp(static_cast<int>(plan.valley_y(k, x) / level.cell_m), 1, h - 2);
    };
    const int out_row = row(east ? (w - 0.5) * level.cell_m : 0.0);
    const int in_row = row(east ? 0.0 : (w - 0.5) * level.cell_m);
    const std::int32_t out = out_row * w + (east ? w - 1 : 0);
    const std::int32_t in = in_row * w + (east ? 0 : w - 1);
    level.outlets.push_back(out);
    if (set_levels) level.altitude_m[static_cast<std::size_t>(out)] = 0.F;
    level.inflow_km2[static_cast<std::size_t>(in)] =
        static_cast<float>(1400.0 * plan.unit_m() * plan.unit_m());
    mouths.push_back(out);
    mouths.push_back(in);
  }
  const double rim_m = 2.0 * (w + h - 2) * level.cell_m;
  const double spacing = 11000.0 * plan.unit_m();
  const int count = std::max(4, static_cast<int>(rim_m / spacing));
  for (int i = 0; i < count; ++i) {
    const std::int32_t cell = rim_cell(
        level, (i + 0.2 + 0.6 * draw_uniform(plan.seed(), i, 0, TerrainDraw::outlet_place)) *
                   rim_m / count);
    const bool taken = std::any_of(mouths.begin(), mouths.end(), [&](std::int32_t m) {
      return exact::hypot(cell % w - m % w, cell / w - m / w) * level.cell_m <
             6000.0 * plan.unit_m();
    });
    if (taken) continue;
    level.outlets.push_back(cell);
    if (set_levels)
      level.altitude_m[static_cast<std::size_t>(cell)] =
          120.F +
          420.F * static_cast<float>(draw_uniform(plan.seed(), i, 0, TerrainDraw::outlet_level));
  }
}

// Roughness at the scale of a few cells on steep ground, mostly at high altitudes: seeds of gullies
// and ribs for the erosion.
void roughen(Level& level, const Plan& plan, float relief_m) {
  const double length = 12.0 * level.cell_m;
  const auto cell = static_cast<float>(level.cell_m);
  const Grid<float> before = level.altitude_m;
  parallel_rows(before.height(), [&](int y) {
    for (int x = 0; x < before.width(); ++x) {
      const float gx = before.clamped(x + 1, y) - before.clamped(x - 1, y);
      const float gy = before.clamped(x, y + 1) - before.clamped(x, y - 1);
      const float slope = std::sqrt(gx * gx + gy * gy) / (2.F * cell);
      const float steep = smoothstep(0.2F, 0.8F, slope);
      if (steep <= 0.F) continue;
      const double u = (x + 0.5) * level.cell_m / length;
      const double v = (y + 0.5) * level.cell_m / length;
      const double wu = u + 0.6 * static_cast<double>(gradient_noise(
                                      noise_seed(plan.seed(), TerrainNoise::roughness_bends_east),
                                      u * 0.7, v * 0.7));
      const double wv = v + 0.6 * static_cast<double>(gradient_noise(
                                      noise_seed(plan.seed(), TerrainNoise::roughness_bends_south),
                                      u * 0.7, v * 0.7));
      const float rock = 0.7F + 1.3F * smoothstep(0.35F, 0.65F, before(x, y) / relief_m);
      level.altitude_m(x, y) +=
          cell * rock * steep *
          (ridged_noise(noise_seed(plan.seed(), TerrainNoise::roughness), wu, wv, 3, 0.6F) - 0.5F);
    }
  });
}

// Debris rounds the foot of the slopes: the edges of floors are smoothed over `sigma` cells.
void soften_feet(Grid<float>& altitude_m, const Grid<float>& floor, double sigma) {
  const Grid<float> smooth = gaussian_blur(altitude_m, sigma);
  const Grid<float> share = gaussian_blur(floor, sigma);
  parallel_rows(altitude_m.height(), [&](int y) {
    for (int x = 0; x < altitude_m.width(); ++x) {
      const float s = share(x, y);
      const float edge = 4.F * s * (1.F - s);
      altitude_m(x, y) += edge * (smooth(x, y) - altitude_m(x, y));
    }
  });
}

// The nearest of `count` cells to a position; halves are rounded up.
int nearest(float position, int count) {
  return std::clamp(static_cast<int>(std::floor(static_cast<double>(position) + 0.5)), 0,
                    count - 1);
}

// Ribs and gullies of steep ground: noise stretched along the fall line (line integral convolution,
// Cabral & Leedom 1993).
void add_ribs(Level& level, const Plan& plan, float relief_m) {
  const int width = level.altitude_m.width();
  const int height = level.altitude_m.height();
  const Grid<float> smooth = gaussian_blur(level.altitude_m, 4.0);
  Grid<float> noise(width, height);
  Grid<glm::vec2> fall(width, height);  // unit vector uphill
  Grid<float> steep(width, height);
  const auto cell = static_cast<float>(level.cell_m);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const float gx = (smooth.clamped(x + 1, y) - smooth.clamped(x - 1, y)) / (2.F * cell);
      const float gy = (smooth.clamped(x, y + 1) - smooth.clamped(x, y - 1)) / (2.F * cell);
      const float slope = std::sqrt(gx * gx + gy * gy);
      const float high = smoothstep(0.3F, 0.6F, smooth(x, y) / relief_m);
      steep(x, y) = smoothstep(0.35F, 0.9F, slope) * (0.35F + 0.65F * high);
      fall(x, y) = slope > 1e-6F ? glm::vec2(gx, gy) / slope : glm::vec2(0.F);
      noise(x, y) =
          gradient_noise(noise_seed(plan.seed(), TerrainNoise::slope_ribs), x / 3.1, y / 3.1) +
          0.8F * gradient_noise(noise_seed(plan.seed(), TerrainNoise::broad_slope_ribs), x / 7.3,
                                y / 7.3);
    }
  });
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      if (steep(x, y) <= 0.F) continue;
      constexpr int reach = 7;  // cells in each direction
      float sum = noise(x, y);
      for (const float way : {1.F, -1.F}) {
        glm::vec2 position(static_cast<float>(x), static_cast<float>(y));
        std::size_t cell_there = noise.index(x, y);
        for (int k = 0; k < reach; ++k) {
          position += way * fall[cell_there];
          cell_there = noise.index(nearest(position.x, width), nearest(position.y, height));
          sum += noise[cell_there];
        }
      }
      // The standard deviation of the mean of fifteen values along a line is about a sixth here.
      const float rib = std::clamp(3.F * sum / (2 * reach + 1), -1.F, 1.F);
      level.altitude_m(x, y) += 0.62F * cell * steep(x, y) * (rib > 0.F ? rib : 1.4F * rib);
    }
  });
}

// River erosion alone leaves little high ground. Glacial erosion acts at the altitude of snow
// fields and leaves high basins: altitudes, from 0 for the lowest ground, are raised in the middle,
// t + 0.45 t (1 - t), which keeps all drainage paths.
void lift_middle(Grid<float>& altitude_m) {
  const auto [low, high] = std::minmax_element(altitude_m.begin(), altitude_m.end());
  const float base = *low;
  const float relief = std::max(1e-3F, *high - base);
  for (float& z : altitude_m) {
    const float t = (z - base) / relief;
    z = relief * (t + 0.45F * t * (1.F - t));
  }
}

// Mean tangent of slope.
double mean_slope(const Grid<float>& altitude_m, double cell_m) {
  const double sum = deterministic_sum(altitude_m.size(), [&](std::size_t i) {
    const int x = static_cast<int>(i % static_cast<std::size_t>(altitude_m.width()));
    const int y = static_cast<int>(i / static_cast<std::size_t>(altitude_m.width()));
    const float gx = altitude_m.clamped(x + 1, y) - altitude_m.clamped(x - 1, y);
    const float gy = altitude_m.clamped(x, y + 1) - altitude_m.clamped(x, y - 1);
    return exact::hypot(static_cast<double>(gx), static_cast<double>(gy)) / (2.0 * cell_m);
  });
  return sum / static_cast<double>(altitude_m.size());
}

}  // namespace

Dem make_synthetic_terrain(const SyntheticParameters& parameters, Progress& progress) {
  check(parameters);
  // Maps smaller than a mountain range show a scaled-down one.
  const double side_m = std::min(parameters.width, parameters.height) * parameters.cell_m;
  const double unit_m = std::min(1.0, side_m / 30000.0);
  const int refinements = std::clamp(
      static_cast<int>(std::lround(exact::log2(240.0 * unit_m / parameters.cell_m))), 0, 3);
  const int scale = 1 << refinements;
  // A margin that is cut off at the end hides the closed sides of the border.
  constexpr int margin = 12;
  Level level;
  level.cell_m = parameters.cell_m * scale;
  const int width = (parameters.width + scale - 1) / scale + 2 * margin;
  const int height = (parameters.height + scale - 1) / scale + 2 * margin;
  const Plan plan(height * level.cell_m, unit_m, parameters.seed);

  level.altitude_m = Grid<float>(width, height);
  level.uplift_m = Grid<float>(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const double px = (x + 0.5) * level.cell_m;
      const double py = (y + 0.5) * level.cell_m;
      const float rise = plan.uplift(px, py);
      level.uplift_m(x, y) = 30.F * rise * static_cast<float>(unit_m);
      level.altitude_m(x, y) =
          static_cast<float>(unit_m) *
          (60.F + 500.F * rise +
           120.F * fractal_noise(noise_seed(plan.seed(), TerrainNoise::first_relief),
                                 px / (3000.0 * unit_m), py / (3000.0 * unit_m), 5));
    }
  });

  const auto relief = static_cast<float>(parameters.highest_m - parameters.lowest_m);
  ErosionParameters erosion;
  erosion.unit_m = unit_m;
  ValleyParameters valleys;
  valleys.unit_m = unit_m;
  valleys.relief_m = relief;
  valleys.seed = plan.seed();

  // Steps of erosion at the finest, …, coarsest resolution; each costs a quarter of the next finer.
  constexpr int steps[4] = {4, 11, 40, 160};
  const auto steps_at = [&](int l) { return l == refinements ? steps[3] : steps[l]; };
  double total = 0.0;
  for (int l = refinements; l >= 0; --l) total += steps_at(l) * exact::pow(4.0, -l);
  progress.begin("synthetic terrain", total);
  Drainage drainage;
  Grid<ErosionCell> cells;
  for (int l = refinements; l >= 0; --l) {
    if (l < refinements) {
      level.altitude_m = refine(level.altitude_m);
      level.uplift_m = refine(level.uplift_m);
      level.cell_m *= 0.5;
      if (l > 0) {
        level.altitude_m =
            bend(level.altitude_m, noise_seed(plan.seed(), TerrainNoise::river_bends) +
                                       static_cast<std::uint64_t>(10 * l));
        level.uplift_m = bend(level.uplift_m, noise_seed(plan.seed(), TerrainNoise::river_bends) +
                                                  static_cast<std::uint64_t>(10 * l));
      }
      roughen(level, plan, relief);
    }
    open_rim(level, plan, l == refinements);
    level.softness = Grid<float>(level.altitude_m.width(), level.altitude_m.height());
    parallel_rows(level.altitude_m.height(), [&](int y) {
      for (int x = 0; x < level.altitude_m.width(); ++x)
        level.softness(x, y) = plan.softness((x + 0.5) * level.cell_m, (y + 0.5) * level.cell_m);
    });
    erosion.cell_m = level.cell_m;
    valleys.cell_m = level.cell_m;
    const bool ice_is_gone = l == 0 && refinements > 0;
    const int ice_step = l == std::min(1, refinements) ? steps_at(l) - 3 : -1;
    if (ice_is_gone) erosion.step = 0.12F;
    for (int step = 0; step < steps_at(l); ++step) {
      drainage = find_drainage(level.altitude_m, level.outlets,
                               plan.seed() + static_cast<std::uint64_t>(l), std::move(drainage));
      const Grid<float> catchment = catchments_km2(drainage, level.inflow_km2, level.cell_m);
      if (step == ice_step) {
        const Grid<float> floor = carve_valleys(level.altitude_m, drainage, catchment, valleys);
        for (std::size_t i = 0; i < floor.size(); ++i) level.uplift_m[i] *= 1.F - floor[i];
        erosion.step = 0.12F;
        continue;
      }
      erode(level.altitude_m, drainage, catchment, level.uplift_m, level.softness, erosion, cells);
      creep(level.altitude_m, 0.06F);
      progress.advance(exact::pow(4.0, -l));
    }
    if (l > 0 && erosion.step == 1.F) {
      const float factor = relief * 0.97F / largest(level.altitude_m);
      for (float& z : level.altitude_m) z *= factor;
      for (float& u : level.uplift_m) u *= factor;
    }
  }

  // Gravel levels the floors, and moraines dam lakes.
  cells = {};
  drainage = find_drainage(level.altitude_m, level.outlets, plan.seed(), std::move(drainage));
  const Grid<float> catchment = catchments_km2(drainage, level.inflow_km2, level.cell_m);
  valleys.flank = 0.7F;
  valleys.smallest_km2 = 2.F;
  const Grid<float> floor = carve_valleys(level.altitude_m, drainage, catchment, valleys);
  soften_feet(level.altitude_m, floor, 110.0 * unit_m / level.cell_m);
  add_ribs(level, plan, relief);
  drainage = find_drainage(level.altitude_m, level.outlets, plan.seed(), std::move(drainage));
  dam_valleys(level.altitude_m, drainage, catchments_km2(drainage, level.inflow_km2, level.cell_m),
              valleys);

  // Removes the margin.
  Grid<float> altitude(parameters.width, parameters.height);
  const int cut = margin * scale;
  for (int y = 0; y < parameters.height; ++y)
    for (int x = 0; x < parameters.width; ++x) altitude(x, y) = level.altitude_m(x + cut, y + cut);
  lift_middle(altitude);
  // Slopes limit the height of mountains: on small maps summits are lower than requested.
  constexpr double steepest_mean = 0.65;
  const double bearable = steepest_mean / std::max(1e-9, mean_slope(altitude, parameters.cell_m));
  const float highest = largest(altitude);
  const auto factor = static_cast<float>(
      std::min(static_cast<double>(relief) * 0.98 / static_cast<double>(highest), bearable));
  for (float& z : altitude) z = static_cast<float>(parameters.lowest_m) + z * factor;
  fill_pits(altitude, 60);
  Dem dem;
  dem.altitude_m = std::move(altitude);
  dem.filled = Grid<std::uint8_t>(parameters.width, parameters.height, 0);
  dem.transform = {0.0, parameters.height * parameters.cell_m, parameters.cell_m,
                   parameters.cell_m};
  return dem;
}

Dem make_ridged_noise(const SyntheticParameters& parameters) {
  check(parameters);
  Dem dem;
  dem.altitude_m = Grid<float>(parameters.width, parameters.height);
  dem.filled = Grid<std::uint8_t>(parameters.width, parameters.height, 0);
  dem.transform = {0.0, parameters.height * parameters.cell_m, parameters.cell_m,
                   parameters.cell_m};
  const auto lowest = static_cast<float>(parameters.lowest_m);
  const auto relief = static_cast<float>(parameters.highest_m - parameters.lowest_m);
  // Ranges every nine kilometres, or four across a smaller map; as many octaves as the cells can
  // resolve, at most seven.
  const double length =
      std::min(9000.0, 0.25 * std::max(parameters.width, parameters.height) * parameters.cell_m);
  const int octaves =
      std::clamp(static_cast<int>(exact::log2(length / (2.0 * parameters.cell_m))), 1, 7);
  const std::uint64_t seed = stream_seed(parameters.seed, Stream::ridged_terrain);
  parallel_rows(parameters.height, [&](int y) {
    for (int x = 0; x < parameters.width; ++x) {
      const double u = x * parameters.cell_m / length;
      const double v = y * parameters.cell_m / length;
      dem.altitude_m(x, y) = lowest + relief * ridged_noise(seed, u, v, octaves);
    }
  });
  return dem;
}

}  // namespace belvedere
