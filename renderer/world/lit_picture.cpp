#include "renderer/world/lit_picture.h"

#include <algorithm>
#include <utility>

#include "base/angle.h"
#include "renderer/paint/composite.h"
#include "renderer/paint/light.h"
#include "renderer/scene/scene_error.h"

namespace belvedere {
namespace {

ToneParameters to_tone_parameters(const World& world) {
  ToneParameters parameters;
  parameters.light = world.scene.light;
  if (world.view.sun.altitude_deg <= 0.0) parameters.light.sun = 0.0;
  parameters.sun_direction = world.view.sun_direction;
  parameters.pixels_per_unit = world.scene.pixels_per_unit();
  parameters.sun_image_x = world.view.sun_image_x;
  parameters.seed = world.scene.seed;
  return parameters;
}

BaseParameters to_base_parameters(const World& world) {
  BaseParameters parameters;
  parameters.air = world.scene.air;
  parameters.horizon_px = world.horizon_px;
  parameters.sun_image_x = world.view.sun_image_x;
  parameters.pixels_per_unit = world.scene.pixels_per_unit();
  parameters.seed = world.scene.seed;
  return parameters;
}

GuidanceParameters to_guidance_parameters(const World& world, int tile_px) {
  GuidanceParameters parameters;
  parameters.sampling = world.scene.sampling;
  parameters.sun_direction = world.view.sun_direction;
  parameters.sun_radius_rad = to_radians(world.scene.sun.radius_deg);
  parameters.tile_size = tile_px;
  return parameters;
}

}  // namespace

StrokeParameters to_stroke_parameters(const World& world, const Palette& palette) {
  StrokeParameters parameters;
  parameters.pixels_per_unit = world.scene.pixels_per_unit();
  parameters.winter = palette.winter;
  parameters.sun_side = world.view.sun_image_x < 0.0 ? -1.0 : 1.0;
  parameters.seed = world.scene.seed;
  parameters.leaves = palette.growth.leaves;
  parameters.leaf_share = palette.growth.leaf_share;
  return parameters;
}

LitPicture make_lit_picture(const World& world, const Palette& palette, PixelRect region, const Run& run) {
  const glm::ivec2 origin_px{region.x0, region.y0};
  LitPicture picture;
  picture.guidance = trace_guidance(world.terrain, world.surface, world.tracer, *world.camera, to_guidance_parameters(world, run.tile_px),
                                    region, run.progress);
  picture.guidance.tone = make_tone(picture.guidance, to_tone_parameters(world), origin_px, run.progress);
  picture.base = make_base_picture(picture.guidance, palette, to_base_parameters(world), origin_px, world.camera->size(), run.progress);
  picture.guidance.base = decode_srgb(picture.base.colour);
  return picture;
}

int lit_margin_px(const Scene& scene) {
  ToneParameters tone;
  tone.pixels_per_unit = scene.pixels_per_unit();
  BaseParameters base;
  base.pixels_per_unit = scene.pixels_per_unit();
  return guidance_margin_px() + std::max(tone_margin_px(tone), base_margin_px(base));
}

}  // namespace belvedere
