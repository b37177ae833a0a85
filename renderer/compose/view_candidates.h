#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/compose/coarse_ground.h"
#include "renderer/compose/massifs.h"
#include "renderer/compose/view_measures.h"
#include "renderer/compose/view_score.h"
#include "renderer/compose/view_shape.h"
#include "renderer/trace/camera.h"
#include "terrain/deform/deform.h"

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

// The user's request for the view.
struct ViewRequest {
  ViewFormat format = {};
  std::optional<double> towards_deg = {};  // azimuth of the view, ±15°
  std::optional<glm::dvec2> from = {};     // position of the viewer, scene CRS
  struct Place {
    std::string name;
    glm::dvec2 position{0.0};  // scene CRS
  };
  std::vector<Place> include = {};  // must be in the picture
  bool plain = false;               // no valley widened, no summit raised individually
};

// The parameters of a search for a view; all else is derived.
struct ViewPlan {
  int anchor = 0;  // that the picture is about
  double azimuth_deg = 0.0;
  double field_of_view_deg = 44.0;
  double far_m = 0.0;
  double near_share = 0.42;  // of far
  double crest_share = 0.80;
  double anchor_share = 0.76;  // distance of the anchor
  double across = 0.5;         // position of the anchor in the picture
};

// The improvement of a view by a change beyond the usual ones.
struct ViewGain {
  double merit = 0.0;
  std::string words;  // the improvement, "ground 47 to 55 %"; empty: the change is not used
};

// A summit that is raised more than the rest.
struct RaisedSummit {
  int anchor = 0;
  SummitExaggeration by;
  ViewGain gain;
};

// Changes to the ground of a view besides raising and bending it (view_changes.h).
struct ViewChanges {
  double widen_valleys_m = 0.0;
  ViewGain widened;
  std::vector<RaisedSummit> summits;
};

// A view that was laid out and evaluated.
struct Candidate {
  ViewPlan plan;
  ViewShape view;
  ViewMeasures measures;  // of the massifs' anchors, then of the places to include
  std::vector<ScoreTerm> terms;
  double score = 0.0;
  double merit = 0.0;  // 0…10
  ViewChanges changes;
};

// The ground, its subjects, and the request: of one search.
struct ViewSearch {
  const CoarseGround& ground;
  const Massifs& massifs;
  ViewRequest request;
};

// The view of a plan, without its layout.
ViewShape shape_of(const ViewSearch& search, const ViewPlan& plan);
// Laid out and evaluated; nothing where the data do not fill it.
std::optional<Candidate> judge(const ViewSearch& search, const ViewPlan& plan,
                               const MeasureParameters& measure = {});
// All first candidates: anchors × azimuths × distances × positions across × sizes. In a fixed
// order.
std::vector<Candidate> first_candidates(const ViewSearch& search);
// Steps from a candidate while they improve it, halved a few times.
Candidate refine(const ViewSearch& search, Candidate from);
// Only short steps, from a candidate whose ground has changed a little.
Candidate resolve(const ViewSearch& search, Candidate from);

// A camera's own picture, in any projection.
class CameraPicture final : public PictureMap {
 public:
  explicit CameraPicture(const CameraParameters& parameters);
  glm::dvec2 position(glm::dvec2 direction, double depression) const override;

 private:
  std::unique_ptr<Camera> camera_;
  double azimuth_deg_;
};

// The directions that a camera looks in, (right, ahead), one per column.
std::vector<glm::dvec2> camera_directions(const CameraParameters& camera, int columns);

// From where level ground meets the lower edge of a picture to its horizon, where level ground is
// highest in it. Level ground is at the altitude that two fifths of the ground in view lie below,
// raised and bent as in the view.
struct ViewReach {
  double near_m = 0.0;
  double far_m = 0.0;  // 0: no data lie in the direction of the view
};
ViewReach find_reach(const CoarseGround& ground, const Deformation& deformation,
                     const CameraParameters& camera);

}  // namespace belvedere
