#include "terrain/shape/inferred_rivers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"

// Cells of rivers, linked along the drainage.

namespace belvedere {
namespace {

// Passes of [1 2 1] / 4, each of variance 1/2: 24 smooth by sqrt(12) = 3.5 cells.
constexpr int smoothing_passes = 24;

}  // namespace

std::vector<RiverReach> find_reaches(const Grid<float>& catchment_km2, double min_km2) {
  std::vector<RiverReach> reaches;
  Grid<std::int32_t> number(catchment_km2.width(), catchment_km2.height(), -1);
  for (int y = 0; y < catchment_km2.height(); ++y) {
    for (int x = 0; x < catchment_km2.width(); ++x) {
      const float area = catchment_km2(x, y);
      if (static_cast<double>(area) < min_km2) continue;
      number(x, y) = static_cast<std::int32_t>(reaches.size());
      reaches.push_back({{x, y}, 0.0, area, no_reach, no_reach});
    }
  }
  for (std::size_t i = 0; i < reaches.size(); ++i) {
    RiverReach& reach = reaches[i];
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = static_cast<int>(reach.position.x) + dx;
        const int y = static_cast<int>(reach.position.y) + dy;
        if (!number.contains(x, y) || number(x, y) < 0) continue;
        const auto other = static_cast<std::size_t>(number(x, y));
        if (reaches[other].catchment_km2 <= reach.catchment_km2) continue;
        if (reach.downstream == no_reach ||
            reaches[other].catchment_km2 < reaches[reach.downstream].catchment_km2)
          reach.downstream = other;
      }
    }
    if (reach.downstream == no_reach) continue;
    RiverReach& below = reaches[reach.downstream];
    if (below.upstream == no_reach || reaches[below.upstream].catchment_km2 < reach.catchment_km2)
      below.upstream = i;
  }
  return reaches;
}

void smooth_reaches(std::vector<RiverReach>& reaches, const std::vector<double>& leashes) {
  std::vector<glm::dvec2> cells;
  for (const RiverReach& reach : reaches) cells.push_back(reach.position);
  for (int pass = 0; pass < smoothing_passes; ++pass) {
    std::vector<RiverReach> next = reaches;
    for (std::size_t i = 0; i < reaches.size(); ++i) {
      const RiverReach& here = reaches[i];
      if (here.upstream == no_reach || here.downstream == no_reach) continue;
      const RiverReach& above = reaches[here.upstream];
      const RiverReach& below = reaches[here.downstream];
      next[i].position = 0.5 * here.position + 0.25 * (above.position + below.position);
      if (!leashes.empty()) {
        const glm::dvec2 off = next[i].position - cells[i];
        const double far = glm::length(off);
        if (far > leashes[i]) next[i].position = cells[i] + off * (leashes[i] / far);
      }
      next[i].half_width_m =
          0.5 * here.half_width_m + 0.25 * (above.half_width_m + below.half_width_m);
    }
    reaches.swap(next);
  }
}

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
constexpr double relief_leash = 0.8;  // cells by which a line may leave the drainage on relief …
constexpr double level_leash = 12.0;  // … and on level ground
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

// 0 on relief … 1 where a river has room on level ground.
double levelness(double room_cells) {
  return smoothstep((room_cells - rounded_from) / (rounded_to - rounded_from));
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
  for (std::size_t i = 0; i < count; ++i) rounded[i] = levelness(room[i]);
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

namespace {

constexpr int into_open_cells = 2;      // a river continues this far into a lake
constexpr std::size_t fade_cells = 14;  // over which one fades in from dry ground, or out
// On level ground, D8 lines meet a river at any angle; natural tributaries join obliquely, farther
// downstream. On relief the ground leads them, and only the last cells turn.
constexpr double down_cells = 12.0;
constexpr double led_cells = 24.0;    // length before the mouth over which a river is bent there
constexpr double relief_share = 0.2;  // of both on relief
constexpr std::size_t own_cells =
    10;  // cells before the mouth that ignore the width of the larger river

// On a level floor D8 lines run side by side, where water would have joined long before.
constexpr int beside_cells = 12;              // so near a smaller river joins a larger one …
constexpr std::size_t min_beside_cells = 24;  // … if it would run on for so long by itself

bool level_between(const Grid<float>& altitude_m, glm::dvec2 from, glm::dvec2 to, double cell_m) {
  const auto altitude = [&](glm::dvec2 at) {
    return static_cast<double>(altitude_m.clamped(static_cast<int>(std::lround(at.x)),
                                                  static_cast<int>(std::lround(at.y))));
  };
  const double length = glm::length(to - from);
  for (double away = 1.0; away <= length; away += 1.0)
    if (std::abs(altitude(from + (to - from) * (away / length)) - altitude(from)) >
        level_m + level_slope * away * cell_m)
      return false;
  return true;
}

// Links each river that runs beside a larger one on level ground to it, where it first comes near.
// Its own cells farther down are given up, as far as no other river flows into them.
void join_beside(std::vector<RiverReach>& reaches, const Grid<float>& altitude_m, double cell_m) {
  Grid<std::int32_t> number(altitude_m.width(), altitude_m.height(), -1);
  std::vector<std::size_t> second(reaches.size(), no_reach);  // upstream, after the largest
  const auto number_at = [&](std::size_t i) -> std::int32_t& {
    return number(static_cast<int>(reaches[i].position.x), static_cast<int>(reaches[i].position.y));
  };
  for (std::size_t i = 0; i < reaches.size(); ++i) {
    number_at(i) = static_cast<std::int32_t>(i);
    const std::size_t below = reaches[i].downstream;
    if (below != no_reach && reaches[below].upstream != i &&
        (second[below] == no_reach ||
         reaches[second[below]].catchment_km2 < reaches[i].catchment_km2))
      second[below] = i;
  }
  std::vector<std::size_t> way_of(reaches.size(), no_reach);  // the spring that last came past
  const auto larger_beside = [&](std::size_t at, std::size_t spring) {
    std::size_t nearest = no_reach;
    double nearest_cells = beside_cells + 0.5;
    const auto x = static_cast<int>(reaches[at].position.x);
    const auto y = static_cast<int>(reaches[at].position.y);
    for (int v = y - beside_cells; v <= y + beside_cells; ++v)
      for (int u = x - beside_cells; u <= x + beside_cells; ++u) {
        if (!number.contains(u, v) || number(u, v) < 0) continue;
        const auto other = static_cast<std::size_t>(number(u, v));
        const double away = glm::length(reaches[other].position - reaches[at].position);
        if (away >= nearest_cells || way_of[other] == spring ||
            reaches[other].catchment_km2 <= reaches[at].catchment_km2 ||
            !level_between(altitude_m, reaches[at].position, reaches[other].position, cell_m))
          continue;
        nearest = other;
        nearest_cells = away;
      }
    return nearest;
  };
  for (std::size_t spring = 0; spring < reaches.size(); ++spring) {
    if (reaches[spring].upstream != no_reach) continue;
    std::vector<std::size_t> own{spring};  // down to its mouth, which is that of a larger river
    bool mouth = false;
    way_of[spring] = spring;
    for (std::size_t at = spring; reaches[at].downstream != no_reach;) {
      const std::size_t below = reaches[at].downstream;
      mouth = mouth || reaches[below].upstream != at;
      if (!mouth) own.push_back(below);
      way_of[below] = spring;
      at = below;
    }
    for (std::size_t k = 0; k + min_beside_cells < own.size(); ++k) {
      const std::size_t to = larger_beside(own[k], spring);
      if (to == no_reach) continue;
      reaches[own[k]].downstream = to;
      if (second[to] == no_reach) second[to] = own[k];
      for (++k; k < own.size() && second[own[k]] == no_reach; ++k) {
        const std::size_t below = std::exchange(reaches[own[k]].downstream, no_reach);
        reaches[own[k]].upstream = no_reach;
        number_at(own[k]) = -1;
        if (below != no_reach && second[below] == own[k]) second[below] = no_reach;  // its mouth
      }
      if (k < own.size()) reaches[own[k]].upstream = second[own[k]];
      break;
    }
  }
}

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

// Bends the end of a line, the last point of which lies on the larger river, towards a position
// some cells farther downstream on that river; `level`: 0 on relief … 1 on level ground.
void lead_mouth(std::vector<glm::dvec2>& positions, const std::vector<RiverReach>& reaches,
                std::size_t mouth, double level) {
  const double share = relief_share + (1.0 - relief_share) * level;
  const auto down = static_cast<std::size_t>(share * down_cells);
  std::size_t at = mouth;
  for (std::size_t k = 0;
       k < std::min(down, positions.size() / 3) && reaches[at].downstream != no_reach; ++k)
    at = reaches[at].downstream;
  const glm::dvec2 way = reaches[at].position - positions.back();
  const std::size_t led =
      std::min(static_cast<std::size_t>(share * led_cells), positions.size() - 1);
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
  const double cell_m = 0.5 * (transform.cell_x + transform.cell_y);
  join_beside(reaches, altitude_m, cell_m);
  std::vector<double> level(reaches.size());
  std::vector<double> leashes(reaches.size());
  parallel_ranges(reaches.size(), std::size_t{256}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      level[i] = levelness(room_at(altitude_m, reaches[i].position, cell_m));
      leashes[i] = relief_leash + (level_leash - relief_leash) * level[i];
    }
  });
  smooth_reaches(reaches, leashes);
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
    if (line.joins) {
      const std::size_t mouth = line.reaches.back();
      lead_mouth(positions, reaches, mouth, level[mouth]);
    }
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
