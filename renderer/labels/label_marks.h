#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "renderer/labels/label_points.h"
#include "renderer/trace/geo_map.h"

namespace belvedere {

enum class MarkState : int { seen, hidden, outside_picture, behind_eye, outside_terrain };
std::string_view name_of(MarkState state);  // "seen", "hidden behind ground" …

// Position of a point in the picture.
struct LabelMark {
  glm::dvec2 drawn_position{
      0.0};  // scene CRS: of a summit its top as drawn; else the point's position
  double dem_altitude_m = 0.0;  // of the undeformed, ungeneralized DEM there; NaN outside it
  // x right, y down, (0, 0) the outer corner; for visible and hidden points and those outside the
  // picture. For a visible summit the upper edge as drawn: seen from high above, ground just behind
  // the top may be drawn above it.
  glm::dvec2 pixel{0.0};
  double distance_m = 0.0;  // from the eye
  MarkState state = MarkState::outside_terrain;
  std::optional<GeoPosition> in_front;  // the ground that hides it
  bool on_skyline = false;              // only sky is above it
  double width_px = 0.0;                // of a seen area: how wide it is at the mark's row
};

// Input for marks: the generalized ground, whose tops are drawn, with the map to the picture. All
// must outlive it.
struct LocatedGround {
  const Grid<float>& altitude_m;     // of the DEM
  const Grid<float>& generalized_m;  // as drawn, before it is bent
  GeoTransform transform;
  double cell_m = 1.0;
  const GeoMap& map;
};

// The top of the drawn ground that is reached from a position on it (GeoMap::drawn_position) by
// going up, always to the highest cell of those within three columns and rows; of level ones the
// first. The position itself where the top is farther away than max_m; nothing where it lies
// outside the terrain.
std::optional<glm::dvec2> climb(const LocatedGround& ground, glm::dvec2 position, double max_m);

// The mark of each point, in parallel; the same for any number of threads.
std::vector<LabelMark> find_marks(const LocatedGround& ground, const std::vector<LabelPoint>& points,
                                  const LabelStyle& style);

}  // namespace belvedere
