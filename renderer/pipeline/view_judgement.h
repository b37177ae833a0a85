#pragma once

#include <string>
#include <vector>

#include "renderer/compose/view_score.h"
#include "renderer/world/view.h"
#include "terrain/io/dem.h"

namespace belvedere {

// Evaluates the composition of any scene's picture, by the measures and the table that views are
// proposed by.
struct ViewEvaluation {
  std::vector<ScoreTerm> terms;  // empty if not evaluated …
  std::string why_not;           // … and why
  double merit = 0.0;            // 0…10
  std::string subject;           // description of the main subject
  double near_m = 0.0;           // where level ground meets the lower edge
  double far_m = 0.0;            // the horizon

  bool evaluated() const { return !terms.empty(); }
};

// On the ground as changed by handles, summits and valleys wider by `widen_valleys_m`, under the
// scene's own bend and exaggeration. Parallel projections are not evaluated: they have neither sky
// nor horizon.
ViewEvaluation evaluate_view(const CoarseAltitudes& region, const View& view,
                             double widen_valleys_m = 0.0);

}  // namespace belvedere
