#include "terrain/cover/rule_ice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <utility>

#include "base/filter.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/rising_queue.h"

namespace belvedere::class_rules {
namespace {

constexpr float lasting_balance = -8.F;    // no ice below this balance
constexpr double widest_stream_m = 900.0;  // of ice, on each side
constexpr float min_stream_km2 = 0.02F;    // smaller streams are dropped

constexpr std::array<glm::ivec2, 8> around_cell = {
    {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

// Flow directions of ice from a cell: to all lower neighbours, more to the steeper ones (Freeman
// 1991).
struct Downhill {
  std::array<float, 8> shares{};  // in the order of around_cell, of `total`
  float total = 0.F;
};
Downhill downhill(const Grid<float>& surface, int x, int y) {
  Downhill down;
  const float here = surface(x, y);
  for (std::size_t k = 0; k < around_cell.size(); ++k) {
    const glm::ivec2 step = around_cell[k];
    if (!surface.contains(x + step.x, y + step.y)) continue;
    const float drop = here - surface(x + step.x, y + step.y);
    const float steep = step.x != 0 && step.y != 0 ? drop * 0.7071F : drop;
    // To the power 1.25, within Freeman's range, as two square roots: fast and equally rounded on
    // every machine.
    if (drop > 0.F) down.shares[k] = steep * std::sqrt(std::sqrt(steep));
    down.total += down.shares[k];
  }
  return down;
}

}  // namespace

RuleIce flowing_ice(const Grid<float>& balance, const Dem& dem,
                    const std::vector<IceEntry>& entries) {
  const int width = dem.width();
  const int height = dem.height();
  const double cell = dem.cell_m();
  // Smoothed: ice does not follow every gully of its bed.
  Grid<float> surface = gaussian_blur(dem.altitude_m, 90.0 / cell);
  // Highest first, equal ones in the order of their cells.
  std::vector<std::uint64_t> falling;
  for (std::size_t i = 0; i < balance.size(); ++i)
    if (balance[i] > lasting_balance)
      falling.push_back(rising_key(-surface[i], static_cast<std::uint32_t>(i)));
  std::sort(falling.begin(), falling.end());

  // In km² of snow field.
  const auto own = static_cast<float>(cell * cell * 1e-6);
  Grid<float> flux(width, height, 0.F);
  for (const IceEntry& entry : entries) flux[static_cast<std::size_t>(entry.cell)] += entry.km2;
  for (const std::uint64_t key : falling) {
    const auto i = static_cast<std::int32_t>(key & 0xffffffffU);
    const auto here = static_cast<std::size_t>(i);
    flux[here] = std::max(0.F, flux[here] + own * std::min(balance[here], 1.F));
    if (flux[here] <= 0.F) continue;
    const Downhill down = downhill(surface, i % width, i / width);
    if (down.total <= 0.F) continue;
    for (std::size_t k = 0; k < down.shares.size(); ++k)
      if (down.shares[k] > 0.F)
        flux(i % width + around_cell[k].x, i / width + around_cell[k].y) +=
            flux[here] * down.shares[k] / down.total;
  }

  falling = {};

  // The thickness of a stream grows with its flow; it covers the neighbouring bed up to its level.
  struct IceStream {
    int x;
    int reach;  // cells
    float level_m;
  };
  std::vector<std::vector<IceStream>> streams(static_cast<std::size_t>(height));  // of each row
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const float f = flux(x, y);
      if (f < min_stream_km2 || !(balance(x, y) > lasting_balance)) continue;
      const auto thickness = static_cast<float>(45.0 * exact::pow(f, 0.3));
      const int reach = static_cast<int>(
          std::min(widest_stream_m, 420.0 * std::sqrt(static_cast<double>(f))) / cell);
      streams[static_cast<std::size_t>(y)].push_back({x, reach, surface(x, y) + thickness});
    }
  });
  Grid<float> covered(width, height, 0.F);
  const int farthest = static_cast<int>(widest_stream_m / cell);
  parallel_rows(height, [&](int y) {
    const float* bed = dem.altitude_m.row(y);
    const float* melts = balance.row(y);
    float* out = covered.row(y);
    for (int cy = std::max(0, y - farthest); cy < std::min(height, y + farthest + 1); ++cy) {
      const int dy = y - cy;
      for (const IceStream& stream : streams[static_cast<std::size_t>(cy)]) {
        const int left = stream.reach * stream.reach - dy * dy;
        if (left < 0) continue;
        int half = static_cast<int>(std::sqrt(static_cast<float>(left)));
        while (half * half > left) --half;
        while ((half + 1) * (half + 1) <= left) ++half;
        const int end = std::min(width, stream.x + half + 1);
        for (int x = std::max(0, stream.x - half); x < end; ++x)
          out[x] = ((bed[x] < stream.level_m) & (melts[x] > lasting_balance)) != 0 ? 1.F : out[x];
      }
    }
  });
  return {gaussian_blur(covered, 60.0 / cell), std::move(flux), std::move(surface)};
}

std::vector<IceEntry> find_ice_entries(const RuleGround& around, const Dem& window) {
  std::vector<IceEntry> entries;
  const Grid<float>& flux = around.ice_km2;
  if (flux.empty()) return entries;
  // Cells of the surrounding ground whose centres lie in the window.
  const auto cell_at = [&](double column, double row) {
    const glm::dvec2 position = window.transform.to_crs(column, row);
    return around.transform.to_cell(position.x, position.y);
  };
  const glm::dvec2 first = cell_at(0.0, 0.0);
  const glm::dvec2 last = cell_at(window.width() - 1.0, window.height() - 1.0);
  constexpr double close = 1e-3;
  const PixelRect inside = {static_cast<int>(std::ceil(first.x - close)),
                            static_cast<int>(std::ceil(first.y - close)),
                            static_cast<int>(std::floor(last.x + close)) + 1,
                            static_cast<int>(std::floor(last.y + close)) + 1};
  const int factor =
      static_cast<int>(std::lround(around.transform.cell_x / window.transform.cell_x));
  const auto look = [&](int x, int y) {  // visits a cell outside, next to the window
    if (!flux.contains(x, y) || flux(x, y) < min_stream_km2) return;
    const Downhill down = downhill(around.ice_surface_m, x, y);
    for (std::size_t k = 0; k < around_cell.size(); ++k) {
      const glm::ivec2 next = glm::ivec2(x, y) + around_cell[k];
      if (!(down.shares[k] > 0.F) || next.x < inside.x0 || next.y < inside.y0 ||
          next.x >= inside.x1 || next.y >= inside.y1)
        continue;
      // It flows to the lowest ground nearby.
      const glm::dvec2 position = around.transform.to_crs(next.x, next.y);
      const glm::ivec2 centre(glm::round(window.transform.to_cell(position.x, position.y)));
      glm::ivec2 lowest(std::clamp(centre.x, 0, window.width() - 1),
                        std::clamp(centre.y, 0, window.height() - 1));
      for (int v = -factor / 2; v <= factor / 2; ++v)
        for (int u = -factor / 2; u <= factor / 2; ++u)
          if (const glm::ivec2 other = centre + glm::ivec2(u, v);
              window.altitude_m.contains(other.x, other.y) &&
              window.altitude_m(other.x, other.y) < window.altitude_m(lowest.x, lowest.y))
            lowest = other;
      entries.push_back(
          {lowest.y * window.width() + lowest.x, flux(x, y) * down.shares[k] / down.total});
    }
  };
  for (int x = inside.x0 - 1; x <= inside.x1; ++x) look(x, inside.y0 - 1), look(x, inside.y1);
  for (int y = inside.y0; y < inside.y1; ++y) look(inside.x0 - 1, y), look(inside.x1, y);
  return entries;
}

}  // namespace belvedere::class_rules
