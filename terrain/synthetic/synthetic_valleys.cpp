#include "terrain/synthetic/synthetic_valleys.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/rising_queue.h"
#include "terrain/shape/spill_level.h"
#include "terrain/synthetic/synthetic_plan.h"

namespace belvedere::synthetic {
namespace {

template <class F>
void for_each_neighbour(const Grid<float>& grid, std::int32_t i, F&& f) {
  const int width = grid.width();
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      if ((dx != 0 || dy != 0) && grid.contains(i % width + dx, i / width + dy))
        f(i + dy * width + dx);
}

// A river cell and the trough around it.
struct Trough {
  int x;
  int y;
  float bed_m;
  float half_width_m;
  float radius_m;  // of the parabola of the flanks
};

// Number of cells, up to a limit, that drain through `outlet` and lie below `level_m`.
std::size_t count_flooded(const Grid<float>& altitude_m, const Drainage& drainage,
                          std::int32_t outlet, float level_m, std::size_t limit) {
  std::vector<std::int32_t> cells = {outlet};
  for (std::size_t k = 0; k < cells.size() && cells.size() <= limit; ++k)
    for_each_neighbour(altitude_m, cells[k], [&](std::int32_t j) {
      if (drainage.receiver[at(j)] == cells[k] && altitude_m[at(j)] < level_m) cells.push_back(j);
    });
  return cells.size();
}

}  // namespace

float floor_half_width_m(const ValleyParameters& p, double x_m, double y_m, float catchment_km2,
                         float altitude_m) {
  const double u = x_m / p.unit_m;
  const double v = y_m / p.unit_m;
  const float area = catchment_km2 / static_cast<float>(p.unit_m * p.unit_m);
  // Basins and narrows alternate every few kilometres.
  const float swell =
      std::clamp(0.85F + 0.9F * gradient_noise(noise_seed(p.seed, TerrainNoise::floor_widths),
                                               u / 3700.0, v / 3700.0),
                 0.25F, 1.6F);
  const float river = 62.F * exact::pow(area, 0.41F) * swell * smoothstep(1.F, 8.F, area);
  const float cirque =
      170.F * smoothstep(0.42F, 0.62F, altitude_m / p.relief_m) * smoothstep(0.25F, 0.9F, area) *
      std::clamp(0.8F + 0.7F * gradient_noise(noise_seed(p.seed, TerrainNoise::cirques), u / 1500.0,
                                              v / 1500.0),
                 0.F, 1.5F);
  return static_cast<float>(p.unit_m) * (river + cirque);
}

Grid<float> carve_valleys(Grid<float>& altitude_m, const Drainage& drainage,
                          const Grid<float>& catchment_km2, const ValleyParameters& p) {
  const int width = altitude_m.width();
  const int height = altitude_m.height();
  const auto cell = static_cast<float>(p.cell_m);
  const float smallest = p.smallest_km2 * static_cast<float>(p.unit_m * p.unit_m);
  std::vector<Trough> troughs;
  for (const std::int32_t i : drainage.order) {
    if (catchment_km2[at(i)] < smallest) continue;
    const int x = i % width;
    const int y = i / width;
    const float half = floor_half_width_m(p, (x + 0.5) * p.cell_m, (y + 0.5) * p.cell_m,
                                          catchment_km2[at(i)], altitude_m[at(i)]);
    if (half < 0.6F * cell) continue;
    troughs.push_back({x, y, altitude_m[at(i)], half,
                       p.flank * (0.35F * half + 60.F * static_cast<float>(p.unit_m))});
  }

  // The lower envelope does not depend on the order of troughs, so bands of rows may run in
  // parallel.
  Grid<float> floor(width, height, 0.F);
  // Gravel from the sides lets floors rise towards their edges, by varying amounts.
  Grid<float> apron(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const double u = (x + 0.5) * p.cell_m / (1300.0 * p.unit_m);
      const double v = (y + 0.5) * p.cell_m / (1300.0 * p.unit_m);
      apron(x, y) =
          0.004F +
          0.05F * std::max(0.F, gradient_noise(noise_seed(p.seed, TerrainNoise::aprons), u, v));
    }
  });
  constexpr int band = 32;
  parallel_rows((height + band - 1) / band, [&](int b) {
    const int band_top = b * band;
    const int band_end = std::min(height, band_top + band);
    for (const Trough& t : troughs) {
      const float reach = t.half_width_m + 3.F * t.radius_m;
      const int cells = static_cast<int>(reach / cell) + 1;
      for (int y = std::max(band_top, t.y - cells); y < std::min(band_end, t.y + cells + 1); ++y) {
        for (int x = std::max(0, t.x - cells); x < std::min(width, t.x + cells + 1); ++x) {
          const float away =
              cell * std::sqrt(static_cast<float>((x - t.x) * (x - t.x) + (y - t.y) * (y - t.y)));
          if (away > reach) continue;
          const float up = std::max(0.F, away - t.half_width_m);
          const float profile =
              t.bed_m + apron(x, y) * std::min(away, t.half_width_m) + up * up / (2.F * t.radius_m);
          altitude_m(x, y) = std::min(altitude_m(x, y), profile);
          floor(x, y) = std::max(
              floor(x, y), std::clamp((t.half_width_m - away) / (2.F * cell) + 0.5F, 0.F, 1.F));
        }
      }
    }
  });
  return floor;
}

void dam_valleys(Grid<float>& altitude_m, const Drainage& drainage,
                 const Grid<float>& catchment_km2, const ValleyParameters& p) {
  const int width = altitude_m.width();
  const auto unit2 = static_cast<float>(p.unit_m * p.unit_m);

  // Valleys of some size, in random order.
  std::vector<std::pair<std::uint64_t, std::int32_t>> positions;
  for (const std::int32_t i : drainage.order) {
    const float area = catchment_km2[at(i)] / unit2;
    if (area < 6.F || area > 220.F || altitude_m[at(i)] > 0.55F * p.relief_m) continue;
    positions.emplace_back(draw_bits(p.seed, i % width, i / width, TerrainDraw::dam_order), i);
  }
  std::sort(positions.begin(), positions.end());

  const double map_km2 = static_cast<double>(altitude_m.size()) * p.cell_m * p.cell_m * 1e-6 /
                         static_cast<double>(unit2);
  const auto target_count = static_cast<std::size_t>(std::max(2.0, std::round(map_km2 / 260.0)));
  std::vector<std::int32_t> dams;
  for (const auto& [chance, i] : positions) {
    if (dams.size() >= target_count) break;
    const int cx = i % width;
    const int cy = i / width;
    const bool near = std::any_of(dams.begin(), dams.end(), [&](std::int32_t d) {
      return exact::hypot(d % width - cx, d / width - cy) * p.cell_m < 5000.0 * p.unit_m;
    });
    if (near) continue;
    // The lowest dam that holds a lake of the required size.
    const double area_m2 = (0.35 + 3.4 * draw_uniform(p.seed, cx, cy, TerrainDraw::dam_size) *
                                       draw_uniform(p.seed, cx, cy, TerrainDraw::dam_share)) *
                           1e6 * static_cast<double>(unit2);
    const auto cells = static_cast<std::size_t>(std::max(24.0, area_m2 / (p.cell_m * p.cell_m)));
    float level = 0.F;
    for (float dam = 6.F; dam <= 90.F && level == 0.F; dam *= 1.25F)
      if (count_flooded(altitude_m, drainage, i, altitude_m[at(i)] + dam, cells) > cells)
        level = altitude_m[at(i)] + dam;
    if (level == 0.F) continue;
    dams.push_back(i);

    // The valley's direction, over half a kilometre downstream.
    std::int32_t down = i;
    for (int k = 0;
         k < static_cast<int>(500.0 * p.unit_m / p.cell_m) + 1 && drainage.receiver[at(down)] >= 0;
         ++k)
      down = drainage.receiver[at(down)];
    const double dx = down % width - cx;
    const int down_y = down / width;
    const double dy = down_y - cy;
    const double length = std::max(1e-6, exact::hypot(dx, dy));
    const double half = 80.0 * p.unit_m + 1.6 * static_cast<double>(floor_half_width_m(
                                                    p, (cx + 0.5) * p.cell_m, (cy + 0.5) * p.cell_m,
                                                    catchment_km2[at(i)], altitude_m[at(i)]));
    const double foot = 90.0 * p.unit_m + static_cast<double>(level - altitude_m[at(i)]) / 0.08;
    const int reach = static_cast<int>((half + foot) / p.cell_m) + 1;
    for (int y = std::max(0, cy - reach); y < std::min(altitude_m.height(), cy + reach + 1); ++y) {
      for (int x = std::max(0, cx - reach); x < std::min(width, cx + reach + 1); ++x) {
        const double along = ((x - cx) * dx + (y - cy) * dy) / length * p.cell_m;
        const double across =
            std::max(0.0, std::abs((x - cx) * dy - (y - cy) * dx) / length * p.cell_m - half);
        const double u = (x + 0.5) * p.cell_m / (260.0 * p.unit_m);
        const double v = (y + 0.5) * p.cell_m / (260.0 * p.unit_m);
        const auto away =
            static_cast<float>(std::max(0.0, exact::hypot(along, across) - 90.0 * p.unit_m));
        const float top =
            level +
            5.F * std::abs(fractal_noise(noise_seed(p.seed, TerrainNoise::moraines), u, v, 3)) -
            0.08F * away;
        altitude_m(x, y) = std::max(altitude_m(x, y), top);
      }
    }
  }
}

Grid<std::uint8_t> fill_pits(Grid<float>& altitude_m, int min_lake_cells) {
  const int width = altitude_m.width();
  const int height = altitude_m.height();
  std::vector<std::int32_t> rim;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (x == 0 || y == 0 || x == width - 1 || y == height - 1) rim.push_back(y * width + x);

  // Hollows: connected cells that the flood raises by more than about 10 cm, all to the same spill
  // level.
  Grid<float> filled = altitude_m;
  fill_to_spill_level(filled, rim);
  Grid<std::uint8_t> lake(width, height, 0);
  std::vector<std::uint8_t> seen(altitude_m.size(), 0);
  std::vector<std::int32_t> hollow;
  for (std::size_t start = 0; start < seen.size(); ++start) {
    if (seen[start] != 0 || filled[start] <= altitude_m[start]) continue;
    hollow.assign(1, static_cast<std::int32_t>(start));
    seen[start] = 1;
    for (std::size_t k = 0; k < hollow.size(); ++k)
      for_each_neighbour(altitude_m, hollow[k], [&](std::int32_t j) {
        if (seen[at(j)] != 0 || filled[at(j)] <= altitude_m[at(j)] ||
            filled[at(j)] != filled[start])
          return;
        seen[at(j)] = 1;
        hollow.push_back(j);
      });
    if (hollow.size() < static_cast<std::size_t>(min_lake_cells)) continue;
    for (const std::int32_t i : hollow) {
      lake[at(i)] = 1;
      altitude_m[at(i)] = filled[start];
    }
  }

  // A second flood gives everything else a slope; a lake takes the level of the cell through which
  // it is reached first, and all of it is reached before anything higher.
  constexpr float fall_m = 0.004F;
  RisingQueue front;
  const auto push = [&](std::int32_t i) {
    front.push(rising_key(altitude_m[at(i)], static_cast<std::uint32_t>(i)));
  };
  std::vector<std::uint8_t> reached(altitude_m.size(), 0);
  for (const std::int32_t i : rim) {
    reached[at(i)] = 1;
    push(i);
  }
  while (!front.empty()) {
    const auto i = static_cast<std::int32_t>(front.pop() & 0xffffffffU);
    for_each_neighbour(altitude_m, i, [&](std::int32_t j) {
      if (reached[at(j)] != 0) return;
      reached[at(j)] = 1;
      altitude_m[at(j)] = std::max(
          altitude_m[at(j)], lake[at(j)] != 0 ? altitude_m[at(i)] : altitude_m[at(i)] + fall_m);
      push(j);
    });
  }
  return lake;
}

}  // namespace belvedere::synthetic
