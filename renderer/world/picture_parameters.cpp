#include "renderer/world/picture_parameters.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <limits>

#include "base/math.h"
#include "base/random.h"
#include "renderer/paint/clouds/clouds.h"
#include "renderer/world/scene_season.h"

namespace belvedere {
namespace {

// Views of one scene, and scenes of one seed, have different skies: by the viewer's position, to
// 100 m, and the direction of view.
std::uint64_t sky_seed(const World& world) {
  const auto to_100_m = [](double m) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::llround(m / 100.0)));
  };
  const glm::dvec2 viewer = world.view.viewer_xy;
  const auto to_degree = static_cast<std::uint64_t>(
      static_cast<std::int64_t>(std::llround(world.view.camera.azimuth_deg)));
  return mix_bits(mix_bits(mix_bits(world.scene.seed + to_100_m(viewer.x)) + to_100_m(viewer.y)) +
                  to_degree);
}

// The sides of the data; none where rays are parallel.
std::optional<TerrainSides> find_sides(const World& world) {
  const Projection* projection = find_projection(world.view.camera.projection);
  if (projection == nullptr || !(projection->widest_deg > 0.0)) return std::nullopt;
  const Dem& dem = *world.terrain.dem;
  const glm::dvec2 a = dem.transform.to_crs(0.0, 0.0);
  const glm::dvec2 b = dem.transform.to_crs(dem.width() - 1.0, dem.height() - 1.0);
  return TerrainSides{glm::min(a, b), glm::max(a, b), world.view.viewer_xy};
}

}  // namespace

SheetView view_of(const World& world) {
  return {*world.camera, world.scene.pixels_per_unit(), world.horizon_px};
}

SheetView reduced_view(const World& world, const Camera& reduced, int factor) {
  return {reduced, world.scene.pixels_per_unit() / factor, world.horizon_px / factor};
}

ToneParameters to_tone_parameters(const World& world, const Palette& palette,
                                  const SheetView& view) {
  ToneParameters parameters;
  parameters.light = world.scene.light;
  if (world.view.sun.altitude_deg <= 0.0) parameters.light.sun = 0.0;
  parameters.sun_direction = world.view.sun_direction;
  parameters.pixels_per_unit = view.pixels_per_unit;
  parameters.sun_image_x = world.view.sun_image_x;
  parameters.light_field = world.light_field;
  parameters.air = world.view.air;
  parameters.winter = palette.winter;
  parameters.seed = world.scene.seed;
  return parameters;
}

RockParameters to_rock_parameters(const World& world, const Palette& palette,
                                  const SheetView& view) {
  return {to_tone_parameters(world, palette, view), &find_rock_kind(world.scene.land_cover.rock),
          palette.winter};
}

BaseParameters to_base_parameters(const World& world, const Palette& palette,
                                  const SheetView& view) {
  BaseParameters parameters;
  parameters.air = world.view.air;
  parameters.horizon_px = view.horizon_px;
  parameters.rock = &find_rock_kind(world.scene.land_cover.rock);
  parameters.sun_image_x = world.view.sun_image_x;
  parameters.light_field = world.light_field;
  parameters.sunny_side = world.sunny_side;
  parameters.pixels_per_unit = view.pixels_per_unit;
  parameters.seed = world.scene.seed;
  parameters.air.sky = find_sky_kind(world.scene.sky);
  parameters.sky_seed = sky_seed(world);
  parameters.water = world.scene.water;
  parameters.waters = world.waters->get();
  parameters.sides = find_sides(world);
  parameters.tint = make_ground_tint(world.terrain, palette, world.scene.land_cover.colour_share);
  return parameters;
}

StrokeParameters to_stroke_parameters(const World& world, const Palette& palette) {
  return to_stroke_parameters(world, palette, view_of(world));
}

StrokeParameters to_stroke_parameters(const World& world, const Palette& palette,
                                      const SheetView& view) {
  StrokeParameters parameters;
  parameters.pixels_per_unit = view.pixels_per_unit;
  parameters.winter = palette.winter;
  parameters.sun_side = world.view.sun_image_x < 0.0 ? -1.0 : 1.0;
  if (world.light_field)
    parameters.local_side = [field = world.light_field](glm::dvec2 position_m) {
      return field->at(position_m).side;
    };
  parameters.seed = world.scene.seed;
  parameters.leaves = palette.growth.leaves;
  parameters.leaf_share = palette.growth.leaf_share;
  parameters.larch = palette.growth.larch;
  parameters.larch_share = palette.growth.larch_share;
  parameters.treeline_m = palette.treeline_m;
  parameters.wind = world.scene.water.wind;
  parameters.surf_units =
      world.scene.land_cover.sea == "none" ? 0.0 : 2.0 * world.scene.water.surf_mm;
  parameters.foam = world.scene.water.foam;
  parameters.sea_level_m = world.scene.land_cover.sea_level_m.value_or(0.0);
  parameters.frozen_from_m =
      palette.winter ? palette.lakes_freeze_from_m : std::numeric_limits<double>::infinity();
  return parameters;
}

std::optional<WaterImage> trace_reflections(const World& world, const SheetView& view,
                                            const Palette& palette, const GuidanceBuffers& guidance,
                                            glm::ivec2 origin_px, PixelRect wanted) {
  if (world.scene.water.mirror != "traced") return std::nullopt;
  bool any = false;
  for (int y = wanted.y0; y < wanted.y1 && !any; ++y)
    any = std::find(guidance.land_cover.row(y) + wanted.x0, guidance.land_cover.row(y) + wanted.x1,
                    LandCoverClass::water) != guidance.land_cover.row(y) + wanted.x1;
  if (!any) return std::nullopt;
  const int margin = water_image_margin_px(view.pixels_per_unit);
  const PixelRect rect =
      intersection({0, 0, guidance.width(), guidance.height()},
                   {wanted.x0, wanted.y0 - margin, wanted.x1, wanted.y1 + margin});
  Grid<std::uint8_t> mask(rect.width(), rect.height());
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x)
      mask(x, y) = guidance.land_cover(rect.x0 + x, rect.y0 + y) == LandCoverClass::water ? 1 : 0;
  MirrorParameters rays;
  rays.sun_direction = world.view.sun_direction;
  const MirrorSight sight =
      trace_mirror(world.terrain, *world.surface, world.deformation, world.tracer, view.camera,
                   rays, mask, moved(rect, origin_px.x, origin_px.y));
  WaterImageParameters look;
  look.light = world.scene.light;
  if (world.view.sun.altitude_deg <= 0.0) look.light.sun = 0.0;
  look.sun_direction = world.view.sun_direction;
  look.air = world.view.air;
  look.pixels_per_unit = view.pixels_per_unit;
  look.strength = world.scene.water.mirror_share;
  return paint_water_image(sight, rect, guidance, palette, look, wanted);
}

namespace {

GuidanceParameters to_guidance_parameters(const World& world, const Run& run) {
  GuidanceParameters parameters;
  parameters.sampling = world.scene.sampling;
  parameters.sun_direction = world.view.sun_direction;
  parameters.light_field = world.light_field;
  parameters.sun_radius_rad = to_radians(world.scene.sun.radius_deg);
  parameters.tile_size = run.tile_px;
  return parameters;
}

}  // namespace

GuidanceBuffers trace_view(const World& world, const SheetView& view, PixelRect region,
                           const Run& run) {
  return trace_guidance(world.terrain, *world.surface, world.tracer, view.camera,
                        to_guidance_parameters(world, run), region, run.progress);
}

Grid<float> trace_view_shadows(const World& world, const SheetView& view, PixelRect region,
                               const Run& run) {
  return trace_shadows(world.terrain, *world.surface, world.tracer, view.camera,
                       to_guidance_parameters(world, run), region, run.progress);
}

GuidanceBuffers trace_forms(const World& world, const Camera& camera, PixelRect region,
                            const Run& run) {
  GuidanceParameters parameters;
  parameters.sampling = {.pixel_samples = 1, .shadow_rays = 1, .sky_directions = 0};
  parameters.sun_direction = {0.0, 0.0, -1.0};
  parameters.tile_size = run.tile_px;
  return trace_guidance(world.terrain, *world.surface, world.tracer, camera, parameters, region,
                        run.progress);
}

}  // namespace belvedere
