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
  glm::vec2 place{0.0F};
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

// The same spurs as numbers side by side (to_lanes).
struct SpurLanes {
  std::vector<float> numbers;
  std::ptrdiff_t field = 0;  // numbers to the next field …
  std::ptrdiff_t row = 0;    // … and row of cells
};
// Spurs of one band and size over a rectangle of cells.
struct SpurCells {
  float spacing = 1.0F;
  float lost_beyond = 0.4F;  // height, in spacings, that a spur loses across the border of what it stands on
  glm::ivec2 first{0};
  glm::ivec2 count{0};
  std::vector<Spur> spurs;
  SpurLanes lanes;
};
// Form of a spur, in its own spacings: a roof whose head and foot slant and come to a point.
namespace spur_form {
inline constexpr float head_rise = 0.9F;
inline constexpr float back_rise = 0.06F;
inline constexpr float head_point = 0.25F;
inline constexpr float foot_point = 0.35F;
// Flanks open downhill: the lower the place, the broader the spur.
inline constexpr float opening = 0.75F;
inline constexpr float opening_along = 0.45F;
inline constexpr float opening_from = -0.5F;
inline constexpr float opening_to = 1.6F;
// How far a spur's surface may stray in depth: its tolerance times this and the distance from its place.
inline constexpr float stray = 0.6F;
// Cells around a place whose spurs can be highest there: those above it reach farther down than those below it up.
inline constexpr int reach_across = 2;
inline constexpr int reach_up = 3;
inline constexpr int reach_down = 2;
}  // namespace spur_form

// The numbers of spurs that say how high each is somewhere, sorted by number, so that a row of cells is asked at once.
SpurLanes to_lanes(const SpurCells& cells);

// The two spurs that are highest at a place, of equal ones the first: their numbers in the cells (-1: none), and the height of the second.
struct SpurPeaks {
  int best = -1;
  int next = -1;
  float next_height = -1e9F;
};
SpurPeaks find_peaks(const SpurCells& cells, float slender, glm::vec2 place, float depth_m, std::uint32_t parent);

}  // namespace belvedere
