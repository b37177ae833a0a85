#include "terrain/generalize.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "renderer/base/error.h"
#include "renderer/base/filter.h"
#include "renderer/base/parallel.h"
#include "renderer/base/pyramid.h"

namespace belvedere {
namespace {

// The change that a kept lake would have had is taken off the land around it as well, less and less over so many cells: a
// valley whose floor sinks must not leave its lake on a table.
constexpr float surroundings_cells = 32.0F;
// That change is a mean over this deviation, so that no seams run between lakes; in blocks, because it is smooth.
constexpr int block_cells = 4;
constexpr double mean_cells = 10.0;
// What is left of the change at the shore itself fades in over so many cells.
constexpr float shore_cells = 6.0F;
// The crest terms of the recipe end with the fourth band.
constexpr int crest_bands = 4;

// The stage works on the change, D = A' - A: with D_n = 0 and D_i = expand(D_i+1) + (w_i - 1) L_i it needs no band grids, keeps
// the float's precision for the small numbers, and unit weights change nothing at all. An empty grid is a change of 0.
struct Levels {
  std::vector<Grid<float>> altitude_m;  // [i] is level i + 1: level 0 is the caller's
  std::vector<Grid<float>> share;       // of the foreground, level 0 first; empty: 1
  std::vector<Grid<float>> free;        // 1 where the terrain may change, 0 in lakes; empty: 1
};

struct BandWeight {
  float foreground = 1.F;
  float background = 1.F;
};

float unit(float v) { return std::clamp(v, 0.F, 1.F); }

// expand(D) of a coarser change, 0 where there is none.
void expand_change_row(const Grid<float>& coarser, int y, std::vector<float>& row) {
  if (coarser.empty()) {
    std::fill(row.begin(), row.end(), 0.F);
  } else {
    expand_row(coarser, y, static_cast<int>(row.size()), row.data());
  }
}

// D_i from D_i+1, `level` being G_i and `coarser` G_i+1.
Grid<float> add_band(const Grid<float>& level, const Grid<float>& coarser, const Grid<float>& coarser_change, const Grid<float>* share,
                     const Grid<float>* free, BandWeight weight) {
  const bool unchanged = weight.foreground == 1.F && (share == nullptr || weight.background == 1.F);
  if (unchanged && coarser_change.empty()) return {};
  const int width = level.width();
  Grid<float> change(width, level.height());
  parallel_rows(level.height(), [&](int y) {
    std::vector<float> smooth(static_cast<std::size_t>(width));
    std::vector<float> gain(static_cast<std::size_t>(width), weight.foreground - 1.F);
    float* out = change.row(y);
    if (coarser_change.empty()) {
      std::fill(out, out + width, 0.F);
    } else {
      expand_row(coarser_change, y, width, out);
    }
    if (unchanged) return;
    expand_row(coarser, y, width, smooth.data());
    if (share != nullptr) {
      const float* u = share->row(y);
      for (int x = 0; x < width; ++x) {
        const float near = unit(u[x]);
        gain[x] = near * weight.foreground + (1.F - near) * weight.background - 1.F;
      }
    }
    if (free != nullptr) {
      const float* m = free->row(y);
      for (int x = 0; x < width; ++x) gain[x] *= unit(m[x]);
    }
    const float* g = level.row(y);
    for (int x = 0; x < width; ++x) out[x] += gain[x] * (g[x] - smooth[x]);
  });
  return change;
}

// b2 + b3 + .6 b4 and b5 + b6 + … + base of the recipe, both at level 1; one row of expand brings them to level 0.
struct CrestTerms {
  Grid<float> detail_m;
  Grid<float> ground_m;
};

CrestTerms find_crests(const std::vector<Grid<float>>& levels) {
  CrestTerms crests;
  const int top = std::min(static_cast<int>(levels.size()), crest_bands) - 1;
  crests.ground_m = levels[static_cast<std::size_t>(top)];
  for (int i = top - 1; i >= 0; --i) {
    const Grid<float>& level = levels[static_cast<std::size_t>(i)];
    const Grid<float>& coarser = levels[static_cast<std::size_t>(i) + 1];
    const float weight = i == crest_bands - 2 ? 0.6F : 1.F;
    const int width = level.width();
    Grid<float> detail(width, level.height());
    Grid<float> ground(width, level.height());
    parallel_rows(level.height(), [&](int y) {
      std::vector<float> below(static_cast<std::size_t>(width));
      std::vector<float> smooth(static_cast<std::size_t>(width));
      expand_change_row(crests.detail_m, y, below);
      expand_row(coarser, y, width, smooth.data());
      for (int x = 0; x < width; ++x) detail(x, y) = below[x] + weight * (level(x, y) - smooth[x]);
      expand_row(crests.ground_m, y, width, ground.row(y));
    });
    crests.detail_m = std::move(detail);
    crests.ground_m = std::move(ground);
  }
  return crests;
}

void add_crests(Grid<float>& change, const CrestTerms& crests, const Grid<float>* share, float strength) {
  const int width = change.width();
  parallel_rows(change.height(), [&](int y) {
    std::vector<float> detail(static_cast<std::size_t>(width));
    std::vector<float> ground(static_cast<std::size_t>(width));
    expand_change_row(crests.detail_m, y, detail);
    expand_row(crests.ground_m, y, width, ground.data());
    float* out = change.row(y);
    for (int x = 0; x < width; ++x) {
      const float high = unit((ground[x] - 1200.F) / 700.F);
      const float near = share == nullptr ? 1.F : unit((*share)(x, y));
      out[x] += strength * high * std::clamp(detail[x], 0.F, 60.F) * (1.F - 0.2F * (1.F - near));
    }
  });
}

float smoothstep(float t) { return t * t * (3.F - 2.F * t); }

// Distance from a cell to its nearest lake cell, cells; there is a lake.
float shore_distance(const Grid<std::int32_t>& nearest, int x, int y) {
  const std::int32_t shore = nearest(x, y);
  const int across = shore % nearest.width() - x;
  const int down = shore / nearest.width() - y;
  const auto dx = static_cast<float>(across);
  const auto dy = static_cast<float>(down);
  return std::sqrt(dx * dx + dy * dy);
}

// What lakes take off the change around them, in blocks of block_cells: the mean change of the lake cells nearby, fading with the
// distance. The last blur rounds the creases that the distance has halfway between two shores.
Grid<float> pull_of_lakes(const Grid<float>& change, const Grid<unsigned char>& keep, const Grid<std::int32_t>& nearest) {
  Grid<float> sum((change.width() + block_cells - 1) / block_cells, (change.height() + block_cells - 1) / block_cells);
  Grid<float> count(sum.width(), sum.height());
  parallel_rows(sum.height(), [&](int block) {
    for (int y = block * block_cells; y < std::min((block + 1) * block_cells, change.height()); ++y) {
      for (int x = 0; x < change.width(); ++x) {
        if (keep(x, y) == 0) continue;
        sum(x / block_cells, block) += change(x, y);
        count(x / block_cells, block) += 1.F;
      }
    }
  });
  Grid<float> pull = gaussian_blur(sum, mean_cells / block_cells);
  count = gaussian_blur(count, mean_cells / block_cells);
  parallel_rows(pull.height(), [&](int y) {
    for (int x = 0; x < pull.width(); ++x) {
      const int middle_x = std::min(x * block_cells + block_cells / 2, change.width() - 1);
      const int middle_y = std::min(y * block_cells + block_cells / 2, change.height() - 1);
      const float fade = 1.F - smoothstep(unit(shore_distance(nearest, middle_x, middle_y) / surroundings_cells));
      pull(x, y) = count(x, y) > 0.F ? fade * pull(x, y) / count(x, y) : 0.F;
    }
  });
  return gaussian_blur(pull, 1.5);
}

// No change in lakes, little of it beside them, all of it farther off.
void settle_around_lakes(Grid<float>& change, const Grid<unsigned char>& keep) {
  const Grid<std::int32_t> nearest = nearest_marked(keep);
  const Grid<float> pull = pull_of_lakes(change, keep, nearest);
  parallel_rows(change.height(), [&](int y) {
    for (int x = 0; x < change.width(); ++x) {
      const float distance = shore_distance(nearest, x, y);
      if (distance >= 1.5F * surroundings_cells) continue;  // beyond the reach of the last blur
      // Block centres lie at 1.5, 5.5, 9.5… cells.
      const double u = (x - 0.5 * (block_cells - 1)) / block_cells;
      const double v = (y - 0.5 * (block_cells - 1)) / block_cells;
      change(x, y) = (change(x, y) - sample_bspline(pull, u, v)) * smoothstep(unit(distance / shore_cells));
    }
  });
}

void check(const Grid<float>& altitude_m, const Grid<float>& share, const Grid<unsigned char>& keep,
           const GeneralizeParameters& parameters) {
  if (parameters.foreground.size() != parameters.background.size()) {
    throw Error(ErrorKind::usage, "generalize.background", fmt::format("{} weights", parameters.background.size()),
                fmt::format("as many as generalize.foreground has, {}", parameters.foreground.size()));
  }
  if ((!share.empty() && !share.same_size(altitude_m)) || (!keep.empty() && !keep.same_size(altitude_m))) {
    throw Error(ErrorKind::bug, "generalize", "a foreground or lake grid whose size is not the DEM's");
  }
}

}  // namespace

Grid<float> generalize(const Grid<float>& altitude_m, const Grid<float>& foreground_share, const Grid<unsigned char>& keep,
                       const GeneralizeParameters& parameters, Progress& progress) {
  check(altitude_m, foreground_share, keep, parameters);
  const int weights = static_cast<int>(parameters.foreground.size());
  const int possible = most_bands(altitude_m.width(), altitude_m.height());
  const int bands = std::min(weights, possible);
  const int reductions = parameters.crest > 0.F ? std::min(std::max(weights, crest_bands), possible) : bands;
  const bool has_share = !foreground_share.empty();
  const bool has_lakes = std::any_of(keep.begin(), keep.end(), [](unsigned char k) { return k != 0; });
  progress.begin("generalize", 2.0 * reductions + 1.0);

  Levels levels;
  for (int i = 0; i < reductions; ++i) {
    levels.altitude_m.push_back(reduce(i == 0 ? altitude_m : levels.altitude_m.back()));
    progress.advance(1.0);
  }
  // Coarser levels of the two masks; level 0 is read where it is.
  for (int i = 1; has_share && i < bands; ++i) levels.share.push_back(reduce(i == 1 ? foreground_share : levels.share.back()));
  Grid<float> free;
  if (has_lakes) {
    free = Grid<float>(altitude_m.width(), altitude_m.height());
    std::transform(keep.begin(), keep.end(), free.begin(), [](unsigned char k) { return k == 0 ? 1.F : 0.F; });
    for (int i = 1; i < bands; ++i) levels.free.push_back(reduce(i == 1 ? free : levels.free.back()));
  }

  const auto at_level = [](bool present, const Grid<float>& finest, const std::vector<Grid<float>>& coarser, int i) {
    return !present ? nullptr : i == 0 ? &finest : &coarser[static_cast<std::size_t>(i) - 1];
  };
  Grid<float> change;
  for (int i = bands - 1; i >= 0; --i) {
    const auto w = static_cast<std::size_t>(weights - 1 - i);  // weights begin with the coarsest band
    change = add_band(i == 0 ? altitude_m : levels.altitude_m[static_cast<std::size_t>(i) - 1],
                      levels.altitude_m[static_cast<std::size_t>(i)], change, at_level(has_share, foreground_share, levels.share, i),
                      at_level(has_lakes, free, levels.free, i), {parameters.foreground[w], parameters.background[w]});
    progress.advance(1.0);
  }
  if (parameters.crest > 0.F && reductions > 0) {
    if (change.empty()) change = Grid<float>(altitude_m.width(), altitude_m.height());
    add_crests(change, find_crests(levels.altitude_m), has_share ? &foreground_share : nullptr, parameters.crest);
  }
  if (change.empty()) return altitude_m;
  if (has_lakes) settle_around_lakes(change, keep);
  parallel_rows(change.height(), [&](int y) {
    const float* a = altitude_m.row(y);
    float* out = change.row(y);
    for (int x = 0; x < change.width(); ++x) out[x] += a[x];
  });
  progress.advance(1.0);
  return change;
}

}  // namespace belvedere
