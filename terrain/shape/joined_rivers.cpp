#include "terrain/shape/joined_rivers.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

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

}  // namespace belvedere
