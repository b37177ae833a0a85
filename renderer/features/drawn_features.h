#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "base/pixel_rect.h"
#include "renderer/features/drawn_parts.h"
#include "renderer/features/feature_set.h"
#include "renderer/features/ground_sight.h"
#include "renderer/trace/light_field.h"
#include "terrain/cover/map_cover.h"

namespace belvedere {

// Everything that lines and buildings need to be painted in any rectangle of a sheet, made once for it.
struct DrawnFeatures {
  FeatureStyle style;
  bool winter = false;
  double px_per_mm = 1.0;
  std::uint64_t seed = 1;
  glm::ivec2 sheet_px{0};
  std::vector<DrawnLine> lines;
  std::vector<DrawnHouse> houses;
  std::vector<std::vector<DrawnCount>> counts;  // by source and kind
  // Numbers of the lines and houses that may touch each cell of a net, row by row.
  std::vector<std::vector<std::uint32_t>> lines_in, houses_in;
  glm::ivec2 net{0};
  bool rivers = false;     // the sheet's ground has rivers as lines
  int house_reach_px = 0;  // the farthest paint of any house from its foot

  bool empty() const { return lines.empty() && houses.empty(); }
  // Those that may touch a rectangle of the sheet, each once, in their order.
  std::vector<std::uint32_t> lines_at(PixelRect rect) const;
  std::vector<std::uint32_t> houses_at(PixelRect rect) const;
};

struct DrawnParameters {
  bool winter = false;
  double px_per_mm = 1.0;  // of the sheet
  std::uint64_t seed = 1;
  glm::dvec3 sun{0.0, 0.0, 1.0};                            // unit, towards it
  std::shared_ptr<const LightField> light_field = nullptr;  // where light differs from place to place
};

// Lays features over the drawn ground: sampled finely enough for every facet and to a third of a pixel, with their widths there, parted
// where ground hides them. What only a bump hides that lifts less than a hair's width of the sheet is seen, and gaps shorter than a mm
// behind ground that is no farther range are closed, so that lines along floors and ridges do not break into dashes. Kinds that change the
// ground (rivers, areas, towns) are not drawn here; of `rivers`, by their kinds of the style, only the banks are kept clear. In parallel;
// the same for any threads.
DrawnFeatures draw_features(const FeatureSet& set, const GroundSight& sight, const DrawnParameters& parameters,
                            std::span<const CoverCourse> rivers = {});

// Of clear_mm, straight below a line in the picture: what stands there in front of it would hide it.
inline constexpr double clear_below = 2.5;

// What a scene without features has.
const DrawnFeatures& no_features();

// How far the paint of a kind reaches from its line in the foreground, px: casing, bed and softness included.
float reach_px(const FeatureKind& kind, const DrawnPoint& point, double px_per_mm);

}  // namespace belvedere
