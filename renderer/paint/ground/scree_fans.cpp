#include "renderer/paint/ground/scree_fans.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "base/guidance_channels.h"
#include "base/math.h"
#include "base/parallel.h"
#include "base/random_streams.h"
#include "renderer/paint/ground/slope_walk.h"
#include "renderer/paint/picture_noise.h"

namespace belvedere {
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
