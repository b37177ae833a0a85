#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "renderer/compose/coarse_ground.h"
#include "renderer/compose/view_shape.h"

namespace belvedere {

// A view is laid out, not searched: sky, lower edge and horizon are constraints, and height of the
// eye, tilt and bend follow from them.
//   eye = base + level + (F² - c²) / (2 R): the line of sight touches bent level ground exactly at
//   F, so that F is the horizon. R = (F² - c² + (near - c)²) / (2 near tan(lower edge)): level
//   ground at `near` is on the lower edge. The upper edge is a share of the height above most
//   of the skyline, and above the highest summit by a margin. F is far_m, c crest_m, R radius_m.
//   The skyline depends on R, so the three are found together as a fixed point.

// Values of a view that are given; the rest follows from them in the same way.
//   Eye given: R = (F² - c²) / (2 (eye - base - level)), so that F is the horizon as well; the
//   position of the lower edge follows.
struct LayoutGiven {
  std::optional<double> exaggeration;
  std::optional<double>
      base_m;  // without it the altitude that a tenth of the ground in view lies below
  std::function<double(const ViewShape&)>
      eye_m;  // once exaggeration and base are known; empty: found
  std::function<double(const ViewShape&)> pitch_deg;  // once the eye is known, too; empty: found
  std::function<double(double)>
      drop_m;  // drop of a given bend, by distance; empty: a parabola is found
};

struct LayoutParameters {
  double sky = 0.12;                   // share of the picture above most of the skyline, 0…0.5
  double max_share_of_skyline = 0.35;  // share of the skyline that may rise above that
  double over_summit =
      0.09;  // share of the picture above the highest summit; for a lone mountain a little less
  int columns = 60, steps = 140, rounds = 7;
};

// The ground that a view shows, near to far: wider at the near end, as in a tilted picture. Rows of
// equal distance.
struct WedgePoint {
  glm::dvec2 position;
  double depth = 0.0;  // 0 near … 1 far
};
std::vector<WedgePoint> wedge_points(const ViewShape& view);

// Whether the data fill the wedge: 99 % of its nearer 60 % lie off the rim, and 93 % of all are
// data.
bool fits_data(const CoarseGround& ground, const ViewShape& view);

// Viewer, azimuth, field, near, far and crest are input; the rest is output. Nothing where the
// wedge holds too little ground.
std::optional<ViewShape> lay_out(const CoarseGround& ground, ViewShape view, double lone,
                                 const LayoutParameters& parameters = {},
                                 const LayoutGiven& given = {});

}  // namespace belvedere
