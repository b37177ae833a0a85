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
  Drainage drainage;
  drainage.receiver.assign(altitude_m.size(), -1);
  drainage.order.reserve(altitude_m.size());
  std::vector<std::uint8_t> reached(altitude_m.size(), 0);

  // Lowest first; ties go to the lower index.
  RisingQueue front;
  const auto push = [&](std::int32_t i) { front.push(rising_key(altitude_m[at(i)], static_cast<std::uint32_t>(i))); };
  for (const std::int32_t i : outlets) {
    if (reached[at(i)] != 0) continue;
    reached[at(i)] = 1;
    push(i);
  }
  const auto is_inside = [&](int x, int y) { return x > 0 && y > 0 && x + 1 < width && y + 1 < height; };
  while (!front.empty()) {
    const auto i = static_cast<std::int32_t>(front.pop() & 0xffffffffU);
    drainage.order.push_back(i);
    const int x = i % width;
    const int y = i / width;
    const bool inside = is_inside(x, y);
    const float level = altitude_m[at(i)];
    for (int k = 0; k < 8; ++k) {
      if (!inside && !altitude_m.contains(x + neighbour_x[k], y + neighbour_y[k])) continue;
      const std::int32_t j = i + neighbour_y[k] * width + neighbour_x[k];
      if (reached[at(j)] != 0) continue;
      reached[at(j)] = 1;
      drainage.receiver[at(j)] = i;
      altitude_m[at(j)] = std::max(altitude_m[at(j)], level);
      push(j);
    }
  }

  // A strictly lower neighbour was taken from the front earlier, so the order holds for these receivers as well.
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<std::int32_t>(altitude_m.index(x, y));
      if (drainage.receiver[at(i)] < 0) continue;
      const bool inside = is_inside(x, y);
      const float diagonal = 1.F / (2.F - static_cast<float>(random_uniform(seed, x, y)));
      const float here = altitude_m[at(i)];
      float steepest = 0.F;
      for (int k = 0; k < 8; ++k) {
        if (!inside && !altitude_m.contains(x + neighbour_x[k], y + neighbour_y[k])) continue;
        const std::int32_t j = i + neighbour_y[k] * width + neighbour_x[k];
        const float drop = (here - altitude_m[at(j)]) * (is_diagonal[k] ? diagonal : 1.F);
        if (drop > steepest) {
          steepest = drop;
          drainage.receiver[at(i)] = j;
        }
      }
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
  Grid<float> incision(width, altitude_m.height());
  parallel_rows(altitude_m.height(), [&](int y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = altitude_m.index(x, y);
      const float area = catchment_km2[i] / area_unit + parameters.hillslope_km2;
      incision[i] = reach * parameters.step * softness[i] * std::pow(area, 0.6F);
    }
  });
  std::vector<std::uint8_t> done(altitude_m.size(), 0);
  // New altitude of the lower of two opposite neighbours, of those that are done; else infinity.
  const auto lower = [&](bool one, std::size_t a, bool two, std::size_t b) {
    double z = infinity;
    if (one && done[a] != 0) z = static_cast<double>(altitude_m[a]);
    if (two && done[b] != 0) z = std::min(z, static_cast<double>(altitude_m[b]));
    return z;
  };
  const auto stride = static_cast<std::size_t>(width);
  for (const std::int32_t cell : drainage.order) {
    const std::size_t i = at(cell);
    done[i] = 1;
    const std::int32_t r = drainage.receiver[i];
    if (r < 0) continue;
    const int x = cell % width;
    const int y = cell / width;
    const float risen = altitude_m[i] + parameters.step * uplift_m[i];
    const float limit = parameters.steepest * static_cast<float>(parameters.cell_m) * (0.6F + 0.4F / softness[i]);
    // Along the water's way: what counts in a channel.
    const float length = step_cells(cell, r, width);
    const float f = incision[i] / length;
    const float below = altitude_m[at(r)];
    float z = std::min((risen + f * below) / (1.F + f), below + limit * length);
    // Along the true gradient: what counts on a slope.
    const double lower_x = lower(x > 0, i - 1, x + 1 < width, i + 1);
    const double lower_y = lower(y > 0, i - stride, y + 1 < altitude_m.height(), i + stride);
    const double low = std::min(lower_x, lower_y);
    if (low < infinity)
      z = std::min(z, static_cast<float>(low + upwind_rise(static_cast<double>(risen) - low, std::max(lower_x, lower_y) - low,
                                                           static_cast<double>(incision[i]), static_cast<double>(limit))));
    altitude_m[i] = z;
  }
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
