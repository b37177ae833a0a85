#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace belvedere {

// A point of a drawn line; pixels of the sheet.
struct DrawnPoint {
  glm::vec2 position{0.F};
  float distance_m = 0.F;
  float half_px = 0.F;  // half of the fill's width
  float share = 1.F;    // of the style's foreground lengths
  float along_mm =
      0.F;  // from the line's start, in foreground lengths: dashes shrink with the line
};

enum class LinePart : std::uint8_t {
  way,    // on the ground
  rope,   // in the air
  pylon,  // upright below a rope
  station,
  lane  // not painted: ground that a rope above it or a river needs free of trees
};

// A visible piece of a line.
struct DrawnLine {
  int kind = 0;
  LinePart part = LinePart::way;
  std::vector<DrawnPoint> points;  // 2 or more
};

// A wall of a house or a side of its roof: its lower edge from left to right, then its upper one
// from right to left, px of the sheet.
struct HouseFace {
  std::array<glm::vec2, 4> corners{};
  float light = 1.F;  // 0 facing away from the sun … 1 facing it
  bool roof = false;
};
// The shadow of a house, or of one of its wings, on the ground.
struct HouseShade {
  glm::vec2 from{0.F}, to{0.F};  // px of the sheet
  float width = 0.F;
};
struct DrawnHouse {
  int kind = 0;
  glm::vec2 foot{0.F};  // centre of the footprint, px of the sheet
  float distance_m = 0.F;
  float reach_px = 0.F;  // from the foot to its farthest paint
  std::vector<HouseShade> shades;
  std::vector<HouseFace> faces;  // in painting order
};

// Statistics of the features of one kind and source.
struct DrawnCount {
  std::size_t features = 0;
  std::size_t outside_terrain = 0;  // wholly
  std::size_t outside_picture = 0;
  std::size_t hidden = 0;  // in the picture, but entirely hidden by ground
  std::size_t too_far = 0;
  std::size_t drawn = 0;
  double length_m = 0.0;  // of lines, horizontal
  double seen_m = 0.0;    // visible part of it
};

}  // namespace belvedere
