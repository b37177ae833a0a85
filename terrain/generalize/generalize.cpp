#include "terrain/generalize/generalize.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/filter.h"
#include "base/math.h"
#include "base/parallel.h"
#include "base/pyramid.h"
#include "terrain/generalize/mask.h"

namespace belvedere {
namespace {

// Reduces the change A' - A to 0 in cells of `keep` != 0, to little next to them, and keeps all of
// it farther away: what remains at their border fades in over fade_cells. Shores are short; across
// the edge of a mask, where the ground goes on, the change must not show.
constexpr float shore_fade_cells = 6.0F;
constexpr float mask_fade_cells = 16.0F;

// The change that a kept lake would have had is also subtracted from the land around it, fading
// over this many cells: otherwise a lowered valley would leave its lake on a plateau.
constexpr float surroundings_cells = 32.0F;
// That change is averaged with this standard deviation, so that there are no seams between lakes;
// in blocks, because it is smooth.
constexpr int block_cells = 4;
constexpr double mean_cells = 10.0;
// Beyond the last blur of the subtracted change.
constexpr int reach_cells = 48;

// Squared distance from each cell to its nearest lake cell, cells²; out_of_reach beyond
// reach_cells. Computed in strips, because the nearest cells themselves would take twice the
// memory.
using Squares = Grid<std::uint16_t>;
constexpr int out_of_reach = 65535;

Squares shore_squares(const Grid<unsigned char>& keep) {
  const int width = keep.width();
  const int height = keep.height();
  Squares squares(width, height);
  constexpr int strip = 256;
  for (int first = 0; first < height; first += strip) {
    const int last = std::min(first + strip, height);
    const int top = std::max(first - reach_cells, 0);
    Grid<unsigned char> around(width, std::min(last + reach_cells, height) - top);
    std::copy_n(keep.row(top), around.size(), around.data());
    const Grid<std::int32_t> nearest = nearest_marked(around);
    parallel_rows(last - first, [&](int i) {
      const int y = first - top + i;
      for (int x = 0; x < width; ++x) {
        const std::int32_t shore = nearest(x, y);
        const std::int64_t across = shore % width - x;
        const std::int64_t down = shore / width - y;
        const std::int64_t square = across * across + down * down;
        const bool reached = shore >= 0 && square <= reach_cells * reach_cells;
        squares(x, first + i) = static_cast<std::uint16_t>(reached ? square : out_of_reach);
      }
    });
  }
  return squares;
}

// Distance from a cell to its nearest lake cell, cells; more than reach_cells if it is unknown.
float shore_distance(const Squares& squares, int x, int y) {
  return std::sqrt(static_cast<float>(squares(x, y)));
}

// The lengths above in cells of a halved DEM.
struct Lengths {
  explicit Lengths(int halved)
      : surroundings(std::ldexp(surroundings_cells, -halved)),
        mean(std::ldexp(mean_cells, -halved)),
        block(std::max(1, block_cells >> halved)),
        last(std::ldexp(1.5 * block_cells, -halved) / block) {}
  float surroundings;
  double mean;
  int block;
  double last;  // blur, blocks
};

// The change subtracted around lakes, in blocks of block_cells: the mean change of the lake cells
// nearby, fading with the distance. The last blur rounds the kinks of the distance halfway between
// two shores.
Grid<float> pull_of_lakes(const Grid<float>& change, const Grid<unsigned char>& keep,
                          const Squares& squares, const Lengths& lengths) {
  const int block_side = lengths.block;
  Grid<float> sum((change.width() + block_side - 1) / block_side,
                  (change.height() + block_side - 1) / block_side);
  Grid<float> count(sum.width(), sum.height());
  parallel_rows(sum.height(), [&](int block) {
    for (int y = block * block_side; y < std::min((block + 1) * block_side, change.height()); ++y) {
      for (int x = 0; x < change.width(); ++x) {
        if (keep(x, y) == 0) continue;
        sum(x / block_side, block) += change(x, y);
        count(x / block_side, block) += 1.F;
      }
    }
  });
  Grid<float> pull = gaussian_blur(sum, lengths.mean / block_side);
  count = gaussian_blur(count, lengths.mean / block_side);
  parallel_rows(pull.height(), [&](int y) {
    for (int x = 0; x < pull.width(); ++x) {
      const int centre_x = std::min(x * block_side + block_side / 2, change.width() - 1);
      const int centre_y = std::min(y * block_side + block_side / 2, change.height() - 1);
      const float fade =
          1.F - smoothstep(shore_distance(squares, centre_x, centre_y) / lengths.surroundings);
      pull(x, y) = count(x, y) > 0.F ? fade * pull(x, y) / count(x, y) : 0.F;
    }
  });
  return gaussian_blur(pull, lengths.last);
}

// Lengths are in cells of the data; halved: number of halvings from the data to these cells.
void settle_around_kept(Grid<float>& change, const Grid<unsigned char>& keep, float fade_cells,
                        int halved = 0) {
  if (std::none_of(keep.begin(), keep.end(), [](unsigned char k) { return k != 0; })) return;
  const Lengths lengths(halved);
  const int block = lengths.block;
  const float fade = std::ldexp(fade_cells, -halved);
  const Squares squares = shore_squares(keep);
  const Grid<float> pull = pull_of_lakes(change, keep, squares, lengths);
  parallel_rows(change.height(), [&](int y) {
    for (int x = 0; x < change.width(); ++x) {
      const float distance = shore_distance(squares, x, y);
      if (distance >= static_cast<float>(reach_cells)) continue;
      // Block centres of four cells lie at 1.5, 5.5, 9.5… cells.
      const double u = (x - 0.5 * (block - 1)) / block;
      const double v = (y - 0.5 * (block - 1)) / block;
      change(x, y) = (change(x, y) - sample_bspline(pull, u, v)) * smoothstep(distance / fade);
    }
  });
}

// Number of bands that this needs.
constexpr int crest_bands = 4;

float unit(float v) { return std::clamp(v, 0.F, 1.F); }

// b2 + b3 + .6 b4 and b5 + b6 + … + base, the terms of GeneralizeParameters::crest, both at the
// finest level given; from level 1 one row of expand brings them to level 0.
struct CrestTerms {
  Grid<float> detail_m;
  Grid<float> ground_m;
};

CrestTerms find_crests(std::vector<Grid<float>> levels, int first) {  // the finest level given
  CrestTerms crests;
  const int top = std::min(static_cast<int>(levels.size()), crest_bands - first + 1) - 1;
  crests.ground_m = levels[static_cast<std::size_t>(top)];
  for (int i = top - 1; i >= 0; --i) {
    const Grid<float>& coarser = levels[static_cast<std::size_t>(i) + 1];
    const float weight = i + first == crest_bands - 1 ? 0.6F : 1.F;
    // The finest is not needed again and becomes the detail, row by row.
    Grid<float> detail = i == 0 ? std::move(levels[0]) : levels[static_cast<std::size_t>(i)];
    const int width = detail.width();
    Grid<float> ground(width, detail.height());
    parallel_rows(detail.height(), [&](int y) {
      std::vector<float> below(static_cast<std::size_t>(width));
      std::vector<float> smooth(static_cast<std::size_t>(width));
      expand_change_row(crests.detail_m, y, width, below.data());
      expand_row(coarser, y, width, smooth.data());
      for (int x = 0; x < width; ++x) detail(x, y) = below[x] + weight * (detail(x, y) - smooth[x]);
      expand_row(crests.ground_m, y, width, ground.row(y));
    });
    crests.detail_m = std::move(detail);
    crests.ground_m = std::move(ground);
  }
  return crests;
}

// Adds the sharpening of high crests to a change: strength · high · clamp(b2 + b3 + .6 b4, 0, 60 m)
// · (1 - .2 (1 - share)) · mask · amplify (see GeneralizeParameters). levels[i] is Gaussian level i
// + 1 of the altitudes; there is at least one. If the DEM was halved `halved` times, levels[i] is
// level `halved` + i of the original: missing bands add nothing. Null: 1.
void add_crests(Grid<float>& change, std::vector<Grid<float>> levels, int halved,
                const Grid<float>* share, const Grid<float>* mask, const Grid<float>* amplify,
                float strength) {
  const CrestTerms crests = find_crests(std::move(levels), std::max(halved, 1));
  const int width = change.width();
  parallel_rows(change.height(), [&](int y) {
    std::vector<float> detail(static_cast<std::size_t>(width));
    std::vector<float> ground(static_cast<std::size_t>(width));
    if (halved == 0) {
      expand_change_row(crests.detail_m, y, width, detail.data());
      expand_row(crests.ground_m, y, width, ground.data());
    } else {
      if (!crests.detail_m.empty()) std::copy_n(crests.detail_m.row(y), width, detail.begin());
      std::copy_n(crests.ground_m.row(y), width, ground.begin());
    }
    float* out = change.row(y);
    for (int x = 0; x < width; ++x) {
      const float high = unit((ground[x] - 1200.F) / 700.F);
      const float near = share == nullptr ? 1.F : unit((*share)(x, y));
      float added =
          strength * high * std::clamp(detail[x], 0.F, 60.F) * (1.F - 0.2F * (1.F - near));
      if (mask != nullptr) added *= unit((*mask)(x, y));
      if (amplify != nullptr) added *= unit((*amplify)(x, y));
      out[x] += added;
    }
  });
}

// The stage computes the change, D = A' - A. With D_n = (base - 1) G_1 and D_i = expand(D_i+1) +
// (w_i - 1) L_i it needs no band grids, keeps float precision for small numbers, and unit weights
// change nothing. An empty grid is a change of 0.

// The Gaussian levels of a grid that the caller holds. Finished levels are freed, so that only the
// finest, which takes the most memory, remains at the end.
class Levels {
 public:
  Levels(const Grid<float>& finest, int bands) : Levels(finest, finest, bands) {}
  // Coarser levels of another grid, which are not kept.
  Levels(const Grid<float>& finest, const Grid<float>& coarsened, int bands) : finest_(finest) {
    for (int i = 1; i < bands && !coarsened.empty(); ++i)
      coarser_.push_back(reduce(i == 1 ? coarsened : coarser_.back()));
  }
  // The coarsest remaining level; null if the grid is empty.
  const Grid<float>* at(int level) const {
    if (level > 0)
      return coarser_.empty() ? nullptr : &coarser_[static_cast<std::size_t>(level) - 1];
    return finest_.empty() ? nullptr : &finest_;
  }
  void drop(int level) {
    if (level > 0 && !coarser_.empty()) coarser_.resize(static_cast<std::size_t>(level) - 1);
  }

 private:
  const Grid<float>& finest_;
  std::vector<Grid<float>> coarser_;
};

void check_number(std::string_view key, const std::vector<float>& weights, std::size_t bands) {
  if (weights.size() == bands || (weights.empty() && key != "background")) return;
  throw Error(ErrorKind::usage, std::string(key), fmt::format("{} weights", weights.size()),
              fmt::format("{} weights, as in foreground", bands));
}

void check(const Grid<float>& altitude_m, const GeneralizeGrids& grids,
           const GeneralizeParameters& parameters) {
  const std::size_t bands = parameters.foreground.size();
  check_number("background", parameters.background, bands);
  check_number("foreground_ridges", parameters.foreground_ridges, bands);
  check_number("foreground_valleys", parameters.foreground_valleys, bands);
  check_number("background_ridges", parameters.background_ridges, bands);
  check_number("background_valleys", parameters.background_valleys, bands);
  if (parameters.finest_band < 0 || parameters.finest_band > 16)
    throw Error(ErrorKind::bug, "generalize", fmt::format("finest band {}", parameters.finest_band),
                "0 to 16");
  const auto fits = [&](const auto& grid) { return grid.empty() || grid.same_size(altitude_m); };
  if (!fits(grids.foreground_share) || !fits(grids.keep) || !fits(grids.mask) ||
      !fits(grids.unchanged) || !fits(grids.amplification_mask)) {
    throw Error(ErrorKind::bug, "generalize",
                "a foreground, lake or mask grid differs in size from the DEM");
  }
}

// Weights of the band at a level, 0 the finest.
BandWeights weights_of(const GeneralizeParameters& parameters, int level, double cell_m) {
  // Weights start with the coarsest band.
  const std::size_t i =
      parameters.foreground.size() - 1 - static_cast<std::size_t>(parameters.finest_band + level);
  const auto at = [i](const std::vector<float>& weights) {
    return weights.empty() ? 0.F : weights[i];
  };
  BandWeights weights;
  weights.near = {parameters.foreground[i], at(parameters.foreground_ridges),
                  at(parameters.foreground_valleys)};
  weights.far = {parameters.background[i], at(parameters.background_ridges),
                 at(parameters.background_valleys)};
  constexpr double wavelength_cells = 4.0;
  weights.printable_m_per_pixel =
      static_cast<float>(wavelength_cells * std::ldexp(cell_m, level) / parameters.print_pixels);
  return weights;
}

BreakLines break_lines_of(const GeneralizeParameters& parameters, int level, glm::dvec2 cell_m) {
  const bool plan = parameters.curvature == CurvatureForm::plan;
  const double full = parameters.full_curvature > 0.F ? parameters.full_curvature
                      : plan                          ? 0.8
                                                      : 0.15;
  const glm::dvec2 cell = cell_m * std::ldexp(1.0, level);
  BreakLines lines;
  lines.scale = {plan, static_cast<float>(1.0 / cell.x), static_cast<float>(1.0 / cell.y),
                 static_cast<float>(0.5 * (cell.x + cell.y) / full)};
  lines.blur_cells = parameters.blur_cells;
  lines.exponent = parameters.exponent;
  return lines;
}

// Change of the lowest Gaussian level; empty if its weight is 1.
Grid<float> change_of_base(const Grid<float>& base_m, const Grid<float>* mask, float weight) {
  if (weight == 1.F) return {};
  Grid<float> change(base_m.width(), base_m.height());
  parallel_rows(change.height(), [&](int y) {
    for (int x = 0; x < change.width(); ++x)
      change(x, y) = (weight - 1.F) * base_m(x, y) *
                     (mask == nullptr ? 1.F : std::clamp((*mask)(x, y), 0.F, 1.F));
  });
  return change;
}

// The mask for coarser bands: 0 in lakes as well.
Grid<float> without_lakes(const Grid<float>& mask, const Grid<unsigned char>& keep) {
  Grid<float> out(keep.width(), keep.height());
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x)
      out(x, y) = keep(x, y) != 0 ? 0.F : mask.empty() ? 1.F : mask(x, y);
  });
  return out;
}

}  // namespace

std::vector<Grid<float>> finer_bands(const Grid<float>& altitude_m, int halvings) {
  std::vector<Grid<float>> out;
  Grid<float> level = altitude_m;
  for (int i = 0; i < halvings && max_bands(level.width(), level.height()) > 0; ++i) {
    Grid<float> coarser = reduce(level);
    const Grid<float> smooth = expand(coarser, level.width(), level.height());
    for (std::size_t at = 0; at < level.size(); ++at) level[at] -= smooth[at];
    for (int left = i; left < halvings; ++left) level = reduce(level);
    out.push_back(std::move(level));
    level = std::move(coarser);
  }
  return out;
}

Grid<float> generalize(const Grid<float>& altitude_m, glm::dvec2 cell_m,
                       const GeneralizeGrids& grids, const GeneralizeParameters& parameters,
                       Progress& progress) {
  check(altitude_m, grids, parameters);
  const int skipped = parameters.finest_band;
  const int weights = std::max(static_cast<int>(parameters.foreground.size()) - skipped, 0);
  const int possible = max_bands(altitude_m.width(), altitude_m.height());
  const int bands = std::min(weights, possible);
  // The lowest of the crest bands needs a level below it.
  const float crest = skipped < crest_bands ? parameters.crest : 0.F;
  const int reductions =
      crest > 0.F ? std::min(std::max(weights, crest_bands - skipped), possible) : bands;
  // Without the lakes; empty: none.
  const Grid<unsigned char> unchanged =
      grids.unchanged.empty() ? unchanged_cells({}, grids.mask) : grids.unchanged;
  Grid<unsigned char> both;
  if (!unchanged.empty() && !grids.keep.empty()) {
    both = unchanged;
    for (std::size_t i = 0; i < both.size(); ++i)
      both[i] = both[i] != 0 || grids.keep[i] != 0 ? 1 : 0;
  }
  const Grid<unsigned char>& keep = unchanged.empty()    ? grids.keep
                                    : grids.keep.empty() ? unchanged
                                                         : both;
  const bool keeps = std::any_of(keep.begin(), keep.end(), [](unsigned char k) { return k != 0; });
  progress.begin("generalize", 2.0 * reductions + 1.0);

  std::vector<Grid<float>> levels_m;  // [i] is level i + 1: level 0 is the caller's
  for (int i = 0; i < reductions; ++i) {
    levels_m.push_back(reduce(i == 0 ? altitude_m : levels_m.back()));
    progress.advance(1.0);
  }
  const int mask_levels = parameters.base == 1.F ? bands : bands + 1;
  Levels mask = keeps && !grids.keep.empty()
                    ? Levels(grids.mask, without_lakes(grids.mask, grids.keep), mask_levels)
                    : Levels(grids.mask, mask_levels);
  Levels share(grids.foreground_share, bands);
  Levels amplify(grids.amplification_mask, bands);

  Grid<float> change =
      change_of_base(bands == 0 ? altitude_m : levels_m[static_cast<std::size_t>(bands) - 1],
                     mask.at(mask_levels > bands ? bands : 0), parameters.base);
  if (mask_levels > bands) mask.drop(bands);
  for (int i = bands - 1; i >= 0; --i) {
    Band band;
    band.level = i == 0 ? &altitude_m : &levels_m[static_cast<std::size_t>(i) - 1];
    band.coarser = &levels_m[static_cast<std::size_t>(i)];
    band.coarser_change = &change;
    band.share = share.at(i);
    band.keep = i == 0 && keeps ? &keep : nullptr;
    band.mask = mask.at(i);
    band.amplify = amplify.at(i);
    band.pixel_ground = grids.pixel_ground.m_per_pixel.empty() ? nullptr : &grids.pixel_ground;
    band.level_cells = 1 << i;
    change = add_band(band, weights_of(parameters, i, 0.5 * (cell_m.x + cell_m.y)),
                      break_lines_of(parameters, i, cell_m));
    for (Levels* levels : {&share, &mask, &amplify}) levels->drop(i);
    if (crest <= 0.F || i >= crest_bands - skipped) levels_m[static_cast<std::size_t>(i)] = {};
    progress.advance(1.0);
  }
  if (crest > 0.F && reductions > 0) {
    if (change.empty()) change = Grid<float>(altitude_m.width(), altitude_m.height());
    std::vector<Grid<float>> levels;
    levels.reserve(levels_m.size() + 1);
    if (skipped > 0) levels.push_back(altitude_m);
    std::move(levels_m.begin(), levels_m.end(), std::back_inserter(levels));
    add_crests(change, std::move(levels), skipped, share.at(0), mask.at(0), amplify.at(0), crest);
  }
  const int known = std::min({skipped, static_cast<int>(grids.finer_m.size()),
                              static_cast<int>(parameters.foreground.size())});
  for (int i = 0; i < known; ++i) {
    const Grid<float>& finer = grids.finer_m[static_cast<std::size_t>(i)];
    const Grid<float> none((finer.width() + 1) / 2, (finer.height() + 1) / 2);
    const Grid<float> no_change;
    Band band;
    band.level = &finer;
    band.coarser = &none;
    band.coarser_change = &no_change;
    band.share = share.at(0);
    band.keep = keeps ? &keep : nullptr;
    band.mask = mask.at(0);
    band.amplify = amplify.at(0);
    band.pixel_ground = grids.pixel_ground.m_per_pixel.empty() ? nullptr : &grids.pixel_ground;
    BandWeights of_all = weights_of(parameters, i - skipped, 0.5 * (cell_m.x + cell_m.y));
    for (WeightSet* set : {&of_all.near, &of_all.far}) set->ridges = set->valleys = 0.F;
    const Grid<float> added = add_band(band, of_all, break_lines_of(parameters, 0, cell_m));
    if (change.empty()) {
      change = added;
    } else if (!added.empty()) {
      for (std::size_t at = 0; at < change.size(); ++at) change[at] += added[at];
    }
  }
  levels_m = {};
  if (change.empty()) return altitude_m;
  settle_around_kept(change, grids.keep, shore_fade_cells, skipped);
  settle_around_kept(change, unchanged, mask_fade_cells, skipped);
  parallel_rows(change.height(), [&](int y) {
    const float* a = altitude_m.row(y);
    float* out = change.row(y);
    for (int x = 0; x < change.width(); ++x)
      out[x] = out[x] == 0.F ? a[x] : a[x] + out[x];  // keeps -0
  });
  progress.advance(1.0);
  return change;
}

}  // namespace belvedere
