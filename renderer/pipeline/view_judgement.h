#pragma once

#include <string>
#include <vector>

#include "renderer/compose/view_score.h"
#include "renderer/world/view.h"
#include "terrain/io/dem.h"

namespace belvedere {

// The composition of any scene's picture, by the measures and the table by which views are proposed.
struct ViewJudgement {
  std::vector<ScoreTerm> terms;  // empty where it was not judged …
  std::string why_not;           // … and why
  double merit = 0.0;            // 0…10
  std::string subject;           // what the picture is about, in words
  double near_m = 0.0;           // where level ground meets the lower edge
  double far_m = 0.0;            // the horizon

  bool judged() const { return !terms.empty(); }
};

// On the ground as handles and summits rearrange it and with its valleys wider by `widen_valleys_m`, under the scene's own bend and
// exaggeration. Parallel projections are not judged: they have neither sky nor horizon.
ViewJudgement judge_view(const CoarseAltitudes& region, const View& view, double widen_valleys_m = 0.0);

}  // namespace belvedere
