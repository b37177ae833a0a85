#include "renderer/paint/water/water_surface.h"

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

#include "base/math.h"
#include "renderer/paint/water/river_water.h"

namespace belvedere {
namespace {

constexpr float deep_tone = 0.20F;   // of lakes in their ramp …
constexpr float deep_share = 0.85F;  // … and how far they take this tone
constexpr float deep_from_m = 7.0F;  // painted depth from which they are deep
constexpr glm::vec3 turquoise{0.47F, 0.76F, 0.74F};
constexpr float turquoise_share = 0.60F;
constexpr float rim_from_m = 0.8F;  // painted depths over which the rim ends
constexpr float rim_to_m = 8.5F;
constexpr glm::vec3 deep_lost{0.24F, 0.13F, 0.07F};  // share of light that deep water absorbs
// Streaks of light towards the far shore: noise from which they begin, and the share of white.
constexpr float streak_from = 0.5F;
constexpr float streak_white = 0.30F;

}  // namespace

WaterSurface water_surface(const WaterSources& water, WaterNoises& noises,
                           const WaterPixel& pixel) {
  const GuidanceBuffers& g = water.guidance;
  const Palette& palette = water.palette;
  const std::size_t i = pixel.index;
  const WaterGround::Place& ground = pixel.ground;
  WaterSurface out;
  out.depth_m = ground.depth_m;
  if (is_frozen(palette, g.altitude_m[i])) out.frozen = ground.lake;
  if (pixel.image != nullptr) {
    const float ruffled = noises.wind.ruffled(pixel.position_m, pixel.metres_per_unit,
                                              static_cast<float>(water.parameters.wind));
    out.look = water_look(g, palette, pixel.mirrored, i, pixel.share, pixel.streak, pixel.patches,
                          {*pixel.image, pixel.image_index, ruffled});
  } else {
    out.look = water_look(g, palette, pixel.mirrored, i, pixel.share, pixel.streak, pixel.patches);
    if (water.parameters.mirror == "none") out.look.image_share = 0.0F;
  }
  out.look =
      with_current(std::move(out.look), pixel.share, pixel.streak, pixel.patches, pixel.river);
  // The painted line along near banks replaces the unknown bed.
  if (water.tint != nullptr)
    out.bed = lake_bed(*water.tint, palette, g.altitude_m[i], pixel.position_m, g.footprint_m[i]);
  if (out.bed.depth_m > 0.F) {
    out.look.shallow_share = 0.F;
  } else if (water.parameters.beds) {
    out.bed = lake_bed(palette, ground, pixel.metres_per_unit);
    if (out.bed.depth_m > 0.F) {
      // A turquoise rim, as painted maps have it.
      const float rim = ground.lake * (1.0F - smoothstep(rim_from_m, rim_to_m, out.bed.depth_m));
      out.look.shallow =
          glm::mix(out.look.shallow, turquoise * (0.70F + 0.45F * unit(g.tone[i])), ground.lake);
      out.look.shallow_share =
          std::max(out.look.shallow_share * (1.0F - ground.lake), turquoise_share * rim);
    }
    // The darkness of open lakes depends on their depth, not on the light.
    const float deep = ground.lake * smoothstep(0.0F, deep_from_m,
                                                palette.winter ? ground.depth_m : out.bed.depth_m);
    out.look.tone_shift -= deep_share * deep * (g.tone[i] - deep_tone);
    if (!palette.winter && deep > 0.0F) {
      const float far = std::min(pixel.mirrored.to_far[i], 60.0F);
      const float near = std::min(pixel.mirrored.to_near[i], 60.0F);
      const float across = near / std::max(near + far, 1e-3F);  // 0 near shore … 1 far shore
      out.look.depth *= 1.0F - deep * (1.0F - 0.6F * smoothstep(0.4F, 1.0F, across)) * deep_lost;
      out.look.white_share = std::max(
          out.look.white_share, streak_white * deep * smoothstep(0.35F, 0.8F, across) *
                                    smoothstep(streak_from, streak_from + 1.0F, pixel.streak));
    }
  }
  return out;
}

glm::vec3 frozen_over(const glm::vec3& colour, const WaterSources& water, WaterNoises& noises,
                      const WaterPixel& pixel, const WaterSurface& surface, double light) {
  if (surface.frozen <= 0.0F) return colour;
  const double altitude = water.guidance.altitude_m[pixel.index];
  return glm::mix(colour,
                  noises.ice.colour(water.palette, altitude, light, pixel.position_m,
                                    surface.depth_m, pixel.metres_per_unit),
                  surface.frozen);
}

}  // namespace belvedere
