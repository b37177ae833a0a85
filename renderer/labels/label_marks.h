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

// Where a point is in the picture.
struct LabelMark {
  glm::dvec2 drawn_place{0.0};  // scene CRS: of a summit its top as it is drawn; else the point's place
  double dem_altitude_m = 0.0;  // of the undeformed, ungeneralized DEM there; NaN outside of it
  // x right, y down, (0, 0) the outer corner; of what is seen, hidden or outside the picture. Of a summit that is seen the upper edge as it
  // is drawn: from high above, ground just behind the top may stand over it.
  glm::dvec2 pixel{0.0};
  double distance_m = 0.0;  // from the eye
  MarkState state = MarkState::outside_terrain;
  std::optional<GeoPlace> in_front;  // the ground that hides it
  bool on_skyline = false;           // nothing but sky stands over it
};

// What marks are found on: the generalized ground, whose tops are drawn, with the map to the picture. All must outlive it.
struct DrawnGround {
  const Grid<float>& altitude_m;     // of the DEM
  const Grid<float>& generalized_m;  // what is drawn, before it is bent
  GeoTransform transform;
  double cell_m = 1.0;
  const GeoMap& map;
};

// The top of the drawn ground that one comes to from a place on it (GeoMap::drawn_place) by going up, always to the highest cell of those
// within three columns and rows; of level ones the first. The place itself where the top lies farther off than most_m; nothing where it
// lies outside of the terrain.
std::optional<glm::dvec2> climb(const DrawnGround& ground, glm::dvec2 place, double most_m);

// The mark of each point, in parallel; the same for any number of threads.
std::vector<LabelMark> find_marks(const DrawnGround& ground, const std::vector<LabelPoint>& points, const LabelStyle& style);

}  // namespace belvedere
