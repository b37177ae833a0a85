#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "base/pixel_rect.h"
#include "renderer/rock/spurs.h"

namespace belvedere {

// Cones of debris below rock walls that elevation data do not contain. Each starts at the mouth of
// a gully, where funnels and fall lines of the wall converge, and spreads down to where the slope
// ends. Channels branch at its head and end in fresh deposits.
struct DebrisChannel {
  float at = 0.0F;    // where it runs to, in half widths of the cone: -1…1
  float from = 0.0F;  // where it leaves the others, in lengths of the cone
  float to = 1.0F;    // where it ends
};
inline constexpr int max_debris_channels = 5;
struct DebrisCone {
  glm::vec2 apex{0.0F};  // units of the sheet
  glm::vec2 down{0.0F, 1.0F};
  float length = 1.0F;  // units
  float bow = 0.0F;     // of its axis to the right of `down`, units at half its length
  float spread = 0.3F;  // half its width at the foot, in lengths
  float top = 0.0F;     // the higher of two lies over the other
  float depth_m = 0.0F, tolerance_m = 0.0F;
  std::uint32_t id = 0;
  std::array<DebrisChannel, max_debris_channels> channels{};
  int channel_count = 0;
};
struct DebrisCones {
  std::vector<DebrisCone> cones;
  glm::ivec2 first{0};  // of the cells by which they are found …
  glm::ivec2 count{0};
  std::vector<std::vector<std::uint32_t>> cells;  // … and the cones that touch each
};

// The cones that touch a rectangle of the sheet (px); the same for any rectangle. Reads the wide
// view within debris_cones_reach_units of it. `amount`: RockKind::cones; rock that breaks into
// little debris has fewer and shorter ones.
DebrisCones grow_debris_cones(const SpurGround& ground, PixelRect sheet_rect, float amount = 1.0F);
float debris_cones_reach_units();

// The cone at a position, units of the sheet.
struct DebrisHit {
  const DebrisCone* cone = nullptr;  // null: none
  float along = 0.0F;                // 0 apex … 1 foot
  float across = 0.0F;               // -1…1 between its sides
  float half_width = 1.0F;           // units
  float inside = 0.0F;               // 0 at its border … 1
  float beside = 0.0F;               // outside, 1 at a border … 0
  float over_next = 1.0F;            // height above the next cone, in half widths: 0 in the notch
  float overgrown = 0.0F;            // about 0 at its head … 1 at its foot
  glm::vec2 slope{0.0F};             // gradient of its height on the sheet, with its channels
  float tone = 0.0F;  // what its stone is lighter than other debris: fresh streaks, blocks
};
DebrisHit debris_at(const DebrisCones& cones, std::uint64_t seed, glm::vec2 position,
                    float depth_m);
// Whether debris covers what grows there.
bool debris_covers(const DebrisHit& hit);

}  // namespace belvedere
