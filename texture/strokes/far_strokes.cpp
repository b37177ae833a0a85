#include "texture/strokes/far_strokes.h"

#include <cstddef>

#include "base/math.h"
#include "base/random.h"

namespace belvedere {
namespace {

constexpr float far_from_haze = 0.28F;
constexpr float far_to_haze = 0.62F;
constexpr float far_missing = 0.50F;  // share of strokes that are left out …
constexpr float far_broader = 0.60F;  // … and how much broader the others are

constexpr double broadest_units = 11.0;  // of the kinds in stroke_table.cpp
static_assert(0.54 * static_cast<double>(far_broader) * broadest_units <= far_reach_units);

float farness_of(const Stroke& stroke, const BasePicture& base) { return smoothstep(far_from_haze, far_to_haze, base.haze[stroke.source]); }

// All strokes of one tree have one seed: it stands or is missing as a whole.
bool is_missing(const Stroke& stroke, float far) {
  const auto lot = static_cast<float>(mix_bits(stroke.seed + 0x5eedULL) >> 40U) * 0x1.0p-24F;
  return lot < far_missing * far;
}

}  // namespace

std::vector<Stroke> broaden_far(std::vector<Stroke> strokes, const BasePicture& base) {
  std::size_t kept = 0;
  for (Stroke& stroke : strokes) {
    const float far = farness_of(stroke, base);
    if (far > 0.F) {
      if (is_missing(stroke, far)) continue;
      stroke.start_width *= 1.F + far_broader * far;
      stroke.end_width *= 1.F + far_broader * far;
    }
    strokes[kept++] = stroke;
  }
  strokes.resize(kept);
  return strokes;
}

}  // namespace belvedere
