#include "terrain/shape/hydrology.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>

#include "base/math_exact.h"
#include "base/parallel.h"
#include "terrain/shape/inferred_rivers.h"
#include "terrain/shape/spill_level.h"

// Rivers as lines with a width: from the catchment grid, smoothed, drawn by the distance to the
// line.

namespace belvedere {
namespace {

struct Step {
  int x;
  int y;
};
// The eight neighbours; the opposite of neighbour k is 7 - k.
constexpr std::array<Step, 8> neighbours{
    {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
constexpr std::uint8_t drains_out = 8;  // leaves the grid
constexpr std::uint8_t no_way = 255;    // not determined yet
constexpr std::uint8_t done_waiting = 255;

// Calls f(k, index) for the neighbours of a cell within the grid. Interior cells, the common case,
// need no bounds checks.
template <class F>
void each_neighbour(int width, int height, std::size_t cell, F&& f) {
  const auto stride = static_cast<std::size_t>(width);
  const int x = static_cast<int>(cell % stride);
  const int y = static_cast<int>(cell / stride);
  const bool inside = x > 0 && y > 0 && x + 1 < width && y + 1 < height;
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    const int u = x + neighbours[k].x;
    const int v = y + neighbours[k].y;
    if (!inside && (u < 0 || v < 0 || u >= width || v >= height)) continue;
    f(k, static_cast<std::size_t>(static_cast<std::ptrdiff_t>(cell) +
                                  neighbours[k].y * static_cast<std::ptrdiff_t>(width) +
                                  neighbours[k].x));
  }
}

// Altitudes with hollows filled up to their outlets on the border.
Grid<float> flood_from_rim(const Grid<float>& altitude_m) {
  const int width = altitude_m.width();
  const int height = altitude_m.height();
  std::vector<std::int32_t> rim;
  for (int y = 0; y < height; ++y) {
    const bool whole_row = y == 0 || y == height - 1;
    for (int x = 0; x < width; x += whole_row ? 1 : std::max(1, width - 1))
      rim.push_back(y * width + x);
  }
  Grid<float> level_m = altitude_m;
  fill_to_spill_level(level_m, rim);
  return level_m;
}

// A flood of level ground follows its bed: the depth of a filled hollow, and on true flats the way
// from higher ground (Barnes, Lehman & Mulla 2014), so that water keeps to the middle. In ranks of
// the root of the depth: exact, and fine where ground is shallow.
constexpr std::uint8_t max_inland = 12;  // cells
constexpr float inland_m = 0.05F;        // depth per cell from higher ground
constexpr float ranks_a_root = 16.F;
constexpr std::size_t bed_ranks = 256;

// Cells between level ground (no_way) and the nearest higher ground, from 1, at most `max_inland`.
Grid<std::uint8_t> find_inland(const Grid<float>& level_m, const Grid<std::uint8_t>& towards) {
  const int width = level_m.width();
  const int height = level_m.height();
  Grid<std::uint8_t> inland(width, height, 0);
  std::vector<std::uint32_t> wave;
  for (std::size_t cell = 0; cell < towards.size(); ++cell) {
    if (towards[cell] != no_way) continue;
    bool beside = false;
    each_neighbour(width, height, cell, [&](std::size_t, std::size_t other) {
      beside = beside || level_m[other] > level_m[cell];
    });
    inland[cell] = beside ? 1 : max_inland;
    if (beside) wave.push_back(static_cast<std::uint32_t>(cell));
  }
  for (std::size_t i = 0; i < wave.size(); ++i) {
    const auto next = static_cast<std::uint8_t>(inland[wave[i]] + 1);
    each_neighbour(width, height, wave[i], [&](std::size_t, std::size_t other) {
      if (inland[other] <= next || level_m[other] != level_m[wave[i]]) return;
      inland[other] = next;
      wave.push_back(static_cast<std::uint32_t>(other));
    });
  }
  return inland;
}

// Flow directions of a flooded terrain: a neighbour's number, or drains_out. Sloping cells drain to
// the steepest neighbour, also inwards from the border; other border cells leave the grid. Level
// ground drains back along a flood from all its outlets, which always takes the deepest cell that
// it has reached: down the course of the valley that a hollow's dam closes, and along the middle of
// a flat, not straight across. So no path leads upwards, and there are no cycles.
Grid<std::uint8_t> find_flow_directions(const Grid<float>& level_m, const Grid<float>& altitude_m) {
  const int width = level_m.width();
  const int height = level_m.height();
  Grid<std::uint8_t> towards(width, height, no_way);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t cell = level_m.index(x, y);
      float steepest = 0.F;
      std::uint8_t way =
          x == 0 || y == 0 || x == width - 1 || y == height - 1 ? drains_out : no_way;
      each_neighbour(width, height, cell, [&](std::size_t k, std::size_t other) {
        const float fall = level_m[cell] - level_m[other];
        const float slope =
            neighbours[k].x != 0 && neighbours[k].y != 0 ? fall * 0.70710678F : fall;
        if (slope > steepest) {
          steepest = slope;
          way = static_cast<std::uint8_t>(k);
        }
      });
      towards[cell] = way;
    }
  });
  // Level ground is rare: its cells are found row by row, and only outlets next to them are used.
  std::vector<std::vector<std::uint32_t>> outlets(static_cast<std::size_t>(height));
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t cell = level_m.index(x, y);
      if (towards[cell] == no_way) continue;
      bool beside = false;
      each_neighbour(width, height, cell, [&](std::size_t, std::size_t other) {
        beside = beside || (towards[other] == no_way && level_m[other] == level_m[cell]);
      });
      if (beside) outlets[static_cast<std::size_t>(y)].push_back(static_cast<std::uint32_t>(cell));
    }
  });
  const Grid<std::uint8_t> inland = find_inland(level_m, towards);
  // Cells that the flood has reached, by the rank of their bed, in the order of their arrival.
  std::array<std::vector<std::uint32_t>, bed_ranks> reached;
  std::array<std::size_t, bed_ranks> taken{};
  std::size_t deepest = 0;
  const auto flood_around = [&](std::size_t cell) {
    each_neighbour(width, height, cell, [&](std::size_t k, std::size_t other) {
      if (towards[other] != no_way || level_m[other] != level_m[cell]) return;
      towards[other] = static_cast<std::uint8_t>(7 - k);
      const float bed_m =
          level_m[other] - altitude_m[other] + inland_m * static_cast<float>(inland[other]);
      const auto rank =
          std::min(bed_ranks - 1, static_cast<std::size_t>(ranks_a_root * std::sqrt(bed_m)));
      reached[rank].push_back(static_cast<std::uint32_t>(other));
      deepest = std::max(deepest, rank);
    });
  };
  for (const std::vector<std::uint32_t>& row : outlets)
    for (const std::uint32_t outlet : row) flood_around(outlet);
  for (;;) {
    if (taken[deepest] < reached[deepest].size()) {
      flood_around(reached[deepest][taken[deepest]++]);
      continue;
    }
    reached[deepest].clear();
    taken[deepest] = 0;
    if (deepest == 0) break;
    --deepest;
  }
  return towards;
}

using Mask = Grid<std::uint8_t>;

// One step of erosion (a cell stays if its four neighbours are set) or dilation (it is set if one
// is); outside is like the border. Masks contain 0 and 1.
template <bool erode>
Mask morph(const Mask& mask) {
  const int width = mask.width();
  Mask out(width, mask.height());
  const auto both = [](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(erode ? a & b : a | b);
  };
  parallel_rows(mask.height(), [&](int y) {
    const std::uint8_t* here = mask.row(y);
    const std::uint8_t* north = mask.row(std::max(y - 1, 0));
    const std::uint8_t* south = mask.row(std::min(y + 1, mask.height() - 1));
    std::uint8_t* to = out.row(y);
    for (int x = 0; x < width; ++x) to[x] = both(here[x], both(north[x], south[x]));
    for (int x = 1; x < width; ++x) to[x] = both(to[x], here[x - 1]);
    for (int x = 0; x + 1 < width; ++x) to[x] = both(to[x], here[x + 1]);
  });
  return out;
}

Mask find_flat_cells(const Grid<float>& altitude_m, float max_range_m) {
  const int width = altitude_m.width();
  Mask flat(width, altitude_m.height());
  parallel_ranges(altitude_m.height(), 16, [&](int y0, int y1) {
    // Minimum and maximum of three cells of a column, with an extra column on both sides.
    std::vector<float> low(static_cast<std::size_t>(width) + 2);
    std::vector<float> high(low.size());
    for (int y = y0; y != y1; ++y) {
      const float* north = altitude_m.row(std::max(y - 1, 0));
      const float* here = altitude_m.row(y);
      const float* south = altitude_m.row(std::min(y + 1, altitude_m.height() - 1));
      float* low_in = low.data() + 1;
      float* high_in = high.data() + 1;
      for (int x = 0; x < width; ++x) {
        low_in[x] = std::min(here[x], std::min(north[x], south[x]));
        high_in[x] = std::max(here[x], std::max(north[x], south[x]));
      }
      low.front() = low_in[0];
      high.front() = high_in[0];
      low.back() = low_in[width - 1];
      high.back() = high_in[width - 1];
      std::uint8_t* to = flat.row(y);
      for (int x = 0; x < width; ++x) {
        const float lowest = std::min(low_in[x], std::min(low_in[x - 1], low_in[x + 1]));
        const float highest = std::max(high_in[x], std::max(high_in[x - 1], high_in[x + 1]));
        to[x] = highest - lowest < max_range_m ? 1 : 0;
      }
    }
  });
  return flat;
}

// Mean height of the ground `bank_distance` cells around a piece above its level, each cell clamped
// to ±2 m; `stamps` marks visited cells with a number unique to the piece.
constexpr int bank_distance = 7;

float bank_height_m(const Grid<float>& altitude_m, const Mask& mask, const std::vector<Step>& piece,
                    Grid<std::int32_t>& stamps, std::int32_t number) {
  std::vector<Step> shore;
  for (const Step& cell : piece) {
    for (const auto& [dx, dy] : neighbours) {
      if (mask.clamped(cell.x + dx, cell.y + dy) == 0) {
        shore.push_back(cell);
        break;
      }
    }
  }
  const std::int32_t near = 2 * number;
  const std::int32_t counted = near + 1;
  for (const Step& cell : piece) stamps(cell.x, cell.y) = near;
  for (const Step& cell : shore) {
    for (int y = cell.y - bank_distance + 1; y < cell.y + bank_distance; ++y) {
      for (int x = cell.x - bank_distance + 1; x < cell.x + bank_distance; ++x) {
        if (stamps.contains(x, y)) stamps(x, y) = near;
      }
    }
  }
  const float level_m = altitude_m(piece[0].x, piece[0].y);
  double sum = 0.0;
  int count = 0;
  const auto visit = [&](int x, int y) {
    if (!stamps.contains(x, y) || stamps(x, y) == near || stamps(x, y) == counted) return;
    stamps(x, y) = counted;
    sum += std::clamp(altitude_m(x, y) - level_m, -2.F, 2.F);
    ++count;
  };
  for (const Step& cell : shore) {
    for (int i = -bank_distance; i <= bank_distance; ++i) {
      visit(cell.x + i, cell.y - bank_distance);
      visit(cell.x + i, cell.y + bank_distance);
      visit(cell.x - bank_distance, cell.y + i);
      visit(cell.x + bank_distance, cell.y + i);
    }
  }
  // A lake that fills the whole grid has no banks to check.
  return count == 0 ? 2.F : static_cast<float>(sum / count);
}

// Clears the pieces that are too small or have no banks.
void remove_what_is_no_lake(Mask& mask, const Grid<float>& altitude_m,
                            const LakeParameters& parameters) {
  const Mask flat = mask;
  Mask seen(mask.width(), mask.height());
  Grid<std::int32_t> stamps(mask.width(), mask.height());
  std::int32_t number = 0;
  std::vector<Step> piece;
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      if (flat(x, y) == 0 || seen(x, y) != 0) continue;
      piece.assign(1, {x, y});
      seen(x, y) = 1;
      for (std::size_t i = 0; i < piece.size(); ++i) {
        const Step here = piece[i];
        for (const auto& [dx, dy] : {Step{-1, 0}, Step{1, 0}, Step{0, -1}, Step{0, 1}}) {
          const Step next{here.x + dx, here.y + dy};
          if (!flat.contains(next.x, next.y) || flat(next.x, next.y) == 0 ||
              seen(next.x, next.y) != 0)
            continue;
          seen(next.x, next.y) = 1;
          piece.push_back(next);
        }
      }
      const bool large =
          piece.size() >= static_cast<std::size_t>(std::max(parameters.min_cells, 0));
      if (large &&
          (parameters.min_bank_m <= 0.F ||
           bank_height_m(altitude_m, flat, piece, stamps, ++number) >= parameters.min_bank_m)) {
        continue;
      }
      for (const Step& cell : piece) mask(cell.x, cell.y) = 0;
    }
  }
}

}  // namespace

Grid<float> flow_accumulation_km2(const Grid<float>& altitude_m, double cell_m,
                                  const std::vector<RiverEntry>& entries) {
  const int width = altitude_m.width();
  const int height = altitude_m.height();
  const Grid<std::uint8_t> towards = find_flow_directions(flood_from_rim(altitude_m), altitude_m);
  const auto target_of = [&](std::size_t cell) {
    const Step& step = neighbours[towards[cell]];
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(cell) + step.x +
                                    static_cast<std::ptrdiff_t>(step.y) * width);
  };
  // Number of neighbours that drain into each cell.
  Grid<std::uint8_t> waiting(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      std::uint8_t count = 0;
      each_neighbour(width, height, towards.index(x, y), [&](std::size_t k, std::size_t other) {
        count = static_cast<std::uint8_t>(count + (towards[other] == 7 - k ? 1 : 0));
      });
      waiting(x, y) = count;
    }
  });
  // Cells are counted exactly, then converted to km². Each path runs from a spring down to where
  // another tributary is still missing; the last one to arrive continues. Sums of whole numbers and
  // maxima do not depend on the order.
  Grid<float> catchment(width, height);
  Grid<std::uint32_t> cells(width, height, 1);
  const double cell_km2 = cell_m * cell_m * 1e-6;
  for (const RiverEntry& entry : entries)
    if (cells.contains(entry.x, entry.y))
      cells(entry.x, entry.y) += static_cast<std::uint32_t>(std::lround(entry.km2 / cell_km2));
  for (std::size_t spring = 0; spring < cells.size(); ++spring) {
    if (waiting[spring] != 0) continue;
    for (std::size_t cell = spring;;) {
      // Above 2^24 cells a float cannot distinguish n from n + 1: the upstream value is the
      // minimum.
      catchment[cell] = std::max(catchment[cell], static_cast<float>(cells[cell] * cell_km2));
      if (towards[cell] == drains_out) break;
      const std::size_t target = target_of(cell);
      cells[target] += cells[cell];
      catchment[target] =
          std::max(catchment[target],
                   std::nextafter(catchment[cell], std::numeric_limits<float>::infinity()));
      // A visited cell waits for nothing and is not a spring.
      if (--waiting[target] != 0) break;
      waiting[target] = done_waiting;
      cell = target;
    }
  }
  return catchment;
}

Grid<float> fill_hollows(const Grid<float>& altitude_m) { return flood_from_rim(altitude_m); }

Grid<std::uint8_t> find_lakes(const Grid<float>& altitude_m, const LakeParameters& parameters) {
  Mask lakes = find_flat_cells(altitude_m, parameters.max_range_m);
  lakes = morph<false>(morph<false>(morph<true>(morph<true>(lakes))));
  remove_what_is_no_lake(lakes, altitude_m, parameters);
  // The neighbourhood of a flat cell is flat as well: a cell at its border is still at the lake's
  // level.
  Mask grown = lakes;
  parallel_rows(lakes.height(), [&](int y) {
    const std::uint8_t* north = lakes.row(std::max(y - 1, 0));
    const std::uint8_t* here = lakes.row(y);
    const std::uint8_t* south = lakes.row(std::min(y + 1, lakes.height() - 1));
    // Usually there is no lake within three columns and rows, and nothing grows.
    std::vector<std::uint8_t> column(static_cast<std::size_t>(lakes.width()) + 2, 0);
    for (int x = 0; x < lakes.width(); ++x)
      column[static_cast<std::size_t>(x) + 1] =
          static_cast<std::uint8_t>(north[x] | here[x] | south[x]);
    for (int x = 0; x < lakes.width(); ++x) {
      const std::uint8_t* around = column.data() + x;
      if ((around[0] | around[1] | around[2]) == 0) continue;
      for (const auto& [dx, dy] : neighbours) {
        if (lakes.clamped(x + dx, y + dy) == 0) continue;
        if (std::abs(altitude_m.clamped(x + dx, y + dy) - altitude_m(x, y)) <
            parameters.max_range_m)
          grown(x, y) = 1;
      }
    }
  });
  return grown;
}

const Grid<float>& Catchments::km2() {
  if (km2_.empty()) km2_ = flow_accumulation_km2(dem_.altitude_m, dem_.cell_m(), dem_.entries);
  return km2_;
}

Grid<float> Catchments::take_km2() {
  km2();
  return std::exchange(km2_, {});
}

namespace {

constexpr double min_catchment_km2 = 75.0;    // streams begin
constexpr double full_catchment_km2 = 110.0;  // and have their full width
constexpr double full_half_width_m = 18.0;
constexpr double widest_m = 90.0;
// On coarse cells a river is widened until it is visible, .58 of a cell to each side, but by at
// most this factor.
constexpr double seen_cells = 0.58;
constexpr double widened = 30.0 / 18.0;

// The share of a cell covered by a straight river of this half-width at this distance from its
// centreline.
double cover(double distance_m, double half_width_m, double cell_m) {
  const double half_cell = 0.5 * cell_m;
  const double near = std::max(distance_m - half_cell, -half_width_m);
  const double far = std::min(distance_m + half_cell, half_width_m);
  return std::clamp((far - near) / cell_m, 0.0, 1.0);
}

// One straight piece of river; the larger cover wins where pieces overlap, so their order does not
// matter.
void draw(Grid<float>& mask, const RiverReach& from, const RiverReach& to, double cell_m) {
  const double margin = std::max(from.half_width_m, to.half_width_m) / cell_m + 1.0;
  const int x0 =
      std::max(0, static_cast<int>(std::floor(std::min(from.position.x, to.position.x) - margin)));
  const int x1 =
      std::min(mask.width() - 1,
               static_cast<int>(std::ceil(std::max(from.position.x, to.position.x) + margin)));
  const int y0 =
      std::max(0, static_cast<int>(std::floor(std::min(from.position.y, to.position.y) - margin)));
  const int y1 =
      std::min(mask.height() - 1,
               static_cast<int>(std::ceil(std::max(from.position.y, to.position.y) + margin)));
  const glm::dvec2 along = to.position - from.position;
  const double length2 = std::max(glm::dot(along, along), 1e-12);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const glm::dvec2 off = glm::dvec2(x, y) - from.position;
      const double t = std::clamp(glm::dot(off, along) / length2, 0.0, 1.0);
      const double distance_m = glm::length(off - t * along) * cell_m;
      const double half_width_m = (1.0 - t) * from.half_width_m + t * to.half_width_m;
      mask(x, y) =
          std::max(mask(x, y), static_cast<float>(cover(distance_m, half_width_m, cell_m)));
    }
  }
}

}  // namespace

double river_half_width_m(double catchment_km2) {
  if (catchment_km2 <= min_catchment_km2) return 0.0;
  const double exponent = exact::log(60.0 / 30.0) / exact::log(500.0 / 110.0);
  const double t = std::clamp(
      (catchment_km2 - min_catchment_km2) / (full_catchment_km2 - min_catchment_km2), 0.0, 1.0);
  return std::min(widest_m, full_half_width_m *
                                exact::pow(catchment_km2 / full_catchment_km2, exponent) * t * t *
                                (3.0 - 2.0 * t));
}

Grid<float> river_mask(const Grid<float>& catchment_km2, double cell_m) {
  std::vector<RiverReach> reaches = find_reaches(catchment_km2, min_catchment_km2);
  for (RiverReach& reach : reaches) {
    const double own_m = river_half_width_m(static_cast<double>(reach.catchment_km2));
    reach.half_width_m = std::max(own_m, std::min(widened * own_m, seen_cells * cell_m));
  }
  smooth_reaches(reaches);
  Grid<float> mask(catchment_km2.width(), catchment_km2.height());
  for (const RiverReach& reach : reaches) {
    if (reach.downstream != no_reach) draw(mask, reach, reaches[reach.downstream], cell_m);
  }
  return mask;
}

}  // namespace belvedere
