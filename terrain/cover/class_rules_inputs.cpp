#include "terrain/cover/class_rules_inputs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/vec2.hpp>
#include <numeric>

#include "base/angle.h"
#include "base/filter.h"
#include "base/noise.h"
#include "base/parallel.h"
#include "base/random.h"
#include "base/random_streams.h"
#include "terrain/shape/derivatives.h"
#include "terrain/shape/hydrology.h"

namespace belvedere::class_rules {
namespace {

template <class F>
void each_cell(Grid<float>& grid, F&& f) {
  parallel_rows(grid.height(), [&](int y) {
    for (int x = 0; x < grid.width(); ++x) grid(x, y) = f(x, y);
  });
}

// Rise towards the east and towards the south, metres a metre.
glm::vec2 rise(const Grid<float>& z, int x, int y, double cell_x, double cell_y) {
  const double gx = static_cast<double>(z.clamped(x + 1, y) - z.clamped(x - 1, y)) / (2.0 * cell_x);
  const double gy = static_cast<double>(z.clamped(x, y + 1) - z.clamped(x, y - 1)) / (2.0 * cell_y);
  return {static_cast<float>(gx), static_cast<float>(gy)};
}

TownParameters to_town_parameters(const Parameters& parameters, const std::vector<KnownTown>& known, std::uint64_t seed) {
  TownParameters towns;
  towns.amount = parameter_or(parameters, "settlement", 0.0);
  towns.highest_m = parameter_or(parameters, "town_highest_m", 1300.0);
  towns.seed = seed;
  towns.known = known;
  return towns;
}

}  // namespace

const std::vector<std::string>& variable_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> n = {"altitude",      "slope",        "slope_smooth", "south", "relief_180", "relief_750", "relief_1800",
                                  "valley_height", "valley_floor", "lake",         "shore", "river",      "town",       "ice",
                                  "below_rock",    "n60",          "n210",         "n660",  "n1800",      "east",       "north"};
    for (const LandCoverClassInfo& c : land_cover_classes()) n.push_back("is_" + std::string(c.name));
    return n;
  }();
  return names;
}

double parameter_or(const Parameters& parameters, const std::string& name, double otherwise) {
  for (const auto& [key, value] : parameters)
    if (key == name) return value;
  return otherwise;
}

std::vector<Grid<float>> make_terrain_inputs(const Dem& dem, const std::vector<bool>& needed, const Parameters& parameters,
                                             const std::vector<KnownTown>& towns, std::uint64_t seed) {
  const double cell = dem.cell_m();
  const double cell_x = dem.transform.cell_x;
  const double cell_y = dem.transform.cell_y;
  const Grid<float>& z = dem.altitude_m;
  std::vector<Grid<float>> inputs(first_noise);
  const auto is_needed = [&](int v) { return static_cast<bool>(needed[static_cast<std::size_t>(v)]); };
  const auto grid = [&](int v) -> Grid<float>& { return inputs[static_cast<std::size_t>(v)]; };

  if (is_needed(altitude)) grid(altitude) = z;
  const bool needs_floor = is_needed(valley_floor) || is_needed(town);
  if (is_needed(valley_height) || needs_floor) grid(valley_height) = height_above_valley(z, cell, 900.0);
  {
    const Grid<float> smooth = gaussian_blur(z, 60.0 / cell);
    if (is_needed(slope) || is_needed(slope_smooth) || needs_floor) grid(slope) = slope_deg(smooth, cell_x, cell_y);
    if (is_needed(slope_smooth)) grid(slope_smooth) = gaussian_blur(grid(slope), 90.0 / cell);
    if (is_needed(south) || is_needed(town)) {
      grid(south) = Grid<float>(z.width(), z.height());
      each_cell(grid(south), [&](int x, int y) {
        // Ground that rises to the north (against the rows) faces south. The small number fades exposure out on flat ground.
        const glm::vec2 g = rise(smooth, x, y, cell_x, cell_y);
        return -g.y / (std::sqrt(g.x * g.x + g.y * g.y) + 1e-3F);
      });
    }
  }
  if (is_needed(relief_180) || is_needed(relief_750)) {
    const Grid<float> inner = gaussian_blur(z, 30.0 / cell);
    for (const auto& [variable, outer_m] : {std::pair{relief_180, 180.0}, std::pair{relief_750, 750.0}}) {
      if (!is_needed(variable)) continue;
      grid(variable) = gaussian_blur(z, outer_m / cell);
      each_cell(grid(variable), [&, v = variable](int x, int y) { return inner(x, y) - grid(v)(x, y); });
    }
  }
  if (is_needed(relief_1800)) grid(relief_1800) = relief(z, cell, 120.0, 1800.0);
  if (needs_floor) {
    const auto steepest = static_cast<float>(parameter_or(parameters, "floor_slope_deg", 5.5));
    const auto highest = static_cast<float>(parameter_or(parameters, "floor_highest_m", 1450.0));
    const auto rise_m = static_cast<float>(parameter_or(parameters, "floor_height_m", 70.0));
    Grid<float> flat(z.width(), z.height());
    each_cell(flat, [&](int x, int y) {
      return grid(slope)(x, y) < steepest && grid(valley_height)(x, y) < rise_m && z(x, y) < highest ? 1.F : 0.F;
    });
    grid(valley_floor) = gaussian_blur(flat, 60.0 / cell);
  }
  if (is_needed(lake) || is_needed(shore)) {
    LakeParameters lakes;
    lakes.max_range_m = static_cast<float>(parameter_or(parameters, "lake_range_m", 0.25));
    lakes.min_cells = static_cast<int>(parameter_or(parameters, "lake_min_cells", 150.0));
    const Grid<std::uint8_t> mask = find_lakes(z, lakes);
    grid(lake) = Grid<float>(z.width(), z.height());
    each_cell(grid(lake), [&](int x, int y) { return mask(x, y) != 0 ? 1.F : 0.F; });
    if (is_needed(shore)) {
      Grid<std::uint8_t> land(z.width(), z.height());
      for (std::size_t i = 0; i < land.size(); ++i) land[i] = mask[i] != 0 ? 0 : 1;
      const Grid<std::int32_t> nearest = nearest_marked(land);
      grid(shore) = Grid<float>(z.width(), z.height());
      each_cell(grid(shore), [&](int x, int y) {
        const std::int32_t at = nearest(x, y);
        return at < 0 ? 1e6F : static_cast<float>(cell * std::hypot(at % z.width() - x, at / z.width() - y));
      });
    }
  }
  if (is_needed(river) || is_needed(town)) {
    const Grid<float> catchment_km2 = flow_accumulation_km2(z, cell);
    if (is_needed(river)) grid(river) = river_mask(catchment_km2, cell);
    if (is_needed(town)) {
      const TownGround ground{z, grid(valley_floor), catchment_km2, grid(slope), grid(south), dem.transform};
      grid(town) = town_field(find_town_sites(ground, to_town_parameters(parameters, towns, seed)), ground);
    }
  }
  return inputs;
}

Grid<float> rock_above(const Grid<LandCoverClass>& classes, const Dem& dem, double reach_m) {
  const int width = classes.width();
  const int height = classes.height();
  const int steps = static_cast<int>(reach_m / dem.cell_m());
  Grid<float> above(width, height);
  each_cell(above, [&](int x, int y) { return classes(x, y) == LandCoverClass::rock ? 1.F : 0.F; });
  if (steps < 1) return above;
  const Grid<float> near = window_maximum(above, steps + 1);  // most of a map has no rock near and needs no search

  // Unit vectors uphill, one cell long; 0 where it is flat and nothing rolls down.
  const Grid<float> smooth = gaussian_blur(dem.altitude_m, 60.0 / dem.cell_m());
  Grid<glm::vec2> uphill(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const glm::vec2 g = rise(smooth, x, y, dem.transform.cell_x, dem.transform.cell_y);
      const float length = std::sqrt(g.x * g.x + g.y * g.y);
      uphill(x, y) = length < 0.02F ? glm::vec2(0.F) : g / length;
    }
  });
  each_cell(above, [&](int x, int y) {
    if (near(x, y) == 0.F || classes(x, y) == LandCoverClass::rock) return near(x, y);
    // Half a cell more, so that cutting off the fraction rounds to the nearest cell.
    glm::vec2 place(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
    glm::vec2 direction = uphill(x, y);
    for (int k = 0; k < steps; ++k) {
      if (direction == glm::vec2(0.F)) return 0.F;
      place += direction;
      if (place.x < 0.F || place.y < 0.F) return 0.F;
      const int ux = static_cast<int>(place.x);
      const int uy = static_cast<int>(place.y);
      if (!classes.contains(ux, uy)) return 0.F;
      if (classes(ux, uy) == LandCoverClass::rock) return 1.F - static_cast<float>(k) / static_cast<float>(steps);
      direction = uphill(ux, uy);
    }
    return 0.F;
  });
  return above;
}

Grid<float> flowing_ice(const Grid<float>& balance, const Dem& dem) {
  const int width = dem.width();
  const int height = dem.height();
  const double cell = dem.cell_m();
  // Ice does not follow every gully of its bed.
  const Grid<float> surface = gaussian_blur(dem.altitude_m, 90.0 / cell);
  std::vector<std::int32_t> order;
  for (std::size_t i = 0; i < balance.size(); ++i)
    if (balance[i] > -8.F) order.push_back(static_cast<std::int32_t>(i));
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    const float za = surface[static_cast<std::size_t>(a)];
    const float zb = surface[static_cast<std::size_t>(b)];
    return za != zb ? za > zb : a < b;
  });

  // Down all lower neighbours, more to the steeper ones (Freeman 1991), in km² of snow field.
  const auto own = static_cast<float>(cell * cell * 1e-6);
  Grid<float> flux(width, height, 0.F);
  for (const std::int32_t i : order) {
    const std::size_t here = static_cast<std::size_t>(i);
    flux[here] = std::max(0.F, flux[here] + own * std::min(balance[here], 1.F));
    if (flux[here] <= 0.F) continue;
    float shares[8];
    float total = 0.F;
    int k = 0;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (dx == 0 && dy == 0) continue;
        shares[k] = 0.F;
        if (surface.contains(i % width + dx, i / width + dy)) {
          const float drop = surface[here] - surface(i % width + dx, i / width + dy);
          if (drop > 0.F) shares[k] = std::pow(dx != 0 && dy != 0 ? drop * 0.7071F : drop, 1.3F);
        }
        total += shares[k++];
      }
    }
    if (total <= 0.F) continue;
    k = 0;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (dx == 0 && dy == 0) continue;
        if (shares[k] > 0.F) flux(i % width + dx, i / width + dy) += flux[here] * shares[k] / total;
        ++k;
      }
    }
  }

  // The stream has a thickness that grows with what flows, and covers the bed beside it up to its level.
  Grid<float> covered(width, height, 0.F);
  constexpr int band = 32;
  parallel_rows((height + band - 1) / band, [&](int b) {
    for (const std::int32_t i : order) {
      const float f = flux[static_cast<std::size_t>(i)];
      if (f < 0.02F) continue;
      const int cx = i % width;
      const int cy = i / width;
      const float thickness = 45.F * std::pow(f, 0.3F);
      const int reach = static_cast<int>(std::min(900.0, 420.0 * std::sqrt(static_cast<double>(f))) / cell);
      const float level = surface[static_cast<std::size_t>(i)] + thickness;
      for (int y = std::max(b * band, cy - reach); y < std::min({height, (b + 1) * band, cy + reach + 1}); ++y)
        for (int x = std::max(0, cx - reach); x < std::min(width, cx + reach + 1); ++x)
          if ((x - cx) * (x - cx) + (y - cy) * (y - cy) <= reach * reach && dem.altitude_m(x, y) < level && balance(x, y) > -8.F)
            covered(x, y) = 1.F;
    }
  });
  return gaussian_blur(covered, 60.0 / cell);
}

void fill_noise(int variable, std::uint64_t seed, const GeoTransform& transform, int row, int width, float* out) {
  constexpr double sigma_m[4] = {60.0, 210.0, 660.0, 1800.0};
  const int k = variable - first_noise;
  const glm::dvec2 first = transform.to_crs(0.0, row);
  gaussian_noise_row(stream_seed(seed, Stream::class_noise, static_cast<std::uint64_t>(k)), first.x, transform.cell_x, width, first.y,
                     sigma_m[k], out);
}

void remove_specks(Grid<LandCoverClass>& classes, int window) {
  const int radius = window / 2;
  if (radius < 1) return;
  const int majority = ((2 * radius + 1) * (2 * radius + 1) + 1) / 2;
  Grid<std::uint8_t> keeps(classes.width(), classes.height());
  parallel_rows(classes.height(), [&](int y) {
    for (int x = 0; x < classes.width(); ++x) {
      const LandCoverClass own = classes(x, y);
      if (own == LandCoverClass::sky) continue;
      int same = 0;
      for (int dy = -radius; dy <= radius; ++dy)
        for (int dx = -radius; dx <= radius; ++dx) same += classes.clamped(x + dx, y + dy) == own ? 1 : 0;
      keeps(x, y) = same >= majority || own == LandCoverClass::water || own == LandCoverClass::settlement ? 1 : 0;
    }
  });
  // Water and settlement hold on to their cells but do not spread into holes.
  Grid<std::uint8_t> gives = keeps;
  for (std::size_t i = 0; i < gives.size(); ++i)
    if (classes[i] == LandCoverClass::water || classes[i] == LandCoverClass::settlement) gives[i] = 0;
  const Grid<std::int32_t> nearest = nearest_marked(gives);
  const Grid<LandCoverClass> before = classes;
  for (std::size_t i = 0; i < classes.size(); ++i)
    if (keeps[i] == 0 && nearest[i] >= 0) classes[i] = before[static_cast<std::size_t>(nearest[i])];
}

}  // namespace belvedere::class_rules
