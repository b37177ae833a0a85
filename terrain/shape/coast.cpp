#include "terrain/shape/coast.h"
#include "base/masks/polygon.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <map>
#include <optional>
#include <utility>

namespace belvedere {
namespace {

using Row = std::vector<glm::dvec2>;

// Line ends closer than this coincide.
constexpr double same_place_m = 0.01;

std::pair<std::int64_t, std::int64_t> key_of(glm::dvec2 position) {
  return {std::llround(position.x / same_place_m), std::llround(position.y / same_place_m)};
}

bool is_ring(const Row& line) {
  return line.size() > 3 && key_of(line.front()) == key_of(line.back());
}

// Joins pieces end to end into one line.
std::vector<Row> join(const std::vector<Row>& lines) {
  std::multimap<std::pair<std::int64_t, std::int64_t>, std::size_t> begins;
  std::map<std::pair<std::int64_t, std::int64_t>, int> ends;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].size() < 2) continue;
    begins.emplace(key_of(lines[i].front()), i);
    ++ends[key_of(lines[i].back())];
  }
  std::vector<bool> taken(lines.size(), false);
  std::vector<Row> joined;
  const auto follow = [&](std::size_t first) {
    Row line = lines[first];
    taken[first] = true;
    while (!is_ring(line)) {
      const auto [from, to] = begins.equal_range(key_of(line.back()));
      const auto next = std::find_if(from, to, [&](const auto& one) { return !taken[one.second]; });
      if (next == to) break;
      const Row& more = lines[next->second];
      taken[next->second] = true;
      line.insert(line.end(), more.begin() + 1, more.end());
    }
    joined.push_back(std::move(line));
  };
  // From true beginnings first; the remaining pieces form rings.
  for (const bool only_beginnings : {true, false})
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (!taken[i] && lines[i].size() > 1 &&
          (!only_beginnings || !ends.contains(key_of(lines[i].front()))))
        follow(i);
  return joined;
}

struct Box {
  glm::dvec2 low, high;

  bool holds(glm::dvec2 p) const {
    return p.x > low.x && p.y > low.y && p.x < high.x && p.y < high.y;
  }
  double around() const { return 2.0 * (high.x - low.x + high.y - low.y); }

  // Position of a point along the edge, clockwise from the lower left corner.
  double along(glm::dvec2 p) const {
    const glm::dvec2 size = high - low;
    const double left = std::abs(p.x - low.x);
    const double right = std::abs(p.x - high.x);
    const double bottom = std::abs(p.y - low.y);
    const double top = std::abs(p.y - high.y);
    const double min = std::min({left, right, bottom, top});
    if (min == left) return p.y - low.y;
    if (min == top) return size.y + (p.x - low.x);
    if (min == right) return size.y + size.x + (high.y - p.y);
    return 2.0 * size.y + size.x + (high.x - p.x);
  }
  std::vector<std::pair<double, glm::dvec2>> corners() const {
    const glm::dvec2 size = high - low;
    return {{0.0, low},
            {size.y, {low.x, high.y}},
            {size.y + size.x, high},
            {2.0 * size.y + size.x, {high.x, low.y}}};
  }

  // The part of the line from a to b inside, as shares of it.
  std::optional<std::pair<double, double>> clip(glm::dvec2 a, glm::dvec2 b) const {
    double from = 0.0;
    double to = 1.0;
    for (int k = 0; k < 2; ++k) {
      const double way = b[k] - a[k];
      if (way == 0.0) {
        if (a[k] <= low[k] || a[k] >= high[k]) return std::nullopt;
        continue;
      }
      const double first = ((way > 0.0 ? low[k] : high[k]) - a[k]) / way;
      const double last = ((way > 0.0 ? high[k] : low[k]) - a[k]) / way;
      from = std::max(from, first);
      to = std::min(to, last);
    }
    if (!(from < to)) return std::nullopt;
    return std::pair(from, to);
  }
};

// The part of a line on the terrain: pieces that begin and end on its edge, or a problem.
std::string cut(const Box& box, Row line, std::vector<Row>& pieces, std::vector<Row>& rings) {
  if (is_ring(line)) {
    line.pop_back();
    const auto outside =
        std::find_if(line.begin(), line.end(), [&](glm::dvec2 p) { return !box.holds(p); });
    if (outside == line.end()) {
      rings.push_back(std::move(line));
      return {};
    }
    std::rotate(line.begin(), outside, line.end());
    line.push_back(line.front());
  }
  for (const glm::dvec2 end : {line.front(), line.back()})
    if (box.holds(end))
      return fmt::format(
          "a coastline begins or ends on the terrain, at E {:.0f}, N {:.0f}, and no other "
          "continues it",
          end.x, end.y);
  Row piece;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const glm::dvec2 a = line[i];
    const glm::dvec2 b = line[i + 1];
    const auto part = box.clip(a, b);
    if (!part) continue;
    if (part->first > 0.0 || !box.holds(a))
      piece = {glm::clamp(glm::mix(a, b, part->first), box.low, box.high)};
    piece.push_back(part->second < 1.0 ? glm::clamp(glm::mix(a, b, part->second), box.low, box.high)
                                       : b);
    if (part->second < 1.0 || !box.holds(b)) {
      pieces.push_back(std::move(piece));
      piece.clear();
    }
  }
  return {};
}

// Joins pieces along the edge, clockwise, from where one leaves the terrain to where the next
// enters: sea lies to the right of both.
std::string close(const Box& box, const std::vector<Row>& pieces, std::vector<Row>& rings) {
  struct Event {
    double along;
    bool comes_in;
    std::size_t piece;
  };
  std::vector<Event> events;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    events.push_back({box.along(pieces[i].front()), true, i});
    events.push_back({box.along(pieces[i].back()), false, i});
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.along < b.along; });
  std::vector<std::size_t> leaves(pieces.size());
  for (std::size_t e = 0; e < events.size(); ++e) {
    if (events[e].comes_in == events[(e + 1) % events.size()].comes_in) {
      const Row& piece = pieces[events[e].piece];
      const glm::dvec2 at = events[e].comes_in ? piece.front() : piece.back();
      return fmt::format(
          "two adjacent coastlines at the terrain's edge, near E {:.0f}, N {:.0f}, run in the same "
          "direction",
          at.x, at.y);
    }
    if (!events[e].comes_in) leaves[events[e].piece] = e;
  }
  std::vector<bool> taken(pieces.size(), false);
  for (std::size_t first = 0; first < pieces.size(); ++first) {
    if (taken[first]) continue;
    Row ring;
    for (std::size_t i = first; !taken[i];) {
      taken[i] = true;
      ring.insert(ring.end(), pieces[i].begin(), pieces[i].end());
      const Event& leave = events[leaves[i]];
      const Event& enter = events[(leaves[i] + 1) % events.size()];
      const double way = enter.along >= leave.along ? enter.along - leave.along
                                                    : enter.along - leave.along + box.around();
      std::vector<std::pair<double, glm::dvec2>> passed;
      for (const auto& [along, corner] : box.corners()) {
        const double on =
            along >= leave.along ? along - leave.along : along - leave.along + box.around();
        if (on < way) passed.emplace_back(on, corner);
      }
      std::sort(passed.begin(), passed.end(),
                [](const auto& a, const auto& b) { return a.first < b.first; });
      for (const auto& one : passed) ring.push_back(one.second);
      i = enter.piece;
    }
    rings.push_back(std::move(ring));
  }
  return {};
}

}  // namespace

CoastAreas close_coast(const std::vector<std::vector<glm::dvec2>>& lines, glm::dvec2 low,
                       glm::dvec2 high) {
  const Box box{low, high};
  CoastAreas areas;
  std::vector<Row> pieces;
  for (Row& line : join(lines)) {
    areas.problem = cut(box, std::move(line), pieces, areas.rings);
    if (!areas.problem.empty()) return {.rings = {}, .problem = areas.problem};
  }
  if (pieces.empty()) {
    // The orientation of the largest ring decides what surrounds all.
    double largest = 0.0;
    for (const Row& ring : areas.rings)
      if (const double area = signed_area(ring); std::abs(area) > std::abs(largest)) largest = area;
    if (largest > 0.0) areas.rings.push_back({low, {low.x, high.y}, high, {high.x, low.y}});
    return areas;
  }
  areas.problem = close(box, pieces, areas.rings);
  if (!areas.problem.empty()) areas.rings.clear();
  return areas;
}

}  // namespace belvedere
