#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "renderer/compose/coarse_ground.h"
#include "renderer/compose/massifs.h"
#include "renderer/compose/view_layout.h"
#include "renderer/compose/view_measures.h"
#include "renderer/compose/view_score.h"
#include "terrain/deform/deform.h"

namespace belvedere {

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

}  // namespace belvedere
