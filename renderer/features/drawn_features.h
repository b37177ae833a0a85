#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "base/pixel_rect.h"
#include "renderer/features/feature_style.h"
#include "renderer/features/line_samples.h"
#include "renderer/trace/light_field.h"
#include "terrain/cover/map_cover.h"

namespace belvedere {

// Everything needed to paint lines and buildings in any rectangle of a sheet, made once for the
// sheet.
struct DrawnFeatures {
  FeatureStyle style;
  bool winter = false;
  double px_per_mm = 1.0;
  std::uint64_t seed = 1;
  glm::ivec2 sheet_px{0};
  std::vector<DrawnLine> lines;
  std::vector<DrawnHouse> houses;
  std::vector<std::vector<DrawnCount>> counts;  // by source and kind
  // Indices of the lines and houses that may touch each grid cell, row by row.
  std::vector<std::vector<std::uint32_t>> lines_in, houses_in;
  glm::ivec2 net{0};
  bool rivers = false;     // the sheet's ground has rivers as lines
  int house_reach_px = 0;  // max distance of any house's paint from its foot

  bool empty() const { return lines.empty() && houses.empty(); }
  // The features that may touch a rectangle of the sheet, each once, in order.
  std::vector<std::uint32_t> lines_at(PixelRect rect) const;
  std::vector<std::uint32_t> houses_at(PixelRect rect) const;
};

struct DrawnParameters {
  bool winter = false;
  double px_per_mm = 1.0;  // of the sheet
  std::uint64_t seed = 1;
  glm::dvec3 sun{0.0, 0.0, 1.0};                            // unit, towards the sun
  std::shared_ptr<const LightField> light_field = nullptr;  // light that varies with position
};

// Projects features onto the drawn ground: sampled finely enough for every facet and to a third of
// a pixel, with their widths there, split where ground hides them. Parts hidden only by a bump of
// less than a hair's width on the sheet count as visible, and gaps shorter than 1 mm not caused by
// a farther range are closed, so that lines along floors and ridges do not break into dashes. Kinds
// that change the ground (rivers, areas, towns) are not drawn here; of `rivers`, by their kinds of
// the style, only the banks are kept clear. Parallel; the same result for any number of threads.
DrawnFeatures draw_features(const FeatureSet& set, const GroundSight& sight,
                            const DrawnParameters& parameters,
                            std::span<const CoverRiver> rivers = {});

// In multiples of clear_mm, straight below a line in the picture: objects standing there would hide
// it.
inline constexpr double clear_below = 2.5;

// The features of a scene that has none.
const DrawnFeatures& no_features();

// Max distance of a kind's paint from its line in the foreground, px: casing, bed and softness
// included.
float reach_px(const FeatureKind& kind, const DrawnPoint& point, double px_per_mm);

}  // namespace belvedere
