#pragma once

#include <vector>

#include "base/grid.h"
#include "terrain/generalize/generalize_rows.h"

namespace belvedere::test {

// Plan curvature, 1/m, of a whole grid by the rows that generalize() uses for break lines; border
// cells are 0.
inline Grid<float> curvature_by_rows(const Grid<float>& altitude_m, double cell_m, bool plan) {
  BreakLineScale scale;
  scale.plan = plan;
  scale.inverse_x = scale.inverse_y = static_cast<float>(1.0 / cell_m);
  Grid<float> out(altitude_m.width(), altitude_m.height());
  std::vector<float> row(static_cast<std::size_t>(altitude_m.width()) - 2);
  for (int y = 1; y + 1 < out.height(); ++y) {
    plan_curvature_row(altitude_m.row(y - 1) + 1, altitude_m.row(y) + 1, altitude_m.row(y + 1) + 1,
                       static_cast<int>(row.size()), scale, row.data());
    std::copy(row.begin(), row.end(), out.row(y) + 1);
  }
  return out;
}

}  // namespace belvedere::test
