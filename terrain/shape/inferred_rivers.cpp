#include "terrain/shape/inferred_rivers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/math.h"
#include "base/parallel.h"
#include "terrain/shape/river_bends.h"
#include "terrain/shape/river_reaches.h"

namespace belvedere {
namespace {

constexpr int into_open_cells = 2;      // a river continues this far into a lake
constexpr std::size_t fade_cells = 14;  // over which one fades in from dry ground, or out
// On level ground, D8 lines meet a river at any angle; natural tributaries join obliquely, farther
// downstream.
constexpr std::size_t down_cells = 12;
constexpr std::size_t led_cells = 24;  // length before the mouth over which a river is bent there
constexpr std::size_t own_cells =
    10;  // cells before the mouth that ignore the width of the larger river

// A river as the cells of its reaches, downstream; the last one may belong to the larger river it
// flows into.
struct JoinedRiver {
  std::vector<std::size_t> reaches;
  bool joins = false;
};

// Values beyond the ends of a line: a river does not end at the border of the ground.
struct Ends {
  bool comes_in = false, goes_on = false;
};

// Bends the end of a line, of which `places` points remain and the last lies on the larger river,
// towards a position some cells farther downstream on that river.
void lead_mouth(std::vector<glm::dvec2>& positions, const std::vector<RiverReach>& reaches,
                std::size_t mouth) {
  std::size_t at = mouth;
  for (std::size_t k = 0;
       k < std::min(down_cells, positions.size() / 3) && reaches[at].downstream != no_reach; ++k)
    at = reaches[at].downstream;
  const glm::dvec2 way = reaches[at].position - positions.back();
  const std::size_t led = std::min(led_cells, positions.size() - 1);
  for (std::size_t k = 0; k < led; ++k) {
    const double near = 1.0 - static_cast<double>(k) / static_cast<double>(led);
    positions[positions.size() - 1 - k] += near * near * way;  // strongest at the mouth
  }
}

std::vector<JoinedRiver> follow_water(const std::vector<RiverReach>& reaches) {
  std::vector<JoinedRiver> lines;
  for (std::size_t i = 0; i < reaches.size(); ++i) {
    // A spring has nothing above it.
    if (reaches[i].upstream != no_reach) continue;
    JoinedRiver line;
    for (std::size_t at = i; at != no_reach; at = reaches[at].downstream) {
      line.reaches.push_back(at);
      const std::size_t below = reaches[at].downstream;
      if (below == no_reach || reaches[below].upstream == at) continue;
      line.reaches.push_back(below);
      line.joins = true;
      break;
    }
    if (line.reaches.size() > 1) lines.push_back(std::move(line));
  }
  return lines;
}

// A piece of a line: points `first` … `last` (inclusive), and whether it fades in and out on dry
// ground.
struct Piece {
  std::size_t first = 0, last = 0;
  bool rises = false, dries = false;
};

std::vector<Piece> pieces_of(std::vector<RiverBed> beds, const Ends& ends,
                             const InferredRiverParameters& parameters) {
  const std::size_t count = beds.size();
  // Short dry gaps between wet points belong to the bed: a step in the ground does not end a river.
  for (std::size_t i = 0; i < count;) {
    std::size_t end = i;
    while (end < count && beds[end] == RiverBed::dry) ++end;
    if (end > i && i > 0 && end < count &&
        end - i <= static_cast<std::size_t>(parameters.closed_cells))
      std::fill(beds.begin() + static_cast<std::ptrdiff_t>(i),
                beds.begin() + static_cast<std::ptrdiff_t>(end), RiverBed::runs);
    i = std::max(end, i + 1);
  }
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < count;) {
    if (beds[i] != RiverBed::runs) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < count && beds[end] == RiverBed::runs) ++end;
    Piece piece{i, end - 1, i > 0 ? beds[i - 1] == RiverBed::dry : !ends.comes_in,
                end < count ? beds[end] == RiverBed::dry : !ends.goes_on};
    const bool long_enough = end - i >= static_cast<std::size_t>(parameters.min_cells);
    // Between two lakes a river may be short.
    if (long_enough || (!piece.rises && !piece.dries)) {
      if (!piece.rises) piece.first -= std::min<std::size_t>(piece.first, into_open_cells);
      if (!piece.dries) piece.last = std::min(count - 1, piece.last + into_open_cells);
      pieces.push_back(piece);
    }
    i = end;
  }
  return pieces;
}

}  // namespace

std::vector<RiverCentreline> infer_rivers_of_ground(
    const Grid<float>& catchment_km2, const Grid<float>& altitude_m, const GeoTransform& transform,
    const std::function<RiverBed(int x, int y)>& bed, const InferredRiverParameters& parameters) {
  std::vector<RiverReach> reaches = find_reaches(catchment_km2, parameters.min_km2);
  std::vector<RiverBed> beds(reaches.size());
  std::vector<bool> at_rim(reaches.size());
  for (std::size_t i = 0; i < reaches.size(); ++i) {
    RiverReach& reach = reaches[i];
    const auto x = static_cast<int>(reach.position.x);
    const auto y = static_cast<int>(reach.position.y);
    beds[i] = bed(x, y);
    at_rim[i] =
        x <= 1 || y <= 1 || x + 2 >= catchment_km2.width() || y + 2 >= catchment_km2.height();
    const auto km2 = static_cast<double>(reach.catchment_km2);
    const double grown =
        smoothstep((km2 - parameters.min_km2) / (parameters.full_km2 - parameters.min_km2));
    reach.half_width_m = known_half_width_m(km2) * grown;
  }
  smooth_reaches(reaches);
  const std::vector<JoinedRiver> lines = follow_water(reaches);
  // First every river is bent along its own part; then tributaries are led to the new position of
  // the larger ones.
  std::vector<std::vector<glm::dvec2>> ways(lines.size());
  parallel_ranges(lines.size(), std::size_t{4}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) {
      RiverLine river;
      for (const std::size_t reach : lines[i].reaches) {
        river.positions.push_back(reaches[reach].position);
        river.half_width_m.push_back(reaches[reach].half_width_m);
        river.held.push_back(beds[reach] == RiverBed::open);
      }
      bend_on_level_ground(river, altitude_m, transform, parameters.seed);
      ways[i] = std::move(river.positions);
    }
  });
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t k = 0; k < lines[i].reaches.size() - (lines[i].joins ? 1 : 0); ++k)
      reaches[lines[i].reaches[k]].position = ways[i][k];
  std::vector<RiverCentreline> centrelines;
  for (std::size_t number = 0; number < lines.size(); ++number) {
    const JoinedRiver& line = lines[number];
    std::vector<RiverBed> along;
    along.reserve(line.reaches.size());
    for (const std::size_t reach : line.reaches) along.push_back(beds[reach]);
    const Ends ends{at_rim[line.reaches.front()], line.joins || at_rim[line.reaches.back()]};
    std::vector<glm::dvec2>& positions = ways[number];
    if (line.joins) lead_mouth(positions, reaches, line.reaches.back());
    const std::size_t before =
        line.reaches.size() - 1 - std::min(line.reaches.size() - 1, own_cells);
    const double widest_m =
        reaches[line.joins ? line.reaches[before] : line.reaches.back()].half_width_m;
    for (const Piece& piece : pieces_of(std::move(along), ends, parameters)) {
      RiverCentreline centreline;
      for (std::size_t i = piece.first; i <= piece.last; ++i) {
        const RiverReach& reach = reaches[line.reaches[i]];
        centreline.positions.push_back(transform.to_crs(positions[i].x, positions[i].y));
        const auto faded = [](std::size_t away) {
          return smoothstep(static_cast<double>(away) / static_cast<double>(fade_cells));
        };
        const double share = (piece.rises ? faded(i - piece.first) : 1.0) *
                             (piece.dries ? faded(piece.last - i) : 1.0);
        centreline.half_width_m.push_back(
            static_cast<float>(share * std::min(reach.half_width_m, widest_m)));
      }
      if (centreline.positions.size() > 1) centrelines.push_back(std::move(centreline));
    }
  }
  return centrelines;
}

}  // namespace belvedere
