#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

#include "base/grid.h"
#include "base/math_exact.h"
#include "base/parallel.h"

namespace belvedere {

// The horizon of every cell in one direction, in constant time per cell and from any distance.
// Lines run over the grid away from the sun, one from row to row (from column to column if the
// direction is nearer to north and south), with heights interpolated between two cells. Each line
// keeps the upper convex hull of the points passed so far: a point of the hull below the line of
// sight from here to the previous one can never be a horizon again. The horizon of a cell is
// interpolated between the two neighbouring lines. Earth curvature: z - t² / 2R is the height above
// one plane along a line, in which the local horizontal is tilted by t / R; R includes the common
// refraction of .13, 6371 km · 1.15.

inline constexpr double sight_radius_m = 6371000.0 * 1.15;
inline constexpr float no_horizon =
    -9.0F;  // tangent if nothing is in that direction: at the edge of the data

// The geometry of the lines on a grid of one size for one direction.
struct SweepPlan {
  bool along_rows = true;  // a line has one point in each column; else one in each row
  bool from_end =
      false;       // the first point of a line, nearest to the sun, is that with the largest index
  int length = 0;  // points of a line
  int across = 0;  // cells along the other side of the grid
  int first_line = 0;  // lines first_line … last_line are needed
  int last_line = 0;
  double step_m = 1.0;      // distance on the ground between two points
  std::vector<int> whole;   // a point lies at line + whole + part, across
  std::vector<float> part;  // 0…1
  std::vector<int> up;      // the first cell at or beyond a line's point lies at line + up …
  std::vector<float>
      back;  // … and takes this share of its horizon from that line, the rest from the next; 0…1
  std::vector<float> drop_m;  // t² / 2R
  std::vector<float> lean;    // t / R
};

// `towards`: viewing azimuth on the grid, clockwise from the top: east is its sine, north its
// cosine.
SweepPlan plan_sweep(int width, int height, glm::dvec2 cell_m, const exact::Turn& towards);

// Tangents of the horizon's elevation angle at the points of `count` lines from `first` on,
// [line][point]; NaN where the ground is void or beyond the grid. `tangents` is resized.
void sweep_lines(const Grid<float>& altitude_m, const SweepPlan& plan, int first, int count,
                 std::vector<float>& tangents);

// Calls see(x, y, tangent) for every cell of the grid, each once, from several threads.
template <class See>
void sweep_horizon(const Grid<float>& altitude_m, const SweepPlan& plan, See&& see) {
  constexpr int strip = 16;  // lines swept together: a strip fits in the processor's cache
  const int lines = plan.last_line - plan.first_line;
  parallel_ranges((lines + strip - 1) / strip, 1, [&](int begin, int end) {
    std::vector<float> tangents;
    for (int s = begin; s != end; ++s) {
      const int first = plan.first_line + s * strip;
      const auto count = static_cast<std::size_t>(std::min(strip, plan.last_line - first));
      const auto length = static_cast<std::size_t>(plan.length);
      sweep_lines(altitude_m, plan, first, static_cast<int>(count) + 1, tangents);
      // A cell between line j and the next lies at j + whole + part <= cell < j + 1 + whole + part.
      const auto visit = [&](std::size_t line, std::size_t point) {
        const int cell = first + static_cast<int>(line) + plan.up[point];
        if (cell < 0 || cell >= plan.across) return;
        const float* const here = tangents.data() + line * length + point;
        const float low = here[0];
        const float high = here[length];
        float tangent = high + (low - high) * plan.back[point];
        // If one of the lines has no horizon here, the other's is used.
        if (!(low > -8.0F && high > -8.0F))
          tangent = low > -8.0F ? low : high > -8.0F ? high : no_horizon;
        if (plan.along_rows)
          see(static_cast<int>(point), cell, tangent);
        else
          see(cell, static_cast<int>(point), tangent);
      };
      // In memory order of the cells.
      if (plan.along_rows) {
        for (std::size_t line = 0; line < count; ++line)
          for (std::size_t point = 0; point < length; ++point) visit(line, point);
      } else {
        for (std::size_t point = 0; point < length; ++point)
          for (std::size_t line = 0; line < count; ++line) visit(line, point);
      }
    }
  });
}

// The whole grid at once: tangents of the horizon towards an azimuth of the map, no_horizon at the
// edge on that side, NaN nowhere.
Grid<float> horizon_tangents(const Grid<float>& altitude_m, glm::dvec2 cell_m, double azimuth_deg);

}  // namespace belvedere
