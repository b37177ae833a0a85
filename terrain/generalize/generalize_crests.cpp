#include "terrain/generalize/generalize_crests.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "base/pyramid.h"
#include "terrain/generalize/generalize_band.h"

namespace belvedere {
namespace {

float unit(float v) { return std::clamp(v, 0.F, 1.F); }

// b2 + b3 + .6 b4 and b5 + b6 + … + base, the terms of GeneralizeParameters::crest, both at the
// finest level given; from level 1 one row of expand brings them to level 0.
struct CrestTerms {
  Grid<float> detail_m;
  Grid<float> ground_m;
};

CrestTerms find_crests(std::vector<Grid<float>> levels, int first) {  // the finest level given
  CrestTerms crests;
  const int top = std::min(static_cast<int>(levels.size()), crest_bands - first + 1) - 1;
  crests.ground_m = levels[static_cast<std::size_t>(top)];
  for (int i = top - 1; i >= 0; --i) {
    const Grid<float>& coarser = levels[static_cast<std::size_t>(i) + 1];
    const float weight = i + first == crest_bands - 1 ? 0.6F : 1.F;
    // The finest is not needed again and becomes the detail, row by row.
    Grid<float> detail = i == 0 ? std::move(levels[0]) : levels[static_cast<std::size_t>(i)];
    const int width = detail.width();
    Grid<float> ground(width, detail.height());
    parallel_rows(detail.height(), [&](int y) {
      std::vector<float> below(static_cast<std::size_t>(width));
      std::vector<float> smooth(static_cast<std::size_t>(width));
      expand_change_row(crests.detail_m, y, width, below.data());
      expand_row(coarser, y, width, smooth.data());
      for (int x = 0; x < width; ++x) detail(x, y) = below[x] + weight * (detail(x, y) - smooth[x]);
      expand_row(crests.ground_m, y, width, ground.row(y));
    });
    crests.detail_m = std::move(detail);
    crests.ground_m = std::move(ground);
  }
  return crests;
}

}  // namespace

void add_crests(Grid<float>& change, std::vector<Grid<float>> levels, int halved,
                const Grid<float>* share, const Grid<float>* mask, const Grid<float>* amplify,
                float strength) {
  const CrestTerms crests = find_crests(std::move(levels), std::max(halved, 1));
  const int width = change.width();
  parallel_rows(change.height(), [&](int y) {
    std::vector<float> detail(static_cast<std::size_t>(width));
    std::vector<float> ground(static_cast<std::size_t>(width));
    if (halved == 0) {
      expand_change_row(crests.detail_m, y, width, detail.data());
      expand_row(crests.ground_m, y, width, ground.data());
    } else {
      if (!crests.detail_m.empty()) std::copy_n(crests.detail_m.row(y), width, detail.begin());
      std::copy_n(crests.ground_m.row(y), width, ground.begin());
    }
    float* out = change.row(y);
    for (int x = 0; x < width; ++x) {
      const float high = unit((ground[x] - 1200.F) / 700.F);
      const float near = share == nullptr ? 1.F : unit((*share)(x, y));
      float added =
          strength * high * std::clamp(detail[x], 0.F, 60.F) * (1.F - 0.2F * (1.F - near));
      if (mask != nullptr) added *= unit((*mask)(x, y));
      if (amplify != nullptr) added *= unit((*amplify)(x, y));
      out[x] += added;
    }
  });
}

}  // namespace belvedere
