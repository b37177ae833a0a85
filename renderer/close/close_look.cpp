#include "renderer/close/close_look.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "base/random.h"
#include "renderer/close/ice_streams.h"
#include "renderer/paint/ground/snow_relief.h"
#include "renderer/paint/picture_filter.h"
#include "renderer/paint/picture_noise.h"

namespace belvedere {
namespace {

// The sun is turned until its cosine to the large form lies between these, with their sines.
constexpr float max_facing = 0.62F;
constexpr float max_facing_sine = 0.785F;
constexpr float min_facing = 0.25F;
constexpr float min_facing_sine = 0.968F;
constexpr float wrap = 0.10F;

GroundLight light_of(const ToneParameters& parameters, const GuidanceBuffers& g, std::size_t i) {
  return ground_light(parameters, glm::dvec2(g.position_m[i]) + glm::dvec2(g.origin_m));
}

}  // namespace

SlopeFrame::SlopeFrame(glm::vec3 n) : normal(n) {
  const glm::vec3 fall = glm::vec3(n.x * n.z, n.y * n.z, n.z * n.z - 1.0F);
  const float length = std::sqrt(glm::dot(fall, fall));
  if (length < 1e-4F) return;
  down = fall / length;
  across = glm::cross(n, down);
}

glm::vec3 SlopeFrame::tilted(glm::vec2 gradient, glm::vec2 fall) const {
  constexpr float along = 0.8F;
  const float to_right = gradient.x * fall.y - gradient.y * fall.x;
  const float downhill = along * (gradient.x * fall.x + gradient.y * fall.y);
  return glm::normalize(normal - across * to_right - down * downhill);
}

float RakingLight::facing(glm::vec3 normal) const {
  return unit((glm::dot(normal, sun) + wrap) / (1.0F + wrap));
}

RakingLight raking_light(const ToneParameters& parameters, const GuidanceBuffers& g, std::size_t i,
                         glm::vec3 mean, bool snow) {
  const GroundLight own = light_of(parameters, g, i);
  const glm::vec3 sun(own.sun);
  const float facing = glm::dot(mean, sun);
  RakingLight rake{sun};
  const bool too_near = facing > max_facing;
  if (too_near || (facing < min_facing && !snow)) {
    glm::vec3 across = sun - facing * mean;
    const float length = std::sqrt(glm::dot(across, across));
    constexpr float too_short = 0.05F;
    if (length < too_short) {
      // From where the sun stands above: any side is as good.
      const glm::vec3 side(-mean.y, mean.x, 0.1F);
      across = glm::normalize(side - glm::dot(side, mean) * mean);
    } else {
      across /= length;
    }
    rake.sun = too_near ? max_facing * mean + max_facing_sine * across
                        : min_facing * mean + min_facing_sine * across;
  }
  const float direct = static_cast<float>(parameters.light.sun) * own.strength;
  const float left = 1.0F - static_cast<float>(parameters.light.shadow_depth) *
                                (1.0F - (snow ? smoothstep(0.3F, 0.7F, g.shadow[i]) : g.shadow[i]));
  constexpr float min_strength = 0.34F;  // forms in cast shadow remain
  rake.strength = (snow ? 1.3F * direct * left : std::max(direct * left, min_strength)) / raw_range;
  return rake;
}

RakingLight sun_light(const ToneParameters& parameters, const GuidanceBuffers& g, std::size_t i,
                      float strength) {
  return {glm::vec3(light_of(parameters, g, i).sun), strength};
}

namespace {

using Class = LandCoverClass;

constexpr std::array<RoofSize, close_sizes> size_table = {{
    {.spacing_units = 44.0F, .slender = 0.45F, .lean_rad = 0.25F},
    {.spacing_units = 14.0F, .slender = 0.45F, .lean_rad = 0.25F},
    {.spacing_units = 6.5F, .slender = 0.25F, .lean_rad = 0.12F},
    {.spacing_units = 84.0F, .slender = 0.60F, .lean_rad = 0.35F},
    {.spacing_units = 48.0F, .slender = 0.60F, .lean_rad = 0.30F},
    {.spacing_units = 15.0F, .slender = 0.60F, .lean_rad = 0.30F},
    {.spacing_units = 36.0F, .slender = 0.80F, .lean_rad = 0.55F},
    {.spacing_units = 30.0F, .slender = 0.55F, .lean_rad = 0.40F},
    {.spacing_units = 74.0F, .slender = 0.60F, .lean_rad = 0.45F},
}};
constexpr bool lies_along_wind(std::size_t size) { return size >= slabs && size <= small_swells; }
constexpr CloseCover cover_with(std::size_t size) {
  return size == scree_roofs   ? CloseCover::scree
         : size >= grass_roofs ? CloseCover::grass
                               : CloseCover::snow;
}

constexpr double mean_normal_units = 14.0;  // deviation of the large form that light rakes
constexpr double dome_units = 56.0;         // … and of what domes and basins rise from
glm::vec2 position_of(const CloseScene& s, int x, int y, glm::dvec2 within) {
  const double ppu = s.ground.pixels_per_unit;
  return {static_cast<float>((s.origin_px.x + x + within.x) / ppu),
          static_cast<float>((s.origin_px.y + y + within.y) / ppu)};
}

RakingLight rake_at(const CloseScene& s, std::size_t i, glm::vec3 mean, bool snow) {
  return raking_light(s.parameters.light, s.guidance, i, mean, snow);
}

constexpr float one_light = 0.7F;  // how far a plane of snow has the light of its middle

// Forms that the wind has laid are worn: crisp at their crest, they run out before they meet.
constexpr float worn_height(std::size_t size) {  // above the next form, in spacings
  return size == slabs ? 0.42F : 0.20F;
}
constexpr float bend_units = 6.0F;  // of slabs: deviation of their crests from straight

// Gradient of one size, and its plane; `gully`: units from where it meets the next; `leader`: the
// form itself if it leads.
glm::vec2 form_at(const CloseScene& s, CloseSize size, glm::vec2 position, float depth_m,
                  FormLook& look, bool leads, float* gully = nullptr,
                  const Spur** leader = nullptr) {
  const SpurHit hit = highest_spur(s.roofs[size], size_table[size].slender, position, depth_m, 0);
  if (gully != nullptr)
    *gully = hit.over_next * size_table[size].spacing_units / (2.0F * hit.steepness);
  const std::uint32_t plane = hit.flank_id() * 5U + static_cast<std::uint32_t>(hit.part);
  look.edges = look.edges * 0x9e3779b1U + plane;
  if (leads) look.plane = hit.flank_id();
  if (leads && leader != nullptr) *leader = hit.spur;
  if (!lies_along_wind(size) || hit.spur == nullptr) return hit.slope;
  const glm::vec2 down = hit.spur->down;
  return smoothstep(0.0F, worn_height(size), hit.over_next) *
         (hit.slope - glm::dot(hit.slope, down) * down);
}

// The large form around a wide pixel's surface; `otherwise` where there is none.
glm::vec3 mean_at(const CloseScene& s, const std::array<Grid<float>, 3>& normals, int x, int y,
                  glm::vec3 otherwise) {
  glm::vec3 mean(0.0F);
  for (int k = 0; k < 3; ++k)
    mean[k] = value_on_surface(s.ground.wide, normals[static_cast<std::size_t>(k)],
                               s.origin_px.x + x, s.origin_px.y + y, s.guidance.depth_m(x, y));
  const float length = std::sqrt(glm::dot(mean, mean));
  return length > 0.1F ? mean / length : otherwise;
}

FormLook snow_look(const CloseScene& s, int x, int y, std::size_t i, glm::vec2 position,
                   glm::vec2 fall, glm::vec3 mean) {
  const GuidanceBuffers& g = s.guidance;
  const int u = x - s.made.x0;
  const int v = y - s.made.y0;
  glm::vec3 detail = 0.7F * g.normal_detail[i] + 0.3F * g.normal[i];
  detail.x *= 1.3F;
  detail.y *= 1.3F;
  const SlopeFrame frame(glm::normalize(detail));
  const float slope = g.slope_deg[i];
  const float depth_m = g.depth_m[i];
  // Nearly one or the other: mixed they would look like panes of glass over each other.
  const float steep = smoothstep(25.0F, 29.0F, slope + 2.0F * s.steepness(u, v));
  const float calm = smoothstep(-0.6F, 0.7F, s.calm(u, v));
  const float small_calm = smoothstep(-0.1F, 0.9F, s.small_calm(u, v));
  // Whole slopes are empty beside busy ones.
  const float quiet = 1.0F - 0.80F * smoothstep(0.25F, 0.95F, s.quiet(u, v));
  FormLook look;
  glm::vec2 broad(0.0F);
  glm::vec2 large(0.0F);
  glm::vec2 small(0.0F);
  const Spur* leader = nullptr;
  const float level = 1.0F - smoothstep(9.0F, 20.0F, slope);
  if (steep > 0.01F) {
    const float lively = 0.55F + 0.45F * smoothstep(24.0F, 38.0F, slope);
    large +=
        0.38F * steep * lively * quiet * form_at(s, ribs, position, depth_m, look, steep > 0.5F);
    small += 0.16F * steep * (0.4F + 0.6F * small_calm) * quiet *
             form_at(s, small_ribs, position, depth_m, look, false);
    if (slope > 36.0F)
      small += 0.24F * smoothstep(37.0F, 44.0F, slope) *
               form_at(s, flutes, position, depth_m, look, false);
  }
  if (steep < 0.99F) {
    // Level basins are held by broad slabs, bent as the wind turns, with few smaller swells.
    const glm::vec2 bent = bend_units * glm::vec2(s.small_calm(u, v), 0.6F * s.steepness(u, v));
    broad += 0.22F * (1.0F - steep) * (0.5F + 0.5F * level) *
             form_at(s, slabs, position + bent, depth_m, look, steep <= 0.5F && level > 0.6F);
    large += 0.38F * (1.0F - steep) * (0.35F + 0.65F * calm) * (1.0F - 0.65F * level) * quiet *
             form_at(s, swells, position, depth_m, look, steep <= 0.5F && level <= 0.6F, nullptr,
                     &leader);
    small += 0.10F * (1.0F - steep) * calm * small_calm * quiet *
             form_at(s, small_swells, position, depth_m, look, false);
  }
  const RakingLight rake = rake_at(s, i, mean, true);
  const glm::vec3 under = frame.tilted(broad, fall);
  const glm::vec3 wide = frame.tilted(broad + large, fall);
  const glm::vec3 all = frame.tilted(broad + large + small, fall);
  const float lit = smoothstep(0.35F, 0.75F, rake.facing(frame.normal) * g.shadow[i]);
  // Domes and basins, which full light would leave blank.
  const glm::vec3 base = mean_at(s, s.dome_normal, x, y, mean);
  const float dome = (1.0F - smoothstep(14.0F, 24.0F, slope)) *
                     soft_limit(1.3F * rake_at(s, i, base, true)(mean, base), 0.24F);
  // A plane has one light, that of the ground in its middle: soft humps would look airbrushed.
  const float plane = leader == nullptr
                          ? 0.0F
                          : one_light * (1.0F - level) *
                                soft_limit(sun_light(s.parameters.light, g, i, rake.strength)(
                                               leader->normal, g.normal[i]),
                                           0.28F);
  // Broad basins lie in pools of light and shade, drawn out along the flow of their ice.
  const float pool =
      0.06F * level * std::clamp(s.quiet(u, v), -1.3F, 1.0F) +
      0.15F * level *
          value_on_surface(s.ground.wide, s.streams, s.origin_px.x + x, s.origin_px.y + y, depth_m);
  look.tone = plane + pool + lit * (soft_limit(0.55F * rake(frame.normal, mean), 0.16F) + dome) +
              soft_limit(rake(under, frame.normal), 0.22F) + soft_limit(rake(wide, under), 0.28F) +
              soft_limit(rake(all, wide), 0.11F);
  return look;
}

// A line of water between two forms: it comes and goes. Tone.
float runnel(const CloseScene& s, int x, int y, std::size_t i, float from_gully) {
  constexpr float half_width = 1.1F;
  if (from_gully >= half_width) return 0.0F;
  const float shown = smoothstep(0.0F, 0.8F, s.runnels(x - s.made.x0, y - s.made.y0)) *
                      smoothstep(16.0F, 24.0F, s.guidance.slope_deg[i]);
  return -0.11F * shown * (1.0F - from_gully / half_width);
}

// Lateral moraine: a ridge of rubble along the side of a glacier, where a certain share of ice lies
// around. Gradient of its height on the sheet.
glm::vec2 lateral_moraine(const CloseScene& s, int x, int y, float depth_m) {
  constexpr float aside_units = 1.5F;
  constexpr float half_share = 0.07F;
  constexpr float height = 0.75F;
  const WideView& wide = s.ground.wide;
  const auto share = [&](float dx, float dy) {
    const auto ppu = static_cast<float>(s.ground.pixels_per_unit);
    return value_on_surface(wide, s.ice.ice,
                            s.origin_px.x + x + static_cast<int>(std::lround(dx * ppu)),
                            s.origin_px.y + y + static_cast<int>(std::lround(dy * ppu)), depth_m);
  };
  const float own = share(0.0F, 0.0F);
  if (own < 0.02F || own > 0.32F) return {0.0F, 0.0F};
  const float raised = smoothstep(-1.4F, -0.2F, s.calm(x - s.made.x0, y - s.made.y0));
  const float at =
      0.11F + 0.03F * std::clamp(s.steepness(x - s.made.x0, y - s.made.y0), -1.0F, 1.0F);
  const float b = (own - at) / half_share;
  if (std::abs(b) >= 1.0F || raised <= 0.0F) return {0.0F, 0.0F};
  const glm::vec2 rise(share(aside_units, 0.0F) - share(-aside_units, 0.0F),
                       share(0.0F, aside_units) - share(0.0F, -aside_units));
  const glm::vec2 slope = -2.0F * b / half_share * height * raised * rise / (2.0F * aside_units);
  const float size = std::sqrt(glm::dot(slope, slope));
  constexpr float steepest = 0.8F;
  return size > steepest ? slope * (steepest / size) : slope;
}

FormLook scree_look(const CloseScene& s, int x, int y, std::size_t i, glm::vec2 position,
                    glm::vec2 fall, glm::vec3 mean) {
  const GuidanceBuffers& g = s.guidance;
  const SlopeFrame frame(glm::normalize(0.6F * g.normal_detail[i] + 0.4F * g.normal_smooth[i]));
  FormLook look;
  float gully = 1e9F;
  const float quiet = smoothstep(0.1F, 0.8F, s.quiet(x - s.made.x0, y - s.made.y0));
  glm::vec2 slope = 0.20F * (1.0F - 0.60F * quiet) *
                    form_at(s, scree_roofs, position, g.depth_m[i], look, false, &gully);
  const DebrisHit debris = debris_at(s.cones, s.ground.seed, position, g.depth_m[i]);
  if (debris.cone != nullptr) {
    slope = (1.0F - 0.75F * debris.inside) * slope + debris.inside * debris.slope;
    look.tone = debris.inside * debris.tone;
    look.edges = look.edges * 0x9e3779b1U + debris.cone->id;
    if (debris.inside > 0.25F) look.plane = debris.cone->id;
  } else {
    // Old stone between them is dark.
    look.tone = -0.07F - 0.09F * debris.beside;
  }
  slope += lateral_moraine(s, x, y, g.depth_m[i]);
  look.tone += (1.0F - debris.inside) * runnel(s, x, y, i, gully);
  look.tone += soft_limit(
      1.15F * rake_at(s, i, mean, false)(frame.tilted(slope, fall), frame.normal), 0.26F);
  return look;
}

// Narrow treads that cattle and creeping soil make along the contours of grass: the position in a
// step is 0 … 1 upwards.
float terracettes(const CloseScene& s, int x, int y, std::size_t i) {
  const GuidanceBuffers& g = s.guidance;
  const float slope = g.slope_deg[i];
  const float field = smoothstep(15.0F, 24.0F, slope) * (1.0F - smoothstep(36.0F, 44.0F, slope)) *
                      smoothstep(-0.1F, 0.7F, s.terraces(x - s.made.x0, y - s.made.y0));
  if (field <= 0.0F) return 0.0F;
  constexpr float rise_units = 2.2F;  // of a step on the sheet, about
  const float metres_per_unit = g.footprint_m[i] * static_cast<float>(s.ground.pixels_per_unit);
  const float wanted_m = std::max(0.2F, rise_units * metres_per_unit);
  float step_m = 0.25F;
  while (step_m * 1.4142F < wanted_m) step_m *= 2.0F;
  const glm::vec2 position = position_of(s, x, y, {0.5, 0.5});
  const float broken = broken_noise(stream_seed(s.ground.seed, Stream::close_calm, 9),
                                    position.x / 5.0F, position.y / 5.0F);
  const float phase = g.altitude_m[i] / step_m + 0.30F * broken;
  const float at = phase - std::floor(phase);
  const float riser = at < 0.30F ? (0.30F - at) / 0.30F : 0.0F;
  const float tread = at > 0.62F ? (at - 0.62F) / 0.38F : 0.0F;
  return field * (0.05F * tread - 0.06F * riser);
}

FormLook grass_look(const CloseScene& s, int x, int y, std::size_t i, glm::vec2 position,
                    glm::vec2 fall, glm::vec3 mean) {
  const GuidanceBuffers& g = s.guidance;
  const SlopeFrame frame(glm::normalize(0.45F * g.normal_detail[i] + 0.55F * g.normal_smooth[i]));
  const float steep = smoothstep(14.0F, 32.0F, g.slope_deg[i]);
  // Planes of unlike size: whole slopes without small ones.
  const float quiet = smoothstep(0.1F, 0.8F, s.quiet(x - s.made.x0, y - s.made.y0));
  const float amount = 0.42F * steep * (1.0F - 0.9F * quiet) *
                       smoothstep(-0.3F, 0.8F, s.calm(x - s.made.x0, y - s.made.y0));
  FormLook look;
  float gully = 1e9F;
  const glm::vec2 broad =
      0.21F * steep * form_at(s, grass_slopes, position, g.depth_m[i], look, false);
  const glm::vec2 slope =
      broad + amount * form_at(s, grass_roofs, position, g.depth_m[i], look, true, &gully);
  look.tone =
      0.4F * runnel(s, x, y, i, gully) +
      soft_limit(rake_at(s, i, mean, false)(frame.tilted(slope, fall), frame.normal), 0.22F) +
      terracettes(s, x, y, i);
  return look;
}

// A level direction on the ground, as on the sheet at a wide pixel; unit.
glm::vec2 on_sheet(const SpurGround& ground, glm::vec3 way, std::size_t i) {
  const SlopeFrame frame(ground.wide.seen.normal[i]);
  const glm::vec2 fall = ground.fall[i];
  constexpr float foreshortened = 0.5F;
  const glm::vec2 to = glm::dot(frame.across, way) * glm::vec2(fall.y, -fall.x) +
                       foreshortened * glm::dot(frame.down, way) * fall;
  const float length = std::sqrt(to.x * to.x + to.y * to.y);
  return length > 1e-3F ? to / length : glm::vec2(1.0F, 0.0F);
}

}  // namespace

CloseCover close_cover(LandCoverClass id, bool winter) {
  if (id == Class::scree && !winter) return CloseCover::scree;
  if (is_white(id, winter)) return CloseCover::snow;
  return is_open_ground(id) ? CloseCover::grass : CloseCover::other;
}

CloseScene make_close_scene(const GuidanceBuffers& guidance, const RockParameters& parameters,
                            const SpurGround& ground, const DebrisCones& cones,
                            const IceAround& ice, glm::ivec2 origin_px, PixelRect made,
                            const std::array<bool, close_covers>& present) {
  const double ppu = ground.pixels_per_unit;
  const std::uint64_t seed = parameters.light.seed;
  CloseScene scene{.guidance = guidance,
                   .parameters = parameters,
                   .ground = ground,
                   .origin_px = origin_px,
                   .made = made,
                   .warp = Warp(seed),
                   .cones = cones,
                   .ice = ice};
  const PixelRect sheet_rect = moved(made, origin_px.x, origin_px.y);
  const glm::vec3 wind(glm::vec2(snow_wind(parameters.light.sun_direction)), 0.0F);
  const auto down = [&](std::size_t i) { return std::optional(ground.fall[i]); };
  const auto along_wind = [&](std::size_t i) { return std::optional(on_sheet(ground, wind, i)); };
  const GuidanceBuffers& wide = ground.wide.seen;
  for (std::size_t k = 0; k < close_sizes; ++k)
    if (present[static_cast<std::size_t>(cover_with(k))])
      scene.roofs[k] = lies_along_wind(k)
                           ? grow_roofs(ground, size_table[k], k + 1, sheet_rect, along_wind)
                           : grow_roofs(ground, size_table[k], k + 1, sheet_rect, down);
  const PixelRect held{0, 0, wide.width(), wide.height()};
  const PixelRect read = moved(wide_rect(sheet_rect, ground.wide.factor), -ground.wide.origin_px.x,
                               -ground.wide.origin_px.y);
  for (std::size_t k = 0; k < 3; ++k) {
    Grid<float> part(wide.width(), wide.height());
    for (std::size_t i = 0; i < part.size(); ++i) part[i] = wide.normal[i][static_cast<int>(k)];
    const auto around = [&](double units) {
      return blur_on_surface(part, wide.depth_m, units * ppu / ground.wide.factor,
                             intersection(held, grown(surface_look(read), 1)));
    };
    scene.mean_normal[k] = around(mean_normal_units);
    if (present[static_cast<std::size_t>(CloseCover::snow)])
      scene.dome_normal[k] = around(dome_units);
  }
  if (present[static_cast<std::size_t>(CloseCover::snow)])
    scene.streams = ice_streams(ground, intersection(held, grown(surface_look(read), 1)));
  const auto noise = [&](std::uint64_t part, double sigma_x, double sigma_y) {
    return make_image_noise(stream_seed(seed, Stream::close_calm, part),
                            origin_px + glm::ivec2(made.x0, made.y0), made.width(), made.height(),
                            ppu, sigma_x, sigma_y);
  };
  scene.calm = noise(0, 42.0, 42.0);
  scene.small_calm = noise(1, 17.0, 17.0);
  scene.steepness = noise(2, 40.0, 40.0);
  scene.terraces = noise(3, 15.0, 6.0);
  scene.quiet = noise(4, 85.0, 60.0);
  scene.runnels = noise(5, 16.0, 22.0);
  return scene;
}

float close_forms_reach_units() {
  float reach = 0.0F;
  for (const RoofSize& size : size_table) reach = std::max(reach, roof_reach_units(size));
  return reach;
}

int streams_reach(double pixels_per_unit, int factor) {
  return ice_streams_reach(pixels_per_unit, factor) + surface_look_rows + 4;
}

int mean_normal_reach(double pixels_per_unit, int factor) {
  return surface_reach_px(dome_units * pixels_per_unit / factor) + surface_look_rows + 4;
}

FormLook look_at_form(const CloseScene& s, int x, int y, CloseCover cover, glm::dvec2 within) {
  const std::size_t i = s.guidance.depth_m.index(x, y);
  const WideView& wide = s.ground.wide;
  const int sheet_x = s.origin_px.x + x;
  const int sheet_y = s.origin_px.y + y;
  const glm::vec3 mean = mean_at(s, s.mean_normal, x, y, s.guidance.normal[i]);
  const glm::vec2 fall = s.ground.fall[wide.index(sheet_x, sheet_y)];
  const glm::vec2 position =
      s.warp(position_of(s, x, y, within), static_cast<float>(s.ground.pixels_per_unit));
  switch (cover) {
    case CloseCover::snow:
      return snow_look(s, x, y, i, position, fall, mean);
    case CloseCover::scree:
      return scree_look(s, x, y, i, position, fall, mean);
    case CloseCover::grass:
      return grass_look(s, x, y, i, position, fall, mean);
    case CloseCover::other:
      break;
  }
  return {};
}

}  // namespace belvedere
