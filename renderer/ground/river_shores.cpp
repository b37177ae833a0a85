#include "renderer/ground/river_shores.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <utility>

#include "base/math.h"
#include "base/noise.h"
#include "base/parallel.h"
#include "base/random.h"

namespace belvedere {
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
constexpr double max_gravel_units = 3.4;
constexpr double min_grove_units = 0.45;  // narrower ones are scraps of trees
constexpr double max_grove_units = 2.2;
// In half widths of the river.
constexpr double gravel_breadth = 0.60;
constexpr double gravel_noise_widths = 7.0;  // deviation of the noise
constexpr double grove_breadth = 0.75;
constexpr double grove_noise_widths = 15.0;
constexpr double tuft_noise_widths = 5.0;
constexpr double bend_widths = 4.0;  // way over which a bend is measured
// Of curvature times half width, 1 is a full bend: gravel lies already in gentle ones.
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
