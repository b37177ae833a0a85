#include "renderer/exemplar/painted_edges.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "base/filter.h"
#include "base/parallel.h"
#include "renderer/image/srgb.h"

namespace belvedere {
namespace {

constexpr float jump_ratio = 1.1F;  // of distances across a silhouette
constexpr double along_px = 2.5;    // sigma: how much of a silhouette moves together
constexpr float min_edge = 0.02F;   // OKLab difference of neighbours in paint blurred by a pixel
constexpr float stands_out = 1.8F;  // the edge relative to the mean within the radius

bool is_jump(float a, float b) { return std::max(a, b) > jump_ratio * std::min(a, b); }

Grid<glm::vec3> soft_oklab(const Grid<glm::vec3>& painting) {
  Grid<glm::vec3> out(painting.width(), painting.height());
  for (int c = 0; c < 3; ++c) {
    Grid<float> one(out.width(), out.height());
    for (std::size_t i = 0; i < one.size(); ++i)
      one[i] = static_cast<float>(to_oklab(painting[i])[c]);
    one = gaussian_blur(one, 1.0);
    for (std::size_t i = 0; i < one.size(); ++i) out[i][c] = one[i];
  }
  return out;
}

// For each jump between a pixel and the next one along `step` how many pixels along `step` the edge
// lies away; 0 elsewhere.
Grid<int> edge_offsets(const Grid<float>& jump, const Grid<float>& edge,
                       const Grid<float>& radius_px, glm::ivec2 step) {
  const int most = static_cast<int>(*std::max_element(radius_px.begin(), radius_px.end()));
  const Grid<float> jumps_near = gaussian_blur(jump, along_px);
  Grid<int> offset(jump.width(), jump.height(), 0);
  Grid<float> best(jump.width(), jump.height(), 0.F), sum = best;
  // From near to far, so that of equal edges the nearest counts.
  for (int k = 0; k <= 2 * most; ++k) {
    const int d = k % 2 == 0 ? k / 2 : -(k + 1) / 2;
    Grid<float> moved(jump.width(), jump.height());
    parallel_rows(moved.height(), [&](int y) {
      for (int x = 0; x < moved.width(); ++x)
        moved(x, y) = jump(x, y) * edge.clamped(x + d * step.x, y + d * step.y);
    });
    moved = gaussian_blur(moved, along_px);
    parallel_rows(moved.height(), [&](int y) {
      for (int x = 0; x < moved.width(); ++x) {
        if (jump(x, y) <= 0.F || static_cast<float>(std::abs(d)) > radius_px(x, y)) continue;
        const float value = moved(x, y) / jumps_near(x, y);
        sum(x, y) += value;
        if (value <= best(x, y)) continue;
        best(x, y) = value;
        offset(x, y) = d;
      }
    });
  }
  for (std::size_t i = 0; i < offset.size(); ++i) {
    const float mean = sum[i] / (2.F * std::floor(radius_px[i]) + 1.F);
    if (best[i] < min_edge || best[i] < stands_out * mean) offset[i] = 0;
  }
  return offset;
}

Grid<float> snap_along(const Grid<float>& depth_m, const Grid<glm::vec3>& oklab,
                       const Grid<float>& radius_px, glm::ivec2 step) {
  Grid<float> jump(depth_m.width(), depth_m.height()), edge = jump, reach_px = jump;
  parallel_rows(jump.height(), [&](int y) {
    for (int x = 0; x < jump.width(); ++x) {
      const bool here = is_jump(depth_m(x, y), depth_m.clamped(x + step.x, y + step.y));
      jump(x, y) = here ? 1.F : 0.F;
      reach_px(x, y) = std::max(radius_px(x, y), radius_px.clamped(x + step.x, y + step.y));
      edge(x, y) = glm::distance(oklab(x, y), oklab.clamped(x + step.x, y + step.y));
    }
  });
  const Grid<int> offset = edge_offsets(jump, edge, reach_px, step);
  Grid<float> out = depth_m;
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      const int d = offset(x, y);
      // Towards the next pixel this side grows, else that one.
      const float grown = d > 0 ? depth_m(x, y) : depth_m.clamped(x + step.x, y + step.y);
      for (int k = std::min(d, 0) + 1; k <= std::max(d, 0); ++k) {
        const glm::ivec2 at = glm::ivec2(x, y) + k * step;
        if (at.x >= 0 && at.y >= 0 && at.x < out.width() && at.y < out.height())
          out(at.x, at.y) = grown;
      }
    }
  return out;
}

}  // namespace

Grid<float> snap_silhouettes(Grid<float> depth_m, const Grid<glm::vec3>& painting,
                             const Grid<float>& radius_px) {
  const Grid<glm::vec3> oklab = soft_oklab(painting);
  for (const glm::ivec2 step : {glm::ivec2(0, 1), glm::ivec2(1, 0)})
    depth_m = snap_along(depth_m, oklab, radius_px, step);
  return depth_m;
}

}  // namespace belvedere
