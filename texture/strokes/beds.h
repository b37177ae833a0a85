#pragma once

#include "base/math_exact.h"

namespace belvedere {

inline constexpr float bed_thickness_m = 26.F * 6.2832F;  // from one riser to the next

// Bedding of rock: where in a bed a place lies, rad, one turn a bed, growing with altitude. Beds dip to the west and waver with n8 (noise
// of deviation 1 over some 200 m, of Stream::bed_wavering: light and strokes must tell the same beds).
inline float bed_phase(float altitude_m, float east_m, float n8) { return (altitude_m + 35.F * n8 + 0.06F * east_m) / 26.F; }

// Light on the bed, -.58 … 1.15: treads broad and light, risers dark.
inline float bed_light(float phase) {
  const exact::Turn turn = exact::turn(static_cast<double>(phase));
  const auto sine = static_cast<float>(turn.sine);
  return 0.8F * sine - 0.35F * (1.F - 2.F * sine * sine);
}

// 1 at the upper edge of a riser, where the tread above it begins, 0 from a twelfth of a bed away.
inline float bed_edge(float phase) {
  const float near = (static_cast<float>(exact::cos(static_cast<double>(phase) + 0.5)) - 0.87F) / 0.10F;
  return near < 0.F ? 0.F : near > 1.F ? 1.F : near;
}

// How plainly beds show, 0…1, by n25, noise of deviation 1 over some 700 m, of Stream::bed_strengths: in places a wall is one slab.
inline float bed_strength(float n25) { return n25 < -0.43F ? 0.F : n25 > 1.F ? 1.F : 0.3F + 0.7F * n25; }

}  // namespace belvedere
