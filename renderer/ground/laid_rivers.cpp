#include "renderer/ground/laid_rivers.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>

#include "base/filter.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/pixel_rect.h"
#include "base/random.h"
#include "renderer/ground/cached_products.h"

namespace belvedere {

void each_field(auto& bytes, FieldsOf<RiverCentreline> auto& centreline) {
  auto& [positions, half_width_m, group] = centreline;
  bytes(positions, half_width_m, group);
}

namespace {

constexpr float max_widened = 3.F;
// Factors on min_px: inferred rivers narrower than the first at their widest are not drawn, from
// the second on they are.
constexpr float faded_below = 0.4F;
constexpr float full_from = 0.8F;
// Inferred rivers of this half width, m, are drawn with min_px; larger ones with a power of the
// ratio, so that a river is visibly wider below its confluences.
constexpr double min_of_half_m = 18.0;
constexpr double grown_exponent = 0.85;
constexpr double max_grown = 3.0;

// Ground values that rivers depend on: flow and altitude.
void add_ground(CacheKeyText& key, const Dem& dem) {
  const auto& [altitude_m, filled, transform, crs, entries, halved] = dem;
  key.add("altitude_m", altitude_m);
  add_transform(key, transform);
  for (const auto& [x, y, km2] : entries) key.add("entry_x", x).add("entry_y", y).add("km2", km2);
}

CacheKey rivers_key(const LoadedScene& loaded, const MapRivers& rivers, const Dem& dem) {
  CacheKeyText key;
  std::vector<double> numbers;
  for (const MappedRiver& river : rivers.lines) {
    const auto& [positions, width_m, min_width_m, snap_m, group] = river;
    numbers.insert(numbers.end(), {width_m, min_width_m, snap_m, static_cast<double>(group),
                                   static_cast<double>(positions.size())});
    for (const glm::dvec2 position : positions)
      numbers.insert(numbers.end(), {position.x, position.y});
  }
  Grid<double> row(static_cast<int>(numbers.size()), 1);
  std::copy(numbers.begin(), numbers.end(), row.begin());
  key.add("rivers", row);
  add_ground(key, dem);
  return make_cache_key(CachedProduct::river_courses, key, subject_of(loaded));
}

// Across a river at each of its positions: pixels of the picture in a metre of the ground; 0 where
// the camera does not see it or the river has no direction.
std::vector<double> px_across(const CoverRiver& river, const Dem& dem, const SeenFrom& from) {
  constexpr double step_m = 30.0;
  const auto seen = [&](glm::dvec2 position) {
    const glm::dvec2 cell = dem.transform.to_cell(position.x, position.y);
    return from.camera.project(
        from.deformation.point({position, sample_bilinear(dem.altitude_m, cell.x, cell.y)}));
  };
  std::vector<double> across(river.positions.size(), 0.0);
  const std::size_t last = river.positions.size() - 1;
  for (std::size_t i = 0; i < river.positions.size(); ++i) {
    const glm::dvec2 along =
        river.positions[std::min(i + 1, last)] - river.positions[i - std::min<std::size_t>(i, 1)];
    const double length = glm::length(along);
    if (!(length > 0.0)) continue;
    const glm::dvec2 ahead = along * (step_m / length);
    const auto here = seen(river.positions[i]);
    const auto on = seen(river.positions[i] + ahead);
    const auto beside = seen(river.positions[i] + glm::dvec2(-ahead.y, ahead.x));
    if (!here || !on || !beside) continue;
    const glm::dvec2 a = (*on - *here) / step_m;
    const glm::dvec2 b = (*beside - *here) / step_m;
    // Thickness in pixels of a strip 1 m wide.
    across[i] = std::abs(a.x * b.y - a.y * b.x) / std::max(glm::length(a), 1e-12);
  }
  return across;
}

}  // namespace

std::vector<CoverRiver> lay_rivers(const MapRivers& rivers, const LoadedScene& loaded,
                                   const Dem& dem, Progress& progress, const Cache& cache,
                                   Catchments* catchments) {
  if (rivers.lines.empty()) return {};
  const std::vector<RiverCentreline> courses = cached<std::vector<RiverCentreline>>(
      cache, [&] { return rivers_key(loaded, rivers, dem); }, progress,
      [&](Progress& watcher) {
        watcher.begin("aligning rivers with their valleys", 0.0);
        Catchments own(dem);
        RiverCentrelines laid =
            snap_rivers(rivers.lines, dem, (catchments != nullptr ? *catchments : own).km2());
        if (laid.lines.empty()) return std::move(laid.lines);
        watcher.note(
            fmt::format("rivers of the map: {} in {} pieces, moved to the bottoms of their valleys "
                        "by {:.0f} m on average, {:.0f} m at most",
                        laid.lines.size(), laid.lines.size() + laid.joined, laid.mean_moved_m,
                        laid.max_moved_m));
        return std::move(laid.lines);
      });
  std::vector<CoverRiver> centrelines;
  for (const RiverCentreline& course : courses) {
    CoverRiver centreline = rivers.looks[static_cast<std::size_t>(course.group)];
    centreline.positions = course.positions;
    centreline.half_width_m = course.half_width_m;
    centrelines.push_back(std::move(centreline));
  }
  return centrelines;
}

CoverRiver widen_for_view(CoverRiver centreline, const RiverLook& look, const Dem& dem,
                          const SeenFrom& from) {
  constexpr int passes = 40;  // the ground's direction changes from cell to cell; widths do not
  const std::vector<double> across = px_across(centreline, dem, from);
  std::vector<float> wanted = centreline.half_width_m;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!(across[i] > 0.0)) continue;
    const float half = centreline.half_width_m[i];
    const auto needed = static_cast<float>(0.5 * look.min_px / std::max(across[i], 1e-9));
    const double grown =
        look.fades
            ? std::clamp(exact::pow(std::max(static_cast<double>(half), 1e-3) / min_of_half_m,
                                    grown_exponent),
                         1.0, max_grown)
            : 1.0;
    wanted[i] = std::clamp(needed * static_cast<float>(grown), half, max_widened * half);
    if (look.fades)
      wanted[i] *= smoothstep(faded_below, full_from, wanted[i] / std::max(needed, 1e-6F));
  }
  for (int pass = 0; pass < passes && wanted.size() > 2; ++pass) {
    std::vector<float> next = wanted;
    for (std::size_t i = 1; i + 1 < wanted.size(); ++i)
      next[i] = 0.5F * wanted[i] + 0.25F * (wanted[i - 1] + wanted[i + 1]);
    wanted.swap(next);
  }
  centreline.half_width_m = std::move(wanted);
  return centreline;
}

std::vector<double> units_across(const CoverRiver& river, double pixels_per_unit, const Dem& dem,
                                 const SeenFrom& seen) {
  constexpr std::size_t step = 8;
  const std::size_t count = river.positions.size();
  CoverRiver few;
  for (std::size_t i = 0; i < count; i += step) few.positions.push_back(river.positions[i]);
  const std::vector<double> across = px_across(few, dem, seen);
  std::vector<double> units(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = i / step;
    const std::size_t next = std::min(k + 1, across.size() - 1);
    const double t = static_cast<double>(i % step) / static_cast<double>(step);
    units[i] = ((1.0 - t) * across[k] + t * across[next]) / pixels_per_unit;
  }
  return units;
}

namespace {

LandCoverClass nearest_class(const LandCover& cover, glm::dvec2 position) {
  const glm::dvec2 at = cover.classes.transform.to_cell(position.x, position.y);
  return cover.classes.cells.clamped(static_cast<int>(std::lround(at.x)),
                                     static_cast<int>(std::lround(at.y)));
}

}  // namespace

void refine_by_rules(LandCover& cover, const LandCover& rules, const CoverRefinement& refine) {
  Grid<LandCoverClass>& cells = cover.classes.cells;
  parallel_rows(cells.height(), [&](int y) {
    for (int x = 0; x < cells.width(); ++x) {
      const LandCoverClass seen = nearest_class(rules, cover.classes.transform.to_crs(x, y));
      for (const auto& [to, from] : refine)
        if (cells(x, y) == from && seen == to) {
          cells(x, y) = to;
          break;
        }
    }
  });
}

std::vector<CoverRiver> refine_rivers(std::vector<CoverRiver> rivers, const LandCover& cover,
                                      const CoverRefinement& refine) {
  const auto to_water = [](const auto& row) { return row.first == LandCoverClass::water; };
  if (std::none_of(refine.begin(), refine.end(), to_water)) return {};
  for (CoverRiver& river : rivers)
    for (std::size_t i = 0; i < river.positions.size(); ++i) {
      const LandCoverClass here = nearest_class(cover, river.positions[i]);
      const auto allows = [&](const auto& row) { return to_water(row) && row.second == here; };
      if (here != LandCoverClass::water && std::none_of(refine.begin(), refine.end(), allows))
        river.half_width_m[i] = 0.F;
    }
  return rivers;
}

namespace {

// Parts of the stream of banks; 0 and 1 are the banks themselves.
constexpr std::uint64_t gravel_part = 2;
constexpr std::uint64_t grove_part = 4;
constexpr std::uint64_t tuft_part = 6;

// Half widths of the river in units of the sheet: below the first none, from the second on all.
constexpr double gravel_from_units = 0.7;
constexpr double gravel_full_units = 1.8;
constexpr double groves_from_units = 0.6;
constexpr double groves_full_units = 2.6;
constexpr double min_gravel_units = 0.4;
constexpr double max_gravel_units = max_shore_units;
constexpr double min_grove_units = 0.45;  // narrower ones are scraps of trees
constexpr double max_grove_units = 2.2;
// In half widths of the river.
constexpr double gravel_breadth = 0.60;
constexpr double gravel_noise_widths = 7.0;  // deviation of the noise
constexpr double grove_breadth = 0.75;
constexpr double grove_noise_widths = 15.0;
constexpr double tuft_noise_widths = 5.0;
constexpr double bend_widths = 4.0;  // way over which a bend is measured
// Gain on curvature times half width, whose product 1 is a full bend: gravel already lies in gentle
// bends.
constexpr double shore_bend_gain = 24.0;

struct Site {
  double half_m;
  double units_per_m;
  double inner;  // of this bank: 1 on the inner side of a full bend, -1 on the outer
  glm::dvec2 position;
};

double noise_at(const ShoreParameters& p, std::uint64_t part, const Site& site, double widths) {
  return gaussian_noise(stream_seed(p.seed, Stream::river_banks, part), site.position.x,
                        site.position.y, widths * site.half_m);
}

// How broad the gravel of a bank is, m.
double gravel_m(const ShoreParameters& p, std::uint64_t side, const Site& site) {
  const double drawn =
      smoothstep(gravel_from_units, gravel_full_units, site.half_m * site.units_per_m);
  if (drawn <= 0.0) return 0.0;
  const double noise = noise_at(p, gravel_part + side, site, gravel_noise_widths);
  const double share = -0.10 + 1.1 * smoothstep(-0.1, 0.8, site.inner) + 0.5 * noise;
  const double breadth = gravel_breadth * site.half_m * std::max(share, 0.0);
  const double bar = std::min(breadth, max_gravel_units / site.units_per_m) * drawn;
  // A bar narrower than a dab would only serrate the bank.
  return bar * smoothstep(min_gravel_units, 2.0 * min_gravel_units, bar * site.units_per_m);
}

// Half of the breadth of a grove, m.
double grove_half_m(const ShoreParameters& p, std::uint64_t side, const Site& site) {
  const double drawn =
      smoothstep(groves_from_units, groves_full_units, site.half_m * site.units_per_m);
  if (drawn <= 0.0) return 0.0;
  const double stand = noise_at(p, grove_part + side, site, grove_noise_widths);
  const double tuft = noise_at(p, tuft_part + side, site, tuft_noise_widths);
  const double share =
      smoothstep(0.25, 1.1, stand + 0.45 * tuft - 0.45 * std::clamp(site.inner, -1.0, 1.0));
  const double half =
      std::min(grove_breadth * site.half_m, max_grove_units / site.units_per_m) * share * drawn;
  return half * smoothstep(min_grove_units, 1.5 * min_grove_units, half * site.units_per_m);
}

struct Shores {
  std::vector<CoverRiver> gravel;
  std::vector<CoverRiver> groves;
};

CoverRiver strip_of(const CoverRiver& river, LandCoverClass painted_as) {
  CoverRiver strip;
  strip.painted_as = painted_as;
  strip.rank = river.rank;
  strip.kind = shore_kind;
  return strip;
}

// Adds what has a width, in pieces without the gaps.
void add_pieces(std::vector<CoverRiver>& to, const CoverRiver& strip) {
  CoverRiver piece = strip_of(strip, strip.painted_as);
  const std::size_t count = strip.positions.size();
  for (std::size_t i = 0; i < count; ++i) {
    const bool has_width = strip.half_width_m[i] > 0.F;
    const bool next = i + 1 < count && strip.half_width_m[i + 1] > 0.F;
    const bool before = i > 0 && strip.half_width_m[i - 1] > 0.F;
    if (!has_width && !next && !before) continue;
    piece.positions.push_back(strip.positions[i]);
    piece.half_width_m.push_back(strip.half_width_m[i]);
    if (has_width || !before) continue;
    to.push_back(std::exchange(piece, strip_of(strip, strip.painted_as)));
    if (!next) continue;
    piece.positions.push_back(strip.positions[i]);
    piece.half_width_m.push_back(strip.half_width_m[i]);
  }
  if (piece.positions.size() > 1) to.push_back(std::move(piece));
}

Shores shores_of(const CoverRiver& river, const std::vector<double>& units_per_m,
                 const ShoreParameters& p) {
  Shores out;
  const std::size_t count = river.positions.size();
  if (count < 3 || river.painted_as != LandCoverClass::water) return out;
  bool wide = false;
  for (std::size_t i = 0; i < count && !wide; ++i)
    wide = static_cast<double>(river.half_width_m[i]) * units_per_m[i] >
           std::min(gravel_from_units, groves_from_units);
  if (!wide) return out;
  std::array<CoverRiver, 2> gravel{strip_of(river, LandCoverClass::sand),
                                   strip_of(river, LandCoverClass::sand)};
  std::array<CoverRiver, 2> groves{strip_of(river, LandCoverClass::forest),
                                   strip_of(river, LandCoverClass::forest)};
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec2 at = river.positions[i];
    const double half = static_cast<double>(river.half_width_m[i]);
    // Positions a bend's way before and after.
    std::size_t from = i;
    std::size_t to = i;
    for (double way = 0.0; from > 0 && way < bend_widths * half; --from)
      way += glm::length(river.positions[from] - river.positions[from - 1]);
    for (double way = 0.0; to + 1 < count && way < bend_widths * half; ++to)
      way += glm::length(river.positions[to + 1] - river.positions[to]);
    const glm::dvec2 before = at - river.positions[from];
    const glm::dvec2 after = river.positions[to] - at;
    const double lengths = glm::length(before) * glm::length(after);
    const glm::dvec2 way = before + after;
    const double way_m = glm::length(way);
    if (!(half > 0.0) || !(units_per_m[i] > 0.0) || !(lengths > 0.0) || !(way_m > 0.0)) {
      for (std::size_t side = 0; side < 2; ++side)
        for (CoverRiver* strip : {&gravel[side], &groves[side]}) {
          strip->positions.push_back(at);
          strip->half_width_m.push_back(0.F);
        }
      continue;
    }
    // Sine of the turn; > 0 to the left.
    const double turn = (before.x * after.y - before.y * after.x) / lengths;
    const double bend = std::clamp(
        shore_bend_gain * turn * half / (0.5 * (glm::length(before) + glm::length(after))), -1.2,
        1.2);
    const glm::dvec2 left = glm::dvec2(-way.y, way.x) / way_m;
    for (std::size_t side = 0; side < 2; ++side) {
      const glm::dvec2 out_of = side == 0 ? left : -left;
      const Site site{half, units_per_m[i], side == 0 ? bend : -bend, at + half * out_of};
      const double bar_m = gravel_m(p, side, site);
      const bool open = p.is_open(at + (half + 0.7 * bar_m + 0.3 * half) * out_of);
      gravel[side].positions.push_back(site.position);
      gravel[side].half_width_m.push_back(open ? static_cast<float>(bar_m) : 0.F);
      const double grove_m = open ? grove_half_m(p, side, site) : 0.0;
      const glm::dvec2 middle = at + (half + bar_m + grove_m) * out_of;
      groves[side].positions.push_back(middle);
      groves[side].half_width_m.push_back(p.grows_trees(middle) ? static_cast<float>(grove_m)
                                                                : 0.F);
    }
  }
  for (std::size_t side = 0; side < 2; ++side) {
    add_pieces(out.gravel, gravel[side]);
    add_pieces(out.groves, groves[side]);
  }
  return out;
}

}  // namespace

std::vector<CoverRiver> river_shores(std::span<const CoverRiver> rivers,
                                     const ShoreParameters& parameters) {
  std::vector<Shores> each(rivers.size());
  parallel_ranges<std::size_t>(rivers.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i)
      each[i] = shores_of(rivers[i], parameters.units_per_m(i), parameters);
  });
  std::vector<CoverRiver> shores;
  for (Shores& one : each)
    std::move(one.groves.begin(), one.groves.end(), std::back_inserter(shores));
  for (Shores& one : each)
    std::move(one.gravel.begin(), one.gravel.end(), std::back_inserter(shores));
  return shores;
}

}  // namespace belvedere
