#include "terrain/climate/horizon_sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.h"

namespace belvedere {

SweepPlan plan_sweep(int width, int height, glm::dvec2 cell_m, const exact::Turn& towards) {
  // Cells per metre, rows southwards.
  const double right = towards.sine / cell_m.x;
  const double down = -towards.cosine / cell_m.y;
  SweepPlan plan;
  plan.along_rows = std::abs(right) >= std::abs(down);
  plan.length = plan.along_rows ? width : height;
  plan.across = plan.along_rows ? height : width;
  const double major = plan.along_rows ? right : down;
  const double shear = (plan.along_rows ? down : right) / major;
  plan.from_end = major > 0.0;
  plan.step_m = 1.0 / std::abs(major);
  int min = 0;
  int max = 0;
  for (int i = 0; i < plan.length; ++i) {
    const double at = shear * i;
    const double whole = std::floor(at);
    const double t = plan.step_m * (plan.from_end ? plan.length - 1 - i : i);
    plan.whole.push_back(static_cast<int>(whole));
    plan.part.push_back(static_cast<float>(at - whole));
    // Rounding in float to a whole cell would select the wrong lines.
    if (plan.part.back() >= 1.0F) {
      plan.part.back() = 0.0F;
      ++plan.whole.back();
    }
    plan.drop_m.push_back(static_cast<float>(t * t / (2.0 * sight_radius_m)));
    plan.lean.push_back(static_cast<float>(t / sight_radius_m));
    // From the point back to the cell: a cell at line + up lies 1 - part behind the line's point
    // and part before the next line's.
    const bool between = plan.part.back() > 0.0F;
    const int up = plan.whole.back() + (between ? 1 : 0);
    plan.up.push_back(up);
    plan.back.push_back(between ? plan.part.back() : 1.0F);
    min = std::min(min, up);
    max = std::max(max, up);
  }
  plan.first_line = -max;
  plan.last_line = plan.across - min;
  return plan;
}

namespace {

// Heights above one plane along the lines, [line][point]; NaN beyond the grid. Up to half a cell
// outside uses the border.
void sample_lines(const Grid<float>& altitude_m, const SweepPlan& plan, int first, int count,
                  std::vector<float>& heights) {
  const auto length = static_cast<std::size_t>(plan.length);
  const auto width = static_cast<std::size_t>(altitude_m.width());
  const int last = plan.across - 1;
  constexpr float beyond = std::numeric_limits<float>::quiet_NaN();
  if (plan.along_rows) {
    for (int line = 0; line < count; ++line) {
      float* out = heights.data() + static_cast<std::size_t>(line) * length;
      for (std::size_t p = 0; p < length; ++p) {
        const int y = first + line + plan.whole[p];
        if (y < -1 || y > last) {
          out[p] = beyond;
          continue;
        }
        const float a = altitude_m[static_cast<std::size_t>(std::max(y, 0)) * width + p];
        const float b = altitude_m[static_cast<std::size_t>(std::min(y + 1, last)) * width + p];
        out[p] = a + (b - a) * plan.part[p] - plan.drop_m[p];
      }
    }
    return;
  }
  for (std::size_t p = 0; p < length; ++p) {
    const float* row = altitude_m.data() + p * width;
    const int start = first + plan.whole[p];
    const float part = plan.part[p];
    const float drop = plan.drop_m[p];
    for (int line = 0; line < count; ++line) {
      const int x = start + line;
      float& out = heights[static_cast<std::size_t>(line) * length + p];
      if (x < -1 || x > last) {
        out = beyond;
        continue;
      }
      const float a = row[std::max(x, 0)];
      const float b = row[std::min(x + 1, last)];
      out = a + (b - a) * part - drop;
    }
  }
}

// A point of the hull and the rise from it to the previous point of the hull, per step.
struct HullPoint {
  float position;
  float height_m;
  float rise_m;
};

}  // namespace

void sweep_lines(const Grid<float>& altitude_m, const SweepPlan& plan, int first, int count,
                 std::vector<float>& tangents) {
  const auto length = static_cast<std::size_t>(plan.length);
  tangents.resize(length * static_cast<std::size_t>(count));
  sample_lines(altitude_m, plan, first, count, tangents);
  std::vector<HullPoint> hull(length + 1);
  const auto per_step = static_cast<float>(1.0 / plan.step_m);
  for (int line = 0; line < count; ++line) {
    float* values = tangents.data() + static_cast<std::size_t>(line) * length;
    HullPoint* top = hull.data();  // one past the last point; nothing is read before hull[0]
    for (std::size_t k = 0; k < length; ++k) {
      const std::size_t p = plan.from_end ? length - 1 - k : k;
      const float height = values[p];
      if (std::isnan(height)) continue;
      const auto position = static_cast<float>(k);
      // From the second point on: the last point is hidden for good if the one before it is visible
      // over it.
      while (top - hull.data() >= 2 &&
             top[-1].height_m - height <= top[-1].rise_m * (position - top[-1].position))
        --top;
      float rise = 0.0F;
      if (top == hull.data()) {
        values[p] = no_horizon;
      } else {
        rise = (top[-1].height_m - height) / (position - top[-1].position);
        values[p] = rise * per_step - plan.lean[p];
      }
      *top++ = {position, height, rise};
    }
  }
}

Grid<float> horizon_tangents(const Grid<float>& altitude_m, glm::dvec2 cell_m, double azimuth_deg) {
  Grid<float> tangents(altitude_m.width(), altitude_m.height());
  const SweepPlan plan = plan_sweep(altitude_m.width(), altitude_m.height(), cell_m,
                                    exact::turn(to_radians(azimuth_deg)));
  sweep_horizon(altitude_m, plan, [&](int x, int y, float tangent) { tangents(x, y) = tangent; });
  return tangents;
}

}  // namespace belvedere
