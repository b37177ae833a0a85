#include "renderer/world/lit_picture.h"

#include <algorithm>
#include <utility>

#include "base/angle.h"
#include "base/instruction_set.h"
#include "renderer/paint/composite.h"
#include "renderer/paint/light.h"
#include "renderer/paint/sky.h"

namespace belvedere {
namespace {

ToneParameters to_tone_parameters(const Stage& stage) {
  const SceneLight& light = stage.scene.light;
  ToneParameters parameters;
  parameters.sun_direction = stage.view.sun_direction;
  parameters.sun_strength = stage.view.sun.altitude_deg > 0.0 ? light.sun : 0.0;
  parameters.sky_strength = light.sky;
  parameters.relief_strength = light.relief;
  parameters.shadow_depth = light.shadow_depth;
  parameters.contrast = light.contrast;
  parameters.pixels_per_unit = stage.scene.pixels_per_unit();
  parameters.sun_image_x = stage.view.sun_image_x;
  parameters.seed = stage.scene.seed;
  return parameters;
}

BaseParameters to_base_parameters(const Stage& stage) {
  const SceneAir& air = stage.scene.air;
  BaseParameters parameters;
  parameters.haze = air.haze;
  parameters.haze_from_m = air.from_m;
  parameters.haze_scale_m = air.scale_m;
  parameters.range_mist = air.range_mist;
  parameters.warm_near = air.warm_near;
  parameters.hue_drift = air.hue_drift;
  parameters.rim_fade_m = air.rim_fade_m;
  parameters.clouds = air.clouds;
  parameters.horizon_px = stage.horizon_px;
  parameters.sun_image_x = stage.view.sun_image_x;
  parameters.pixels_per_unit = stage.scene.pixels_per_unit();
  parameters.seed = stage.scene.seed;
  return parameters;
}

GuidanceParameters to_guidance_parameters(const Stage& stage, int tile_size) {
  const SceneSampling& sampling = stage.scene.sampling;
  GuidanceParameters parameters;
  parameters.pixel_samples = sampling.pixel_samples;
  parameters.shadow_rays = sampling.shadow_rays;
  parameters.sky_directions = sampling.sky_directions;
  parameters.sky_reach_m = sampling.sky_reach_m;
  parameters.sun_direction = stage.view.sun_direction;
  parameters.sun_radius_rad = to_radians(stage.scene.sun.radius_deg);
  parameters.tile_size = tile_size;
  return parameters;
}

TracerParameters to_tracer_parameters(const Scene& scene) {
  TracerParameters tracing;
  tracing.instruction_set = scene.sampling.instruction_set;
  return tracing;
}

// What can be refused before the terrain is read, and what before its land cover is made.
Stage begin_stage(const LoadedScene& loaded) {
  choose_instruction_set(loaded.scene.sampling.instruction_set);  // what this machine lacks is said before the work
  Stage stage;
  stage.scene = loaded.scene;
  stage.palette = read_palette(find_named_file(loaded, "palettes", loaded.scene.palette));
  return stage;
}

void set_camera(Stage& stage, const Dem& dem, Progress& progress) {
  stage.view = make_view(stage.scene, dem, progress);
  stage.camera = make_camera(stage.view.camera);
}

void set_ground(Stage& stage, const LoadedScene& loaded, Dem dem, LandCover land_cover, Progress& progress) {
  stage.ground = make_ground(loaded, std::move(dem), std::move(land_cover), stage.view, progress);
  check_folds(loaded.scene, stage.ground, *stage.camera, progress);
  progress.begin("building the ray tracer", 0.0);
  stage.tracer = std::make_unique<Tracer>(stage.ground.surface, to_tracer_parameters(loaded.scene));
  stage.horizon_px = skyline_row_px(*stage.camera, *stage.tracer, 0.18 * loaded.scene.output.height);
}

}  // namespace

Stage set_stage(const LoadedScene& loaded, Progress& progress) {
  Stage stage = begin_stage(loaded);
  Dem dem = make_scene_dem(loaded, progress);
  set_camera(stage, dem, progress);
  LandCover land_cover = make_scene_land_cover(loaded, dem, progress);
  set_ground(stage, loaded, std::move(dem), std::move(land_cover), progress);
  return stage;
}

Stage set_stage(const LoadedScene& loaded, Dem dem, LandCover land_cover, Progress& progress) {
  Stage stage = begin_stage(loaded);
  set_camera(stage, dem, progress);
  set_ground(stage, loaded, std::move(dem), std::move(land_cover), progress);
  return stage;
}

StrokeParameters to_stroke_parameters(const Stage& stage) {
  StrokeParameters parameters;
  parameters.pixels_per_unit = stage.scene.pixels_per_unit();
  parameters.winter = stage.palette.winter;
  parameters.sun_side = stage.view.sun_image_x < 0.0 ? -1.0 : 1.0;
  parameters.seed = stage.scene.seed;
  parameters.leaves = stage.palette.growth.leaves;
  parameters.leaf_share = stage.palette.growth.leaf_share;
  return parameters;
}

LitPicture make_lit_picture(const Stage& stage, PixelRect region, int tile_size, Progress& progress) {
  const glm::ivec2 origin_px{region.x0, region.y0};
  LitPicture picture;
  picture.guidance = trace_guidance(stage.ground.model, stage.ground.surface, *stage.tracer, *stage.camera,
                                    to_guidance_parameters(stage, tile_size), region, progress);
  picture.guidance.tone = make_tone(picture.guidance, to_tone_parameters(stage), origin_px, progress);
  picture.ground = make_paint_ground(picture.guidance, stage.palette, to_base_parameters(stage), origin_px, stage.camera->size(), progress);
  picture.guidance.base = decode_srgb(picture.ground.colour);
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
