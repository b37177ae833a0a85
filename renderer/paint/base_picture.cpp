#include "renderer/paint/base_picture.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "base/error.h"
#include "base/grid.h"
#include "base/math.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/paint/air.h"
#include "renderer/paint/forest_cover.h"
#include "renderer/paint/ground/ground_tint.h"
#include "renderer/paint/ground/slope_walk.h"
#include "renderer/paint/light.h"
#include "renderer/paint/picture_filter.h"
#include "renderer/paint/picture_noise.h"
#include "renderer/paint/sky.h"
#include "renderer/paint/terrain_end.h"
#include "renderer/paint/water/water_surface.h"

namespace belvedere {
namespace {

constexpr float garden_share = 0.80F;           // share in a village: houses stand in greenery …
constexpr float town_garden_share = 0.30F;      // … and in the centre of a town
constexpr glm::vec3 pale{0.74F, 0.70F, 0.60F};  // yards, walls and lanes in full light
constexpr float pale_share = 0.35F;
constexpr float pale_from = 0.02F;  // density of houses from which the ground is pale …
constexpr float pale_to = 0.18F;    // … and fully so

}  // namespace

glm::vec3 town_ground_colour(const Palette& palette, glm::vec3 street, float built,
                             double altitude_m, double light, float drift, float metres_per_unit) {
  const float green = garden_share + (town_garden_share - garden_share) * unit(built);
  const glm::vec3 lawn =
      palette.winter ? glm::vec3(1.0F) : 1.0F + (crop_colour(Crop::grass) - 1.0F) * drift;
  const LandCoverClass gardens =
      palette.winter ? LandCoverClass::snow : LandCoverClass::valley_floor;
  const glm::vec3 ground =
      glm::mix(street, lawn * palette_colour(palette, gardens, altitude_m, light - 0.08), green);
  if (palette.winter) return ground;
  const float place = village_share(metres_per_unit) * smoothstep(pale_from, pale_to, built);
  return glm::mix(ground, pale * (0.55F + 0.60F * static_cast<float>(light)), pale_share * place);
}

namespace {

constexpr float melting_units = 5.0F;  // fields that look narrower than this merge into bands

}  // namespace

glm::vec3 field_colour(const Parcel& parcel, float slope_deg, float metres_per_unit, float air,
                       float drift) {
  const float level = unit((5.5F - slope_deg) / 2.5F);
  const float units = metres_per_unit > 0.0F ? parcel.width_m / metres_per_unit : 100.0F;
  const float apart =
      (0.55F + 0.60F * unit(units / melting_units - 1.0F)) * (1.0F - 0.35F * std::min(air, 1.0F));
  const glm::vec3 crop = crop_colour(parcel.crop) * (1.0F + 0.035F * parcel.shade);
  glm::vec3 colour = glm::mix(mean_crop_colour(), crop, apart);
  const float edge = unit(1.0F - parcel.border_m / (0.10F * parcel.width_m));
  colour *= 1.0F - edge * apart * (parcel.hedged ? 0.13F : 0.05F);
  const float lane = unit(1.0F - parcel.lane_m / (0.06F * parcel.width_m));
  if (!parcel.hedged)
    colour = glm::mix(colour, glm::vec3(1.02F, 0.99F, 1.05F), 0.55F * lane * apart);
  colour = glm::mix(crop_colour(Crop::hay), colour, level);
  return 1.0F + (colour - 1.0F) * drift;
}

namespace {

constexpr double tone_step = 0.17;  // offset of the darker and the lighter picture
const glm::vec3 reflected_warmth{
    0.24F, 0.07F,
    -0.08F};  // factors that light from lit ground adds to the shade at the foot of a wall
const glm::vec3 full_warmth{0.10F, -0.02F,
                            -0.16F};  // factors that regional light of warmth 1 adds to lit colours
constexpr double ice_step = 0.4;      // of the tone step: strokes on ice have less contrast
constexpr float high_m = 260.0F;  // height above the surroundings from which a position is a crest

using Class = LandCoverClass;

// Colour terms that the three tones of a pixel share.
struct PixelColour {
  glm::vec3 added;   // grasses
  glm::vec3 factor;  // drift of hue, warm foreground, fields
  glm::vec3 air_colour;
  float air = 0.0F;
  float desaturated = 0.0F;  // loss of freshness of greens, 0…1
  float mist = 0.0F;         // share of the colour between ranges, in hollows of far ones
  RangeEdge edge;
  TerrainEnd end;
  glm::vec3 beyond;  // colour behind the end of the terrain

  glm::vec3 finish(glm::vec3 colour, glm::vec3 range_mist) const {
    colour = glm::clamp(colour + added, 0.0F, 1.0F) * factor;
    const float grey = 0.30F * colour.r + 0.59F * colour.g + 0.11F * colour.b;
    colour = glm::mix(colour, glm::vec3(1.03F, 0.99F, 1.04F) * grey, 0.12F * desaturated);
    colour = glm::mix(colour, air_colour, air);
    colour = glm::mix(colour, range_mist, mist);
    colour = glm::mix(colour, range_mist, edge.mist);
    colour = glm::mix(colour, air_colour, end.air);
    colour = glm::clamp(colour * (1.0F - glm::vec3(0.40F, 0.35F, 0.27F) * edge.dark), 0.0F, 1.0F);
    return glm::mix(colour, beyond, end.dissolved);
  }
  // Share of the finished colour that does not come from the ground.
  float veiled() const {
    return 1.0F - (1.0F - air) * (1.0F - mist) * (1.0F - std::min(edge.mist, 1.0F)) *
                      (1.0F - end.air) * (1.0F - end.dissolved);
  }
};

struct BasePixel {
  glm::vec3 colour, darker, lighter;
  float accent = 0.0F;
  float tree_density = 0.0F;
  float haze = 0.0F;
};

BasePixel sky_pixel(glm::vec3 sky) {
  return {sky, sky * 0.97F, glm::min(sky * 1.03F, glm::vec3(1.0F))};
}

// Everything that pixels are painted from.
struct Scenery {
  const GuidanceBuffers& guidance;
  const WideView& wide;
  const Palette& palette;
  const BaseParameters& parameters;
  const BaseSurroundings& around;
  double horizon_px;
  glm::ivec2 origin_px;
  int width_px;  // of the whole picture
  const WaterImage* image;
  PixelRect wanted;

  // Metres of ground that a unit of the sheet shows.
  float metres_per_unit(std::size_t i) const {
    return guidance.footprint_m[i] * static_cast<float>(parameters.pixels_per_unit);
  }
  glm::dvec3 position_m(std::size_t i) const {
    return glm::dvec3(guidance.position_m[i]) + guidance.origin_m;
  }
  WaterPixel water_pixel(std::size_t i, int x, int y, const Patches& patches) const {
    const bool known = parameters.waters && guidance.land_cover[i] == Class::water;
    const WaterGround::Place ground =
        known ? parameters.waters->at(glm::dvec2(position_m(i))) : WaterGround::Place{};
    return {.index = i,
            .position_m = position_m(i),
            .metres_per_unit = metres_per_unit(i),
            .ground = ground,
            .mirrored = around.mirrored,
            .river = known ? 1.0F - ground.lake : 0.0F,
            .share = around.water[i],
            .streak = around.streaks.empty() ? 0.0F : around.streaks[i],
            .patches = patches,
            .image = image,
            .image_index = image != nullptr ? image->share.index(x - wanted.x0, y - wanted.y0) : 0};
  }
  // Position relative to the surroundings: -1 valley … 1 crest.
  float raised(std::size_t i) const {
    return std::clamp(guidance.relief_l_m[i] / high_m, -1.0F, 1.0F);
  }
};

// Colour factor of vegetation: greens of meadows, fields, woods of gullies and ribs. In winter it
// lies under snow.
glm::vec3 grown_hue(const Scenery& s, std::size_t i, const Patches& patches,
                    const ForestTurn& woods, float air) {
  const GuidanceBuffers& g = s.guidance;
  const Class id = g.land_cover[i];
  const auto drift = static_cast<float>(s.parameters.air.hue_drift);
  if (id == Class::forest) return woods.factor;
  const MeadowPosition position =
      meadow_position(g, i, s.palette.treeline_m, static_cast<float>(s.parameters.sunny_side));
  const MeadowMix mix = meadow_mix(id, position, patches);
  glm::vec3 hue = meadow_hue(mix, drift * static_cast<float>(s.palette.ground_drift_share));
  const float fields = id == Class::valley_floor ? 1.0F : mix.mown;
  if (fields > 0.0F) {
    const glm::dvec3 at = s.position_m(i);
    const float metres_per_unit = s.metres_per_unit(i);
    const Parcel parcel = parcel_at(s.parameters.seed, at.x, at.y, metres_per_unit, g.grain[i]);
    // Mown slopes keep their strips; on the valley floor only the slopes where meadow replaces
    // fields.
    const float slope_deg = id == Class::valley_floor ? g.slope_deg[i] : 0.25F * g.slope_deg[i];
    hue *= glm::mix(glm::vec3(1.0F), field_colour(parcel, slope_deg, metres_per_unit, air, drift),
                    fields);
  }
  return hue;
}

// Colour factor of the low sun on high, bare ground: lit walls turn pink, more so the higher they
// stand above their surroundings. Only near the viewer, because the colour of far ranges comes from
// the air.
glm::vec3 evening_glow(const Scenery& s, std::size_t i, float far) {
  const GuidanceBuffers& g = s.guidance;
  if (g.land_cover[i] != Class::rock || s.palette.winter) return glm::vec3(1.0F);
  const float lit = smoothstep(0.42F, 0.85F, g.tone[i]);
  const float high = smoothstep(-60.0F, 240.0F, g.relief_l_m[i]);
  const auto drift = static_cast<float>(s.parameters.air.hue_drift);
  return 1.0F + glm::vec3(0.034F, -0.038F, -0.065F) *
                    (lit * (0.35F + 0.65F * high) * (1.0F - far) * drift);
}

// Colour factor of warm or cool light on lit ground; shade keeps the palette's colour.
glm::vec3 light_warmth(const Scenery& s, std::size_t i) {
  if (!s.parameters.light_field) return glm::vec3(1.0F);
  const float warmth = s.parameters.light_field->at(glm::dvec2(s.position_m(i))).warmth;
  return 1.0F + full_warmth * (warmth * smoothstep(0.30F, 0.80F, s.guidance.tone[i]));
}

TerrainEnd end_at(const Scenery& s, std::size_t i, int x, const Patches& patches) {
  const BaseParameters& p = s.parameters;
  if (!(p.air.rim_fade_m > 0.0)) return {};
  const TerrainEnd end = terrain_end_at(s.guidance.rim_m[i], p.air.rim_fade_m);
  if (!p.sides) return end;
  const float side =
      side_share(*p.sides, {.position = glm::dvec2(s.position_m(i)),
                            .metres_per_unit = static_cast<double>(s.metres_per_unit(i)),
                            .from_left_units = (x + s.origin_px.x + 0.5) / p.pixels_per_unit,
                            .sheet_width_units = s.width_px / p.pixels_per_unit});
  return with_sides(end, side, patches.n60 + 0.6F * patches.n25);
}

PixelColour pixel_colour(const Scenery& s, std::size_t i, int x, int y, const Patches& patches,
                         const ForestTurn& woods) {
  const GuidanceBuffers& g = s.guidance;
  const BaseParameters& p = s.parameters;
  const Class id = g.land_cover[i];
  const double depth = g.depth_m[i];
  const auto drift = static_cast<float>(p.air.hue_drift);
  const auto separation = static_cast<float>(p.air.range_mist);
  const float warm = foreground_warmth(p.air, depth) *
                     static_cast<float>(p.air.warm_near * s.palette.warm_share) *
                     class_info(id).hue.warmth * g.tone[i];
  const float far = farness(p.air, depth) * separation;
  const float raised = s.raised(i);
  PixelColour pixel{};
  pixel.added = grass_shift(id, patches, g.relief_s_m[i]) * drift *
                static_cast<float>(s.palette.ground_drift_share);
  pixel.factor =
      hue_drift(id, patches, s.palette, drift) * (1.0F + glm::vec3(0.06F, 0.03F, -0.07F) * warm);
  if (has_trait(id, ClassTrait::desaturates))
    pixel.desaturated = green_desaturation(p.air, depth) * static_cast<float>(p.air.warm_near);
  pixel.air_colour = air_colour(p.air, s.palette, depth);
  pixel.air = air_share(p.air, s.palette, depth, g.altitude_m[i], far, raised);
  pixel.edge =
      range_edge(s.around.log_depth[i] - s.around.mean_log_depth[i], far, raised, separation);
  pixel.mist = hollow_mist(s.around.mist[i], g.relief_l_m[i], g.slope_deg[i], separation);
  if (pixel.mist != 0.0F)
    pixel.mist = pixel.mist * far_range_share(p.air, depth, g.altitude_m[i]) *
                 static_cast<float>(s.palette.haze_share);
  pixel.edge.mist = std::min(pixel.edge.mist, edge_mist_beside(pixel.mist, separation));
  pixel.beyond = air_beyond(s.palette, (y + s.origin_px.y + 0.5) / s.horizon_px);
  pixel.end = end_at(s, i, x, patches);
  if (!s.palette.winter) pixel.factor *= grown_hue(s, i, patches, woods, pixel.air);
  pixel.factor *= evening_glow(s, i, far);
  pixel.factor *= light_warmth(s, i);
  if (is_white(id, s.palette.winter))
    pixel.factor *= near_snow_hue(g.tone[i], g.slope_deg[i], close_share(s.metres_per_unit(i)));
  return pixel;
}

// How much warm light the lit ground at the foot of a wall reflects into its shade, 0…1: evaluated
// some units below the pixel.
float reflected_share(const Scenery& s, int x, int y) {
  constexpr int looks = 8;
  constexpr double spacing_units = 1.7;
  int open = 0;
  for (int k = 1; k <= looks; ++k) {
    const int down =
        static_cast<int>(std::lround(k * spacing_units * s.parameters.pixels_per_unit));
    const std::size_t w = s.wide.index(s.origin_px.x + x, s.origin_px.y + y + down);
    const Class id = s.wide.seen.land_cover[w];
    if (id != Class::rock && id != Class::sky &&
        same_surface(s.wide.seen.depth_m[w], s.guidance.depth_m(x, y)))
      ++open;
  }
  return static_cast<float>(open) / looks;
}

float firn_share(const Scenery& s, int x, int y) {
  const float bare = value_on_surface(s.wide, s.around.bare, s.origin_px.x + x, s.origin_px.y + y,
                                      s.guidance.depth_m(x, y));
  const float tongue = smoothstep(0.02F, 0.24F, bare);
  return s.palette.winter ? 1.0F - 0.35F * tongue : 1.0F - tongue;
}

BasePixel ground_pixel(const Scenery& s, GroundNoises& noises, WaterNoises& waters, int x, int y) {
  const GuidanceBuffers& g = s.guidance;
  const std::size_t i = g.depth_m.index(x, y);
  const Class id = g.land_cover[i];
  const double altitude = g.altitude_m[i];
  const Patches patches = patches_at(noises, s.position_m(i), s.metres_per_unit(i));
  const auto drift = static_cast<float>(s.parameters.air.hue_drift);
  const ForestTurn woods =
      id == Class::forest ? forest_turn(g.relief_s_m[i], g.relief_m_m[i], g.tone[i], patches, drift)
                          : ForestTurn{};
  const PixelColour pixel = pixel_colour(s, i, x, y, patches, woods);
  const float glade = s.around.cover.glade[i];
  const bool has_gravel = has_trait(id, ClassTrait::gravel_banks) && !s.palette.winter;
  const float gravel = has_gravel ? gravel_share(s.around.water[i], patches) : 0.0F;
  const WaterSources sources{g, s.palette, s.parameters.water, s.parameters.tint.get()};
  const WaterPixel wet = s.water_pixel(i, x, y, patches);
  const WaterSurface open =
      id == Class::water ? water_surface(sources, waters, wet) : WaterSurface{};
  const WaterLook& water = open.look;
  const bool bare = id == Class::rock && !g.rock_facet.empty();
  const glm::vec2 cover = bare ? g.rock_cover[i] : glm::vec2(0.0F);
  const float shade = bare ? 1.0F - smoothstep(0.10F, 0.42F, g.tone[i]) : 0.0F;
  glm::vec3 hue = bare ? rock_hue(*s.parameters.rock, g.rock_facet[i], shade) : glm::vec3(1.0F);
  if (shade > 0.0F && !s.palette.winter)
    hue *= 1.0F + shade * reflected_share(s, x, y) * reflected_warmth;
  const TintShift tint = s.parameters.tint && id != Class::water
                             ? tint_shift(*s.parameters.tint, s.palette, id, altitude,
                                          s.position_m(i), g.footprint_m[i])
                             : TintShift{};
  // Ice deep inside snow is white with firn; its tongues are blue and bare.
  const float firn = id == Class::glacier ? firn_share(s, x, y) : 0.0F;
  const ScreeTurn fan =
      id == Class::scree && !s.palette.winter
          ? scree_turn(s.around.fans.position[i],
                       // Near debris has cones of its own (renderer/close).
                       s.around.fans.streak[i] * (1.0F - 0.30F * close_share(s.metres_per_unit(i))),
                       g.relief_s_m[i], drift)
          : ScreeTurn{};
  if (id == Class::scree && !s.palette.winter && !g.rock_facet.empty())
    hue *= near_scree_hue(g.rock_facet[i] != 0, close_share(s.metres_per_unit(i)));
  const float turned = fan.tone + woods.tone;
  const bool multiplied = s.parameters.mean_light > 0.0 && id != Class::water;
  const auto paint = [&](double step) {
    const double lit =
        g.tone[i] + static_cast<double>(water.tone_shift) + static_cast<double>(turned) + step;
    const double light = multiplied ? static_cast<double>(middle_tone) : lit;
    glm::vec3 ramp = palette_colour(s.palette, id, altitude, light) * hue * fan.factor;
    if (firn > 0.0F)
      ramp = glm::mix(ramp, palette_colour(s.palette, Class::snow, altitude, light), firn);
    if (fan.grown > 0.0F)
      ramp = glm::mix(ramp, palette_colour(s.palette, Class::alpine_grass, altitude, light - 0.06),
                      fan.grown);
    // Turf is never as light as the wall around it; snow takes the light of the wall.
    if (cover.x > 0.0F)
      ramp = glm::mix(
          ramp,
          palette_colour(s.palette, Class::alpine_grass, altitude, std::min(light, 0.75) - 0.05),
          cover.x);
    if (cover.y > 0.0F)
      ramp =
          glm::mix(ramp, palette_colour(s.palette, Class::snow, altitude, light + 0.06), cover.y);
    if (glade > 0.0F)
      ramp = glm::mix(ramp, glade_colour(s.palette, altitude, light), 0.85F * glade);
    if (gravel > 0.0F) ramp = glm::mix(ramp, gravel_colour(light), gravel);
    ramp = open.bed.under(tint.over(ramp), s.palette, altitude, light);
    if (id == Class::settlement)
      ramp =
          town_ground_colour(s.palette, ramp, g.built[i], altitude, light,
                             static_cast<float>(s.parameters.air.hue_drift), s.metres_per_unit(i));
    if (multiplied)
      ramp = times_light(ramp, light_of_tone(static_cast<float>(lit)) /
                                   static_cast<float>(s.parameters.mean_light));
    ramp = water.over(ramp);
    ramp = frozen_over(ramp, sources, waters, wet, open, g.tone[i] + ice_step * step);
    return pixel.finish(ramp, s.palette.range_mist);
  };
  const int step_px = std::max(1, static_cast<int>(std::lround(s.parameters.pixels_per_unit)));
  const glm::vec3 colour = paint(0.0);
  const bool tones = s.parameters.tones;
  return {.colour = colour,
          .darker = tones ? paint(-tone_step) : colour,
          .lighter = tones ? paint(tone_step) : colour,
          .accent = accent_at(g, s.around.log_depth, x, y, step_px),
          .tree_density = id == Class::forest ? s.around.cover.density[i]
                                              : bush_density(id, s.around.wood[i], patches),
          .haze = pixel.veiled()};
}

}  // namespace

BasePicture make_base_picture(const GuidanceBuffers& guidance, const Palette& palette,
                              const BaseParameters& parameters, glm::ivec2 origin_px,
                              glm::ivec2 picture_size, Progress& progress, PixelRect wanted) {
  return make_base_picture(guidance, {guidance, 1, origin_px}, palette, parameters, origin_px,
                           picture_size, progress, wanted);
}

BasePicture make_base_picture(const GuidanceBuffers& guidance, const WideView& wide,
                              const Palette& palette, const BaseParameters& parameters,
                              glm::ivec2 origin_px, glm::ivec2 picture_size, Progress& progress,
                              PixelRect wanted, const WaterImage* image) {
  using B = GuidanceBuffers;
  require_channels(
      guidance,
      {&B::depth_m, &B::position_m, &B::altitude_m, &B::land_cover, &B::tone, &B::fall_line,
       &B::slope_deg, &B::footprint_m, &B::normal_smooth, &B::relief_s_m, &B::relief_m_m,
       &B::relief_l_m, &B::valley_height_m, &B::rim_m, &B::built, &B::grain},
      "base picture");
  if (wanted.empty()) wanted = {0, 0, guidance.width(), guidance.height()};
  const int width = wanted.width();
  const int height = wanted.height();
  progress.begin("base picture", height);
  const double horizon_px =
      parameters.horizon_px > 0.0 ? parameters.horizon_px : 0.18 * picture_size.y;
  const SkyParameters sky{
      picture_size,           horizon_px,     parameters.air.clouds, parameters.air.sky,
      parameters.sun_image_x, palette.winter, parameters.sky_seed};
  const BaseSurroundings around =
      look_around(guidance, wide, palette, parameters, sky, origin_px, wanted);
  if (image != nullptr && (image->share.width() != width || image->share.height() != height))
    throw Error(ErrorKind::bug, "base picture",
                "the reflected image covers other pixels than the picture");
  const Scenery scenery{guidance,   wide,      palette,        parameters, around,
                        horizon_px, origin_px, picture_size.x, image,      wanted};

  BasePicture picture;
  picture.colour = picture.darker = picture.lighter = Grid<glm::vec3>(width, height);
  picture.accent = picture.tree_density = picture.haze = Grid<float>(width, height, 0.0F);
  parallel_rows(height, [&](int y) {
    GroundNoises noises(parameters.seed);
    WaterNoises waters(parameters.seed);
    for (int x = 0; x < width; ++x) {
      const std::size_t i = picture.colour.index(x, y);
      const bool is_sky = guidance.is_sky(guidance.depth_m.index(wanted.x0 + x, wanted.y0 + y));
      const BasePixel pixel =
          is_sky ? sky_pixel(around.sky[i])
                 : ground_pixel(scenery, noises, waters, wanted.x0 + x, wanted.y0 + y);
      picture.colour[i] = pixel.colour;
      picture.darker[i] = pixel.darker;
      picture.lighter[i] = pixel.lighter;
      picture.accent[i] = pixel.accent;
      picture.tree_density[i] = pixel.tree_density;
      picture.haze[i] = pixel.haze;
    }
    progress.advance(1.0);
  });
  return picture;
}

}  // namespace belvedere
