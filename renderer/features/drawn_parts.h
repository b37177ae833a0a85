#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace belvedere {

// A place of a drawn line; pixels of the sheet.
struct DrawnPoint {
  glm::vec2 place{0.F};
  float distance_m = 0.F;
  float half_px = 0.F;   // half of the fill's width
  float share = 1.F;     // of the lengths that the style has for the foreground
  float along_mm = 0.F;  // from the line's start, in lengths of the foreground: dashes shrink with the line
};

enum class LinePart : std::uint8_t {
  way,    // on the ground
  rope,   // in the air
  pylon,  // upright below a rope
  station,
  lane  // no paint: ground that a rope above it or a river needs free of trees
};

// A piece of a line that the picture shows, without what ground hides.
struct DrawnLine {
  int kind = 0;
  LinePart part = LinePart::way;
  std::vector<DrawnPoint> points;  // 2 or more
};

// A side of a house or its roof: its lower edge from left to right, then its upper one from right to left, px of the sheet.
struct HouseFace {
  std::array<glm::vec2, 4> corners{};
  float light = 1.F;  // 0 turned away from the sun … 1 towards it
  bool roof = false;
};
// The shadow of a house, or of one of its wings, on the ground.
struct HouseShade {
  glm::vec2 from{0.F}, to{0.F};  // px of the sheet
  float width = 0.F;
};
struct DrawnHouse {
  int kind = 0;
  glm::vec2 foot{0.F};  // middle of the footprint, px of the sheet
  float distance_m = 0.F;
  float reach_px = 0.F;  // from the foot to its farthest paint
  std::vector<HouseShade> shades;
  std::vector<HouseFace> faces;  // in the order of painting
};

// What became of the features of one kind and source.
struct DrawnCount {
  std::size_t features = 0;
  std::size_t outside_terrain = 0;  // wholly
  std::size_t outside_picture = 0;
  std::size_t hidden = 0;  // in the picture, and ground stands before all of it
  std::size_t too_far = 0;
  std::size_t drawn = 0;
  double length_m = 0.0;  // of lines, on the level
  double seen_m = 0.0;    // of that
};

}  // namespace belvedere
