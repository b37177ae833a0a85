#pragma once

#include <string>
#include <vector>

#include "renderer/compose/coarse_ground.h"
#include "renderer/compose/view_candidates.h"
#include "terrain/deform/deform.h"

namespace belvedere {

// Changes that painters make to the land besides raising and bending all of it: wider valleys,
// summits raised individually. A view uses only those that clearly improve it, because readers of a
// map expect the land as it is.

// Grounds with wider valleys, shared by all views of a search.
struct WideGround {
  double width_m = 0.0;
  CoarseGround ground;
};
std::vector<WideGround> widen_grounds(const CoarseGround& ground);

// How the upper part of a summit is raised in a view.
SummitExaggeration raise_of(const Anchor& summit, const ViewShape& view, double factor);

// A refined candidate with those changes that clearly improve it: valleys of one width, and two
// summits at most; else itself. It is evaluated on the changed ground; viewer, bend and frame
// follow by the same layout.
Candidate with_changes(const ViewSearch& search, const std::vector<WideGround>& wide,
                       const Candidate& from);

// The unusual changes of a candidate, with their improvement: "valleys 450 m wider improve floor 19
// to 59 %"; empty if none.
std::string describe_changes(const ViewSearch& search, const Candidate& candidate);

// A coarse ground with the changes that a scene makes before it is raised as a whole and bent. The
// reference values of evaluation stay the region's: its side, relief, plateau and distances to the
// rim.

// The ground with valleys widened by this many metres (terrain/generalize/widen_valleys.h); lakes
// are unchanged.
CoarseGround widened_ground(const CoarseGround& ground, double width_m);

// The ground with its summits raised individually.
CoarseGround raised_ground(const CoarseGround& ground,
                           const std::vector<SummitExaggeration>& summits);

}  // namespace belvedere
