#include "terrain/shape/river_bends.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/noise.h"
#include "base/random_streams.h"

namespace belvedere {
namespace {

// Ground that a river may occupy: its height differs by at most this, plus this much per metre of
// distance.
constexpr double level_m = 3.0;
constexpr double level_slope = 0.015;
constexpr int max_room = 24;  // cells
constexpr int tight = 9;      // cells: the narrowest position within this distance counts
// Passes of [1 2 1] / 4, each of variance 1/2.
constexpr int rounding_passes = 120;  // 7.7 cells, on wide ground
constexpr int room_passes = 30;       // 3.9 cells
constexpr double rounded_from = 3.0;  // cells of room at which rounding begins …
constexpr double rounded_to = 10.0;   // … and is complete
constexpr std::size_t end_cells = 20;
constexpr std::size_t across_cells = 5;
constexpr double of_room =
    0.45;  // share of the room that bends take at twice their standard deviation
// Gaussian noise of standard deviation s crosses 0 every 4.4 s, so a full bend is 8.9 s long.
struct Swing {
  double sigma_widths;  // of half the drawn width
  double share;         // its amplitude (standard deviation), of sigma
};
constexpr std::array<Swing, 2> swings = {Swing{4.5, 0.70}, Swing{13.0, 0.45}};
constexpr double min_sigma_cells = 1.2;
constexpr double min_half_m = 8.0;
constexpr std::uint64_t first_part =
    1024;  // of the noise of land cover; its patches of 60 m and more use lower parts

// Extent in cells of the level ground around a position, in the most confined direction.
double room_at(const Grid<float>& altitude_m, glm::dvec2 position, double cell_m) {
  const auto x = static_cast<int>(std::lround(position.x));
  const auto y = static_cast<int>(std::lround(position.y));
  if (!altitude_m.contains(x, y)) return 0.0;
  const auto here = static_cast<double>(altitude_m(x, y));
  int min = max_room;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      if (dx == 0 && dy == 0) continue;
      const double step = std::sqrt(static_cast<double>(dx * dx + dy * dy));
      int k = 1;
      for (; k * step <= min; ++k) {
        if (!altitude_m.contains(x + k * dx, y + k * dy)) break;
        const double off = std::abs(static_cast<double>(altitude_m(x + k * dx, y + k * dy)) - here);
        if (off > level_m + level_slope * k * step * cell_m) break;
      }
      min = std::min(min, static_cast<int>((k - 1) * step));
    }
  return min;
}

template <class T>
void smooth(std::vector<T>& values, int passes, const std::vector<double>& share) {
  std::vector<T> next = values;
  for (int pass = 0; pass < passes && values.size() > 2; ++pass) {
    for (std::size_t i = 1; i + 1 < values.size(); ++i)
      next[i] = values[i] + 0.25 * share[i] * (values[i - 1] + values[i + 1] - 2.0 * values[i]);
    values.swap(next);
  }
}

// Room along the river: the narrowest nearby, smoothed, none at its ends and on open water.
std::vector<double> room_along(const RiverLine& river, const Grid<float>& altitude_m,
                               double cell_m) {
  const std::size_t count = river.positions.size();
  std::vector<double> own(count);
  for (std::size_t i = 0; i < count; ++i)
    own[i] = river.held[i] ? 0.0 : room_at(altitude_m, river.positions[i], cell_m);
  std::vector<double> room(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto first =
        own.begin() + static_cast<std::ptrdiff_t>(i - std::min<std::size_t>(i, tight));
    const auto last = own.begin() + static_cast<std::ptrdiff_t>(std::min(count, i + tight + 1));
    room[i] = *std::min_element(first, last);
  }
  smooth(room, room_passes, std::vector<double>(count, 1.0));
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t end = std::min({i, count - 1 - i, end_cells});
    room[i] *=
        river.held[i] ? 0.0 : smoothstep(static_cast<double>(end) / static_cast<double>(end_cells));
  }
  return room;
}

}  // namespace

void bend_on_level_ground(RiverLine& river, const Grid<float>& altitude_m,
                          const GeoTransform& transform, std::uint64_t seed) {
  const std::size_t count = river.positions.size();
  if (count < 3) return;
  const double cell_m = 0.5 * (transform.cell_x + transform.cell_y);
  const std::vector<double> room = room_along(river, altitude_m, cell_m);
  if (std::all_of(room.begin(), room.end(), [](double cells) { return cells < 1.0; })) return;
  std::vector<double> rounded(count);
  for (std::size_t i = 0; i < count; ++i)
    rounded[i] = smoothstep((room[i] - rounded_from) / (rounded_to - rounded_from));
  smooth(river.positions, rounding_passes, rounded);
  const std::vector<glm::dvec2> straight = river.positions;
  for (std::size_t i = 0; i < count; ++i) {
    if (room[i] <= 0.0) continue;
    const glm::dvec2 along =
        straight[std::min(i + across_cells, count - 1)] - straight[i - std::min(i, across_cells)];
    const double length = glm::length(along);
    if (!(length > 0.0)) continue;
    const glm::dvec2 position_m = transform.to_crs(straight[i].x, straight[i].y);
    const double half_m = std::max(river.half_width_m[i], min_half_m);
    double aside_m = 0.0;
    double deviation2_m2 = 0.0;
    for (std::size_t k = 0; k < swings.size(); ++k) {
      // Octaves fixed to the map, mixed so that the amplitude is constant: a river that widens does
      // not slide along its bends.
      const double octave =
          exact::log2(std::max(swings[k].sigma_widths * half_m, min_sigma_cells * cell_m));
      const double below = std::floor(octave);
      const double above = octave - below;
      const double norm = std::sqrt(above * above + (1.0 - above) * (1.0 - above));
      const auto of = [&](double power) {
        const double sigma_m = exact::exp2(power);
        const std::uint64_t key =
            stream_seed(seed, Stream::class_noise, first_part + static_cast<std::uint64_t>(power));
        return sigma_m * gaussian_noise(key, position_m.x, position_m.y, sigma_m);
      };
      const double mixed = (1.0 - above) * of(below) + above * of(below + 1.0);
      const double deviation_m = swings[k].share * exact::exp2(octave);
      aside_m += swings[k].share * mixed / norm;
      deviation2_m2 += deviation_m * deviation_m;
    }
    const double bound_m = 0.5 * of_room * room[i] * cell_m;
    const double share = std::min(1.0, bound_m / std::sqrt(deviation2_m2));
    river.positions[i] += share * aside_m / cell_m * glm::dvec2(-along.y, along.x) / length;
  }
}

}  // namespace belvedere
