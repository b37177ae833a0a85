#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "renderer/compose/coarse_ground.h"
#include "renderer/compose/massifs.h"
#include "renderer/compose/view_shape.h"

namespace belvedere {

// A view as measures see it: samples along level lines of sight. Bend and exaggeration do not
// change azimuths, so each column of a picture is one line over the ground; going outwards, what
// lies higher in the picture than all before it is visible.
struct SightModel {
  const PictureMap& picture;
  glm::dvec2 viewer{0.0};
  double eye_m = 0.0;
  double azimuth_deg = 0.0;
  double width = 1.0;                  // field of view, rad
  double height = 0.4;                 // of the picture, rad (of a cylinder: tangents)
  double near_m = 0.0, far_m = 0.0;    // lower edge and horizon
  std::vector<glm::dvec2> directions;  // (right, ahead), columns
  std::vector<double> distance_m;      // of the samples, growing
  std::vector<double> drop_m;          // of the bend, at each
  std::vector<double> exaggeration;    // at each
  double base_m = 0.0;                 // that exaggeration keeps
  double rim_fade_m = 0.0;
  double air_from_m = 0.0, air_scale_m = 1.0, haze = 0.0;
};

// Position and visibility of an anchor in the picture.
struct AnchorSight {
  bool inside = false;
  double seen =
      0.0;  // of a summit 1 or 0; of canyons and shores the visible share of their floor or water
  glm::dvec2 position{0.5};  // 0…1
  double size = 0.0;         // its height or depth, in picture heights
  double along = 0.0;        // |cosine| of the angle between the line of sight and the canyon
  double distance_m = 0.0;
};

// Heights from the top of the picture, in picture heights.
struct SkylineMeasures {
  double mean = 0.0;  // share of the picture above the skyline
  double low = 0.0;   // its low parts: 96 % of it are higher
  double median = 0.0;
  double summit = 0.0;     // its highest point
  double deviation = 0.0;  // standard deviation
  double hump = 0.0;  // 0…1: how much it is one hump that falls off to the sides, without peaks
};

struct ValleyFloorMeasures {
  double visible = 0.0;       // visible share of the valley floor in view
  double share = 0.0;         // of the picture
  double depth_spread = 0.0;  // 0…1: evenness over near and far
  double width_spread = 0.0;  // 0…1: evenness from left to right
};

struct LowerEdgeMeasures {
  double empty = 0.0;      // share without ground
  double cut = 0.0;        // share that cuts through mountains
  double angle_deg = 0.0;  // at its centre, between line of sight and bent ground
  double cell_px = 0.0;    // width of a cell of the data, on a picture 2400 wide
};

// Ground nearer to the end of the data than the fade.
struct RimMeasures {
  double share = 0.0;       // of the picture
  double near_share = 0.0;  // its part in the nearer half
};

struct ViewMeasures {
  SkylineMeasures skyline;
  ValleyFloorMeasures floor;
  LowerEdgeMeasures lower_edge;
  RimMeasures rim;
  double visible_ground = 0.0;  // visible share of the ground in view
  double water = 0.0;           // share of the picture
  double flat = 0.0;            // share of the picture that is low ground
  double ranges = 0.0;          // edges of one range in front of another, per column
  double forms =
      0.0;  // height of landforms above their valleys, in picture heights: root mean square
  double rise = 0.0;                 // height of the far ground above the near, in reliefs
  double area = 0.0;                 // ground in view, in areas of the region
  double haze = 0.0;                 // mean share of haze over the ground
  std::vector<AnchorSight> anchors;  // of the given massifs, in their order
};

// How much a skyline, as heights from the top of the picture at even steps across, is one hump,
// 0…1: its sides lie far down, and it deviates little from its best parabola, so that there are no
// peaks.
double hump_of(const std::vector<double>& skyline);

// Measures the first `count` anchors only.
ViewMeasures measure_view(const CoarseGround& ground, const SightModel& sight,
                          const std::vector<Anchor>& anchors);

// Sampling of a view that was laid out: columns × steps samples.
struct MeasureParameters {
  int columns = 150, steps = 260;
};
ViewMeasures measure_view(const CoarseGround& ground, const ViewShape& view,
                          const std::vector<Anchor>& anchors,
                          const MeasureParameters& parameters = {});

}  // namespace belvedere
