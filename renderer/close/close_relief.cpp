#include "renderer/close/close_relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "base/math.h"
#include "base/parallel.h"
#include "base/random.h"
#include "base/random_streams.h"
#include "renderer/close/close_borders.h"
#include "renderer/paint/picture_filter.h"
#include "renderer/paint/picture_noise.h"
#include "renderer/rock/extent.h"
#include "renderer/rock/rock_view.h"

namespace belvedere {
namespace {

using Class = LandCoverClass;

enum class Cover : std::uint8_t { other, snow, scree, grass };

Cover cover_of(Class id, bool winter) {
  if (id == Class::scree && !winter) return Cover::scree;
  if (is_white(id, winter)) return Cover::snow;
  return is_open_ground(id) ? Cover::grass : Cover::other;
}

// Sizes of forms. Those of snow come in two directions: ribs down the fall line, swells along the
// wind; slabs are broad and low and hold the basins together.
enum Size : std::size_t {
  ribs,
  small_ribs,
  flutes,
  slabs,
  swells,
  small_swells,
  scree_roofs,
  grass_roofs,
  sizes
};
constexpr std::array<RoofSize, sizes> size_table = {{
    {.spacing_units = 44.0F, .slender = 0.45F, .lean_rad = 0.25F},
    {.spacing_units = 14.0F, .slender = 0.45F, .lean_rad = 0.25F},
    {.spacing_units = 6.5F, .slender = 0.25F, .lean_rad = 0.12F},
    {.spacing_units = 84.0F, .slender = 0.60F, .lean_rad = 0.35F},
    {.spacing_units = 48.0F, .slender = 0.60F, .lean_rad = 0.30F},
    {.spacing_units = 15.0F, .slender = 0.60F, .lean_rad = 0.30F},
    {.spacing_units = 30.0F, .slender = 0.50F, .lean_rad = 0.25F},
    {.spacing_units = 30.0F, .slender = 0.55F, .lean_rad = 0.40F},
}};
constexpr bool lies_along_wind(std::size_t size) { return size >= slabs && size <= small_swells; }
constexpr Cover cover_with(std::size_t size) {
  return size == scree_roofs ? Cover::scree : size == grass_roofs ? Cover::grass : Cover::snow;
}

constexpr double mean_normal_units = 14.0;  // deviation of the large form that light rakes
constexpr double lip_units = 1.2;           // of snow above bare ground
// The sun is turned until its cosine to the large form lies between these, with their sines.
constexpr float max_facing = 0.62F;
constexpr float max_facing_sine = 0.785F;
constexpr float min_facing = 0.25F;
constexpr float min_facing_sine = 0.968F;
constexpr float wrap = 0.10F;

// x limited softly to ±max.
float soft(float x, float max) {
  const float t = x / max;
  return x / std::sqrt(1.0F + t * t);
}

// Directions on the ground that belong to the fall line on the sheet and to its right.
struct Frame {
  glm::vec3 normal;
  glm::vec3 down{0.0F};
  glm::vec3 across{0.0F};

  explicit Frame(glm::vec3 n) : normal(n) {
    const glm::vec3 fall = glm::vec3(n.x * n.z, n.y * n.z, n.z * n.z - 1.0F);
    const float length = std::sqrt(glm::dot(fall, fall));
    if (length < 1e-4F) return;
    down = fall / length;
    across = glm::cross(n, down);
  }
  // The normal under a form of this gradient on the sheet.
  glm::vec3 tilted(glm::vec2 gradient, glm::vec2 fall) const {
    constexpr float along = 0.8F;
    const float to_right = gradient.x * fall.y - gradient.y * fall.x;
    const float downhill = along * (gradient.x * fall.x + gradient.y * fall.y);
    return glm::normalize(normal - across * to_right - down * downhill);
  }
};

struct CloseScene {
  const GuidanceBuffers& guidance;
  const RockParameters& parameters;
  const SpurGround& ground;
  glm::ivec2 origin_px;
  PixelRect made;
  Warp warp;
  std::array<SpurCells, sizes> roofs;
  std::array<Grid<float>, 3> mean_normal;
  Grid<float> calm, small_calm, steepness, terraces, quiet;

  glm::vec2 position(int x, int y, glm::dvec2 within) const {
    const double ppu = ground.pixels_per_unit;
    return {static_cast<float>((origin_px.x + x + within.x) / ppu),
            static_cast<float>((origin_px.y + y + within.y) / ppu)};
  }
};

// The light that forms on a large form get.
struct Rake {
  glm::vec3 sun;
  float strength = 1.0F;

  float facing(glm::vec3 normal) const {
    return unit((glm::dot(normal, sun) + wrap) / (1.0F + wrap));
  }
  float operator()(glm::vec3 form, glm::vec3 ground) const {
    return strength * (facing(form) - facing(ground));
  }
};

Rake rake_at(const CloseScene& s, std::size_t i, glm::vec3 mean, bool snow) {
  const GuidanceBuffers& g = s.guidance;
  const GroundLight own =
      ground_light(s.parameters.light, glm::dvec2(g.position_m[i]) + glm::dvec2(g.origin_m));
  const glm::vec3 sun(own.sun);
  const float facing = glm::dot(mean, sun);
  Rake rake{sun};
  const bool too_near = facing > max_facing;
  if (too_near || (facing < min_facing && !snow)) {
    glm::vec3 across = sun - facing * mean;
    const float length = std::sqrt(glm::dot(across, across));
    constexpr float too_short = 0.05F;
    // From where the sun stands above: any side is as good.
    across =
        length > too_short ? across / length : glm::normalize(glm::vec3(-mean.y, mean.x, 0.1F));
    rake.sun = too_near ? max_facing * mean + max_facing_sine * across
                        : min_facing * mean + min_facing_sine * across;
  }
  const float direct = static_cast<float>(s.parameters.light.light.sun) * own.strength;
  const float left = 1.0F - static_cast<float>(s.parameters.light.light.shadow_depth) *
                                (1.0F - (snow ? smoothstep(0.3F, 0.7F, g.shadow[i]) : g.shadow[i]));
  constexpr float min_strength = 0.34F;  // forms in cast shadow remain
  rake.strength = (snow ? 1.3F * direct * left : std::max(direct * left, min_strength)) / raw_range;
  return rake;
}

// What forms make of a position.
struct FormLook {
  float tone = 0.0F;
  std::uint32_t plane = 0;  // of the form that strokes follow
  std::uint32_t edges = 0;  // differs where any plane does
};

// Gradient of one size, and its plane.
glm::vec2 form_at(const CloseScene& s, Size size, glm::vec2 position, float depth_m, FormLook& look,
                  bool leads) {
  const SpurHit hit = highest_spur(s.roofs[size], size_table[size].slender, position, depth_m, 0);
  const std::uint32_t plane = hit.flank_id() * 5U + static_cast<std::uint32_t>(hit.part);
  look.edges = look.edges * 0x9e3779b1U + plane;
  if (leads) look.plane = hit.flank_id();
  return hit.slope;
}

FormLook snow_look(const CloseScene& s, int x, int y, std::size_t i, glm::vec2 position,
                   glm::vec2 fall, glm::vec3 mean) {
  const GuidanceBuffers& g = s.guidance;
  const int u = x - s.made.x0;
  const int v = y - s.made.y0;
  glm::vec3 detail = 0.7F * g.normal_detail[i] + 0.3F * g.normal[i];
  detail.x *= 1.3F;
  detail.y *= 1.3F;
  const Frame frame(glm::normalize(detail));
  const float slope = g.slope_deg[i];
  const float depth_m = g.depth_m[i];
  // Nearly one or the other: mixed they would look like panes of glass over each other.
  const float steep = smoothstep(25.0F, 29.0F, slope + 2.0F * s.steepness(u, v));
  const float calm = smoothstep(-0.6F, 0.7F, s.calm(u, v));
  const float small_calm = smoothstep(-0.1F, 0.9F, s.small_calm(u, v));
  // Whole slopes are empty beside busy ones.
  const float quiet = 1.0F - 0.7F * smoothstep(0.3F, 1.1F, s.quiet(u, v));
  FormLook look;
  glm::vec2 broad(0.0F);
  glm::vec2 large(0.0F);
  glm::vec2 small(0.0F);
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
    // Level basins are held by broad slabs, with few smaller swells.
    const float level = 1.0F - smoothstep(9.0F, 20.0F, slope);
    broad += 0.22F * (1.0F - steep) * (0.5F + 0.5F * level) *
             form_at(s, slabs, position, depth_m, look, steep <= 0.5F && level > 0.6F);
    large += 0.26F * (1.0F - steep) * (0.35F + 0.65F * calm) * (1.0F - 0.65F * level) * quiet *
             form_at(s, swells, position, depth_m, look, steep <= 0.5F && level <= 0.6F);
    small += 0.07F * (1.0F - steep) * calm * small_calm * quiet *
             form_at(s, small_swells, position, depth_m, look, false);
  }
  const Rake rake = rake_at(s, i, mean, true);
  const glm::vec3 under = frame.tilted(broad, fall);
  const glm::vec3 wide = frame.tilted(broad + large, fall);
  const glm::vec3 all = frame.tilted(broad + large + small, fall);
  const float lit = smoothstep(0.35F, 0.75F, rake.facing(frame.normal) * g.shadow[i]);
  look.tone = lit * soft(0.55F * rake(frame.normal, mean), 0.16F) +
              soft(rake(under, frame.normal), 0.18F) + soft(rake(wide, under), 0.28F) +
              soft(rake(all, wide), 0.11F);
  return look;
}

FormLook scree_look(const CloseScene& s, std::size_t i, glm::vec2 position, glm::vec2 fall,
                    glm::vec3 mean) {
  const GuidanceBuffers& g = s.guidance;
  const Frame frame(glm::normalize(0.6F * g.normal_detail[i] + 0.4F * g.normal_smooth[i]));
  FormLook look;
  const glm::vec2 slope = 0.20F * form_at(s, scree_roofs, position, g.depth_m[i], look, true);
  look.tone =
      soft(1.15F * rake_at(s, i, mean, false)(frame.tilted(slope, fall), frame.normal), 0.16F);
  look.plane = 0;  // its dabs do not follow planes
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
  const glm::vec2 position = s.position(x, y, {0.5, 0.5});
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
  const Frame frame(glm::normalize(0.45F * g.normal_detail[i] + 0.55F * g.normal_smooth[i]));
  const float amount = 0.46F * smoothstep(14.0F, 32.0F, g.slope_deg[i]) *
                       smoothstep(-0.5F, 0.7F, s.calm(x - s.made.x0, y - s.made.y0));
  FormLook look;
  const glm::vec2 slope = amount * form_at(s, grass_roofs, position, g.depth_m[i], look, true);
  look.tone = soft(rake_at(s, i, mean, false)(frame.tilted(slope, fall), frame.normal), 0.22F) +
              terracettes(s, x, y, i);
  return look;
}

FormLook look_at(const CloseScene& s, int x, int y, Cover cover, glm::dvec2 within) {
  const std::size_t i = s.guidance.depth_m.index(x, y);
  const WideView& wide = s.ground.wide;
  const int sheet_x = s.origin_px.x + x;
  const int sheet_y = s.origin_px.y + y;
  glm::vec3 mean(0.0F);
  for (int k = 0; k < 3; ++k)
    mean[k] = value_on_surface(wide, s.mean_normal[static_cast<std::size_t>(k)], sheet_x, sheet_y,
                               s.guidance.depth_m[i]);
  const float length = std::sqrt(glm::dot(mean, mean));
  mean = length > 0.1F ? mean / length : s.guidance.normal[i];
  const glm::vec2 fall = s.ground.fall[wide.index(sheet_x, sheet_y)];
  const glm::vec2 position =
      s.warp(s.position(x, y, within), static_cast<float>(s.ground.pixels_per_unit));
  switch (cover) {
    case Cover::snow:
      return snow_look(s, x, y, i, position, fall, mean);
    case Cover::scree:
      return scree_look(s, i, position, fall, mean);
    case Cover::grass:
      return grass_look(s, x, y, i, position, fall, mean);
    case Cover::other:
      break;
  }
  return {};
}

// Where the wind blows on the sheet, at a wide pixel: 35° aside of where the light goes.
glm::vec2 wind_on_sheet(const SpurGround& ground, glm::vec3 wind, std::size_t i) {
  const Frame frame(ground.wide.seen.normal[i]);
  const glm::vec2 fall = ground.fall[i];
  constexpr float foreshortened = 0.5F;
  const glm::vec2 to = glm::dot(frame.across, wind) * glm::vec2(fall.y, -fall.x) +
                       foreshortened * glm::dot(frame.down, wind) * fall;
  const float length = std::sqrt(to.x * to.x + to.y * to.y);
  return length > 1e-3F ? to / length : glm::vec2(1.0F, 0.0F);
}

glm::vec3 wind_of(const ToneParameters& light) {
  const glm::vec2 level(static_cast<float>(light.sun_direction.x),
                        static_cast<float>(light.sun_direction.y));
  const float length = std::sqrt(level.x * level.x + level.y * level.y);
  const glm::vec2 away = length > 1e-6F ? -level / length : glm::vec2(1.0F, 0.0F);
  constexpr float cosine = 0.819F;
  constexpr float sine = 0.574F;
  return {away.x * cosine - away.y * sine, away.x * sine + away.y * cosine, 0.0F};
}

float close_at(const GuidanceBuffers& g, std::size_t i, double pixels_per_unit) {
  return close_share(g.footprint_m[i] * static_cast<float>(pixels_per_unit));
}

int reach_px(double units, double pixels_per_unit) {
  return static_cast<int>(std::ceil(units * pixels_per_unit)) + 1;
}

}  // namespace

void add_close_relief(RockRelief& relief, const GuidanceBuffers& guidance, const WideView& wide,
                      const RockParameters& parameters, glm::ivec2 origin_px, Progress& progress,
                      PixelRect wanted) {
  const PixelRect whole{0, 0, guidance.width(), guidance.height()};
  if (wanted.empty()) wanted = whole;
  const double ppu = parameters.light.pixels_per_unit;
  std::array<bool, 4> present{};
  const PixelRect close = extent_of(wanted, [&](int x, int y) {
    const std::size_t i = guidance.depth_m.index(x, y);
    return !guidance.is_sky(i) && close_at(guidance, i, ppu) > 0.0F &&
           cover_of(guidance.land_cover[i], parameters.winter) != Cover::other;
  });
  if (close.empty()) return;
  progress.begin("close ground", 2.0 * close.height());
  // Edges of planes, and the ground above and below, are found from neighbours.
  const int lip_px = reach_px(lip_units, ppu);
  const PixelRect made = intersection(whole, grown(close, lip_px));

  const int times = thinned_times(ppu, wide.factor);
  const GuidanceBuffers thin = thin_out(wide, times);
  const WideView far{thin, wide.factor * times, thinned_origin(wide, times)};
  const auto in_far = [&](double units) {
    return intersection(
        {0, 0, thin.width(), thin.height()},
        moved(wide_rect(grown(moved(made, origin_px.x, origin_px.y), reach_px(units, ppu)),
                        far.factor),
              -far.origin_px.x, -far.origin_px.y));
  };
  float reach_units = roof_reach_units(border_roofs);
  for (const RoofSize& size : size_table)
    reach_units = std::max(reach_units, roof_reach_units(size));
  const Grid<glm::vec2> fall =
      smooth_fall_lines(far, ppu, in_far(static_cast<double>(reach_units)));
  const SpurGround ground{far, fall, ppu, parameters.light.seed};
  const PixelRect sheet_rect = moved(made, origin_px.x, origin_px.y);
  for (int y = made.y0; y < made.y1; ++y)
    for (int x = made.x0; x < made.x1; ++x)
      present[static_cast<std::size_t>(cover_of(guidance.land_cover(x, y), parameters.winter))] =
          true;

  CloseScene scene{.guidance = guidance,
                   .parameters = parameters,
                   .ground = ground,
                   .origin_px = origin_px,
                   .made = made,
                   .warp = Warp(parameters.light.seed),
                   .roofs = {},
                   .mean_normal = {},
                   .calm = {},
                   .small_calm = {},
                   .steepness = {},
                   .terraces = {},
                   .quiet = {}};
  const glm::vec3 wind = wind_of(parameters.light);
  const auto down = [&](std::size_t i) { return std::optional(fall[i]); };
  const auto along_wind = [&](std::size_t i) {
    return std::optional(wind_on_sheet(ground, wind, i));
  };
  for (std::size_t k = 0; k < sizes; ++k)
    if (present[static_cast<std::size_t>(cover_with(k))])
      scene.roofs[k] = lies_along_wind(k)
                           ? grow_roofs(ground, size_table[k], k + 1, sheet_rect, along_wind)
                           : grow_roofs(ground, size_table[k], k + 1, sheet_rect, down);
  const CloseBorders borders{guidance, ground, origin_px,
                             grow_roofs(ground, border_roofs, border_roofs_part, sheet_rect, down),
                             parameters.light.seed};
  const PixelRect blurred = grown(in_far(0.0), surface_look_rows + 1);
  for (int k = 0; k < 3; ++k) {
    Grid<float> part(thin.width(), thin.height());
    for (std::size_t i = 0; i < part.size(); ++i) part[i] = thin.normal[i][k];
    scene.mean_normal[static_cast<std::size_t>(k)] =
        blur_on_surface(part, thin.depth_m, mean_normal_units * ppu / far.factor,
                        intersection({0, 0, thin.width(), thin.height()}, blurred));
  }
  const auto noise = [&](std::uint64_t part, double sigma_x, double sigma_y) {
    return make_image_noise(stream_seed(parameters.light.seed, Stream::close_calm, part),
                            origin_px + glm::ivec2(made.x0, made.y0), made.width(), made.height(),
                            ppu, sigma_x, sigma_y);
  };
  scene.calm = noise(0, 42.0, 42.0);
  scene.small_calm = noise(1, 17.0, 17.0);
  scene.steepness = noise(2, 40.0, 40.0);
  scene.terraces = noise(3, 15.0, 6.0);
  scene.quiet = noise(4, 85.0, 60.0);

  Grid<Class> shown(made.width(), made.height());
  parallel_rows(made.height(), [&](int row) {
    for (int x = made.x0; x < made.x1; ++x) {
      const std::size_t i = guidance.depth_m.index(x, made.y0 + row);
      shown(x - made.x0, row) = guidance.is_sky(i)
                                    ? guidance.land_cover[i]
                                    : borders.at(x, made.y0 + row, close_at(guidance, i, ppu));
    }
    progress.advance(1.0);
  });
  Grid<std::uint32_t> edges(made.width(), made.height(), 0U);
  const auto lies = [&](int x, int y) {
    return cover_of(shown(x - made.x0, y - made.y0), parameters.winter);
  };
  constexpr glm::dvec2 centre_of_pixel{0.5, 0.5};
  parallel_rows(made.height(), [&](int row) {
    const int y = made.y0 + row;
    for (int x = made.x0; x < made.x1; ++x) {
      const std::size_t i = guidance.depth_m.index(x, y);
      if (guidance.is_sky(i)) continue;
      const float near = close_at(guidance, i, ppu);
      const Cover cover = lies(x, y);
      if (near <= 0.0F || cover == Cover::other) continue;
      const FormLook look = look_at(scene, x, y, cover, centre_of_pixel);
      edges(x - made.x0, row) = look.edges;
      if (x < wanted.x0 || y < wanted.y0 || x >= wanted.x1 || y >= wanted.y1) continue;
      const int u = x - wanted.x0;
      const int v = y - wanted.y0;
      // Where rock has changed the class, its border stays.
      if (relief.land_cover(u, v) != guidance.land_cover[i]) continue;
      relief.land_cover(u, v) = shown(x - made.x0, row);
      relief.facet(u, v) = look.plane;
      relief.tone(u, v) = near * look.tone;
    }
    progress.advance(1.0);
  });
  // Four samples where planes meet, and the lips of snow.
  parallel_rows(made.height(), [&](int row) {
    const int y = made.y0 + row;
    if (y < wanted.y0 || y >= wanted.y1) return;
    for (int x = std::max(made.x0, wanted.x0); x < std::min(made.x1, wanted.x1); ++x) {
      const int u = x - made.x0;
      const std::uint32_t own = edges(u, row);
      const int to_x = x - wanted.x0;
      const int to_y = y - wanted.y0;
      if (own == 0 || relief.land_cover(to_x, to_y) != shown(u, row)) continue;
      const std::size_t i = guidance.depth_m.index(x, y);
      const float near = close_at(guidance, i, ppu);
      const Cover cover = lies(x, y);
      const bool edge = (u > 0 && edges(u - 1, row) != own) ||
                        (u + 1 < made.width() && edges(u + 1, row) != own) ||
                        (row > 0 && edges(u, row - 1) != own) ||
                        (row + 1 < made.height() && edges(u, row + 1) != own);
      if (edge) {
        float tone = 0.0F;
        for (const glm::dvec2 within : {glm::dvec2(0.25, 0.25), glm::dvec2(0.75, 0.25),
                                        glm::dvec2(0.25, 0.75), glm::dvec2(0.75, 0.75)})
          tone += look_at(scene, x, y, cover, within).tone;
        relief.tone(to_x, to_y) = near * 0.25F * tone;
      }
      // The edge of snow is thick: it catches light above bare ground, which lies in its shade.
      const auto there = [&](float units) {
        const glm::vec2 way =
            fall[far.index(origin_px.x + x, origin_px.y + y)] * (units * static_cast<float>(ppu));
        const int to_column =
            std::clamp(x + static_cast<int>(std::lround(way.x)), made.x0, made.x1 - 1);
        const int to_row =
            std::clamp(y + static_cast<int>(std::lround(way.y)), made.y0, made.y1 - 1);
        return same_surface(guidance.depth_m(to_column, to_row), guidance.depth_m[i])
                   ? lies(to_column, to_row)
                   : cover;
      };
      if (cover == Cover::snow && there(1.0F) != Cover::snow)
        relief.tone(to_x, to_y) += 0.10F * near;
      if (cover != Cover::snow && there(-0.9F) == Cover::snow)
        relief.tone(to_x, to_y) -= 0.13F * near;
    }
  });
}

int close_near_margin_px(const RockParameters& parameters) {
  const double ppu = parameters.light.pixels_per_unit;
  return reach_px(lip_units, ppu) + reach_px(static_cast<double>(border_reach_units), ppu) + 1;
}

int close_margin_px(const RockParameters& parameters) {
  const double ppu = parameters.light.pixels_per_unit;
  const int factor = rock_factor(ppu);
  float reach_units = roof_reach_units(border_roofs);
  for (const RoofSize& size : size_table)
    reach_units = std::max(reach_units, roof_reach_units(size));
  const int roofs = reach_px(static_cast<double>(reach_units), ppu) +
                    factor * (smooth_fall_reach(ppu, factor) + 3);
  const int blur =
      factor * (surface_reach_px(mean_normal_units * ppu / factor) + surface_look_rows + 4);
  return std::max(roofs, blur) + close_near_margin_px(parameters) + 2;
}

}  // namespace belvedere
