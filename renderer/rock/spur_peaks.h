#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace belvedere {

// A spur of rock (spurs.h).
struct Spur {
  bool grown = false;
  glm::vec2 position{0.0F};
  glm::vec2 down{0.0F, 1.0F};  // unit direction of its crest, downhill
  glm::vec2 fall{0.0F, 1.0F};  // unit fall line of the wall it grew on
  glm::vec3 normal{0.0F};      // of that wall, a mean over the spur
  float top = 0.0F;            // height of its head
  std::array<float, 2> flank{};
  float length = 1.0F, foot = 1.0F;
  float skew_foot = 0.0F, skew_head = 0.0F;
  float depth_m = 0.0F, tolerance_m = 0.0F;
  std::uint32_t id = 0;
  std::uint32_t parent = 0;  // flank of the next larger spur that it stands on
};

// The same spurs as structure of arrays (to_lanes).
struct SpurLanes {
  std::vector<float> numbers;
  std::ptrdiff_t field = 0;  // numbers to the next field …
  std::ptrdiff_t row = 0;    // … and row of cells
};
// Spurs of one band and size over a rectangle of cells.
struct SpurCells {
  float spacing = 1.0F;
  float lost_beyond =
      0.4F;  // height, in spacings, that a spur loses across the border of its parent
  bool any_direction = false;  // spurs may run up, too
  glm::ivec2 first{0};
  glm::ivec2 count{0};
  std::vector<Spur> spurs;
  SpurLanes lanes;
};
// Shape of a spur, in its own spacings: a roof with a slanting, pointed head and foot.
namespace spur_form {
inline constexpr float head_rise = 0.9F;
inline constexpr float back_rise = 0.06F;
inline constexpr float head_point = 0.25F;
inline constexpr float foot_point = 0.35F;
// Flanks widen downhill: the lower the position, the broader the spur.
inline constexpr float opening = 0.75F;
inline constexpr float opening_along = 0.45F;
inline constexpr float opening_from = -0.5F;
inline constexpr float opening_to = 1.6F;
// How far a spur's surface may deviate in depth: its tolerance times this and the distance from its
// origin.
inline constexpr float stray = 0.6F;
// Cells around a position whose spurs can be highest there: those above reach farther down than
// those below reach up. Roofs that lie in any direction have the larger reach on every side.
inline constexpr int reach_across = 2;
inline constexpr int reach_up = 3;
inline constexpr int reach_down = 2;
inline constexpr int max_reach = 3;
}  // namespace spur_form

// The fields that determine a spur's height at a position, sorted by field, so that a row of cells
// is evaluated at once.
SpurLanes to_lanes(const SpurCells& cells);

// The two highest spurs at a position (of equal ones the first): their numbers in the cells (-1:
// none), and the height of the second.
struct SpurPeaks {
  int best = -1;
  int next = -1;
  float next_height = -1e9F;
};
SpurPeaks find_peaks(const SpurCells& cells, float slender, glm::vec2 position, float depth_m,
                     std::uint32_t parent);

}  // namespace belvedere
