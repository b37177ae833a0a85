#pragma once

#include <string>
#include <vector>

#include "renderer/compose/view_candidates.h"

namespace belvedere {

struct ProposalParameters {
  int max = 6;  // 1…12
};

// The best views of a region that differ, best first: in their subject, or by 25° of azimuth and a
// quarter of the region's side in the viewer's position. Error(input), with what to do, for regions
// that are too small or mostly without data, and where no view fits the data or the request. Same
// result for any number of threads.
std::vector<Candidate> propose_views(const ViewSearch& search,
                                     const ProposalParameters& parameters = {});

// Errors for regions that are unsuitable for a picture, before any search. `name`: of the DEM, for
// messages.
void require_region(const CoarseGround& ground, const Massifs& massifs, const std::string& name);

}  // namespace belvedere
