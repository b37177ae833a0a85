#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "renderer/register/registered_ground.h"

namespace belvedere {

// A line along which the ground ends before the sky (a part of the skyline) or before ground
// farther away (a ridge), from left to right.
struct SeenLine {
  bool skyline = false;
  std::vector<glm::vec2>
      points;  // px of the ground's grid, (0, 0) its outer corner at the top left
};

struct SeenLinesParameters {
  float min_jump = 1.06F;  // of distance across a ridge, as a ratio, > 1
  int max_step_px = 5;     // a line rises or falls by at most this from column to column
  int min_length_px = 8;   // columns; shorter ones are left out
};

// Skyline and ridges of the ground, linked from column to column: each end of a line goes on at the
// nearest jump of its kind.
std::vector<SeenLine> seen_lines(const RegisteredGround& ground,
                                 const SeenLinesParameters& parameters = {});

}  // namespace belvedere
