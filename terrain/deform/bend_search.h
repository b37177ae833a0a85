#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"
#include "terrain/deform/deform.h"

namespace belvedere {

// A viewing direction and the vertical range of the picture: tangents of angles against the
// horizontal.
struct SightLine {
  double azimuth_deg = 0.0;  // clockwise from grid north
  double lowest = -1e9;
  double highest = 1e9;
};

// The land as seen from one point, for evaluating any bend. A bend depends only on the distance
// from the viewer, so visibility is decided along each azimuth independently: heights are sampled
// once along every line of sight at equal steps, and a bend is evaluated by one sweep outwards over
// each line that keeps the steepest angle so far. Each bend costs a few milliseconds.
class ValleySight {
 public:
  // altitude_m: the DEM, NaN outside. eye_m: height of the eye in the deformed world. Large grids
  // are reduced by averaging whole cells. Lines are evenly spaced in azimuth.
  ValleySight(const Grid<float>& altitude_m, const GeoTransform& transform,
              const Deformation& deformation, double eye_m, std::vector<SightLine> lines);

  // Share of the valley floors' area on the lines of sight (0…1, 0 if there is none) that is
  // visible within the picture if the unbent ground sinks by drop_m(distance).
  double visible_share(const BendProfile& bend) const;
  double floor_km2() const { return floor_m2_ * 1e-6; }
  // The distances from the nearest unbent ground within the picture's frame to the horizon: all but
  // a twentieth of the ground is nearer. Only floors beyond the former count.
  double nearest_m() const { return nearest_m_; }
  double farthest_m() const { return farthest_m_; }

 private:
  struct Sample {
    float height_m;  // unbent, exaggerated; NaN where there is no ground
    bool floor;
  };
  std::vector<SightLine> lines_;
  std::vector<double> curvature_drop_m_;  // by step: earth curvature, independent of the bend
  Grid<Sample> samples_;                  // a row a line, a column a step
  double eye_m_ = 0.0;
  double step_m_ = 1.0;
  double floor_m2_ = 0.0;  // area on the lines
  double nearest_m_ = 0.0;
  double farthest_m_ = 0.0;
};

// Effect of a bend on a level plain between two distances.
struct BendDistortion {
  double largest_deg = 0.0;           // amount of the inclination
  double mean_deg = 0.0;              // mean amount over the distance
  double bending_deg_per_10km = 0.0;  // the fastest change of inclination
};
BendDistortion measure_distortion(const BendProfile& bend, double from_m, double to_m);

struct BendSearchParameters {
  double max_inclination_deg = 20.0;      // 1…60: limit of the tilt
  double max_bending_deg_per_10km = 6.0;  // 0.1…60
  int points = 5;  // control points, evenly spaced from the nearest to the farthest ground, 3…8
};
struct BendFound {
  BendCurve curve;  // inclinations in tenths of a degree, never growing with distance; level at the
                    // horizon
  double visible_share = 0.0;
  BendDistortion distortion;
  int tried = 0;
};
// The curve that shows the largest area of valley floor within the bounds; among nearly equal
// curves the gentlest (a degree of mean inclination must gain a thousandth). A coarse lattice of
// curves is searched exhaustively, then the best ones are refined with steps down to a tenth of a
// degree. Deterministic. Throws Error(usage) for parameters out of range.
BendFound search_bend(const ValleySight& sight, const BendSearchParameters& parameters,
                      Progress& progress);

}  // namespace belvedere
