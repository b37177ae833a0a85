#pragma once

#include <string>
#include <vector>

#include "renderer/compose/view_candidates.h"

namespace belvedere {

// What painters do to the land besides raising and bending all of it: wider valleys, summits raised by themselves. A view takes of it only
// what makes it clearly better, because whoever reads a map finds the land as it is.

// Grounds with wider valleys, the same for all views of a search.
struct WideGround {
  double width_m = 0.0;
  CoarseGround ground;
};
std::vector<WideGround> widen_grounds(const CoarseGround& ground);

// How the upper part of a summit is raised in a view.
SummitExaggeration raise_of(const Anchor& summit, const ViewShape& view, double factor);

// A refined candidate with what of this makes it clearly better: valleys of one width, and two summits at most; else itself. It is judged
// on the ground as it then is; viewer, bend and frame follow by the same layout.
Candidate with_changes(const ViewSearch& search, const std::vector<WideGround>& wide, const Candidate& from);

// What a candidate does beyond the usual, with what that wins: "valleys 450 m wider win floor 19 to 59 %"; empty where there is nothing.
std::string describe_changes(const ViewSearch& search, const Candidate& candidate);

}  // namespace belvedere
