#include "terrain/synthetic/synthetic_erosion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "base/lines/power_line.h"
#include "base/parallel.h"
#include "terrain/synthetic/synthetic_parts.h"

namespace belvedere::synthetic {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Distance to the receiver in cells.
float step_cells(std::int32_t from, std::int32_t to, int width) {
  const std::int32_t d = std::abs(from - to);
  return d == 1 || d == width ? 1.F : 1.41421356F;
}

// Solves w = c - a g and g <= limit, w the altitude above the lower of the neighbours in x and y, d
// the height difference of these two. The upwind gradient g = sqrt(w² + max(0, w - d)²) (Rouy &
// Tourin 1992), in metres per cell, does not depend on direction; the eight flow directions would
// leave artefacts on every slope.
double upwind_rise(double c, double d, double a, double limit) {
  if (c <= 0.0) return c;
  double w = c / (1.0 + a);
  if (w > d) {
    const double b = c - a * a * d;
    w = (c * c - a * a * d * d) /
        (b + std::sqrt(b * b - (2.0 * a * a - 1.0) * (a * a * d * d - c * c)));
  }
  const double steepest = limit > d ? 0.5 * (d + std::sqrt(2.0 * limit * limit - d * d)) : limit;
  return std::min(w, steepest);
}

}  // namespace

void erode(Grid<float>& altitude_m, const Drainage& drainage, const Grid<float>& catchment_km2,
           const Grid<float>& uplift_m, const Grid<float>& softness,
           const ErosionParameters& parameters, Grid<ErosionCell>& memory) {
  const int width = altitude_m.width();
  const auto reach = static_cast<float>(240.0 * parameters.unit_m / parameters.cell_m);
  const auto area_unit = static_cast<float>(parameters.unit_m * parameters.unit_m);
  constexpr float unknown = std::numeric_limits<float>::infinity();
  if (!memory.same_size(altitude_m)) memory = Grid<ErosionCell>(width, altitude_m.height());
  Grid<ErosionCell>& cells = memory;
  parallel_rows(altitude_m.height(), [&](int y) {
    std::vector<float> water(static_cast<std::size_t>(width));
    for (int x = 0; x < width; ++x)
      water[at(x)] = catchment_km2(x, y) / area_unit + parameters.hillslope_km2;
    power_line(water.data(), 0.6, width, water.data());
    for (int x = 0; x < width; ++x) {
      const std::size_t i = altitude_m.index(x, y);
      cells[i] = {
          unknown, altitude_m[i] + parameters.step * uplift_m[i],
          reach * parameters.step * softness[i] * water[at(x)],
          parameters.steepest * static_cast<float>(parameters.cell_m) * (0.6F + 0.4F / softness[i]),
          drainage.receiver[i]};
    }
  });
  // New altitude of the lower of two opposite neighbours that are done; else infinity.
  const auto lower = [&](bool one, std::size_t a, bool two, std::size_t b) {
    const float z = one ? cells[a].altitude_m : unknown;
    return static_cast<double>(two ? std::min(z, cells[b].altitude_m) : z);
  };
  const auto stride = static_cast<std::size_t>(width);
  constexpr std::size_t ahead = 16;  // cells whose neighbourhoods are prefetched
  for (std::size_t k = 0; k < drainage.order.size(); ++k) {
    if (k + ahead < drainage.order.size()) {
      const std::size_t next = at(drainage.order[k + ahead]);
      __builtin_prefetch(&cells[next]);
      if (next >= stride) __builtin_prefetch(&cells[next - stride]);
      if (next + stride < cells.size()) __builtin_prefetch(&cells[next + stride]);
    }
    const std::int32_t index = drainage.order[k];
    const std::size_t i = at(index);
    ErosionCell& cell = cells[i];
    if (cell.receiver < 0) {
      cell.altitude_m = altitude_m[i];
      continue;
    }
    const int x = index % width;
    const int y = index / width;
    // Along the flow path: relevant in a channel.
    const float length = step_cells(index, cell.receiver, width);
    const float f = cell.incision / length;
    const float below = cells[at(cell.receiver)].altitude_m;
    float z = std::min((cell.risen_m + f * below) / (1.F + f), below + cell.limit_m * length);
    // Along the true gradient: relevant on a slope.
    const double lower_x = lower(x > 0, i - 1, x + 1 < width, i + 1);
    const double lower_y = lower(y > 0, i - stride, y + 1 < altitude_m.height(), i + stride);
    const double low = std::min(lower_x, lower_y);
    if (low < infinity)
      z = std::min(z, static_cast<float>(low + upwind_rise(static_cast<double>(cell.risen_m) - low,
                                                           std::max(lower_x, lower_y) - low,
                                                           static_cast<double>(cell.incision),
                                                           static_cast<double>(cell.limit_m))));
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
      const float straight =
          before(x - 1, y) + before(x + 1, y) + before(x, y - 1) + before(x, y + 1);
      const float diagonal =
          before(x - 1, y - 1) + before(x + 1, y - 1) + before(x - 1, y + 1) + before(x + 1, y + 1);
      // Weights 4:1 make the nine-point Laplacian isotropic.
      altitude_m(x, y) += rate * ((4.F * straight + diagonal) / 20.F - before(x, y));
    }
  });
}

}  // namespace belvedere::synthetic
