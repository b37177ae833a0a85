#include "terrain/synthetic/synthetic_erosion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/parallel.h"
#include "base/random.h"
#include "base/rising_queue.h"

namespace belvedere::synthetic {
namespace {

constexpr int neighbour_x[8] = {-1, 0, 1, -1, 1, -1, 0, 1};
constexpr int neighbour_y[8] = {-1, -1, -1, 0, 0, 1, 1, 1};
constexpr bool is_diagonal[8] = {true, false, true, false, false, true, false, true};

constexpr double infinity = std::numeric_limits<double>::infinity();

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// Length of the way to the receiver in cells.
float step_cells(std::int32_t from, std::int32_t to, int width) {
  const std::int32_t d = std::abs(from - to);
  return d == 1 || d == width ? 1.F : 1.41421356F;
}

// Altitude w above the lower of the neighbours in x and y, of which the higher one stands d above the lower: the upwind
// gradient g = sqrt(w² + max(0, w - d)²) (Rouy & Tourin 1992), in metres a cell, does not depend on direction, where the
// eight ways of the water would leave their marks on every slope. Solves w = c - a g and g <= limit.
double upwind_rise(double c, double d, double a, double limit) {
  if (c <= 0.0) return c;
  double w = c / (1.0 + a);
  if (w > d) {
    const double b = c - a * a * d;
    w = (c * c - a * a * d * d) / (b + std::sqrt(b * b - (2.0 * a * a - 1.0) * (a * a * d * d - c * c)));
  }
  const double steepest = limit > d ? 0.5 * (d + std::sqrt(2.0 * limit * limit - d * d)) : limit;
  return std::min(w, steepest);
}

}  // namespace

Drainage find_drainage(Grid<float>& altitude_m, const std::vector<std::int32_t>& outlets, std::uint64_t seed) {
  const int width = altitude_m.width();
  const int height = altitude_m.height();
  // The flood jumps about the map, so what it asks of a cell lies together: one wait for memory instead of three.
  struct Cell {
    float altitude_m;
    std::int32_t receiver;
  };
  constexpr std::int32_t nowhere = -1;
  constexpr std::int32_t not_reached = -2;
  std::vector<Cell> cells(altitude_m.size());
  parallel_ranges(cells.size(), std::size_t{1} << 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) cells[i] = {altitude_m[i], not_reached};
  });
  Drainage drainage;
  drainage.order.reserve(cells.size());

  // Lowest first; ties go to the lower index.
  RisingQueue front;
  const auto push = [&](std::int32_t i) { front.push(rising_key(cells[at(i)].altitude_m, static_cast<std::uint32_t>(i))); };
  for (const std::int32_t i : outlets) {
    if (cells[at(i)].receiver != not_reached) continue;
    cells[at(i)].receiver = nowhere;
    push(i);
  }
  const auto is_inside = [&](int x, int y) { return x > 0 && y > 0 && x + 1 < width && y + 1 < height; };
  while (!front.empty()) {
    const auto i = static_cast<std::int32_t>(front.pop() & 0xffffffffU);
    drainage.order.push_back(i);
    const int x = i % width;
    const int y = i / width;
    const bool inside = is_inside(x, y);
    const float level = cells[at(i)].altitude_m;
    for (int k = 0; k < 8; ++k) {
      if (!inside && !altitude_m.contains(x + neighbour_x[k], y + neighbour_y[k])) continue;
      const std::int32_t j = i + neighbour_y[k] * width + neighbour_x[k];
      Cell& cell = cells[at(j)];
      if (cell.receiver != not_reached) continue;
      cell = {std::max(cell.altitude_m, level), i};
      push(j);
    }
  }

  // A strictly lower neighbour was taken from the front earlier, so the order holds for these receivers as well.
  drainage.receiver.resize(cells.size());
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<std::int32_t>(altitude_m.index(x, y));
      const float here = cells[at(i)].altitude_m;
      std::int32_t receiver = std::max(cells[at(i)].receiver, nowhere);
      altitude_m[at(i)] = here;
      if (receiver != nowhere) {
        const bool inside = is_inside(x, y);
        const float diagonal = 1.F / (2.F - static_cast<float>(random_uniform(seed, x, y)));
        float steepest = 0.F;
        for (int k = 0; k < 8; ++k) {
          if (!inside && !altitude_m.contains(x + neighbour_x[k], y + neighbour_y[k])) continue;
          const std::int32_t j = i + neighbour_y[k] * width + neighbour_x[k];
          const float drop = (here - cells[at(j)].altitude_m) * (is_diagonal[k] ? diagonal : 1.F);
          receiver = drop > steepest ? j : receiver;
          steepest = drop > steepest ? drop : steepest;
        }
      }
      drainage.receiver[at(i)] = receiver;
    }
  });
  return drainage;
}

Grid<float> catchments_km2(const Drainage& drainage, const Grid<float>& inflow_km2, double cell_m) {
  // The caller's grid gives the shape; without inflow every cell just has its own area.
  Grid<float> catchment = inflow_km2;
  const auto own = static_cast<float>(cell_m * cell_m * 1e-6);
  for (float& c : catchment) c += own;
  for (auto i = drainage.order.rbegin(); i != drainage.order.rend(); ++i)
    if (drainage.receiver[at(*i)] >= 0) catchment[at(drainage.receiver[at(*i)])] += catchment[at(*i)];
  return catchment;
}

void erode(Grid<float>& altitude_m, const Drainage& drainage, const Grid<float>& catchment_km2, const Grid<float>& uplift_m,
           const Grid<float>& softness, const ErosionParameters& parameters) {
  const int width = altitude_m.width();
  const auto reach = static_cast<float>(240.0 * parameters.unit_m / parameters.cell_m);
  const auto area_unit = static_cast<float>(parameters.unit_m * parameters.unit_m);
  // What the walk in the water's order asks of a cell lies together, as in find_drainage.
  struct Cell {
    float altitude_m;  // new; infinity where it is not known so far
    float risen_m;
    float incision;
    float limit_m;  // steepest rise, metres a cell
    std::int32_t receiver;
  };
  constexpr float unknown = std::numeric_limits<float>::infinity();
  Grid<Cell> cells(width, altitude_m.height());
  parallel_rows(altitude_m.height(), [&](int y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = altitude_m.index(x, y);
      const float area = catchment_km2[i] / area_unit + parameters.hillslope_km2;
      cells[i] = {unknown, altitude_m[i] + parameters.step * uplift_m[i], reach * parameters.step * softness[i] * std::pow(area, 0.6F),
                  parameters.steepest * static_cast<float>(parameters.cell_m) * (0.6F + 0.4F / softness[i]), drainage.receiver[i]};
    }
  });
  // New altitude of the lower of two opposite neighbours, of those that are done; else infinity.
  const auto lower = [&](bool one, std::size_t a, bool two, std::size_t b) {
    const float z = one ? cells[a].altitude_m : unknown;
    return static_cast<double>(two ? std::min(z, cells[b].altitude_m) : z);
  };
  const auto stride = static_cast<std::size_t>(width);
  for (const std::int32_t index : drainage.order) {
    const std::size_t i = at(index);
    Cell& cell = cells[i];
    if (cell.receiver < 0) {
      cell.altitude_m = altitude_m[i];
      continue;
    }
    const int x = index % width;
    const int y = index / width;
    // Along the water's way: what counts in a channel.
    const float length = step_cells(index, cell.receiver, width);
    const float f = cell.incision / length;
    const float below = cells[at(cell.receiver)].altitude_m;
    float z = std::min((cell.risen_m + f * below) / (1.F + f), below + cell.limit_m * length);
    // Along the true gradient: what counts on a slope.
    const double lower_x = lower(x > 0, i - 1, x + 1 < width, i + 1);
    const double lower_y = lower(y > 0, i - stride, y + 1 < altitude_m.height(), i + stride);
    const double low = std::min(lower_x, lower_y);
    if (low < infinity)
      z = std::min(z, static_cast<float>(low + upwind_rise(static_cast<double>(cell.risen_m) - low, std::max(lower_x, lower_y) - low,
                                                           static_cast<double>(cell.incision), static_cast<double>(cell.limit_m))));
    cell.altitude_m = z;
  }
  parallel_rows(altitude_m.height(), [&](int y) {
    for (int x = 0; x < width; ++x)
      if (cells(x, y).altitude_m < unknown) altitude_m(x, y) = cells(x, y).altitude_m;
  });
}

void creep(Grid<float>& altitude_m, float rate) {
  const Grid<float> before = altitude_m;
  parallel_rows(altitude_m.height() - 2, [&](int row) {
    const int y = row + 1;
    for (int x = 1; x + 1 < altitude_m.width(); ++x) {
      const float straight = before(x - 1, y) + before(x + 1, y) + before(x, y - 1) + before(x, y + 1);
      const float diagonal = before(x - 1, y - 1) + before(x + 1, y - 1) + before(x - 1, y + 1) + before(x + 1, y + 1);
      // Weights 4:1 make the nine-point Laplacian isotropic.
      altitude_m(x, y) += rate * ((4.F * straight + diagonal) / 20.F - before(x, y));
    }
  });
}

}  // namespace belvedere::synthetic
