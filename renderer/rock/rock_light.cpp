#include "renderer/rock/rock_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/random.h"

namespace belvedere {
namespace {

constexpr float lift = 0.10F;
constexpr float fill_strength = 0.30F;  // sky and ground opposite the sun still model shaded rock
constexpr float flatness = 0.85F;       // how far a facet has a single normal
// Max change of the tone by each size, and how that differs in shade, which has large planes and
// little detail.
constexpr std::array<float, spur_sizes> max_tone = {0.50F, 0.13F, 0.055F};
constexpr std::array<float, spur_sizes> shade_factor = {2.2F, 1.6F, 0.8F};
constexpr float shade_tone = 0.24F;   // tone of painted walls in shade
constexpr float shade_drawn = 0.65F;  // how far tones are compressed towards it
constexpr float shade_lift =
    0.06F;  // what gullies and planes facing away from the light of the sky lose again
constexpr std::array<float, spur_sizes> calm_min = {1.0F, 0.6F, 0.25F};
// Lines of the three sizes, units: half widths of light crests and dark gullies, and their
// strength.
constexpr std::array<float, spur_sizes> crest_width = {0.84F, 0.60F, 0.36F};
constexpr std::array<float, spur_sizes> gully_width = {1.20F, 0.72F, 0.40F};
constexpr std::array<float, spur_sizes> crest_strength = {0.9F, 0.8F, 0.5F};
constexpr std::array<float, spur_sizes> gully_strength = {1.0F, 0.85F, 0.5F};
constexpr float cast_spacings = 0.40F;  // how far towards the sun a large spur is searched
constexpr float crest_light = 0.22F;
// Shares of rock around for patches about 6 and 14 units wide, and the share of the relief's light
// that remains on the smallest.
constexpr float small_patch = 0.12F;
constexpr float large_patch = 0.55F;
constexpr float min_of_patch = 0.35F;
constexpr float gully_dark = 0.34F;
constexpr float snow_paint = 0.95F;  // of what lies in snow

float hashed(std::uint32_t id, std::uint64_t salt) {
  return static_cast<float>(mix_bits((static_cast<std::uint64_t>(id) << 8U) + salt) >> 40U) *
         0x1.0p-24F;
}

// Share of a size that is drawn: none where a spur is only a pixel or two wide.
float drawn(const RockKind& kind, int size, const RockPixel& p) {
  return smoothstep(1.6F, 4.5F, spur_spacing(kind, size, p.band) * p.scale);
}

struct Sun {
  const ToneParameters& light;
  glm::vec3 sun;
  glm::vec3 fill;  // towards the sky opposite
  float strength;  // of sunlight

  Sun(const ToneParameters& p, const RockPixel& at)
      : light(p),
        sun(at.own_light ? at.own_light->sun : p.sun_direction),
        fill(glm::normalize(glm::vec3(-sun.x, -sun.y, 0.35F))),
        strength(static_cast<float>(p.light.sun) * (at.own_light ? at.own_light->strength : 1.0F)) {
  }

  float facing(glm::vec3 normal) const {
    const auto wrap = static_cast<float>(light.wrap);
    return unit((glm::dot(normal, sun) + wrap) / (1.0F + wrap));
  }
  // Tone of a normal on a wall that faces the sun by `wall`. The sunlight left in a cast shadow has
  // no direction: from the sun's side it would cancel the fill, and walls in shade would look like
  // felt.
  float operator()(glm::vec3 normal, float shadow, float sky_share, float wall) const {
    const float direct =
        facing(normal) * shadow +
        wall * (1.0F - static_cast<float>(light.light.shadow_depth)) * (1.0F - shadow);
    const float value = strength * direct +
                        static_cast<float>(light.light.sky) * sky_share * (0.6F + 0.4F * normal.z) +
                        fill_strength * (0.5F * glm::dot(normal, fill) + 0.2F);
    return middle_tone +
           ((value - raw_black) / raw_range - middle_tone) *
               class_info(LandCoverClass::rock).tone.contrast +
           lift;
  }
};

// The bed at a position: how strongly it is drawn, and the position in the bed, 0 its foot … 1 its
// upper edge.
struct Bed {
  float shown = 0.0F;
  float height = 0.0F;
  float strong = 0.0F;  // 0…1, of this bed
};

Bed bed_at(const RockKind& kind, const RockPixel& p, const SpurHits& hits) {
  Bed bed;
  const float steep = smoothstep(28.0F, 42.0F, p.slope_deg);
  if (steep <= 0.0F || kind.beds <= 0.0F || hits[0].spur == nullptr) return bed;
  // Thickness in metres is a power of two, so that a bed keeps it along a wall; a bed seen from
  // above looks thinner.
  constexpr float foreshortened = 0.75F;
  const float wanted_m =
      std::max(kind.bed_mm * units_per_mm * p.metres_per_unit * foreshortened, 0.5F);
  float thick_m = 1.0F;
  while (thick_m * 1.4142F < wanted_m) thick_m *= 2.0F;
  const std::uint32_t large = hits[0].spur->id;
  const std::uint32_t small = hits[1].spur != nullptr ? hits[1].spur->id : 0U;
  // Beds are offset slightly at every gully, unless they continue through.
  const float thrown =
      (1.0F - kind.through) * (hashed(large, 7) + 0.5F * (hashed(small, 3) - 0.5F)) +
      kind.through * 0.10F * hashed(large, 7);
  const auto phase =
      static_cast<float>((static_cast<double>(p.altitude_m) + 0.10 * p.east_m + 0.05 * p.north_m) /
                         static_cast<double>(thick_m)) +
      thrown + 0.18F * p.bed_noise;
  const float number = std::floor(phase);
  bed.height = phase - number;
  const auto bed_id = static_cast<std::uint32_t>(static_cast<std::int32_t>(number));
  const float of_all = hashed(bed_id, 91);
  const float of_spur = hashed(bed_id * 0x9e3779b9U ^ large, 91);
  bed.strong = kind.through * of_all + (1.0F - kind.through) * of_spur;
  bed.shown =
      smoothstep(0.10F, 0.45F,
                 0.5F * p.bed_show + 0.9F * (bed.strong - 0.62F) + 0.25F + 0.3F * kind.through) *
      steep;
  if (hashed(bed_id * 0x85ebca6bU ^ small, 92) > 0.75F + 0.25F * kind.through) bed.shown = 0.0F;
  bed.shown = std::min(1.0F, bed.shown * kind.beds);
  return bed;
}

// Old snow in summer lies on level or hollow rock, more of it the nearer a snow field is.
float old_snow(const RockPixel& p, glm::vec3 normal, float stands, float near) {
  const float level =
      smoothstep(0.62F, 0.66F, normal.z + 0.14F * (near - 0.55F) + 0.05F * p.cover_noise);
  const float hollow =
      smoothstep(0.22F, 0.40F, -0.8F * stands + 0.35F * (near - 0.6F) + 0.12F * p.cover_noise);
  return std::max(level, hollow);
}

// Winter snow: whole flanks of the larger spurs that are level enough, gullies between them while
// the wall can hold snow, and lines along strong beds; small spurs would strew it with flakes.
// Steep walls are bare rock: calm areas in the picture.
float winter_snow(const RockPixel& p, glm::vec3 large_normal, float stands, float strong_tread) {
  const float holds = 1.0F - smoothstep(54.0F, 74.0F, p.slope_deg + 6.0F * p.calm_noise);
  const float level =
      smoothstep(0.62F, 0.68F, large_normal.z + 0.04F * p.cover_noise + 0.05F * p.calm_noise);
  const float hollow = holds * smoothstep(0.13F, 0.29F, -0.8F * stands + 0.06F * p.cover_noise);
  const float on_tread = (0.35F + 0.65F * holds) * smoothstep(0.34F, 0.52F, strong_tread);
  return std::max({level, hollow, on_tread});
}

// Near walls are bare along the crests of large spurs, the steepest as a whole: ribs, no flecks.
constexpr float snow_holds_deg = 28.0F;  // on flanks
constexpr float snow_slides_deg = 57.0F;
constexpr float bare_crest = 0.46F;  // half width of a crest, spacings

float near_winter_snow(const RockPixel& p, const SpurHits& hits, float stands, float strong_tread) {
  const float steep = smoothstep(snow_holds_deg, snow_slides_deg,
                                 p.slope_deg + 4.0F * std::clamp(p.wall_noise, -1.5F, 1.5F));
  const SpurHit& large = hits[0];
  const float crest = large.spur == nullptr || large.part == SpurPart::foot
                          ? 0.0F
                          : unit(1.0F - std::abs(large.across) / bare_crest);
  const float bare = 1.20F * steep + 0.55F * (crest - 0.5F) + 0.30F * stands +
                     0.07F * p.calm_noise + 0.02F * p.cover_noise;
  const float on_tread = smoothstep(0.45F, 0.75F, p.rock) * smoothstep(0.44F, 0.60F, strong_tread);
  return std::max(1.0F - smoothstep(0.52F, 0.56F, bare), on_tread);
}

// The wall under a pixel, without its spurs, and its light.
struct LitWall {
  glm::vec3 base{0.0F};    // its normal
  float shadow = 0.0F;     // 1 lit by the sun
  float sky_share = 0.0F;  // 0…1
  float facing = 0.0F;     // Sun::facing of the base
};

// Light of the planes of all sizes on a pixel, largest first.
struct PlaneLight {
  float tone = 0.0F;
  float base_tone = 0.0F;        // of the wall without the planes
  glm::vec3 normal{0.0F};        // of the smallest plane
  glm::vec3 large_normal{0.0F};  // of the two larger sizes
};

PlaneLight light_planes(const RockKind& kind, const ToneParameters& light, const Sun& sun,
                        const RockPixel& p, const SpurHits& hits, const LitWall& on, float calm,
                        float stands) {
  const glm::vec3 base = on.base;
  // Axes of the wall: down its slope, and across it to the right of the picture.
  const glm::vec3 downhill(base.x * base.z, base.y * base.z, base.z * base.z - 1.0F);
  const float fall = glm::length(downhill);
  const glm::vec3 down = fall > 1e-4F ? downhill / fall : glm::vec3(0.0F);
  const glm::vec3 across = glm::cross(base, down);
  const float strength =
      static_cast<float>(light.ribs) * (0.35F + 0.65F * smoothstep(18.0F, 40.0F, p.slope_deg));

  float along_sum = 0.0F;
  float across_sum = 0.0F;
  float before = sun(base, on.shadow, on.sky_share, on.facing);
  const float shade = 1.0F - smoothstep(0.25F, 0.50F, before);
  PlaneLight lit{before, before, base, base};
  for (int size = 0; size < spur_sizes; ++size) {
    const auto k = static_cast<std::size_t>(size);
    const SpurHit& hit = hits[k];
    if (hit.spur == nullptr) break;
    const float share = drawn(kind, size, p);
    if (share <= 0.0F) break;
    const glm::vec2 f = hit.spur->fall;
    along_sum += kind.tilt[k] * 0.8F * (hit.slope.x * f.x + hit.slope.y * f.y);
    across_sum += kind.tilt[k] * (hit.slope.x * f.y - hit.slope.y * f.x);
    lit.normal = glm::normalize(base - (across * across_sum + down * along_sum) * strength);
    if (size <= 1) lit.large_normal = lit.normal;
    const float now = sun(lit.normal, on.shadow, on.sky_share, on.facing);
    const float factor = (1.0F + (shade_factor[k] - 1.0F) * shade) *
                         (calm_min[k] + (1.0F - calm_min[k]) * calm) * share;
    lit.tone += factor * soft_limit(now - before, max_tone[k]);
    before = now;
  }
  // Unchanged shade has no darker tones left for the dark side of a plane: it is compressed around
  // the tone of painted shade.
  lit.tone += shade * (shade_lift + shade_drawn * (shade_tone - lit.base_tone)) +
              0.06F * std::clamp(2.0F * stands, -1.0F, 1.0F);
  return lit;
}

// Beds: light treads over dark undercuts. Adds to the tone and returns how far the pixel is on a
// tread.
float light_bed(const RockKind& kind, const Sun& sun, const RockPixel& p, const Bed& bed,
                const LitWall& on, float& tone) {
  if (bed.shown <= 0.0F) return 0.0F;
  const float lit = unit((tone - 0.12F) / 0.5F);
  const float tread = bed.shown * smoothstep(0.66F, 0.69F, bed.height) *
                      (1.0F - smoothstep(0.84F + 0.1F * bed.strong, 0.98F, bed.height));
  const float under = bed.shown * smoothstep(0.40F, 0.62F, bed.height) *
                      (1.0F - smoothstep(0.64F, 0.67F, bed.height));
  const glm::vec3 to_sky =
      glm::normalize(glm::mix(p.normal, glm::vec3(0.0F, 0.0F, 1.0F), kind.tread));
  const float open = sun(to_sky, on.shadow, on.sky_share, on.facing);
  tone += tread * 0.75F * (std::max(open, tone + 0.05F) - tone) * (0.45F + 0.55F * lit) -
          under * 0.28F * (0.4F + 0.6F * lit);
  return tread;
}

// Turf and snow lie where the ground is flat enough, in the amount found nearby.
void cover_rock(RockLook& look, const RockPixel& p, const SpurHits& hits, const PlaneLight& planes,
                bool winter, float stands, float tread, float strong_bed) {
  const float turf_near = smoothstep(0.04F, 0.35F, p.turf);
  if (turf_near > 0.0F && !winter)
    look.turf =
        0.5F * std::max(smoothstep(0.35F, 0.5F, tread) * smoothstep(0.3F, 0.6F, turf_near),
                        turf_near * smoothstep(0.66F, 0.72F,
                                               planes.normal.z + 0.12F * (turf_near - 0.6F) +
                                                   0.05F * p.cover_noise));
  const float close = close_share(p.metres_per_unit);
  if (winter && close > 0.5F) {
    look.snow = snow_paint * near_winter_snow(p, hits, stands, tread * strong_bed);
    return;
  }
  const float field_near = smoothstep(0.03F, 0.40F, p.snow);
  const float snow_near = winter ? std::max(0.75F, field_near) : field_near;
  if (snow_near > 0.0F)
    look.snow = snow_paint * snow_near *
                (winter ? winter_snow(p, planes.large_normal, stands, tread * strong_bed)
                        : old_snow(p, planes.normal, stands, snow_near)) *
                // Near ribs that snow leaves are dark.
                (winter ? 1.0F : 1.0F - 0.65F * close);
}

// Lines of brushwork: light on crests, dark in gullies, 0…1.
struct RockLines {
  float crest = 0.0F;
  float gully = 0.0F;
};

// Interrupted along their length; there are fewer in calm areas.
RockLines draw_rock_lines(const RockKind& kind, const RockPixel& p, const SpurHits& hits,
                          float calm) {
  RockLines lines;
  const float busy = smoothstep(0.45F, 0.85F, calm);
  const std::array<float, spur_sizes> few = {1.0F, 0.45F + 0.55F * busy, 0.8F * busy};
  const float broken = 0.5F + 0.5F * std::clamp(0.48F * p.line_noise + 0.2F, -1.0F, 1.0F);
  const float soft_edge = 0.9F / p.scale * 0.5F + 0.18F;
  for (int size = 0; size < spur_sizes; ++size) {
    const auto k = static_cast<std::size_t>(size);
    const SpurHit& hit = hits[k];
    if (hit.spur == nullptr) break;
    const float share = drawn(kind, size, p) * few[k];
    if (share <= 0.0F) break;
    const float spacing = spur_spacing(kind, size, p.band);
    const float zoom = std::min(1.0F, spur_band_table[static_cast<std::size_t>(p.band)].factor);
    if (hit.part == SpurPart::back && hashed(hit.spur->id, 9) < 0.75F) {
      const float width = crest_width[k] * zoom * (0.3F + 0.9F * broken);
      const float near = 1.0F - smoothstep(width - 0.04F, width + 2.0F * soft_edge,
                                           std::abs(hit.across) * spacing);
      lines.crest = std::max(lines.crest, share * crest_strength[k] * near *
                                              unit(1.0F - 0.5F * std::abs(hit.along - 0.5F)) *
                                              (0.4F + 0.6F * broken));
    }
    if (hashed(hit.spur->id * 13U + hit.next_id, 11) < 0.8F) {
      const float width = gully_width[k] * zoom * (0.15F + broken);
      const float near = 1.0F - smoothstep(width - 0.08F, width + 2.0F * soft_edge,
                                           hit.over_next / (2.0F * hit.steepness) * spacing);
      lines.gully =
          std::max(lines.gully, share * gully_strength[k] * near * (0.35F + 0.65F * broken));
    }
  }
  // A ramp: a light tread over a dark undercut.
  if (hits.ramp_strength > 0.0F) {
    const float d = hits.below_ramp;
    const float on_tread =
        smoothstep(-3.2F * broken - 0.8F, -0.4F, d) * (1.0F - smoothstep(-0.2F, 0.3F, d));
    const float undercut =
        smoothstep(-0.2F, 0.3F, d) * (1.0F - smoothstep(0.8F, 1.2F + 3.0F * broken, d));
    lines.crest = std::max(lines.crest, 0.8F * hits.ramp_strength * on_tread);
    lines.gully = std::max(lines.gully, 0.9F * hits.ramp_strength * undercut);
  }
  return lines;
}

}  // namespace

float stands_out(const SpurHits& hits) {
  const auto raised = [](const SpurHit& hit) {
    return hit.spur == nullptr
               ? 0.0F
               : std::min(hit.over_next / (2.0F * hit.steepness) / 0.40F, 1.0F) - 0.5F;
  };
  return 0.85F * raised(hits[0]) + 0.35F * raised(hits[1]);
}

SunPath way_to_sun(const RockKind& kind, const ToneParameters& light, const RockPixel& p,
                   const SpurHits& hits) {
  SunPath way;
  if (hits[0].spur == nullptr) return way;
  const glm::vec3 normal = hits[0].spur->normal;
  const glm::vec3 sun(p.own_light ? p.own_light->sun : light.sun_direction);
  const float out = glm::dot(normal, sun);
  const glm::vec3 downhill(normal.x * normal.z, normal.y * normal.z, normal.z * normal.z - 1.0F);
  const float fall = glm::length(downhill);
  if (out <= 0.02F || fall < 0.2F) return way;
  const glm::vec3 down = downhill / fall;
  const glm::vec3 across = glm::cross(normal, down);
  const float to_right = glm::dot(sun, across);
  const float to_foot = glm::dot(sun, down);
  const float level = std::sqrt(to_right * to_right + to_foot * to_foot);
  if (level < 0.05F) return way;
  const glm::vec2 f = hits[0].spur->fall;
  const glm::vec2 a(f.y, -f.x);
  way.offset =
      (a * to_right + f * to_foot) * (cast_spacings * spur_spacing(kind, 0, p.band) / level);
  way.gained = cast_spacings * out / level;
  return way;
}

float sun_past(const RockKind& kind, const SunPath& way, float height, float own_height,
               float close) {
  if (way.gained <= 0.0F || height < -1e8F) return 1.0F;
  const float over = 1.6F * kind.tilt[0] * (height - own_height) - way.gained;
  return 1.0F - (0.7F - 0.4F * close) * smoothstep(-0.02F, 0.14F + 0.40F * close, over);
}

RockLook light_rock(const RockKind& kind, const ToneParameters& light, bool winter,
                    const RockPixel& p, const SpurHits& hits, float sun_share) {
  const Sun sun(light, p);
  const float stands = stands_out(hits);
  LitWall wall{.base = p.normal};
  if (hits[1].spur != nullptr)
    wall.base = glm::normalize(p.normal * (1.0F - flatness) + hits[1].spur->normal * flatness);
  wall.sky_share =
      static_cast<float>(exact::pow(static_cast<double>(std::max(p.sky_view, 0.01F)), 1.3));
  // The edge of a cast shadow follows the spurs it falls on.
  wall.shadow = smoothstep(0.36F, 0.64F,
                           p.shadow + 0.22F * std::clamp(2.0F * stands, -1.0F, 1.0F) *
                                          (p.shadow > 0.02F && p.shadow < 0.98F ? 1.0F : 0.0F)) *
                sun_share;
  wall.facing = sun.facing(wall.base);

  const float calm = unit(0.55F + 0.42F * p.calm_noise);
  const PlaneLight planes = light_planes(kind, light, sun, p, hits, wall, calm, stands);
  // A patch of few units is too small for towers: it would glitter like a pebble.
  const float patch = smoothstep(small_patch, large_patch, p.rock);
  float tone = planes.base_tone +
               (planes.tone - planes.base_tone) * (min_of_patch + (1.0F - min_of_patch) * patch);
  const Bed bed = bed_at(kind, p, hits);
  const float tread = light_bed(kind, sun, p, bed, wall, tone);

  RockLook look;
  cover_rock(look, p, hits, planes, winter, stands, tread, bed.strong);
  const RockLines lines = draw_rock_lines(kind, p, hits, calm);
  const float lit = tone;
  look.tone =
      tone + (crest_light * lines.crest * patch * smoothstep(0.32F, 0.60F, lit) -
              gully_dark * lines.gully * patch * (0.45F + 0.55F * smoothstep(0.15F, 0.5F, lit)));
  return look;
}

}  // namespace belvedere
