#include "renderer/register/seen_lines.h"

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <utility>

namespace belvedere {
namespace {

// Between the pixels of two rows: what is seen above it is farther away, or sky.
struct Jump {
  int y = 0;  // of the lower pixel
  bool skyline = false;
};

std::vector<Jump> jumps_of_column(const RegisteredGround& ground, int x, float min_jump) {
  std::vector<Jump> out;
  for (int y = 1; y < ground.distance_m.height(); ++y) {
    const float above = ground.distance_m(x, y - 1);
    const float below = ground.distance_m(x, y);
    if (std::isnan(below)) continue;
    const bool skyline = std::isnan(above);
    if (skyline || above > min_jump * below) out.push_back({y, skyline});
  }
  return out;
}

// A line that may go on in the next column.
struct OpenLine {
  SeenLine line;
  int last_y = 0;
};

// The open line of that kind that ends nearest to the jump, if none of the column's other jumps
// took it.
std::optional<std::size_t> nearest_end(const std::vector<OpenLine>& open,
                                       const std::vector<bool>& taken, const Jump& jump,
                                       int max_step_px) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const int step = std::abs(open[i].last_y - jump.y);
    if (taken[i] || open[i].line.skyline != jump.skyline || step > max_step_px) continue;
    if (!best || step < std::abs(open[*best].last_y - jump.y)) best = i;
  }
  return best;
}

}  // namespace

std::vector<SeenLine> seen_lines(const RegisteredGround& ground,
                                 const SeenLinesParameters& parameters) {
  std::vector<SeenLine> out;
  std::vector<OpenLine> open;
  const auto end = [&](SeenLine line) {
    if (static_cast<int>(line.points.size()) >= parameters.min_length_px)
      out.push_back(std::move(line));
  };
  for (int x = 0; x < ground.distance_m.width(); ++x) {
    std::vector<bool> taken(open.size(), false);
    std::vector<OpenLine> begun;
    for (const Jump& jump : jumps_of_column(ground, x, parameters.min_jump)) {
      const glm::vec2 point(static_cast<float>(x) + 0.5F, static_cast<float>(jump.y));
      const std::optional<std::size_t> found =
          nearest_end(open, taken, jump, parameters.max_step_px);
      if (!found) {
        begun.push_back({{jump.skyline, {point}}, jump.y});
        continue;
      }
      taken[*found] = true;
      open[*found].line.points.push_back(point);
      open[*found].last_y = jump.y;
    }
    std::vector<OpenLine> next;
    for (std::size_t i = 0; i < open.size(); ++i)
      taken[i] ? next.push_back(std::move(open[i])) : end(std::move(open[i].line));
    for (OpenLine& line : begun) next.push_back(std::move(line));
    open = std::move(next);
  }
  for (OpenLine& line : open) end(std::move(line.line));
  return out;
}

}  // namespace belvedere
