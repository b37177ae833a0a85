#include "renderer/paint/water_look.h"

#include <algorithm>
#include <glm/common.hpp>

#include "base/math.h"

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

// What both kinds of reflection share: banks of brooks, streaks, shallows.
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

}  // namespace belvedere
