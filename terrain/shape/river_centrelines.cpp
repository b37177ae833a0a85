#include "terrain/shape/river_centrelines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <utility>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"

namespace belvedere {

JoinedLines join_lines(const std::vector<MappedRiver>& drawn) {
  struct End {
    std::size_t line;
    bool last;
  };
  using Key = std::array<double, 3>;
  std::map<Key, std::vector<End>> ends;
  const auto key_of = [](const MappedRiver& line, bool last) {
    const glm::dvec2 position = last ? line.positions.back() : line.positions.front();
    return Key{static_cast<double>(line.group), position.x, position.y};
  };
  for (std::size_t i = 0; i < drawn.size(); ++i)
    if (drawn[i].positions.size() > 1)
      for (const bool last : {false, true}) ends[key_of(drawn[i], last)].push_back({i, last});
  const auto next_of = [&](End end) -> End {  // the line that continues there, from its other end
    const std::vector<End>& here = ends[key_of(drawn[end.line], end.last)];
    if (here.size() != 2 || here[0].line == here[1].line) return {drawn.size(), false};
    return here[0].line == end.line ? here[1] : here[0];
  };
  JoinedLines out;
  std::vector<bool> used(drawn.size(), false);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (used[i] || drawn[i].positions.size() < 2) continue;
    // Back to where this river begins, or once around.
    End head{i, false};
    for (std::size_t guard = 0; guard < drawn.size(); ++guard) {
      const End before = next_of(head);
      if (before.line == drawn.size() || used[before.line]) break;
      head = {before.line, !before.last};
      if (head.line == i) break;
    }
    MappedRiver river = drawn[head.line];
    river.positions.clear();
    End at = head;
    while (!used[at.line]) {
      used[at.line] = true;
      const MappedRiver& part = drawn[at.line];
      std::vector<glm::dvec2> positions = part.positions;
      if (at.last) std::reverse(positions.begin(), positions.end());
      river.positions.insert(river.positions.end(),
                             positions.begin() + (river.positions.empty() ? 0 : 1),
                             positions.end());
      river.width_m = std::max(river.width_m, part.width_m);
      const End next = next_of({at.line, !at.last});
      if (next.line == drawn.size() || used[next.line]) break;
      ++out.joined;
      at = next;
    }
    out.lines.push_back(std::move(river));
  }
  return out;
}

namespace {

// Costs of a position of a cross-section.
constexpr double cost_of_dry = 1.0;     // without catchment, relative to the largest catchment
constexpr double cost_of_height = 1.0;  // per height_m above the lowest position
constexpr double height_m = 10.0;
constexpr double max_height_m = 40.0;
constexpr double offset_cost = 0.45;  // at snap_m from the map's line
constexpr double cost_of_turn =
    0.18;  // times the squared change of the offset per step, relative to its length
constexpr int max_turn = 2;          // positions of the cross-section, from a step to the next
constexpr int max_half_places = 30;  // of a cross-section, each side
constexpr double min_step_m = 8.0;
constexpr double max_step_m = 60.0;
constexpr int outside_cells = 4;  // distance beyond the ground that a river is followed
// Passes of [1 2 1] / 4, each of variance 1/2.
constexpr int way_passes = 16;    // for the offsets: 2.8 steps
constexpr int line_passes = 6;    // for the line itself: 1.7 steps
constexpr int width_passes = 60;  // for widths: 5.5 steps
constexpr int mouth_steps = 6;    // before its mouth a river ignores the larger one
constexpr int mouth_fade = 14;    // steps over which it is led there
constexpr double law_m = 18.0;
constexpr double law_km2 = 110.0;
constexpr double law_widest_m = 90.0;
constexpr double law_exponent = 0.458;

using Line = std::vector<glm::dvec2>;

struct Work {
  Line positions;  // m
  double width_m = 0.0, min_width_m = 0.0, snap_m = 0.0;
  int group = 0;
  double step_m = 0.0;
  std::vector<float> catchment_km2 = {};
  std::vector<float> half_width_m = {};
  double moved_m = 0.0, max_moved_m = 0.0;
};

constexpr double square(double value) { return value * value; }

class Ground {
 public:
  Ground(const Dem& dem, const Grid<float>& catchment_km2)
      : dem_(dem),
        catchment_km2_(catchment_km2),
        cell_km2_(1e-6 * dem.transform.cell_x * dem.transform.cell_y) {}

  bool holds(glm::dvec2 position) const {
    const glm::dvec2 at = dem_.transform.to_cell(position.x, position.y);
    return at.x >= -outside_cells && at.y >= -outside_cells &&
           at.x < dem_.width() + outside_cells && at.y < dem_.height() + outside_cells;
  }
  double altitude(glm::dvec2 position) const {
    const glm::dvec2 at = dem_.transform.to_cell(position.x, position.y);
    const double x = std::clamp(at.x, 0.0, dem_.width() - 1.0);
    const double y = std::clamp(at.y, 0.0, dem_.height() - 1.0);
    const int x0 = static_cast<int>(x);
    const int y0 = static_cast<int>(y);
    const auto z = [&](int i, int j) {
      return static_cast<double>(dem_.altitude_m.clamped(x0 + i, y0 + j));
    };
    const double fx = x - x0;
    const double fy = y - y0;
    return (z(0, 0) * (1.0 - fx) + z(1, 0) * fx) * (1.0 - fy) +
           (z(0, 1) * (1.0 - fx) + z(1, 1) * fx) * fy;
  }
  // The logarithm of the cells that drain through the nearest drainage line, less next to it: these
  // lines are one cell wide.
  double water(glm::dvec2 position) const {
    const glm::dvec2 at = dem_.transform.to_cell(position.x, position.y);
    const int x0 = static_cast<int>(std::floor(std::clamp(at.x, -1e6, 1e6)));
    const int y0 = static_cast<int>(std::floor(std::clamp(at.y, -1e6, 1e6)));
    double best = 0.0;
    for (int y = y0; y <= y0 + 1; ++y)
      for (int x = x0; x <= x0 + 1; ++x) {
        if (!catchment_km2_.contains(x, y)) continue;
        const double away = exact::hypot(at.x - x, at.y - y);
        const double cells = static_cast<double>(catchment_km2_(x, y)) / cell_km2_;
        best = std::max(best, (1.0 - 0.35 * std::min(away, 1.0)) * exact::log(1.0 + cells));
      }
    return best;
  }
  // The largest catchment nearby.
  double catchment(glm::dvec2 position) const {
    constexpr int near = 2;
    const glm::dvec2 at = dem_.transform.to_cell(position.x, position.y);
    if (!(std::abs(at.x) < 1e6 && std::abs(at.y) < 1e6)) return 0.0;
    const int x0 = static_cast<int>(std::lround(at.x));
    const int y0 = static_cast<int>(std::lround(at.y));
    float best = 0.F;
    for (int y = y0 - near; y <= y0 + near; ++y)
      for (int x = x0 - near; x <= x0 + near; ++x)
        if (catchment_km2_.contains(x, y)) best = std::max(best, catchment_km2_(x, y));
    return static_cast<double>(best);
  }
  double cell_m() const { return dem_.cell_m(); }

 private:
  const Dem& dem_;
  const Grid<float>& catchment_km2_;
  double cell_km2_;
};

// Positions along a line, even and at most a step apart, in the parts on the ground.
std::vector<Work> cut_to_steps(const MappedRiver& line, const Ground& ground) {
  Work usual{.positions = {},
             .width_m = line.width_m,
             .min_width_m = line.min_width_m,
             .snap_m = std::clamp(line.snap_m, 0.0, 2000.0),
             .group = line.group,
             .step_m = std::clamp(ground.cell_m(), min_step_m, max_step_m)};
  std::vector<Work> parts;
  bool open = false;
  const auto add = [&](glm::dvec2 position) {
    if (!ground.holds(position)) {
      open = false;
      return;
    }
    if (!open) parts.push_back(usual);
    open = true;
    Line& to = parts.back().positions;
    if (to.empty() || to.back() != position) to.push_back(position);
  };
  // Steps continue across vertices, so that short segments of a detailed line do not crowd.
  double left_m = 0.0;
  add(line.positions.front());
  for (std::size_t i = 0; i + 1 < line.positions.size(); ++i) {
    const glm::dvec2 along = line.positions[i + 1] - line.positions[i];
    const double length = glm::length(along);
    double at = usual.step_m - left_m;
    for (; at < length; at += usual.step_m) add(line.positions[i] + along * (at / length));
    left_m = usual.step_m - (at - length);
  }
  add(line.positions.back());
  std::erase_if(parts, [](const Work& part) { return part.positions.size() < 2; });
  return parts;
}

void smooth_line(Line& line, int passes) {
  Line next = line;
  for (int pass = 0; pass < passes && line.size() > 2; ++pass) {
    for (std::size_t i = 1; i + 1 < line.size(); ++i)
      next[i] = 0.5 * line[i] + 0.25 * (line[i - 1] + line[i + 1]);
    line.swap(next);
  }
}

void smooth_widths(std::vector<float>& widths, int passes) {
  std::vector<float> next = widths;
  for (int pass = 0; pass < passes && widths.size() > 2; ++pass) {
    for (std::size_t i = 1; i + 1 < widths.size(); ++i)
      next[i] = 0.5F * widths[i] + 0.25F * (widths[i - 1] + widths[i + 1]);
    widths.swap(next);
  }
}

// Perpendicular to the line, by its direction over some steps.
Line normals_of(const Line& line) {
  constexpr std::size_t reach = 3;
  Line normals(line.size());
  for (std::size_t i = 0; i < line.size(); ++i) {
    const glm::dvec2 along =
        line[std::min(i + reach, line.size() - 1)] - line[i - std::min(i, reach)];
    const double length = glm::length(along);
    normals[i] = length > 0.0 ? glm::dvec2(-along.y, along.x) / length : glm::dvec2(0.0);
  }
  return normals;
}

// Displacement of each position across the line, m.
std::vector<double> lateral_offsets(const Work& work, const Line& normals, const Ground& ground) {
  const double between_m = std::max(0.5 * work.step_m, work.snap_m / max_half_places);
  const int half = std::min(max_half_places, static_cast<int>(work.snap_m / between_m));
  const int positions = 2 * half + 1;
  const auto wide = static_cast<std::size_t>(positions);
  const std::size_t count = work.positions.size();
  std::vector<double> cost(wide, 0.0);
  std::vector<double> total(wide, 0.0);
  std::vector<double> height(wide);
  std::vector<double> water(wide);
  std::vector<std::int8_t> came(count * wide, 0);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < wide; ++j) {
      const glm::dvec2 position =
          work.positions[i] + normals[i] * (between_m * (static_cast<int>(j) - half));
      height[j] = ground.altitude(position);
      water[j] = ground.water(position);
    }
    const double lowest = *std::min_element(height.begin(), height.end());
    const double max = std::max(1e-9, *std::max_element(water.begin(), water.end()));
    for (std::size_t j = 0; j < wide; ++j) {
      const double off = between_m * (static_cast<int>(j) - half) / work.snap_m;
      cost[j] = cost_of_dry * (1.0 - water[j] / max) +
                cost_of_height * std::min(height[j] - lowest, max_height_m) / height_m +
                offset_cost * off * off;
    }
    if (i == 0) {
      total = cost;
      continue;
    }
    std::vector<double> next(wide);
    for (int j = 0; j < positions; ++j) {
      double best = std::numeric_limits<double>::infinity();
      int from = 0;
      for (int turn = -max_turn; turn <= max_turn; ++turn) {
        if (j + turn < 0 || j + turn >= positions) continue;
        const double here = total[static_cast<std::size_t>(j + turn)] +
                            cost_of_turn * square(turn * between_m / work.step_m);
        if (here < best) best = here, from = turn;
      }
      next[static_cast<std::size_t>(j)] = best + cost[static_cast<std::size_t>(j)];
      came[i * wide + static_cast<std::size_t>(j)] = static_cast<std::int8_t>(from);
    }
    total.swap(next);
  }
  std::vector<double> ways(count);
  auto j = static_cast<int>(std::min_element(total.begin(), total.end()) - total.begin());
  for (std::size_t i = count; i-- > 0;) {
    ways[i] = between_m * (j - half);
    j += came[i * wide + static_cast<std::size_t>(j)];
  }
  return ways;
}

void move_to_valley(Work& work, const Ground& ground) {
  const Line drawn = work.positions;
  if (work.snap_m >= 0.25 * work.step_m) {
    const Line normals = normals_of(work.positions);
    const std::vector<double> ways = lateral_offsets(work, normals, ground);
    Line moved(work.positions.size());
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] = normals[i] * ways[i];
    smooth_line(moved, way_passes);
    for (std::size_t i = 0; i < moved.size(); ++i) work.positions[i] += moved[i];
  }
  smooth_line(work.positions, line_passes);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const double way = glm::length(work.positions[i] - drawn[i]);
    work.moved_m += way;
    work.max_moved_m = std::max(work.max_moved_m, way);
  }
  work.catchment_km2.resize(work.positions.size());
  for (std::size_t i = 0; i < work.positions.size(); ++i)
    work.catchment_km2[i] = static_cast<float>(ground.catchment(work.positions[i]));
  // Downstream direction: towards lower ground, on level ground towards the larger catchment.
  constexpr double level_m = 5.0;
  const double fall_m =
      ground.altitude(work.positions.front()) - ground.altitude(work.positions.back());
  if (fall_m < -level_m ||
      (fall_m <= level_m && work.catchment_km2.front() > work.catchment_km2.back())) {
    std::reverse(work.positions.begin(), work.positions.end());
    std::reverse(work.catchment_km2.begin(), work.catchment_km2.end());
  }
}

// Widths of a river with a free end.
void find_widths(Work& work) {
  // A river widens downstream, even where smoothing moved it off the cells of its drainage line.
  for (std::size_t i = 1; i < work.catchment_km2.size(); ++i)
    work.catchment_km2[i] = std::max(work.catchment_km2[i], work.catchment_km2[i - 1]);
  const std::size_t last = work.positions.size() - 1;
  const std::size_t before = last - std::min<std::size_t>(last, mouth_steps);
  for (std::size_t i = before; i <= last; ++i)
    work.catchment_km2[i] = std::min(work.catchment_km2[i], work.catchment_km2[before]);
  work.half_width_m.resize(work.positions.size());
  for (std::size_t i = 0; i <= last; ++i) {
    const double law = known_half_width_m(static_cast<double>(work.catchment_km2[i]));
    work.half_width_m[i] =
        static_cast<float>(std::max({law, 0.5 * work.width_m, 0.5 * work.min_width_m}));
  }
  smooth_widths(work.half_width_m, width_passes);
}

// Positions of all rivers in a grid of boxes, to find the nearest of another one.
class NearRivers {
 public:
  NearRivers(const std::vector<Work>& works, double box_m) : works_(works), box_m_(box_m) {
    for (std::size_t i = 0; i < works.size(); ++i)
      for (std::size_t k = 0; k < works[i].positions.size(); ++k)
        boxes_[box_of(works[i].positions[k])].emplace_back(i, k);
  }
  // The nearest position of another river that is larger there than `km2`, within `reach_m`; null
  // if there is none.
  const glm::dvec2* nearest(std::size_t own, glm::dvec2 position, float km2, double reach_m) const {
    const auto [x, y] = box_of(position);
    const int around = static_cast<int>(std::ceil(reach_m / box_m_));
    const glm::dvec2* found = nullptr;
    double min = reach_m * reach_m;
    for (int v = y - around; v <= y + around; ++v)
      for (int u = x - around; u <= x + around; ++u) {
        const auto box = boxes_.find({u, v});
        if (box == boxes_.end()) continue;
        for (const auto& [i, k] : box->second) {
          if (i == own || works_[i].catchment_km2[k] < km2) continue;
          const glm::dvec2 off = works_[i].positions[k] - position;
          const double way2 = glm::dot(off, off);
          if (way2 < min) min = way2, found = &works_[i].positions[k];
        }
      }
    return found;
  }

 private:
  std::pair<int, int> box_of(glm::dvec2 position) const {
    return {static_cast<int>(std::floor(position.x / box_m_)),
            static_cast<int>(std::floor(position.y / box_m_))};
  }
  const std::vector<Work>& works_;
  double box_m_;
  std::map<std::pair<int, int>, std::vector<std::pair<std::size_t, std::size_t>>> boxes_;
};

// The end of a river: the number of positions kept, and the target of the last one; unchanged if no
// larger river is near.
struct Mouth {
  std::size_t count = 0;
  const glm::dvec2* to = nullptr;
};
Mouth find_mouth(const Work& work, std::size_t number, const NearRivers& near) {
  const double reach_m = std::max(work.snap_m, 3.0 * work.step_m);
  const std::size_t last = work.positions.size() - 1;
  // Its catchment before it comes near the larger one.
  const auto own_km2 = [&](std::size_t i) {
    return work.catchment_km2[i - std::min<std::size_t>(i, mouth_steps)];
  };
  // One that was drawn across it ends where it first meets it.
  const std::size_t far = std::min(last - 1, static_cast<std::size_t>(reach_m / work.step_m));
  for (std::size_t i = last - far; i < last; ++i)
    if (const glm::dvec2* met =
            near.nearest(number, work.positions[i], own_km2(i), 1.2 * work.step_m))
      return {i + 1, met};
  return {last + 1, near.nearest(number, work.positions[last], own_km2(last), reach_m)};
}

// Leads rivers into those that they flow into.
void join_mouths(std::vector<Work>& works) {
  if (works.empty()) return;
  const NearRivers near(works, 16.0 * works.front().step_m);
  std::vector<Line> led(works.size());
  parallel_ranges<std::size_t>(works.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) {
      const Mouth mouth = find_mouth(works[i], i, near);
      if (mouth.to == nullptr) continue;
      Line positions(works[i].positions.begin(),
                     works[i].positions.begin() + static_cast<std::ptrdiff_t>(mouth.count));
      const glm::dvec2 way = *mouth.to - positions.back();
      const std::size_t fade = std::min<std::size_t>(mouth_fade, positions.size() - 1);
      for (std::size_t k = 0; k <= fade; ++k) {
        const double share = smoothstep(1.0 - static_cast<double>(k) / static_cast<double>(fade));
        positions[positions.size() - 1 - k] += share * way;
      }
      led[i] = std::move(positions);
    }
  });
  for (std::size_t i = 0; i < works.size(); ++i) {
    if (led[i].empty()) continue;
    works[i].positions = std::move(led[i]);
    works[i].catchment_km2.resize(works[i].positions.size());
  }
}

}  // namespace

double known_half_width_m(double catchment_km2) {
  if (catchment_km2 <= 0.0) return 0.0;
  return std::min(law_widest_m, law_m * exact::pow(catchment_km2 / law_km2, law_exponent));
}

RiverCentrelines snap_rivers(const std::vector<MappedRiver>& drawn, const Dem& dem,
                             const Grid<float>& catchment_km2) {
  RiverCentrelines out;
  const Ground ground(dem, catchment_km2);
  std::vector<Work> works;
  const JoinedLines joined = join_lines(drawn);
  out.joined = joined.joined;
  for (const MappedRiver& line : joined.lines) {
    std::vector<Work> parts = cut_to_steps(line, ground);
    if (parts.empty()) ++out.outside;
    for (Work& part : parts) works.push_back(std::move(part));
  }
  parallel_ranges<std::size_t>(works.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) move_to_valley(works[i], ground);
  });
  double sum_m = 0.0;
  std::size_t positions = 0;
  for (const Work& work : works) {
    sum_m += work.moved_m;
    positions += work.positions.size();
    out.max_moved_m = std::max(out.max_moved_m, work.max_moved_m);
  }
  out.mean_moved_m = positions > 0 ? sum_m / static_cast<double>(positions) : 0.0;
  join_mouths(works);
  for (Work& work : works) find_widths(work);
  for (Work& work : works)
    out.lines.push_back({std::move(work.positions), std::move(work.half_width_m), work.group});
  return out;
}

}  // namespace belvedere
