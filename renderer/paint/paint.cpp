#include "renderer/paint/paint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "base/error.h"
#include "base/math.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/paint/forest_cover.h"
#include "renderer/paint/picture_filter.h"
#include "renderer/paint/picture_noise.h"
#include "renderer/paint/reflection.h"
#include "renderer/paint/sky.h"
#include "texture/strokes/parcels.h"

namespace belvedere {
namespace {

constexpr double tone_step = 0.17;              // to the darker and the lighter picture
constexpr double range_sigma_units = 14.0;      // width of mist behind an edge
constexpr double krummholz_sigma_units = 12.0;  // dwarf pine stands about the treeline
constexpr double brook_sigma_units = 1.8;       // what this blur of the water leaves pale is a brook
constexpr float garden_share = 0.80F;           // of a village's ground: houses stand out from green …
constexpr float town_garden_share = 0.30F;      // … and of the middle of a town
constexpr float melting_units = 5.0F;           // fields that look narrower than this melt into bands
constexpr float unknown_sky_depth_m = 92000.0F;
constexpr float far_air = 0.34F;  // more air where ranges lie one behind the other, crests as well

using Class = LandCoverClass;

struct GroundNoises {
  explicit GroundNoises(std::uint64_t seed) : n3(seed + 20, 60.0), n8(seed + 21, 210.0), n25(seed + 22, 660.0), n60(seed + 23, 1800.0) {}
  GroundNoise n3, n8, n25, n60;
};

// Noise at one place; each fades where its patches become smaller than a stroke.
struct Patches {
  float n3, n8, n25, n60;
};

// 1 where `size_m` covers two units of the sheet or more, 0 where it covers less than 2/3.
float visible(float size_m, float metres_per_unit) { return std::clamp(1.5F - metres_per_unit / size_m, 0.0F, 1.0F); }

Patches patches_at(GroundNoises& noises, glm::dvec3 place, float metres_per_unit) {
  Patches p{};
  p.n3 = noises.n3(place.x, place.y) * visible(60.0F, metres_per_unit);
  p.n8 = noises.n8(place.x, place.y) * visible(210.0F, metres_per_unit);
  p.n25 = noises.n25(place.x, place.y);
  p.n60 = noises.n60(place.x, place.y);
  return p;
}

// Factor of the fields on the colour of the valley floor: crops, darker borders, pale lanes. Towards the slopes meadow takes over, far away
// fields melt into bands; `drift` is the scene's wish for hue.
glm::vec3 field_colour(const GuidanceBuffers& g, std::size_t i, const Parcel& parcel, float metres_per_unit, float haze, float drift) {
  const float slope = g.slope_deg.empty() ? 0.0F : g.slope_deg[i];
  const float level = std::clamp((5.5F - slope) / 2.5F, 0.0F, 1.0F);
  const float units = metres_per_unit > 0.0F ? parcel.width_m / metres_per_unit : 100.0F;
  const float apart = (0.55F + 0.60F * std::clamp(units / melting_units - 1.0F, 0.0F, 1.0F)) * (1.0F - 0.35F * std::min(haze, 1.0F));
  const glm::vec3 crop = crop_colour(parcel.crop) * (1.0F + 0.035F * parcel.shade);
  glm::vec3 colour = glm::mix(mean_crop_colour(), crop, apart);
  const float edge = std::clamp(1.0F - parcel.border_m / (0.10F * parcel.width_m), 0.0F, 1.0F);
  colour *= 1.0F - edge * apart * (parcel.hedged ? 0.13F : 0.05F);
  const float lane = std::clamp(1.0F - parcel.lane_m / (0.06F * parcel.width_m), 0.0F, 1.0F);
  if (!parcel.hedged) colour = glm::mix(colour, glm::vec3(1.02F, 0.99F, 1.05F), 0.55F * lane * apart);
  colour = glm::mix(crop_colour(Crop::hay), colour, level);
  return 1.0F + (colour - 1.0F) * drift;
}

// Grasses: + turns towards ripe yellow, - towards green.
float field_shift(Class id, const Patches& p) {
  switch (id) {
    case Class::valley_floor:
      return 0.12F * p.n8;
    case Class::pasture:
      return 0.20F * p.n8 + 0.12F * p.n3 + 0.12F * p.n25 - 0.15F;
    case Class::alpine_grass:
      return 0.22F * p.n8 + 0.14F * p.n3 + 0.12F * p.n25 - 0.15F;
    case Class::shrub:
      return 0.22F * p.n8 + 0.14F * p.n3 + 0.10F * p.n25 - 0.05F;
    default:
      return 0.0F;
  }
}

// High grass is fresh and dark where water gathers and bleached on ridges: added to the shift towards ripe yellow.
float dryness(const GuidanceBuffers& g, Class id, std::size_t i) {
  if (id != Class::alpine_grass && id != Class::pasture && id != Class::shrub) return 0.0F;
  const float relief = std::clamp(g.relief_s_m[i] / 12.0F, -1.0F, 1.0F);
  return (relief > 0.0F ? 0.16F : 0.24F) * relief;
}

// What that shift adds to a colour: ripe grass is yellow, fresh grass green, not blue.
glm::vec3 field_turn(float shift) { return (shift > 0.0F ? glm::vec3(0.11F, 0.02F, -0.10F) : glm::vec3(0.10F, 0.01F, 0.02F)) * shift; }

// Slow drift of hue, as factors of the colour.
glm::vec3 hue_drift(Class id, const Patches& p, const Palette& palette, float strength) {
  glm::vec3 factor(1.0F);
  switch (id) {
    case Class::valley_floor:
    case Class::forest:
    case Class::alpine_grass:
    case Class::pasture:
    case Class::shrub:
    case Class::scree:
    case Class::rock: {
      const float drift = std::clamp(0.7F * p.n60 + 0.5F * p.n25, -2.0F, 2.0F) * static_cast<float>(palette.ground_drift_share) * strength;
      factor *= 1.0F + glm::vec3(0.035F, 0.02F, -0.03F) * drift;
      break;
    }
    default:
      break;
  }
  if (id == Class::rock) {
    const float drift = std::clamp(0.6F * p.n25 + 0.4F * p.n8, -1.0F, 1.6F) * static_cast<float>(palette.rock_drift_share) * strength;
    factor *= 1.0F + glm::vec3(0.042F, 0.0F, -0.045F) * drift;
  }
  if (id == Class::forest) {
    const float drift = std::clamp(0.7F * p.n25 + 0.5F * p.n8, -1.5F, 1.5F) * static_cast<float>(palette.forest_drift_share) * strength;
    factor *= 1.0F + glm::vec3(0.07F, 0.01F, -0.05F) * drift;
  }
  return factor;
}

// How far the warm foreground reaches: full up to .82 of where air begins, nothing at 1.85 of it (28 and 63 km for 34 km).
float warmth(const BaseParameters& p, double depth_m) {
  if (p.haze_from_m <= 0.0) return 0.0F;
  return static_cast<float>(std::clamp(1.0 - (depth_m - 0.82 * p.haze_from_m) / (1.03 * p.haze_from_m), 0.0, 1.0));
}

// Greens of the middle distance lose their freshness before air veils them: 0 near … 1 from where air begins.
float staleness(Class id, const BaseParameters& p, double depth_m) {
  if (p.haze_from_m <= 0.0) return 0.0F;
  switch (id) {
    case Class::valley_floor:
    case Class::forest:
    case Class::alpine_grass:
    case Class::pasture:
    case Class::shrub:
      return static_cast<float>(std::clamp((depth_m - 0.75 * p.haze_from_m) / (0.75 * p.haze_from_m), 0.0, 1.0));
    default:
      return 0.0F;
  }
}

// 0 in the foreground … 1 where ranges lie one behind the other in the air.
float farness(const BaseParameters& p, double depth_m) {
  return static_cast<float>(std::clamp((depth_m - p.haze_from_m - 0.30 * p.haze_scale_m) / (0.5 * p.haze_scale_m), 0.0, 1.0));
}

// Air turns from its near to its far colour between 30 and 100 km for the default distances.
glm::vec3 air_colour(const BaseParameters& p, const Palette& palette, double depth_m) {
  const double near_m = 0.88 * p.haze_from_m;
  const double far_m = p.haze_from_m + 1.06 * p.haze_scale_m;
  return glm::mix(palette.haze_near, palette.haze_far, static_cast<float>(std::clamp((depth_m - near_m) / (far_m - near_m), 0.0, 1.0)));
}

// 1 at the rim of the terrain, 0 from `fade_m` inwards.
float rim_share(float rim_m, double fade_m) { return 1.0F - smoothstep(static_cast<float>(unit(rim_m / fade_m))); }

// How the terrain ends: not in a cliff, and not rubbed out either. Towards its end it stands ever deeper in air, so that mountains turn
// into blue silhouettes with their crests; only the last strip dissolves in what lies beyond, low ground before high.
constexpr float end_air = 0.86F;         // share of air at the very end
constexpr double dissolving = 0.38;      // the last strip, in shares of the fade
constexpr float crest_dissolves = 0.6F;  // at the very end, of what stands 260 m or more above its surroundings
struct TerrainEnd {
  float air;        // 0…1
  float dissolved;  // 0…1
};
TerrainEnd terrain_end(float rim_m, double fade_m, float height) {
  const float raised = std::clamp(height, 0.0F, 1.0F);
  return {end_air * rim_share(rim_m, fade_m), rim_share(rim_m, dissolving * fade_m) * (1.0F - (1.0F - crest_dissolves) * raised)};
}

// Log depth; the sky counts as little farther than the terrain below it, so that the skyline gets no halo.
Grid<float> log_depths(const GuidanceBuffers& g, int reach_px) {
  Grid<float> logs(g.width(), g.height());
  parallel_rows(g.height(), [&](int y) {
    for (int x = 0; x < g.width(); ++x) {
      float depth = g.depth_m(x, y);
      if (std::isinf(depth)) {
        depth = unknown_sky_depth_m;
        for (int k = 1; k <= reach_px && y + k < g.height(); ++k)
          if (!std::isinf(g.depth_m(x, y + k))) {
            depth = 1.02F * g.depth_m(x, y + k);
            break;
          }
      }
      logs(x, y) = std::log(std::max(depth, 1.0F));
    }
  });
  return logs;
}

// Light on the nearer side of a depth edge, ridges and hollows: where accents go.
float accent_at(const GuidanceBuffers& g, const Grid<float>& logs, int x, int y, int step_px) {
  const auto depth_log = [&](int nx, int ny) { return logs.clamped(nx, ny); };
  float jump = std::max(depth_log(x, y - step_px), std::max(depth_log(x - step_px, y), depth_log(x + step_px, y))) - logs(x, y);
  for (int k = 1; k <= 3; ++k) {
    const auto sky = [&](int nx, int ny) { return std::isinf(g.depth_m.clamped(nx, ny)); };
    // The skyline stays free of accents: a light rim against the sky looks cut out.
    if (sky(x, y - k * step_px) || sky(x - k * step_px, y) || sky(x + k * step_px, y)) jump = 0.0F;
  }
  const float edge = std::clamp(14.0F * jump, 0.0F, 1.0F);
  if (edge > 0.3F) return (g.tone(x, y) > 0.45F ? 0.8F : -0.8F) * edge;
  const float relief = std::clamp(g.relief_s_m(x, y) / 9.0F, -1.0F, 1.0F);
  switch (g.land_cover(x, y)) {
    case Class::rock:
      return 0.9F * relief;
    case Class::snow:
    case Class::glacier:
    case Class::scree:
      return 0.6F * relief;
    default:
      return 0.35F * relief;
  }
}

// Dwarf pines on alpine grass and shrubland; `wood` is the share of forest around. Forest has its own: forest_cover.h.
float bush_density_at(Class id, float wood, const Patches& p) {
  if (id == Class::alpine_grass) return std::clamp(0.75F * wood + 0.06F * p.n3 * (wood > 0.02F ? 1.0F : 0.0F), 0.0F, 0.35F);
  if (id == Class::shrub) return std::clamp(0.45F + 0.22F * p.n8 + 0.12F * p.n3, 0.1F, 0.85F);
  return 0.0F;
}

// Grass among trees: a little darker than that of the open.
glm::vec3 glade_colour(const Palette& palette, double altitude, double light) {
  return palette_colour(palette, altitude > 1600.0 ? Class::alpine_grass : Class::pasture, altitude, light - 0.06);
}

void check_channels(const GuidanceBuffers& g) {
  const auto& size = g.depth_m;
  if (!size.same_size(g.position_m) || !size.same_size(g.altitude_m) || !size.same_size(g.land_cover) || !size.same_size(g.tone) ||
      !size.same_size(g.relief_s_m) || !size.same_size(g.fall_line))
    throw Error(ErrorKind::bug, "base picture", "a guidance channel is missing or has another size",
                "depth, position, altitude, land cover, fall line, tone and relief");
}

// What all three tones of a pixel have in common.
struct PixelColour {
  glm::vec3 added;   // fields
  glm::vec3 factor;  // drift of hue, warm foreground
  glm::vec3 air;
  float haze;
  float stale;  // greens: how much of their freshness is gone, 0…1
  float mist;
  float dark;  // the near side of an edge between ranges
  TerrainEnd end;
  glm::vec3 beyond;  // what is seen where the terrain has ended

  glm::vec3 finish(glm::vec3 colour, glm::vec3 range_mist) const {
    colour = glm::clamp(colour + added, 0.0F, 1.0F) * factor;
    const float grey = 0.30F * colour.r + 0.59F * colour.g + 0.11F * colour.b;
    colour = glm::mix(colour, glm::vec3(1.03F, 0.99F, 1.04F) * grey, 0.12F * stale);
    colour = glm::mix(colour, air, haze);
    colour = glm::mix(colour, range_mist, mist);
    colour = glm::mix(colour, air, end.air);
    colour = glm::clamp(colour * (1.0F - glm::vec3(0.40F, 0.35F, 0.27F) * dark), 0.0F, 1.0F);
    return glm::mix(colour, beyond, end.dissolved);
  }
};

// Banks of gravel where a river has thrown them up, here and there; `around` is the share of water nearby.
float gravel_share(float around, const Patches& p) {
  return 0.8F * std::clamp((around - 0.08F) / 0.25F, 0.0F, 1.0F) * std::clamp(0.15F + 0.8F * p.n8 + 0.6F * p.n25, 0.0F, 1.0F);
}
glm::vec3 gravel_colour(double light) {
  return glm::vec3(0.93F, 0.91F, 0.86F) * static_cast<float>(0.55 + 0.45 * std::clamp(light, 0.0, 1.0));
}

// How water differs from its ramp.
struct WaterLook {
  glm::vec3 image;    // what is mirrored
  float image_share;  // 0…1
  glm::vec3 bank;     // grass and gravel that a brook runs through
  float bank_share;   // 0…1
  float tone_shift;   // streaks of wind and light
  glm::vec3 shallow;  // pale bed seen through
  float shallow_share;

  glm::vec3 over(glm::vec3 colour) const {
    return glm::mix(glm::mix(glm::mix(colour, image, image_share), shallow, shallow_share), bank, bank_share);
  }
};

// `around` is the share of water nearby: brooks are thin and lose themselves between gravel and grass, lakes mirror.
WaterLook water_look(const GuidanceBuffers& g, const Palette& palette, const Mirrored& mirrored, std::size_t i, float around, float streak,
                     const Patches& p) {
  WaterLook look{};
  const float thin = std::clamp((0.52F - around) / 0.3F, 0.0F, 1.0F);
  look.bank = palette_colour(palette, palette.winter ? Class::snow : Class::valley_floor, g.altitude_m[i], g.tone[i]);
  look.bank_share = thin * std::clamp(0.12F + 0.40F * p.n25 + 0.2F * p.n8, 0.0F, 0.8F);
  // Paler towards the horizon, deep below the viewer; the shallows at the near bank and the dark line under the far one.
  const float far = std::min(mirrored.to_far[i], 60.0F);
  const float near = std::min(mirrored.to_near[i], 60.0F);
  look.tone_shift = (0.09F * streak + 0.26F * (near / (near + far) - 0.5F)) * (1.0F - thin);
  look.tone_shift -= 0.30F * std::clamp(1.7F - far, 0.0F, 1.0F) * (1.0F - thin);
  look.shallow_share = 0.38F * std::clamp(2.1F - near, 0.0F, 1.0F) * (1.0F - thin);
  look.shallow = palette.winter ? glm::vec3(0.86F, 0.90F, 0.94F) : glm::vec3(0.78F, 0.83F, 0.74F);
  if (mirrored.source[i] < 0) return look;
  const auto from = static_cast<std::size_t>(mirrored.source[i]);
  // An image in water is darker and bluer than what it is of.
  const glm::vec3 image = palette_colour(palette, g.land_cover[from], g.altitude_m[from], 0.75 * static_cast<double>(g.tone[from]));
  look.image = image * glm::vec3(0.80F, 0.90F, 0.98F);
  look.image_share = std::clamp((0.85F + 0.12F * streak) * mirrored.share[i], 0.0F, 0.9F) * (1.0F - thin);
  return look;
}

}  // namespace

double haze_share(const BaseParameters& p, double depth_m, double altitude_m) {
  const double beyond = std::max(depth_m - p.haze_from_m, 0.0) / p.haze_scale_m;
  const double by_distance = 1.0 - std::exp(-std::pow(beyond, 1.35));
  // Summits stand out of the air, valleys fill with it.
  const double by_altitude = 0.58 + 0.42 * std::exp(-std::max(altitude_m - p.haze_floor_m, 0.0) / 900.0);
  return p.haze * by_distance * by_altitude;
}

PaintGround make_paint_ground(const GuidanceBuffers& guidance, const Palette& palette, const BaseParameters& parameters,
                              glm::ivec2 origin_px, glm::ivec2 picture_size, Progress& progress) {
  check_channels(guidance);
  const int width = guidance.width();
  const int height = guidance.height();
  const double ppu = parameters.pixels_per_unit;
  progress.begin("base picture", height);

  const double range_sigma_px = range_sigma_units * ppu;
  const Grid<float> logs = log_depths(guidance, blur_reach_px(range_sigma_px));
  const Grid<float> mean_logs = blur_in_picture(logs, range_sigma_px, origin_px);
  Grid<float> is_forest(width, height, 0.0F);
  for (std::size_t i = 0; i < is_forest.size(); ++i) is_forest[i] = guidance.land_cover[i] == Class::forest ? 1.0F : 0.0F;
  const Grid<float> wood = blur_in_picture(is_forest, krummholz_sigma_units * ppu, origin_px);
  const ForestCover cover = make_forest_cover(guidance, {ppu, parameters.seed}, origin_px);

  Grid<float> is_water(width, height, 0.0F);
  for (std::size_t i = 0; i < is_water.size(); ++i) is_water[i] = guidance.land_cover[i] == Class::water ? 1.0F : 0.0F;
  const Grid<float> waters = blur_on_surface(is_water, guidance.depth_m, brook_sigma_units * ppu);
  const Mirrored mirrored = find_reflections(guidance, ppu);
  const Grid<float> streaks = make_image_noise(parameters.seed + 29, origin_px, width, height, ppu, 26.0, 1.6);

  SkyParameters sky_parameters{picture_size, parameters.horizon_px, parameters.clouds, parameters.sun_image_x, parameters.seed};
  if (sky_parameters.horizon_px <= 0.0) sky_parameters.horizon_px = 0.18 * picture_size.y;
  const glm::dvec3 origin = guidance.origin_m;
  const Grid<glm::vec3> sky = make_sky(guidance.depth_m, palette, sky_parameters, origin_px);

  PaintGround ground;
  ground.colour = Grid<glm::vec3>(width, height);
  ground.darker = Grid<glm::vec3>(width, height);
  ground.lighter = Grid<glm::vec3>(width, height);
  ground.accent = Grid<float>(width, height, 0.0F);
  ground.tree_density = Grid<float>(width, height, 0.0F);
  ground.haze = Grid<float>(width, height, 0.0F);
  const bool has_rim = guidance.rim_m.same_size(guidance.depth_m) && parameters.rim_fade_m > 0.0;
  const bool has_footprint = guidance.footprint_m.same_size(guidance.depth_m);
  const int step_px = std::max(1, static_cast<int>(std::lround(ppu)));
  const auto far_share = static_cast<float>(std::min(1.0, parameters.haze / BaseParameters{}.haze * palette.haze_share));
  parallel_rows(height, [&](int y) {
    GroundNoises noises(parameters.seed);
    for (int x = 0; x < width; ++x) {
      const std::size_t i = sky.index(x, y);
      if (guidance.is_sky(i)) {
        ground.colour[i] = sky[i];
        ground.darker[i] = sky[i] * 0.97F;
        ground.lighter[i] = glm::min(sky[i] * 1.03F, glm::vec3(1.0F));
        continue;
      }
      const Class id = guidance.land_cover[i];
      const float metres_per_unit = has_footprint ? guidance.footprint_m[i] * static_cast<float>(ppu) : 0.0F;
      const Patches patches = patches_at(noises, glm::dvec3(guidance.position_m[i]) + origin, metres_per_unit);
      const double depth = guidance.depth_m[i];
      const double altitude = guidance.altitude_m[i];
      const float tone = guidance.tone[i];
      const auto drift = static_cast<float>(parameters.hue_drift);
      const float warm = warmth(parameters, depth) * static_cast<float>(parameters.warm_near * palette.warm_share) *
                         (id == Class::rock ? 0.60F : 1.0F) * tone;
      const auto mist = static_cast<float>(parameters.range_mist);
      const float behind = logs[i] - mean_logs[i];
      PixelColour pixel{};
      pixel.added =
          field_turn(field_shift(id, patches) + dryness(guidance, id, i)) * drift * static_cast<float>(palette.ground_drift_share);
      pixel.factor = hue_drift(id, patches, palette, drift) * (1.0F + glm::vec3(0.06F, 0.03F, -0.07F) * warm);
      pixel.stale = staleness(id, parameters, depth) * static_cast<float>(parameters.warm_near);
      pixel.air = air_colour(parameters, palette, depth);
      // Far ranges: the feet stand in mist and the crests out of it, and each hides the next in a step of light.
      const float far = farness(parameters, depth) * mist;
      const float raised = guidance.relief_l_m.empty() ? 0.0F : std::clamp(guidance.relief_l_m[i] / 260.0F, -1.0F, 1.0F);
      const float low = 1.0F - 0.75F * std::max(raised, 0.0F);  // mist lies in valleys, crests stay clear
      pixel.haze = static_cast<float>(std::clamp(haze_share(parameters, depth, altitude) * palette.haze_share, 0.0, 1.0));
      pixel.haze = std::clamp(pixel.haze * (1.0F - 0.30F * far * raised) - 0.06F * far * raised, 0.0F, 1.0F);
      pixel.haze += far_air * far_share * std::min(far, 1.0F) * (1.0F - pixel.haze);
      pixel.mist = std::clamp((3.0F + 5.0F * far) * behind, 0.0F, 0.35F + 0.20F * std::min(far, 1.0F)) * mist * low;
      pixel.dark = std::clamp(-(1.5F + 4.0F * far) * behind, 0.0F, 0.25F + 0.10F * std::min(far, 1.0F)) * mist;
      pixel.beyond = air_beyond(palette, (y + origin_px.y + 0.5) / sky_parameters.horizon_px);
      if (has_rim) pixel.end = terrain_end(guidance.rim_m[i], parameters.rim_fade_m, raised);
      const glm::vec2 grain = guidance.grain.empty() ? glm::vec2(0.0F) : guidance.grain[i];
      if (id == Class::valley_floor && !palette.winter) {
        const glm::dvec3 place = glm::dvec3(guidance.position_m[i]) + origin;
        const Parcel parcel = parcel_at(parameters.seed, place.x, place.y, metres_per_unit, grain);
        pixel.factor *= field_colour(guidance, i, parcel, metres_per_unit, pixel.haze, drift);
      }
      const float built = guidance.built.empty() ? 0.5F : std::clamp(guidance.built[i], 0.0F, 1.0F);
      const float green = garden_share + (town_garden_share - garden_share) * built;
      const glm::vec3 lawn = palette.winter ? glm::vec3(1.0F) : 1.0F + (crop_colour(Crop::grass) - 1.0F) * drift;
      const Class gardens = palette.winter ? Class::snow : Class::valley_floor;
      const float gravel = (id == Class::valley_floor || id == Class::pasture) && !palette.winter ? gravel_share(waters[i], patches) : 0.0F;
      WaterLook water{};
      if (id == Class::water) water = water_look(guidance, palette, mirrored, i, waters[i], streaks[i], patches);
      const auto paint = [&](double step) {
        const double light = tone + static_cast<double>(water.tone_shift) + step;
        glm::vec3 ramp = palette_colour(palette, id, altitude, light);
        if (cover.glade[i] > 0.0F) ramp = glm::mix(ramp, glade_colour(palette, altitude, light), 0.85F * cover.glade[i]);
        if (gravel > 0.0F) ramp = glm::mix(ramp, gravel_colour(light), gravel);
        if (id == Class::settlement) ramp = glm::mix(ramp, lawn * palette_colour(palette, gardens, altitude, light - 0.08), green);
        return pixel.finish(water.over(ramp), palette.range_mist);
      };
      ground.colour[i] = paint(0.0);
      ground.darker[i] = paint(-tone_step);
      ground.lighter[i] = paint(tone_step);
      ground.accent[i] = accent_at(guidance, logs, x, y, step_px);
      ground.tree_density[i] = id == Class::forest ? cover.density[i] : bush_density_at(id, wood[i], patches);
      ground.haze[i] =
          1.0F - (1.0F - pixel.haze) * (1.0F - std::min(pixel.mist, 1.0F)) * (1.0F - pixel.end.air) * (1.0F - pixel.end.dissolved);
    }
    progress.advance(1.0);
  });
  return ground;
}

int base_margin_px(const BaseParameters& parameters) {
  const double ppu = parameters.pixels_per_unit;
  const int ranges = 2 * blur_reach_px(range_sigma_units * ppu);  // the blur, and the sky's look down at the terrain
  const int woods = blur_reach_px(krummholz_sigma_units * ppu);
  const int waters = std::max(reflection_margin_px(ppu), blur_reach_px(brook_sigma_units * ppu));
  return std::max({ranges, woods, waters, forest_cover_margin_px(ppu)}) + 3 * static_cast<int>(std::ceil(ppu)) + 2;
}

}  // namespace belvedere
