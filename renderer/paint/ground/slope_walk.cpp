#include "renderer/paint/ground/slope_walk.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "base/math.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/paint/picture_filter.h"
#include "renderer/paint/picture_noise.h"

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

namespace {

using Class = LandCoverClass;

constexpr double fan_step_units = 2.0;
constexpr int steps = 26;        // in each direction: longer fans are broad fields of stone
constexpr int streak_steps = 9;  // in each direction
constexpr double streak_sigma_units = 1.7;
// Deviation of the sum of 19 samples 2 units apart of that noise: neighbours share exp(-1/4 (2
// / 1.7)²) = .71, the next .25, then .04.
constexpr float streak_deviation = 7.4F;

constexpr glm::vec3 fresh_hue{0.91F, 0.95F, 1.05F};
constexpr glm::vec3 pale_hue{1.035F, 1.01F, 0.965F};

}  // namespace

ScreeFans make_scree_fans(const GuidanceBuffers& g, const WideView& wide,
                          const ScreeFanParameters& parameters, glm::ivec2 origin_px,
                          PixelRect wanted) {
  require_channels(
      g, {&GuidanceBuffers::depth_m, &GuidanceBuffers::land_cover, &GuidanceBuffers::fall_line},
      "scree");
  if (wanted.empty()) wanted = {0, 0, g.width(), g.height()};
  ScreeFans fans{Grid<float>(g.width(), g.height(), 0.0F),
                 Grid<float>(g.width(), g.height(), 0.0F)};
  bool any = false;
  for (int y = wanted.y0; y < wanted.y1 && !any; ++y)
    any = std::find(g.land_cover.row(y) + wanted.x0, g.land_cover.row(y) + wanted.x1,
                    Class::scree) != g.land_cover.row(y) + wanted.x1;
  if (!any) return fans;
  const double ppu = parameters.pixels_per_unit;
  const Grid<float> noise = make_image_noise(
      stream_seed(parameters.seed, Stream::forest_lanes, 1), wide.origin_px, wide.seen.width(),
      wide.seen.height(), ppu / wide.factor, streak_sigma_units, streak_sigma_units);
  const auto step_px = static_cast<float>(fan_step_units * ppu);
  parallel_rows(wanted.height(), [&](int row) {
    const int y = wanted.y0 + row;
    for (int x = wanted.x0; x < wanted.x1; ++x) {
      const std::size_t i = g.depth_m.index(x, y);
      if (g.land_cover[i] != Class::scree) continue;
      const SlopeStart start{origin_px + glm::ivec2(x, y), g.fall_line[i], g.depth_m[i]};
      const SlopeWalk up =
          walk_slope(wide, noise, start, Class::scree, {step_px, -1.0F, steps, streak_steps});
      const SlopeWalk down =
          walk_slope(wide, noise, start, Class::scree, {step_px, 1.0F, steps, streak_steps});
      const float above = up.left_after > 0.0F ? up.left_after : static_cast<float>(steps + 1);
      const float below = down.left_after > 0.0F ? down.left_after : static_cast<float>(steps + 1);
      fans.position[i] = above / (above + below);
      fans.streak[i] =
          (noise[wide.index(start.sheet_px.x, start.sheet_px.y)] + up.noise_sum + down.noise_sum) /
          streak_deviation;
    }
  });
  return fans;
}

int scree_fans_margin_px(double pixels_per_unit) {
  return static_cast<int>(std::ceil(steps * fan_step_units * pixels_per_unit)) + steps;
}

ScreeTurn scree_turn(float position, float streak, float relief_s_m, float strength) {
  const float run = std::clamp(streak, -1.8F, 1.8F);
  const float down = std::clamp(position + 0.10F * run, 0.0F, 1.0F);
  ScreeTurn turn;
  turn.tone = strength * (0.10F * (down - 0.5F) + 0.045F * run +
                          0.05F * std::clamp(relief_s_m / 9.0F, -1.0F, 1.0F));
  const float fresh = 1.0F - smoothstep(0.10F, 0.55F, down);
  const float pale = smoothstep(0.30F, 0.60F, down);
  turn.factor = 1.0F + strength * (fresh * (fresh_hue - 1.0F) + pale * (pale_hue - 1.0F));
  turn.grown = std::min(0.75F * strength, 0.75F) * smoothstep(0.66F, 1.0F, position - 0.16F * run);
  return turn;
}

glm::vec3 near_scree_hue(bool in_cone, float close) {
  constexpr glm::vec3 in_cones{1.035F, 1.02F, 1.0F};
  constexpr glm::vec3 between{0.945F, 0.965F, 0.945F};
  return 1.0F + close * ((in_cone ? in_cones : between) - 1.0F);
}

}  // namespace belvedere
