#include "renderer/paint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "renderer/base/error.h"
#include "renderer/base/parallel.h"
#include "renderer/base/random.h"
#include "renderer/picture_filter.h"
#include "renderer/picture_noise.h"
#include "renderer/sky.h"

namespace belvedere {
namespace {

constexpr double tone_step = 0.17;              // to the darker and the lighter picture
constexpr double range_sigma_units = 14.0;      // width of mist behind an edge
constexpr double treeline_sigma_units = 5.0;    // forest thins towards its border …
constexpr double krummholz_sigma_units = 12.0;  // … and dwarf pine stands about it
constexpr float unknown_sky_depth_m = 92000.0F;

using Class = LandCoverClass;

struct GroundNoises {
  explicit GroundNoises(std::uint64_t seed) : n3(seed + 20, 60.0), n8(seed + 21, 210.0), n25(seed + 22, 660.0), n60(seed + 23, 1800.0) {}
  GroundNoise n3, n8, n25, n60;
};

// Noise at one place; each fades where its patches become smaller than a stroke.
struct Patches {
  float n3, n8, n25, n60;
  float parcel;  // of fields, -.5….5
};

// 1 where `size_m` covers two units of the sheet or more, 0 where it covers less than 2/3.
float visible(float size_m, float metres_per_unit) { return std::clamp(1.5F - metres_per_unit / size_m, 0.0F, 1.0F); }

Patches patches_at(GroundNoises& noises, glm::dvec3 place, float metres_per_unit, std::uint64_t seed) {
  Patches p{};
  p.n3 = noises.n3(place.x, place.y) * visible(60.0F, metres_per_unit);
  p.n8 = noises.n8(place.x, place.y) * visible(210.0F, metres_per_unit);
  p.n25 = noises.n25(place.x, place.y);
  p.n60 = noises.n60(place.x, place.y);
  // Parcels of 330 × 200 m in bent rows.
  const double along = (place.x + 180.0 * p.n25 - 0.35 * place.y) / 330.0;
  const double across = (-place.y + 150.0 * p.n60 - 0.25 * place.x) / 198.0;
  const auto random = static_cast<float>(
      random_uniform(seed + 24, static_cast<std::int64_t>(std::floor(along)), static_cast<std::int64_t>(std::floor(across))));
  p.parcel = (random - 0.5F) * visible(100.0F, metres_per_unit);
  return p;
}

// Fields and grasses: + turns towards ripe yellow, - towards green.
float field_shift(Class id, const Patches& p) {
  switch (id) {
    case Class::valley_floor:
      return p.parcel + 0.12F * p.n8;
    case Class::pasture:
      return 0.20F * p.n8 + 0.12F * p.n3 + 0.12F * p.n25 - 0.15F;
    case Class::alpine_grass:
      return 0.18F * p.n8 + 0.12F * p.n25 - 0.1F;
    case Class::shrub:
      return 0.22F * p.n8 + 0.14F * p.n3 + 0.10F * p.n25 - 0.05F;
    default:
      return 0.0F;
  }
}

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
    factor *= 1.0F + glm::vec3(0.028F, 0.0F, -0.035F) * drift;
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

// Air turns from its near to its far colour between 30 and 100 km for the default distances.
glm::vec3 air_colour(const BaseParameters& p, const Palette& palette, double depth_m) {
  const double near_m = 0.88 * p.haze_from_m;
  const double far_m = p.haze_from_m + 1.06 * p.haze_scale_m;
  return glm::mix(palette.haze_near, palette.haze_far, static_cast<float>(std::clamp((depth_m - near_m) / (far_m - near_m), 0.0, 1.0)));
}

// 1 at the rim of the terrain, 0 from `fade_m` inwards: the world does not end in a cliff but in haze.
float rim_share(float rim_m, double fade_m) {
  const auto t = static_cast<float>(std::clamp(rim_m / fade_m, 0.0, 1.0));
  return 1.0F - t * t * (3.0F - 2.0F * t);
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

// `forest` and `wood` are the shares of forest around, near and farther.
float tree_density_at(Class id, float forest, float wood, const Patches& p) {
  if (id == Class::forest) {
    const float border = 1.0F - std::clamp((forest - 0.5F) / 0.45F, 0.0F, 1.0F);
    const float clearing = 0.22F * std::clamp(0.7F * p.n3 + 0.7F * p.n8 - 0.5F, 0.0F, 1.0F);
    return std::clamp(0.95F - clearing - border * (p.n3 > 0.0F ? 0.60F : 0.40F), 0.25F, 1.0F);
  }
  if (id == Class::alpine_grass) return std::clamp(0.75F * wood + 0.06F * p.n3 * (wood > 0.02F ? 1.0F : 0.0F), 0.0F, 0.35F);
  if (id == Class::shrub) return std::clamp(0.45F + 0.22F * p.n8 + 0.12F * p.n3, 0.1F, 0.85F);
  return 0.0F;
}

void check_channels(const GuidanceBuffers& g) {
  const auto& size = g.depth_m;
  if (!size.same_size(g.position_m) || !size.same_size(g.altitude_m) || !size.same_size(g.land_cover) || !size.same_size(g.tone) ||
      !size.same_size(g.relief_s_m))
    throw Error(ErrorKind::bug, "base picture", "a guidance channel is missing or has another size",
                "depth, position, altitude, land cover, tone and relief");
}

// What all three tones of a pixel have in common.
struct PixelColour {
  glm::vec3 added;   // fields
  glm::vec3 factor;  // drift of hue, warm foreground
  glm::vec3 air;
  float haze;
  float mist;
  float dark;  // the near side of an edge between ranges
  glm::vec3 horizon;
  float rim;  // share of the horizon's air at the end of the terrain

  glm::vec3 finish(glm::vec3 colour, glm::vec3 range_mist) const {
    colour = glm::clamp(colour + added, 0.0F, 1.0F) * factor;
    colour = glm::mix(colour, air, haze);
    colour = glm::mix(colour, range_mist, mist);
    colour = glm::clamp(colour * (1.0F - 0.35F * dark), 0.0F, 1.0F);
    return glm::mix(colour, horizon, rim);
  }
};

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
  const Grid<float> forest = blur_on_surface(is_forest, guidance.depth_m, treeline_sigma_units * ppu);
  const Grid<float> wood = blur_in_picture(is_forest, krummholz_sigma_units * ppu, origin_px);

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
      const Patches patches = patches_at(noises, glm::dvec3(guidance.position_m[i]) + origin, metres_per_unit, parameters.seed);
      const double depth = guidance.depth_m[i];
      const double altitude = guidance.altitude_m[i];
      const float tone = guidance.tone[i];
      const auto drift = static_cast<float>(parameters.hue_drift);
      const float warm = warmth(parameters, depth) * static_cast<float>(parameters.warm_near * palette.warm_share) *
                         (id == Class::rock ? 0.60F : 1.0F) * tone;
      const auto mist = static_cast<float>(parameters.range_mist);
      const float behind = logs[i] - mean_logs[i];
      PixelColour pixel{};
      pixel.added = glm::vec3(0.11F, 0.02F, -0.10F) * field_shift(id, patches) * drift;
      pixel.factor = hue_drift(id, patches, palette, drift) * (1.0F + glm::vec3(0.06F, 0.03F, -0.07F) * warm);
      pixel.air = air_colour(parameters, palette, depth);
      pixel.haze = static_cast<float>(std::clamp(haze_share(parameters, depth, altitude) * palette.haze_share, 0.0, 1.0));
      pixel.mist = std::clamp(3.0F * behind, 0.0F, 0.35F) * mist;
      pixel.dark = std::clamp(-1.5F * behind, 0.0F, 0.25F) * mist;
      pixel.horizon = sky_gradient(palette, (y + origin_px.y + 0.5) / sky_parameters.horizon_px);
      pixel.rim = has_rim ? rim_share(guidance.rim_m[i], parameters.rim_fade_m) : 0.0F;
      ground.colour[i] = pixel.finish(palette_colour(palette, id, altitude, tone), palette.range_mist);
      ground.darker[i] = pixel.finish(palette_colour(palette, id, altitude, tone - tone_step), palette.range_mist);
      ground.lighter[i] = pixel.finish(palette_colour(palette, id, altitude, tone + tone_step), palette.range_mist);
      ground.accent[i] = accent_at(guidance, logs, x, y, step_px);
      ground.tree_density[i] = tree_density_at(id, forest[i], wood[i], patches);
      ground.haze[i] = 1.0F - (1.0F - pixel.haze) * (1.0F - std::min(pixel.mist, 1.0F)) * (1.0F - pixel.rim);
    }
    progress.advance(1.0);
  });
  return ground;
}

int base_margin_px(const BaseParameters& parameters) {
  const double ppu = parameters.pixels_per_unit;
  const int ranges = 2 * blur_reach_px(range_sigma_units * ppu);  // the blur, and the sky's look down at the terrain
  const int woods = blur_reach_px(krummholz_sigma_units * ppu);
  return std::max(ranges, woods) + 3 * static_cast<int>(std::ceil(ppu)) + 2;
}

}  // namespace belvedere
