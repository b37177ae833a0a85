#include "texture/strokes/far_strokes.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/math.h"
#include "base/random.h"

namespace belvedere {
namespace {

constexpr float far_from_haze = 0.34F;
constexpr float far_to_haze = 0.66F;
constexpr float far_missing = 0.50F;  // share of strokes left out …
constexpr float far_broader = 0.60F;  // … and how much broader the others are

constexpr double broadest_units = 11.0;  // of the kinds in stroke_table.cpp
static_assert(0.54 * static_cast<double>(far_broader) * broadest_units <= far_reach_units);

float farness_of(const Stroke& stroke, const BasePicture& base) {
  return smoothstep(far_from_haze, far_to_haze, base.haze[stroke.source]);
}

// Strokes of one small area of the sheet share one random number.
bool is_missing(glm::ivec2 position_px, double pixels_per_unit, float far) {
  constexpr double cell_units = 2.0;
  const auto cell = [&](int px) {
    return static_cast<std::int64_t>(std::floor((px + 0.5) / (cell_units * pixels_per_unit)));
  };
  return random_uniform(0x5eedULL, cell(position_px.x), cell(position_px.y), 0) <
         static_cast<double>(far_missing * far);
}

}  // namespace

std::vector<Stroke> broaden_far(std::vector<Stroke> strokes, const BasePicture& base,
                                glm::ivec2 origin_px, double pixels_per_unit) {
  const int width = base.haze.width();
  std::size_t kept = 0;
  for (Stroke& stroke : strokes) {
    const float far = farness_of(stroke, base);
    if (far > 0.F) {
      const int source = static_cast<int>(stroke.source);
      if (is_missing(origin_px + glm::ivec2(source % width, source / width), pixels_per_unit, far))
        continue;
      stroke.start_width *= 1.F + far_broader * far;
      stroke.end_width *= 1.F + far_broader * far;
    }
    strokes[kept++] = stroke;
  }
  strokes.resize(kept);
  return strokes;
}

}  // namespace belvedere
