#pragma once

#include <tuple>
#include <utility>
#include <vector>

#include "base/guidance_channels.h"

// What the declarations of stages (stages.h) share.
namespace belvedere {

// Measured, per pixel of a window while strokes are laid on it.
inline constexpr double stroke_work_bytes = 67.0;

// The inputs of a stage, in the order of its function's arguments.
template <class... Inputs>
std::tuple<Inputs...> inputs(Inputs... input) {
  return {std::move(input)...};
}

// Guidance channels that strokes read.
inline std::vector<GuidanceMember> stroke_channels() {
  using B = GuidanceBuffers;
  return {&B::depth_m,   &B::position_m,  &B::land_cover, &B::fall_line,
          &B::slope_deg, &B::footprint_m, &B::relief_s_m, &B::built,
          &B::grain,     &B::rock_facet,  &B::tone};
}

}  // namespace belvedere
