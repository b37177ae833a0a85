#include "renderer/world/lit_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/angle.h"
#include "base/random.h"
#include "renderer/image/srgb.h"
#include "renderer/paint/clouds/clouds.h"
#include "renderer/paint/composite.h"
#include "renderer/rock/crest_shift.h"
#include "renderer/scene/scene_error.h"
#include "renderer/trace/camera_reduced.h"
#include "renderer/world/scene_climate.h"
#include "terrain/climate/map_place.h"

namespace belvedere {
namespace {

// Views of one scene, and scenes of one seed, have skies of their own: by where the viewer stands, to 100 m, and where he looks.
std::uint64_t sky_seed(const World& world) {
  const auto to_100_m = [](double m) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::llround(m / 100.0))); };
  const glm::dvec2 viewer = world.view.viewer_xy;
  const auto to_degree = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::llround(world.view.camera.azimuth_deg)));
  return mix_bits(mix_bits(mix_bits(world.scene.seed + to_100_m(viewer.x)) + to_100_m(viewer.y)) + to_degree);
}

}  // namespace

namespace {

// 1 where the noon sun stands in the south, -1 in the north. Where the place is not known it is in the north, as most maps are.
double find_sunny_side(const World& world) {
  const Dem& dem = *world.terrain.dem;
  if (!knows_place(world.scene, dem)) return 1.0;
  const MapPlace place = make_map_place(dem.transform, dem.crs, dem.width(), dem.height(), world.scene.climate.latitude_deg);
  return place.middle_lonlat_deg().y < 0.0 ? -1.0 : 1.0;
}

}  // namespace

SheetView view_of(const World& world) { return {*world.camera, world.scene.pixels_per_unit(), world.horizon_px}; }

SheetView reduced_view(const World& world, const Camera& reduced, int factor) {
  return {reduced, world.scene.pixels_per_unit() / factor, world.horizon_px / factor};
}

ToneParameters to_tone_parameters(const World& world, const Palette& palette, const SheetView& view) {
  ToneParameters parameters;
  parameters.light = world.scene.light;
  if (world.view.sun.altitude_deg <= 0.0) parameters.light.sun = 0.0;
  parameters.sun_direction = world.view.sun_direction;
  parameters.pixels_per_unit = view.pixels_per_unit;
  parameters.sun_image_x = world.view.sun_image_x;
  parameters.light_field = world.light_field;
  parameters.winter = palette.winter;
  parameters.seed = world.scene.seed;
  return parameters;
}

RockParameters to_rock_parameters(const World& world, const Palette& palette, const SheetView& view) {
  return {to_tone_parameters(world, palette, view), &find_rock_kind(world.scene.land_cover.rock), palette.winter};
}

namespace {

// But for how light becomes colour.
BaseParameters to_unlit_parameters(const World& world, const SheetView& view, const Palette& palette) {
  BaseParameters parameters;
  parameters.air = world.view.air;
  parameters.horizon_px = view.horizon_px;
  parameters.rock = &find_rock_kind(world.scene.land_cover.rock);
  parameters.sun_image_x = world.view.sun_image_x;
  parameters.light_field = world.light_field;
  parameters.sunny_side = find_sunny_side(world);
  parameters.pixels_per_unit = view.pixels_per_unit;
  parameters.seed = world.scene.seed;
  parameters.air.sky = find_sky_kind(world.scene.sky);
  parameters.sky_seed = sky_seed(world);
  parameters.water = world.scene.water;
  parameters.waters = find_water_ground(world.terrain);
  parameters.tint = make_ground_tint(world.terrain, palette, world.scene.land_cover.colour_share);
  return parameters;
}

}  // namespace

BaseParameters to_base_parameters(const World& world, const SheetView& view, const Palette& palette) {
  BaseParameters parameters = to_unlit_parameters(world, view, palette);
  if (world.scene.light.model == "product") parameters.mean_light = mean_light_of(world, palette);
  return parameters;
}

StrokeParameters to_stroke_parameters(const World& world, const Palette& palette) {
  return to_stroke_parameters(world, palette, view_of(world));
}

StrokeParameters to_stroke_parameters(const World& world, const Palette& palette, const SheetView& view) {
  StrokeParameters parameters;
  parameters.pixels_per_unit = view.pixels_per_unit;
  parameters.winter = palette.winter;
  parameters.sun_side = world.view.sun_image_x < 0.0 ? -1.0 : 1.0;
  if (world.light_field) parameters.local_side = [field = world.light_field](glm::dvec2 place_m) { return field->at(place_m).side; };
  parameters.seed = world.scene.seed;
  parameters.leaves = palette.growth.leaves;
  parameters.leaf_share = palette.growth.leaf_share;
  parameters.larch = palette.growth.larch;
  parameters.larch_share = palette.growth.larch_share;
  parameters.treeline_m = palette.treeline_m;
  parameters.wind = world.scene.water.wind;
  parameters.surf_units = world.scene.land_cover.sea == "none" ? 0.0 : 2.0 * world.scene.water.surf_mm;
  parameters.foam = world.scene.water.foam;
  parameters.sea_level_m = world.scene.land_cover.sea_level_m.value_or(0.0);
  parameters.frozen_from_m = palette.winter ? palette.lakes_freeze_from_m : std::numeric_limits<double>::infinity();
  return parameters;
}

std::optional<WaterImage> see_mirrored(const World& world, const SheetView& view, const Palette& palette, const GuidanceBuffers& guidance,
                                       glm::ivec2 origin_px, PixelRect wanted) {
  if (world.scene.water.mirror != "traced") return std::nullopt;
  bool any = false;
  for (int y = wanted.y0; y < wanted.y1 && !any; ++y)
    any = std::find(guidance.land_cover.row(y) + wanted.x0, guidance.land_cover.row(y) + wanted.x1, LandCoverClass::water) !=
          guidance.land_cover.row(y) + wanted.x1;
  if (!any) return std::nullopt;
  const int margin = water_image_margin_px(view.pixels_per_unit);
  const PixelRect rect =
      intersection({0, 0, guidance.width(), guidance.height()}, {wanted.x0, wanted.y0 - margin, wanted.x1, wanted.y1 + margin});
  Grid<std::uint8_t> mask(rect.width(), rect.height());
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x) mask(x, y) = guidance.land_cover(rect.x0 + x, rect.y0 + y) == LandCoverClass::water ? 1 : 0;
  MirrorParameters rays;
  rays.sun_direction = world.view.sun_direction;
  const MirrorSight sight = trace_mirror(world.terrain, world.surface, world.deformation, world.tracer, view.camera, rays, mask,
                                         moved(rect, origin_px.x, origin_px.y));
  WaterImageParameters look;
  look.light = world.scene.light;
  if (world.view.sun.altitude_deg <= 0.0) look.light.sun = 0.0;
  look.sun_direction = world.view.sun_direction;
  look.air = world.view.air;
  look.pixels_per_unit = view.pixels_per_unit;
  look.strength = world.scene.water.mirror_share;
  return paint_water_image(sight, rect, guidance, palette, look, wanted);
}

GuidanceBuffers trace_view(const World& world, const SheetView& view, PixelRect region, const Run& run) {
  GuidanceParameters parameters;
  parameters.sampling = world.scene.sampling;
  parameters.sun_direction = world.view.sun_direction;
  parameters.light_field = world.light_field;
  parameters.sun_radius_rad = to_radians(world.scene.sun.radius_deg);
  parameters.tile_size = run.tile_px;
  return trace_guidance(world.terrain, world.surface, world.tracer, view.camera, parameters, region, run.progress);
}

GuidanceBuffers trace_forms(const World& world, const Camera& camera, PixelRect region, const Run& run) {
  GuidanceParameters parameters;
  parameters.sampling = {.pixel_samples = 1, .shadow_rays = 1, .sky_directions = 0};
  parameters.sun_direction = {0.0, 0.0, -1.0};
  parameters.tile_size = run.tile_px;
  return trace_guidance(world.terrain, world.surface, world.tracer, camera, parameters, region, run.progress);
}

namespace {

// Relief of rock and light, over traced channels.
void light_up(GuidanceBuffers& guidance, const GuidanceBuffers& traced, const World& world, const Palette& palette, const SheetView& view,
              glm::ivec2 origin_px, Progress& progress) {
  const RockParameters rock = to_rock_parameters(world, palette, view);
  const WideView wide{traced, 1, origin_px};
  const PixelRect all{0, 0, traced.width(), traced.height()};
  guidance = gather_rows(traced, shift_crests(traced, wide, rock, origin_px, all), all);
  take_relief(guidance, make_rock_relief(guidance, wide, rock, origin_px, progress));
  guidance.tone = make_tone(guidance, wide, to_tone_parameters(world, palette, view), origin_px, progress);
}

constexpr int measured_width_px = 480;
constexpr double no_air_m = 1e9;  // air that begins beyond everything

// Of encoded sRGB, linear: the Y of IEC 61966-2-1.
double luminance_of(const glm::vec3& encoded) {
  const auto linear = [](float value) { return srgb_decoded(static_cast<double>(value)); };
  return 0.2126 * linear(encoded.x) + 0.7152 * linear(encoded.y) + 0.0722 * linear(encoded.z);
}

}  // namespace

double mean_light_of(const World& world, const Palette& palette) {
  const int factor = std::max(1, world.camera->size().x / measured_width_px);
  const std::unique_ptr<const Camera> camera = make_reduced_camera(*world.camera, factor);
  const SheetView view = reduced_view(world, *camera, factor);
  const PixelRect whole{0, 0, camera->size().x, camera->size().y};
  const Run run;
  const GuidanceBuffers traced = trace_view(world, view, whole, run);
  GuidanceBuffers g;
  light_up(g, traced, world, palette, view, {0, 0}, run.progress);
  BaseParameters parameters = to_unlit_parameters(world, view, palette);
  parameters.mean_light = 1.0;
  parameters.air.from_m = no_air_m;
  parameters.air.rim_fade_m = 0.0;
  const BasePicture base = make_base_picture(g, {traced, 1, {0, 0}}, palette, parameters, {0, 0}, camera->size(), run.progress);
  double lit = 0.0;
  double own = 0.0;
  for (std::size_t i = 0; i < g.depth_m.size(); ++i) {
    if (g.is_sky(i) || g.land_cover[i] == LandCoverClass::water || g.shadow[i] <= 0.5F) continue;
    const double luminance = luminance_of(base.colour[i]);
    lit += luminance;
    own += luminance / static_cast<double>(light_of_tone(g.tone[i]));
  }
  return own > 0.0 ? lit / own : static_cast<double>(light_of_tone(middle_tone));
}

LitPicture make_lit_picture(const World& world, const Palette& palette, PixelRect region, const Run& run) {
  const SheetView view = view_of(world);
  const glm::ivec2 origin_px{region.x0, region.y0};
  LitPicture picture;
  const GuidanceBuffers traced = trace_view(world, view, region, run);
  light_up(picture.guidance, traced, world, palette, view, origin_px, run.progress);
  const WideView wide{traced, 1, origin_px};
  const PixelRect all{0, 0, traced.width(), traced.height()};
  const std::optional<WaterImage> image = see_mirrored(world, view, palette, picture.guidance, origin_px, all);
  picture.base = make_base_picture(picture.guidance, wide, palette, to_base_parameters(world, view, palette), origin_px, view.camera.size(),
                                   run.progress, {}, image ? &*image : nullptr);
  picture.guidance.base = decode_srgb(picture.base.colour);
  return picture;
}

}  // namespace belvedere
