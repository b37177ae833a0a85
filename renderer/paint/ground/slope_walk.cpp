#include "renderer/paint/ground/slope_walk.h"

#include <cmath>
#include <glm/common.hpp>

#include "renderer/paint/picture_filter.h"

namespace belvedere {
namespace {

constexpr int halvings = 4;  // bisections of the step in which a class ends

// The sheet's pixel at an offset from another.
glm::ivec2 pixel_at(glm::ivec2 from_px, glm::vec2 offset) {
  return from_px + glm::ivec2(static_cast<int>(std::floor(offset.x + 0.5F)),
                              static_cast<int>(std::floor(offset.y + 0.5F)));
}

// Where a walk left its class within its last step, number `k` from `from` to `to`.
void find_end(SlopeWalk& walk, const WideView& wide, const SlopeStart& start, LandCoverClass over,
              int k, glm::vec2 from, glm::vec2 to) {
  const float depth_m = wide.seen.depth_m[walk.end];
  float inside = 0.0F;
  float outside = 1.0F;
  for (int n = 0; n < halvings; ++n) {
    const float centre = 0.5F * (inside + outside);
    const glm::ivec2 px = pixel_at(start.sheet_px, from + centre * (to - from));
    const std::size_t here = wide.index(px.x, px.y);
    const bool left =
        wide.seen.land_cover[here] != over && same_surface(depth_m, wide.seen.depth_m[here]);
    (left ? outside : inside) = centre;
    if (left) walk.end = here;
  }
  walk.left_after = static_cast<float>(k - 1) + outside;
  walk.end_px = from + outside * (to - from);
}

}  // namespace

SlopeWalk walk_slope(const WideView& wide, const Grid<float>& noise, const SlopeStart& start,
                     LandCoverClass over, const SlopeSteps& way) {
  const GuidanceBuffers& g = wide.seen;
  SlopeWalk result;
  glm::vec2 offset(0.0F);
  glm::vec2 direction(0.0F, way.sign);
  glm::vec2 fall = start.fall;
  float depth_m = start.depth_m;
  for (int k = 1; k <= way.steps; ++k) {
    if (fall.x != 0.0F || fall.y != 0.0F) direction = fall * way.sign;
    const glm::vec2 before = offset;
    offset += direction * way.step_px;
    const glm::ivec2 px = pixel_at(start.sheet_px, offset);
    if (!wide.holds(px.x, px.y)) break;
    const std::size_t here = wide.index(px.x, px.y);
    if (!same_surface(depth_m, g.depth_m[here])) break;
    depth_m = g.depth_m[here];
    fall = g.fall_line[here];
    if (k <= way.noise_steps) result.noise_sum += noise[here];
    if (g.land_cover[here] != over) {
      result.end = here;
      find_end(result, wide, start, over, k, before, offset);
      break;
    }
  }
  return result;
}

glm::vec3 place_left(const WideView& wide, const SlopeStart& start, const SlopeWalk& walk) {
  const GuidanceBuffers& g = wide.seen;
  // In wide pixels of the sheet, from the centre of the first.
  const auto factor = static_cast<float>(wide.factor);
  const glm::vec2 at = (glm::vec2(start.sheet_px) + walk.end_px + 0.5F) / factor - 0.5F;
  const glm::vec2 first = glm::floor(at);
  const glm::vec2 share = at - first;
  glm::vec3 sum(0.0F);
  float weights = 0.0F;
  for (int v = 0; v < 2; ++v)
    for (int u = 0; u < 2; ++u) {
      const glm::ivec2 px = (glm::ivec2(first) + glm::ivec2(u, v)) * wide.factor;
      const std::size_t here = wide.index(px.x, px.y);
      if (!same_surface(g.depth_m[walk.end], g.depth_m[here])) continue;
      const float weight =
          (u == 0 ? 1.0F - share.x : share.x) * (v == 0 ? 1.0F - share.y : share.y);
      sum += weight * g.position_m[here];
      weights += weight;
    }
  return weights > 0.0F ? sum / weights : g.position_m[walk.end];
}

}  // namespace belvedere
