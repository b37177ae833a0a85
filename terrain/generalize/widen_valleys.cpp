#include "terrain/generalize/widen_valleys.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "base/error.h"
#include "base/filter.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "terrain/generalize/mask.h"
#include "terrain/shape/hydrology.h"

namespace belvedere {
namespace {

// A floor's altitude is that of the nearest centreline, smoothed over this many cells, because
// centrelines descend in steps.
constexpr double floor_smoothing_cells = 3.0;
// Up to this distance from the centreline lie the water and its banks, which are not widened with
// the floor.
constexpr float water_cells = 1.5F;
// Ground farther from the centreline than this share of half the width moves fully with its wall.
constexpr float gathered = 0.75F;

// Source of a cell's altitude: cells, relative to itself.
struct Shift {
  Grid<float> x;
  Grid<float> y;
};

// Properties of the valley that a cell belongs to.
struct Valleys {
  Grid<std::int32_t> centreline;  // the nearest cell of a centreline; -1 if there are none
  Grid<float> floor_m;            // its altitude
  Grid<float> half_width;         // cells by which the walls of this valley move at its floor
};

Valleys find_valleys(const Grid<float>& altitude_m, double cell_m,
                     const WidenValleysParameters& parameters) {
  const Grid<float> catchment = flow_accumulation_km2(altitude_m, cell_m);
  Grid<std::uint8_t> water(altitude_m.width(), altitude_m.height());
  std::transform(catchment.begin(), catchment.end(), water.begin(), [&](float area) {
    return static_cast<std::uint8_t>(area >= parameters.min_catchment_km2 ? 1 : 0);
  });
  Valleys valleys;
  valleys.centreline = nearest_marked(water);
  valleys.floor_m = Grid<float>(altitude_m.width(), altitude_m.height());
  valleys.half_width = valleys.floor_m;
  const float min = exact::log(parameters.min_catchment_km2);
  const float span = exact::log(parameters.full_catchment_km2) - min;
  const auto widest = static_cast<float>(0.5 * parameters.width_m / cell_m);
  parallel_rows(altitude_m.height(), [&](int y) {
    for (int x = 0; x < altitude_m.width(); ++x) {
      const std::int32_t at = valleys.centreline(x, y);
      if (at < 0) continue;
      valleys.floor_m(x, y) = altitude_m[static_cast<std::size_t>(at)];
      valleys.half_width(x, y) =
          widest * smoothstep((exact::log(catchment[static_cast<std::size_t>(at)]) - min) / span);
    }
  });
  // A brook that enters a valley is narrower: the change is spread over a distance of the width
  // itself.
  valleys.half_width = gaussian_blur(valleys.half_width, widest);
  return valleys;
}

float distance_to_nearest(const Grid<std::int32_t>& nearest, int x, int y) {
  const auto dx = static_cast<float>(nearest(x, y) % nearest.width() - x);
  const auto dy = static_cast<float>(nearest(x, y) / nearest.width() - y);
  return std::sqrt(dx * dx + dy * dy);
}

// Displacement of each wall, cells: full at the floor, 0 at fade_height of the ridges around and
// above, and where the mask is 0.
Grid<float> find_moves(const Grid<float>& altitude_m, const Valleys& valleys,
                       const Grid<float>& mask, double cell_m,
                       const WidenValleysParameters& parameters) {
  const int reach = std::max(1, static_cast<int>(std::lround(parameters.reach_m / cell_m)));
  const Grid<float> ridge_m = gaussian_blur(window_maximum(altitude_m, reach), 0.3 * reach);
  const Grid<float> smooth_m = gaussian_blur(altitude_m, 2.0);
  const Grid<float> floor_m = gaussian_blur(valleys.floor_m, 0.1 * reach);
  // The walls of two valleys move apart from the line halfway between their centrelines, however
  // low the ground is there: nothing may move at that line, where the distance is largest. Faded
  // over three half-widths, the ground gets at most 1.5 times as steep.
  Grid<float> distance(altitude_m.width(), altitude_m.height());
  parallel_rows(distance.height(), [&](int y) {
    for (int x = 0; x < distance.width(); ++x)
      distance(x, y) = distance_to_nearest(valleys.centreline, x, y);
  });
  const int apart = std::max(2, static_cast<int>(std::ceil(1.5 * parameters.width_m / cell_m)));
  const Grid<float> farthest = window_maximum(distance, apart);
  const Grid<std::int32_t> masked =
      mask.empty() ? Grid<std::int32_t>() : nearest_marked(unchanged_cells({}, mask));
  Grid<float> moves(altitude_m.width(), altitude_m.height());
  parallel_rows(altitude_m.height(), [&](int y) {
    for (int x = 0; x < altitude_m.width(); ++x) {
      const float depth_m = std::max(ridge_m(x, y) - floor_m(x, y), 1.F);
      // Near the floor every wall is low, whatever the smoothed floor is.
      const float height_m =
          std::max(smooth_m(x, y) - std::max(floor_m(x, y), valleys.floor_m(x, y)), 0.F);
      // A quarter of the displacement applies to the whole wall: heights are those of the original
      // cell, before lower ground moves there.
      const float part = height_m / (parameters.fade_height * depth_m);
      moves(x, y) = valleys.half_width(x, y) * (1.F - smoothstep((part - 0.25F) / 0.75F)) *
                    smoothstep((farthest(x, y) - distance(x, y)) / static_cast<float>(apart));
      if (!masked.empty() && masked(x, y) >= 0)
        moves(x, y) *= smoothstep(distance_to_nearest(masked, x, y) / static_cast<float>(apart));
    }
  });
  return moves;
}

// Halfway between two centrelines the direction reverses; a step there would be a cliff, or a kink
// in a road.
Shift smoothed(Shift shift, const Grid<float>& moves) {
  const float widest = *std::max_element(moves.begin(), moves.end());
  const double sigma = std::clamp(0.35 * widest, 1.0, 12.0);
  return {gaussian_blur(shift.x, sigma), gaussian_blur(shift.y, sigma)};
}

Shift find_shifts(const Grid<float>& moves, const Valleys& valleys) {
  Shift shift{Grid<float>(moves.width(), moves.height()),
              Grid<float>(moves.width(), moves.height())};
  parallel_rows(moves.height(), [&](int y) {
    for (int x = 0; x < moves.width(); ++x) {
      const float distance = distance_to_nearest(valleys.centreline, x, y);
      if (distance <= 0.F) continue;
      // No farther than the centreline: beyond it is the other wall.
      const float share = std::min(moves(x, y), distance) / distance;
      shift.x(x, y) = share * static_cast<float>(valleys.centreline(x, y) % moves.width() - x);
      shift.y(x, y) = share * static_cast<float>(valleys.centreline(x, y) / moves.width() - y);
    }
  });
  return smoothed(std::move(shift), moves);
}

// Source of the ground of each cell. The same displacement, but water and banks stay next to the
// centreline, and cells of the new floor take the cover of the bank.
Grid<glm::vec2> find_origins(const Grid<float>& moves, const Valleys& valleys,
                             const Grid<std::uint8_t>& keep, float water) {
  Grid<glm::vec2> out(moves.width(), moves.height());
  parallel_rows(moves.height(), [&](int y) {
    for (int x = 0; x < moves.width(); ++x) {
      const float distance = distance_to_nearest(valleys.centreline, x, y);
      if (distance <= water || (!keep.empty() && keep(x, y) != 0)) continue;
      const float share = std::min(moves(x, y), distance - water) / distance;
      out(x, y) = share * glm::vec2(valleys.centreline(x, y) % moves.width() - x,
                                    valleys.centreline(x, y) / moves.width() - y);
    }
  });
  return out;
}

// Where the features of each cell are drawn: moved away from the centreline by the displacement of
// the wall there.
Grid<glm::vec2> lateral_offsets(const Grid<float>& moves, const Valleys& valleys,
                                const Grid<std::uint8_t>& keep) {
  Shift way{Grid<float>(moves.width(), moves.height()), Grid<float>(moves.width(), moves.height())};
  parallel_rows(moves.height(), [&](int y) {
    for (int x = 0; x < moves.width(); ++x) {
      const float distance = distance_to_nearest(valleys.centreline, x, y);
      if (distance <= 0.F || moves(x, y) <= 0.F || (!keep.empty() && keep(x, y) != 0)) continue;
      const glm::vec2 out = glm::vec2(x - valleys.centreline(x, y) % moves.width(),
                                      y - valleys.centreline(x, y) / moves.width()) /
                            distance;
      const float share =
          smoothstep(distance / (gathered * std::max(valleys.half_width(x, y), 1.F)));
      // Displacements are stored at the target position of a wall; they change by less than a cell
      // from cell to cell.
      constexpr int steps = 12;
      float far = share * moves(x, y);
      for (int i = 0; i < steps; ++i)
        far = share * sample_bilinear(moves, x + far * out.x, y + far * out.y);
      way.x(x, y) = far * out.x;
      way.y(x, y) = far * out.y;
    }
  });
  way = smoothed(std::move(way), moves);
  Grid<glm::vec2> ways(moves.width(), moves.height());
  for (std::size_t i = 0; i < ways.size(); ++i) ways[i] = {way.x[i], way.y[i]};
  if (std::find_if(keep.begin(), keep.end(), [](std::uint8_t is) { return is != 0; }) == keep.end())
    return ways;
  // Lakes do not move, and displacements fade towards them.
  const Grid<std::int32_t> lake = nearest_marked(keep);
  parallel_rows(ways.height(), [&](int y) {
    for (int x = 0; x < ways.width(); ++x)
      ways(x, y) *= smoothstep(distance_to_nearest(lake, x, y) /
                               (2.F * gathered * std::max(valleys.half_width(x, y), 1.F)));
  });
  return ways;
}

// Cubic convolution (Catmull–Rom): keeps the detail of walls that move by fractions of a cell.
// Whole positions give their cell exactly.
float sample_cubic(const Grid<float>& values, float x, float y) {
  const float fx = std::floor(x);
  const float fy = std::floor(y);
  const auto weights = [](float t, float* w) {
    w[0] = 0.5F * t * (t * (2.F - t) - 1.F);
    w[1] = 0.5F * (t * t * (3.F * t - 5.F) + 2.F);
    w[2] = 0.5F * t * (t * (4.F - 3.F * t) + 1.F);
    w[3] = 0.5F * t * t * (t - 1.F);
  };
  float wx[4];
  float wy[4];
  weights(x - fx, wx);
  weights(y - fy, wy);
  float sum = 0.F;
  for (int j = 0; j < 4; ++j) {
    float row = 0.F;
    for (int i = 0; i < 4; ++i)
      row += wx[i] * values.clamped(static_cast<int>(fx) + i - 1, static_cast<int>(fy) + j - 1);
    sum += wy[j] * row;
  }
  return sum;
}

void check(const Grid<float>& altitude_m, const Grid<std::uint8_t>& keep,
           const WidenValleysParameters& p) {
  const auto check_range = [](const char* key, double value, double min, double max) {
    if (value >= min && value <= max) return;
    throw Error(ErrorKind::usage, fmt::format("widen_valleys.{}", key), fmt::format("{}", value),
                fmt::format("{}…{}", min, max));
  };
  check_range("width_m", p.width_m, 0, 5000);
  check_range("min_catchment_km2", p.min_catchment_km2, 0.01, 10000);
  check_range("full_catchment_km2", p.full_catchment_km2, p.min_catchment_km2 * 1.01, 100000);
  check_range("reach_m", p.reach_m, 100, 20000);
  check_range("fade_height", p.fade_height, 0.1, 1);
  if (!keep.empty() && !keep.same_size(altitude_m))
    throw Error(ErrorKind::bug, "widen valleys", "the lake grid differs in size from the DEM");
}

}  // namespace

WidenedValleys widen_valleys(const Grid<float>& altitude_m, const Grid<std::uint8_t>& keep,
                             const Grid<float>& mask, double cell_m,
                             const WidenValleysParameters& parameters, Progress& progress,
                             int halved) {
  check(altitude_m, keep, parameters);
  progress.begin("widen valleys", 4.0);
  if (parameters.width_m <= 0.F || altitude_m.empty()) return {altitude_m, {}, {}};
  const Valleys valleys = find_valleys(altitude_m, cell_m, parameters);
  if (valleys.centreline[0] < 0) {
    progress.note(fmt::format("no valley has a catchment of {} km²; no valley is widened",
                              parameters.min_catchment_km2));
    return {altitude_m, {}, {}};
  }
  progress.advance(1.0);
  const Grid<float> moves = find_moves(altitude_m, valleys, mask, cell_m, parameters);
  const Shift shift = find_shifts(moves, valleys);
  const Grid<float> floor_m =
      gaussian_blur(valleys.floor_m, std::ldexp(floor_smoothing_cells, -halved));
  progress.advance(1.0);
  const Grid<float> depth_m = fill_hollows(altitude_m);
  Grid<float> out(altitude_m.width(), altitude_m.height());
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x) {
      out(x, y) = sample_cubic(altitude_m, static_cast<float>(x) + shift.x(x, y),
                               static_cast<float>(y) + shift.y(x, y));
      // Ground that moved past the centreline is floor: level across, descending with the water.
      const float distance = distance_to_nearest(valleys.centreline, x, y);
      const float floor = smoothstep(2.F * (moves(x, y) - distance) / std::max(moves(x, y), 1.F));
      out(x, y) += floor * (floor_m(x, y) - out(x, y));
    }
  });
  progress.advance(1.0);
  const Grid<float> filled = fill_hollows(out);
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x) {
      const int u = static_cast<int>(std::lround(static_cast<float>(x) + shift.x(x, y)));
      const int v = static_cast<int>(std::lround(static_cast<float>(y) + shift.y(x, y)));
      const float was_m = depth_m.clamped(u, v) - altitude_m.clamped(u, v);
      out(x, y) = std::max(out(x, y), filled(x, y) - was_m);
      if (!keep.empty() && keep(x, y) != 0) out(x, y) = altitude_m(x, y);
    }
  });
  progress.advance(1.0);
  WidenedValleys wide{apply_mask(altitude_m, std::move(out), mask),
                      find_origins(moves, valleys, keep, std::ldexp(water_cells, -halved)),
                      lateral_offsets(moves, valleys, keep)};
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const float m = std::clamp(mask[i], 0.F, 1.F);
    wide.came_from[i] *= m;
    wide.goes_to[i] *= m;
  }
  return wide;
}

glm::dvec2 drawn_cell(const Grid<glm::vec2>& goes_to, glm::dvec2 position) {
  return goes_to.empty() ? position : position + sample_bilinear(goes_to, position.x, position.y);
}

glm::dvec2 origin_cell(const Grid<glm::vec2>& goes_to, glm::dvec2 drawn) {
  if (goes_to.empty()) return drawn;
  // The ground is stretched to at most three times its length, four near lakes, and nowhere
  // compressed to less than a third. A fixed-point iteration with this step therefore converges.
  constexpr double part_of_step = 0.4;
  constexpr int steps = 60;
  constexpr double exact_cells = 1e-4;
  glm::dvec2 at = drawn;
  for (int i = 0; i < steps; ++i) {
    const glm::dvec2 missing = drawn - drawn_cell(goes_to, at);
    if (glm::length(missing) < exact_cells) break;
    at += part_of_step * missing;
  }
  return at;
}

}  // namespace belvedere
