#include "renderer/paint/water/water_surface.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "base/colour/water_colour.h"
#include "base/math.h"
#include "base/random.h"
#include "renderer/image/srgb.h"

namespace belvedere {
namespace {

constexpr glm::vec3 white{0.95F, 0.975F, 0.97F};  // of broken water

}  // namespace

glm::vec3 WaterLook::over(glm::vec3 colour) const {
  const glm::vec3 open =
      depth * glm::mix(glm::mix(colour, image, image_share), shallow, shallow_share);
  return glm::mix(glm::mix(open, white, white_share), bank, bank_share);
}

namespace {

// 0 open water … 1 a brook.
float thinness(float around) { return unit((0.52F - around) / 0.3F); }

// The look of water without reflections, shared by both kinds of them: banks of brooks, streaks,
// shallows.
WaterLook plain_look(const GuidanceBuffers& g, const Palette& palette, const Mirrored& mirrored,
                     std::size_t i, float around, float streak, const Patches& p) {
  WaterLook look;
  const float thin = thinness(around);
  look.bank =
      palette_colour(palette, palette.winter ? LandCoverClass::snow : LandCoverClass::valley_floor,
                     g.altitude_m[i], g.tone[i]);
  look.bank_share = thin * std::clamp(0.12F + 0.40F * p.n25 + 0.2F * p.n8, 0.0F, 0.8F);
  // Paler towards the horizon, deep below the viewer; shallows at the near bank and a dark line
  // under the far one.
  const float far = std::min(mirrored.to_far[i], 60.0F);
  const float near = std::min(mirrored.to_near[i], 60.0F);
  look.tone_shift = (0.09F * streak + 0.26F * (near / (near + far) - 0.5F)) * (1.0F - thin);
  look.tone_shift -= 0.30F * unit(1.7F - far) * (1.0F - thin);
  look.shallow_share = 0.38F * unit(2.1F - near) * (1.0F - thin);
  look.shallow = palette.winter ? glm::vec3(0.86F, 0.90F, 0.94F) : glm::vec3(0.78F, 0.83F, 0.74F);
  return look;
}

}  // namespace

WaterLook water_look(const GuidanceBuffers& g, const Palette& palette, const Mirrored& mirrored,
                     std::size_t i, float around, float streak, const Patches& p) {
  WaterLook look = plain_look(g, palette, mirrored, i, around, streak, p);
  const float thin = thinness(around);
  if (mirrored.source[i] < 0) return look;
  const auto from = static_cast<std::size_t>(mirrored.source[i]);
  // A reflection is darker and bluer than its source.
  const glm::vec3 image = palette_colour(palette, g.land_cover[from], g.altitude_m[from],
                                         0.75 * static_cast<double>(g.tone[from]));
  look.image = image * glm::vec3(0.80F, 0.90F, 0.98F);
  look.image_share =
      std::clamp((0.85F + 0.12F * streak) * mirrored.share[i], 0.0F, 0.9F) * (1.0F - thin);
  return look;
}

WaterLook water_look(const GuidanceBuffers& g, const Palette& palette, const Mirrored& mirrored,
                     std::size_t i, float around, float streak, const Patches& p,
                     const TracedImage& traced) {
  WaterLook look = plain_look(g, palette, mirrored, i, around, streak, p);
  const float thin = thinness(around);
  const auto& [image, at, ruffled] = traced;
  const glm::vec3 sky = glm::min(image.sky[at] * 1.04F, glm::vec3(1.0F));
  look.image = glm::mix(image.colour[at], sky, 0.75F * ruffled);
  const float share =
      glm::mix(image.share[at], std::min(0.75F * image.share[at] + 0.12F, 0.6F), ruffled);
  look.image_share = unit(share + 0.05F * streak) * (1.0F - thin);
  return look;
}

float gravel_share(float around, const Patches& p) {
  return 0.8F * unit((around - 0.08F) / 0.25F) * unit(0.15F + 0.8F * p.n8 + 0.6F * p.n25);
}

glm::vec3 gravel_colour(double light) {
  return glm::vec3(0.93F, 0.91F, 0.86F) * static_cast<float>(0.55 + 0.45 * unit(light));
}

namespace {

constexpr float pool_tone = 0.16F;
constexpr glm::vec3 pool_lost{0.34F, 0.14F, 0.13F};  // share of light that a pool absorbs
constexpr float riffle_tone = 0.07F;
constexpr float riffle_white = 0.50F;

}  // namespace

WaterLook with_current(WaterLook look, float around, float streak, const Patches& patches,
                       float river) {
  // Pools and riffles follow each other; both are over the middle, shallows at the banks.
  const float middle = river * smoothstep(0.45F, 0.95F, around);
  const float pool = middle * smoothstep(-0.3F, 1.1F, patches.n60 + 0.5F * patches.n25);
  const float riffle = middle * smoothstep(0.1F, 1.0F, -patches.n60) * (1.0F - pool);
  look.tone_shift += riffle_tone * riffle - pool_tone * pool;
  look.depth *= 1.0F - pool * pool_lost;
  // Dashes end within the river.
  const float dash = smoothstep(0.2F, 1.3F, streak) * smoothstep(-0.5F, 0.9F, patches.n25);
  look.white_share = riffle_white * riffle * dash;
  return look;
}

namespace {

constexpr double broad_m = 420.0;
constexpr double fine_m = 110.0;

}  // namespace

WaterWind::WaterWind(std::uint64_t seed)
    : broad_(stream_seed(seed, Stream::water_wind, 0), broad_m),
      fine_(stream_seed(seed, Stream::water_wind, 1), fine_m) {}

float WaterWind::ruffled(glm::dvec3 position_m, float metres_per_unit, float strength) {
  if (!(strength > 0.0F)) return 0.0F;
  const float kept = unit(1.6F - metres_per_unit / 40.0F);
  const float noise =
      broad_(position_m.x, position_m.y) + 0.55F * kept * fine_(position_m.x, position_m.y);
  return smoothstep(0.55F, 1.35F, noise + 0.35F * (strength - 1.0F)) * unit(strength);
}

namespace {

constexpr float bare_darker = 0.26F;  // tones: bare ice is darker than snow in the same light
constexpr glm::vec3 bare_hue{0.90F, 0.965F, 0.94F};  // factor on snow's colour
constexpr float max_snow = 0.95F;
constexpr glm::dvec2 drift_axis{0.906,
                                -0.423};  // drifts are stretched from north-west to south-east …
constexpr double drift_length = 2.4;      // … by this factor
constexpr float crack_units = 0.55F;      // half the width of a crack
constexpr float wet_m = 4.0F;             // depth up to which the shore's ice is wet

}  // namespace

LakeIce::LakeIce(std::uint64_t seed)
    : drifts_(stream_seed(seed, Stream::lake_ice, 0), 260.0),
      small_drifts_(stream_seed(seed, Stream::lake_ice, 1), 70.0),
      cracks_(stream_seed(seed, Stream::lake_ice, 2), 520.0),
      stretches_(stream_seed(seed, Stream::lake_ice, 3), 700.0) {}

glm::vec3 LakeIce::colour(const Palette& palette, double altitude_m, double light,
                          glm::dvec3 position_m, float depth_m, float metres_per_unit) {
  const float kept = unit(1.8F - metres_per_unit / 30.0F);
  const double along_m = (position_m.x * drift_axis.x + position_m.y * drift_axis.y) / drift_length;
  const double across_m = position_m.y * drift_axis.x - position_m.x * drift_axis.y;
  const float drift = drifts_(along_m, across_m) + 0.6F * kept * small_drifts_(along_m, across_m);
  // Drifts have an edge: it distinguishes ice from water, which has only its shores.
  const float snow = max_snow * smoothstep(-0.30F, 0.45F, drift);
  const glm::vec3 bare = palette_colour(palette, LandCoverClass::snow, altitude_m,
                                        light - static_cast<double>(bare_darker)) *
                         bare_hue;
  glm::vec3 colour =
      glm::mix(bare, palette_colour(palette, LandCoverClass::snow, altitude_m, light), snow);
  // A crack follows the zero line of slow noise for a stretch: its width in metres is the noise
  // divided by its slope, about 1 per 520 m.
  const float off_m = std::abs(cracks_(position_m.x, position_m.y)) * 520.0F;
  const float stretch = smoothstep(0.5F, 1.1F, stretches_(position_m.x, position_m.y));
  const float crack = stretch * (1.0F - smoothstep(0.3F * crack_units * metres_per_unit,
                                                   crack_units * metres_per_unit + 1.0F, off_m));
  colour *= 1.0F - glm::vec3(0.20F, 0.13F, 0.08F) * crack * (1.0F - 0.6F * snow);
  const float wet = 1.0F - smoothstep(0.0F, wet_m, depth_m);
  colour *= 1.0F - glm::vec3(0.16F, 0.10F, 0.06F) * wet;
  return colour;
}

namespace {

constexpr LandCoverClass bed_class = LandCoverClass::scree;
constexpr float max_share = 0.9F;
constexpr float drawn_from_m =
    7.F;  // metres per unit of the sheet from which shallows are drawn wider than they are …
constexpr float max_drawn = 6.0F;  // … and by how much at most: a rim must be seen on a map
constexpr double lighter_share =
    0.5;  // share of the lightness that shallow water adds: painted deep water is already pale

}  // namespace

glm::vec3 shallow_water(glm::vec3 water) {
  const WaterColours above;
  const glm::dvec3 change = to_oklab(above.shallow / 255.F) - to_oklab(above.deep / 255.F);
  return glm::clamp(from_oklab(to_oklab(water) + glm::dvec3(lighter_share, 1.0, 1.0) * change), 0.F,
                    1.F);
}

LakeBed lake_bed(const GroundTint& tint, const Palette& palette, double altitude_m,
                 glm::dvec3 position_m, double footprint_m) {
  LakeBed bed;
  if (palette.winter) return bed;
  bed.depth_m = lake_depth_at(tint, glm::dvec2(position_m));
  if (!(bed.depth_m > 0.F)) return bed;
  bed.tint = tint_shift(tint, palette, bed_class, altitude_m, position_m, footprint_m);
  bed.share = bed.tint.share;
  return bed;
}

LakeBed lake_bed(const Palette& palette, const WaterGround::Place& water, float metres_per_unit) {
  LakeBed bed;
  if (palette.winter || !(water.lake > 0.F)) return bed;
  bed.depth_m =
      std::max(water.depth_m, 0.01F) / std::clamp(metres_per_unit / drawn_from_m, 1.F, max_drawn);
  bed.share = max_share * water.lake;
  return bed;
}

glm::vec3 LakeBed::under(glm::vec3 water, const Palette& palette, double altitude_m,
                         double light) const {
  if (!(depth_m > 0.F)) return water;
  const glm::vec3 ground = tint.over(palette_colour(palette, bed_class, altitude_m, light));
  return glm::mix(water, water_colour(ground, depth_m, {shallow_water(water), water}), share);
}

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
