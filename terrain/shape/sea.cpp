#include "terrain/shape/sea.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/filter.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "terrain/shape/mask_pieces.h"

namespace belvedere {
namespace {

constexpr float farthest_level_m =
    1.5F;  // of the sea from the datum: tides and differences between geoids
constexpr int fine = 2;

// Mean over a (2 radius + 1)² window, borders replicated: rows, then columns, each by a running sum
// in double that restarts in every row (column), so that threads do not affect the result.
Grid<float> box_mean(const Grid<float>& values, int radius) {
  const int width = values.width();
  const int height = values.height();
  const double share = 1.0 / (2 * radius + 1);
  Grid<float> rows(width, height);
  parallel_rows(height, [&](int y) {
    double sum = 0.0;
    for (int x = -radius; x <= radius; ++x) sum += values.clamped(x, y);
    for (int x = 0; x < width; ++x) {
      rows(x, y) = static_cast<float>(sum * share);
      sum += values.clamped(x + radius + 1, y) - static_cast<double>(values.clamped(x - radius, y));
    }
  });
  // Columns in strips, with adjacent sums.
  Grid<float> mean(width, height);
  constexpr int strip = 256;
  parallel_ranges((width + strip - 1) / strip, 1, [&](int begin, int end) {
    for (int part = begin; part != end; ++part) {
      const int x0 = part * strip;
      const int count = std::min(strip, width - x0);
      std::array<double, strip> sum{};
      for (int y = -radius; y <= radius; ++y)
        for (int k = 0; k < count; ++k)
          sum[static_cast<std::size_t>(k)] += rows(x0 + k, std::clamp(y, 0, height - 1));
      for (int y = 0; y < height; ++y) {
        const float* in = rows.row(std::min(y + radius + 1, height - 1)) + x0;
        const float* out = rows.row(std::max(y - radius, 0)) + x0;
        for (int k = 0; k < count; ++k) {
          double& s = sum[static_cast<std::size_t>(k)];
          mean(x0 + k, y) = static_cast<float>(s * share);
          s += in[k] - static_cast<double>(out[k]);
        }
      }
    }
  });
  return mean;
}

// The most frequent altitude (by fine means) within farthest_level_m of 0; nothing if fewer than
// `least` cells have it.
std::optional<float> max_common_level(const Grid<float>& fine_mean, const Mask& filled, int min) {
  constexpr float bin_m = 0.05F;
  constexpr int bins = 60;  // 2 · farthest_level_m / bin_m
  std::array<std::size_t, bins + 4> count{};
  for (std::size_t i = 0; i < fine_mean.size(); ++i) {
    const float z = fine_mean[i];
    if (filled[i] != 0 || !(std::abs(z) < farthest_level_m)) continue;
    ++count[static_cast<std::size_t>((z + farthest_level_m) / bin_m) + 2];
  }
  std::size_t best = 0;
  std::size_t max = 0;
  for (std::size_t b = 2; b < bins + 2; ++b) {
    const std::size_t near = count[b - 2] + count[b - 1] + count[b] + count[b + 1] + count[b + 2];
    if (near > max) {
      max = near;
      best = b;
    }
  }
  if (max < static_cast<std::size_t>(min)) return std::nullopt;
  const float centre = (static_cast<float>(best) - 1.5F) * bin_m - farthest_level_m;
  // The mean of the altitudes near it; rows are summed separately, then one after the other.
  std::vector<double> sums(static_cast<std::size_t>(fine_mean.height()), 0.0);
  std::vector<double> counts(sums.size(), 0.0);
  parallel_rows(fine_mean.height(), [&](int y) {
    for (int x = 0; x < fine_mean.width(); ++x) {
      const float z = fine_mean(x, y);
      if (filled(x, y) != 0 || !(std::abs(z - centre) < 2.5F * bin_m)) continue;
      sums[static_cast<std::size_t>(y)] += z;
      counts[static_cast<std::size_t>(y)] += 1.0;
    }
  });
  double sum = 0.0;
  double all = 0.0;
  for (std::size_t y = 0; y < sums.size(); ++y) {
    sum += sums[y];
    all += counts[y];
  }
  return static_cast<float>(sum / all);
}

// Deviation of the marked cells from a level: the 95th percentile, to .05 m.
float spread_m(const Grid<float>& z, const Mask& mask, const Mask& filled, float level) {
  constexpr float bin_m = 0.05F;
  std::array<std::size_t, 200> count{};
  std::size_t all = 0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (mask[i] == 0 || filled[i] != 0) continue;
    ++count[static_cast<std::size_t>(std::min(199.F, std::abs(z[i] - level) / bin_m))];
    ++all;
  }
  std::size_t below = 0;
  for (std::size_t b = 0; b < count.size(); ++b) {
    below += count[b];
    if (20 * below >= 19 * all) return b == 0 ? 0.F : static_cast<float>(b + 1) * bin_m;
  }
  return 0.F;
}

// Level water under noise: means over (2 radius + 1)² cells differ from the level and from adjacent
// means by at most this.
struct RoughWater {
  int radius;
  float range_m;
};
// Noise of 2 m leaves .065 m rms between means of open water; ground that rises 1 in 3600 (30 m
// cells) leaves more. Bays are narrower.
constexpr RoughWater open_sea{12, 0.2F};
constexpr RoughWater bay{4, 0.5F};

// Level water near a level: exact, if the DEM's water was flattened, or rough.
Mask level_ground(const Grid<float>& z, const Grid<float>& fine_mean, const Mask& filled,
                  float level, const RoughWater& water) {
  constexpr float exact_m = 0.01F;
  const Grid<float> mean = box_mean(z, water.radius);
  Mask mask(z.width(), z.height(), 0);
  parallel_rows(mask.height(), [&](int y) {
    const auto is_level = [y](const Grid<float>& grid, int x, int reach, float max) {
      const float here = grid(x, y);
      return std::abs(grid.clamped(x + reach, y) - here) <= max &&
             std::abs(grid.clamped(x - reach, y) - here) <= max &&
             std::abs(grid.clamped(x, y + reach) - here) <= max &&
             std::abs(grid.clamped(x, y - reach) - here) <= max;
    };
    for (int x = 0; x < mask.width(); ++x) {
      if (filled(x, y) != 0 || std::abs(fine_mean(x, y) - level) > 1.F) continue;
      const bool exact = std::abs(z(x, y) - level) <= 0.2F && is_level(z, x, fine, exact_m) &&
                         is_level(z, x, 1, exact_m);
      const bool rough = std::abs(mean(x, y) - level) <= water.range_m &&
                         is_level(mean, x, 2 * water.radius, water.range_m);
      mask(x, y) = exact || rough ? 1 : 0;
    }
  });
  return mask;
}

// The median of the marked cells' altitudes: exact if the water was flattened.
float median_of(const Grid<float>& z, const std::vector<std::int32_t>& cells) {
  std::vector<float> values;
  values.reserve(cells.size());
  for (const std::int32_t at : cells) values.push_back(z[static_cast<std::size_t>(at)]);
  return middle_value(std::move(values));
}

// Whether the border of a DEM is open to the sea: the border of the data is, that of a window is
// not.
enum class Edge { open, of_window };

// Voids in the data that are sea: at the border or next to level water, with low ground around.
void mark_holes(Mask& mask, const Dem& dem, float highest_shore_m, Edge edge) {
  const Mask& filled = dem.filled;
  std::vector<std::int32_t> sea;
  each_piece(filled, 1, [&](const std::vector<std::int32_t>& cells) {
    std::size_t around = 0;
    std::size_t low = 0;
    bool open = false;
    for (const std::int32_t at : cells) {
      const int x = at % mask.width();
      const int y = at / mask.width();
      open = open || (edge == Edge::open && at_edge(mask, x, y));
      for (const auto& [dx, dy] :
           {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}}) {
        if (!mask.contains(x + dx, y + dy) || filled(x + dx, y + dy) != 0) continue;
        ++around;
        low += dem.altitude_m(x + dx, y + dy) <= highest_shore_m ? 1 : 0;
        open = open || mask(x + dx, y + dy) != 0;
      }
    }
    if (open && around > 0 && 4 * low >= around) sea.insert(sea.end(), cells.begin(), cells.end());
  });
  for (const std::int32_t at : sea) mask[static_cast<std::size_t>(at)] = 1;
}

std::vector<std::int32_t> marked(const Mask& mask) {
  std::vector<std::int32_t> cells;
  for (std::size_t i = 0; i < mask.size(); ++i)
    if (mask[i] != 0) cells.push_back(static_cast<std::int32_t>(i));
  return cells;
}

// Noise leaves specks of land on the water and water short of the shore: both are closed.
void close_shores(Mask& mask, const Grid<float>& z, float highest_m) {
  for (int round = 0; round < fine; ++round) {
    const Mask before = mask;
    parallel_rows(mask.height(), [&](int y) {
      for (int x = 0; x < mask.width(); ++x) {
        if (before(x, y) != 0 || z(x, y) > highest_m) continue;
        int near = 0;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) near += before.clamped(x + dx, y + dy);
        if (near >= 3) mask(x, y) = 1;
      }
    });
  }
}

Sea finish(Mask mask, float level, float noise) {
  Sea sea;
  std::size_t count = 0;
  for (const std::uint8_t cell : mask) count += cell;
  if (count == 0) return sea;
  sea.share = static_cast<double>(count) / static_cast<double>(mask.size());
  sea.level_m = level;
  sea.noise_m = noise;
  sea.mask = std::move(mask);
  return sea;
}

// Properties of a sea from some of its cells.
struct AboutSea {
  float level_m;
  float noise_m;
  int min_cells;
  Edge edge;
};

// Extends open water to everything that belongs to it.
void spread_sea(Mask& mask, const Dem& dem, const Grid<float>& fine_mean, const AboutSea& about) {
  const Grid<float>& z = dem.altitude_m;
  const float level = about.level_m;
  const float noise = about.noise_m;
  mark_holes(mask, dem, level + 2.F + noise, about.edge);

  // Calm water is distinguished from land by its altitude; noisy water only by means, and single
  // outlying cells are rocks.
  const bool calm = noise < 0.3F;
  const float highest = level + (calm ? 0.3F : 1.25F * noise);
  const float highest_mean = level + (calm ? 1e9F : 0.4F * noise);
  const auto is_low = [&](int x, int y) {
    return z(x, y) <= highest && fine_mean(x, y) <= highest_mean;
  };
  flood(mask, marked(mask), is_low);
  if (!calm) {
    // Noise closes narrow entrances of bays and lagoons: level water a short distance behind the
    // shore is sea as well. Calm lagoons are lakes.
    constexpr int farthest = 48;  // cells
    const Grid<std::int32_t> nearest = nearest_marked(mask);
    const auto is_near = [&](std::int32_t at) {
      const std::int32_t shore = nearest[static_cast<std::size_t>(at)];
      if (shore < 0) return false;
      const int dx = shore % z.width() - at % z.width();
      const int dy = shore / z.width() - at / z.width();
      return dx * dx + dy * dy <= farthest * farthest;
    };
    std::vector<std::int32_t> bays;
    each_piece(level_ground(z, fine_mean, dem.filled, level, bay), 1,
               [&](const std::vector<std::int32_t>& cells) {
                 if (cells.size() >= static_cast<std::size_t>(about.min_cells) &&
                     std::any_of(cells.begin(), cells.end(), is_near))
                   bays.insert(bays.end(), cells.begin(), cells.end());
               });
    for (const std::int32_t at : bays) mask[static_cast<std::size_t>(at)] = 1;
    flood(mask, bays, is_low);
    close_shores(mask, z, highest);
  }
}

// Everything at or below the level that is connected with the border.
Sea below_level(const Dem& dem, float level) {
  const Grid<float>& z = dem.altitude_m;
  constexpr float over_m = 0.25F;
  Mask mask(z.width(), z.height(), 0);
  mark_holes(mask, dem, level + 2.F, Edge::open);
  for (int y = 0; y < z.height(); ++y)
    for (int x = 0; x < z.width(); ++x)
      if (at_edge(mask, x, y) && dem.filled(x, y) == 0 && z(x, y) <= level + over_m) mask(x, y) = 1;
  flood(mask, marked(mask), [&](int x, int y) { return z(x, y) <= level + over_m; });
  return finish(std::move(mask), level, 0.F);
}

}  // namespace

Sea find_sea(const Dem& dem, const SeaParameters& parameters) {
  const Grid<float>& z = dem.altitude_m;
  if (parameters.known) return *parameters.known;
  if (!parameters.look || z.empty()) return {};
  if (parameters.level_m) return below_level(dem, static_cast<float>(*parameters.level_m));
  // Most maps are high above the sea.
  const bool any_low = std::any_of(
      z.begin(), z.end(), [](float altitude) { return altitude < farthest_level_m + 2.F; });
  if (!any_low) return {};

  Mask mask(z.width(), z.height(), 0);
  float level = 0.F;
  float noise = 0.F;
  const Grid<float> fine_mean = box_mean(z, fine);
  if (const auto common = max_common_level(fine_mean, dem.filled, parameters.min_cells)) {
    level = *common;
    const Mask ground = level_ground(z, fine_mean, dem.filled, level, open_sea);
    std::vector<std::int32_t> open_water;
    each_piece(ground, 1, [&](const std::vector<std::int32_t>& cells) {
      if (cells.size() < static_cast<std::size_t>(parameters.min_cells)) return;
      const bool opens = std::any_of(cells.begin(), cells.end(), [&](std::int32_t at) {
        const int x = at % z.width();
        const int y = at / z.width();
        // Means near voids are no longer level: they are searched two windows away.
        for (const auto& [dx, dy] :
             {std::pair{0, 0}, std::pair{2 * open_sea.radius, 0},
              std::pair{-2 * open_sea.radius, 0}, std::pair{0, 2 * open_sea.radius},
              std::pair{0, -2 * open_sea.radius}})
          if (dem.filled.clamped(x + dx, y + dy) != 0) return true;
        return at_edge(ground, x, y);
      });
      if (opens) open_water.insert(open_water.end(), cells.begin(), cells.end());
    });
    for (const std::int32_t at : open_water) mask[static_cast<std::size_t>(at)] = 1;
    if (!open_water.empty()) level = median_of(z, open_water);
    noise = spread_m(z, mask, dem.filled, level);
  }
  spread_sea(mask, dem, fine_mean, {level, noise, parameters.min_cells, Edge::open});
  return finish(std::move(mask), level, noise);
}

Sea continue_sea(const Dem& window, const Dem& whole, const Sea& sea,
                 const SeaParameters& parameters) {
  if (sea.empty() || window.altitude_m.empty()) return {};
  const Grid<float>& z = window.altitude_m;
  const auto level = static_cast<float>(sea.level_m);
  // Where the whole has sea: in the whole's cell that contains the window's.
  Mask known(z.width(), z.height(), 0);
  parallel_rows(z.height(), [&](int y) {
    for (int x = 0; x < z.width(); ++x) {
      const glm::dvec2 position = window.transform.to_crs(x, y);
      const glm::dvec2 at = whole.transform.to_cell(position.x, position.y);
      known(x, y) = sea.mask.clamped(static_cast<int>(std::lround(at.x)),
                                     static_cast<int>(std::lround(at.y)));
    }
  });
  if (std::none_of(known.begin(), known.end(), [](std::uint8_t cell) { return cell != 0; }))
    return {};

  // The whole's cells are means of many, and less noisy.
  const Grid<float> fine_mean = box_mean(z, fine);
  Mask mask = level_ground(z, fine_mean, window.filled, level, open_sea);
  for (std::size_t i = 0; i < mask.size(); ++i)
    mask[i] = static_cast<std::uint8_t>(mask[i] & known[i]);
  const float noise =
      std::max(spread_m(z, mask, window.filled, level), static_cast<float>(sea.noise_m));
  // Shores of the whole's cells are steps: land in its sea is land if it is higher than the noise
  // of the water.
  const float highest = level + std::max(0.3F, 1.25F * noise);
  for (std::size_t i = 0; i < mask.size(); ++i)
    if (known[i] != 0 && (window.filled[i] != 0 || z[i] <= highest)) mask[i] = 1;
  spread_sea(mask, window, fine_mean, {level, noise, parameters.min_cells, Edge::of_window});
  return finish(std::move(mask), level, noise);
}

void level_sea(Dem& dem, const Sea& sea) {
  if (sea.empty()) return;
  const auto level = static_cast<float>(sea.level_m);
  parallel_rows(dem.height(), [&](int y) {
    for (int x = 0; x < dem.width(); ++x) {
      if (sea.mask(x, y) == 0) continue;
      dem.altitude_m(x, y) = level;
      dem.filled(x, y) = 0;
    }
  });
}

}  // namespace belvedere
