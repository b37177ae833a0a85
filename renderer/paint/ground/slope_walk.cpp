#include "renderer/paint/ground/slope_walk.h"

#include <cmath>

#include "renderer/paint/picture_filter.h"

namespace belvedere {

SlopeWalk walk_slope(const WideView& wide, const Grid<float>& noise, const SlopeStart& start, LandCoverClass over, const SlopeSteps& way) {
  const GuidanceBuffers& g = wide.seen;
  SlopeWalk result;
  glm::vec2 offset(0.0F);
  glm::vec2 direction(0.0F, way.sign);
  glm::vec2 fall = start.fall;
  float depth_m = start.depth_m;
  for (int k = 1; k <= way.steps; ++k) {
    if (fall.x != 0.0F || fall.y != 0.0F) direction = fall * way.sign;
    offset += direction * way.step_px;
    const int nx = start.sheet_px.x + static_cast<int>(std::floor(offset.x + 0.5F));
    const int ny = start.sheet_px.y + static_cast<int>(std::floor(offset.y + 0.5F));
    if (!wide.holds(nx, ny)) break;
    const std::size_t here = wide.index(nx, ny);
    if (!same_surface(depth_m, g.depth_m[here])) break;
    depth_m = g.depth_m[here];
    fall = g.fall_line[here];
    if (k <= way.noise_steps) result.noise_sum += noise[here];
    if (g.land_cover[here] != over) {
      result.left_after = k;
      result.end = here;
      break;
    }
  }
  return result;
}

}  // namespace belvedere
