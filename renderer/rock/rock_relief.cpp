#include "renderer/rock/rock_relief.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "base/math.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/paint/picture_filter.h"
#include "renderer/paint/picture_noise.h"
#include "renderer/rock/rock_ground.h"
#include "renderer/rock/rock_light.h"

namespace belvedere {
namespace {

constexpr double cast_reach_units = 48.0;  // max distance from which large spurs cast shadows
constexpr double apron_units = 24.0;       // farther than this no pixel is near rock
constexpr float min_rock = 0.02F;          // share of rock around from which relief is made
constexpr double shadow_blur_units = 1.6;
constexpr double sky_blur_units = 2.0;
constexpr float above_units =
    6.0F;  // distance along the fall line, up and down, that is searched for rock
constexpr glm::dvec2 wall_sigma_units{70.0, 90.0};  // of near walls that are bare of snow
constexpr float rib_half_width = 0.28F;             // of spurs that stand out of snow, spacings
constexpr float turf_shift_units = 13.0F;           // of near turf up and down a wall, at most
constexpr float stroke_feather = 0.6F;              // how far strokes turn down the flanks

// Ground whose border with rock moves up and down the slope where it is near.
bool has_turf_border(LandCoverClass id) { return id == LandCoverClass::rock || is_turf(id); }

// Whether a pixel may show rock by its own class and slope.
bool may_be_bare(const GuidanceBuffers& g, std::size_t i, double pixels_per_unit) {
  const LandCoverClass id = g.land_cover[i];
  const float close = close_share(g.footprint_m[i] * static_cast<float>(pixels_per_unit));
  const std::optional<float> clings = clings_deg(id, close);
  if (!clings) return id == LandCoverClass::rock;
  return g.slope_deg[i] > steep_snow_deg(close) + *clings - 4.0F * close;
}

// The bounding rectangle of the window's pixels with rock around.
PixelRect rocky_part(const GuidanceBuffers& guidance, const WideView& wide, PixelRect made,
                     glm::ivec2 origin_px, double pixels_per_unit) {
  const int apron_px = static_cast<int>(std::ceil(apron_units * pixels_per_unit));
  PixelRect rocky{made.x1, made.y1, made.x0, made.y0};
  const auto include = [&](PixelRect rect) {
    rect = intersection(made, rect);
    if (rect.empty()) return;
    rocky = {std::min(rocky.x0, rect.x0), std::min(rocky.y0, rect.y0), std::max(rocky.x1, rect.x1),
             std::max(rocky.y1, rect.y1)};
  };
  // Wide pixels whose surroundings touch the requested pixels.
  const PixelRect near = intersection(
      {0, 0, wide.seen.width(), wide.seen.height()},
      moved(wide_rect(moved(grown(made, apron_px), origin_px.x, origin_px.y), wide.factor),
            -wide.origin_px.x, -wide.origin_px.y));
  const auto is_near = [&](int x, int y) {
    const glm::ivec2 corner = (wide.origin_px + glm::ivec2(x, y)) * wide.factor - origin_px;
    const PixelRect apron =
        grown({corner.x, corner.y, corner.x + wide.factor, corner.y + wide.factor}, apron_px);
    return !intersection(made, apron).empty();
  };
  const PixelRect seen = extent_of(near, [&](int x, int y) {
    return wide.seen.land_cover(x, y) == LandCoverClass::rock && is_near(x, y);
  });
  if (!seen.empty()) {
    const glm::ivec2 low =
        (wide.origin_px + glm::ivec2(seen.x0, seen.y0)) * wide.factor - origin_px;
    const glm::ivec2 high =
        (wide.origin_px + glm::ivec2(seen.x1, seen.y1)) * wide.factor - origin_px;
    include(grown({low.x, low.y, high.x, high.y}, apron_px));
  }
  // Rock that the wide view has missed.
  include(extent_of(made, [&](int x, int y) {
    return may_be_bare(guidance, guidance.depth_m.index(x, y), pixels_per_unit);
  }));
  // With the neighbours of its border, which are compared with it: in any window they are the same.
  return rocky.empty() ? rocky : intersection(made, grown(rocky, 1));
}

std::uint32_t folded(std::uint32_t id) {
  const std::uint64_t bits = mix_bits(id);
  return static_cast<std::uint32_t>(bits >> 48U);
}

// The plane at a position, from the two larger sizes.
std::uint32_t facet_of(const SpurHits& hits) {
  const std::uint32_t large = folded(hits[0].flank_id());
  const std::uint32_t small =
      folded(hits[1].flank_id() * 5U + static_cast<std::uint32_t>(hits[1].part));
  return std::max(1U, large << 16U | small);
}

// Everything that separates two positions by an edge.
std::uint32_t edge_key(const SpurHits& hits) {
  std::uint32_t key = 0;
  for (const SpurHit& hit : hits.sizes)
    key = key * 0x9e3779b1U + hit.flank_id() * 5U + static_cast<std::uint32_t>(hit.part);
  return key;
}

// Everything of a window that pixels read.
struct RockScene {
  const GuidanceBuffers& guidance;
  const RockView& view;
  const WideView wide;  // of the view
  const RockParameters& parameters;
  glm::ivec2 origin_px;
  double pixels_per_unit;
  RockAround around;
  Grid<float> shadow, sky_view, calm, bed_place, bed_show, lines, cover, funnel, wall;
};

glm::vec2 position_of(const RockScene& s, int x, int y, glm::dvec2 within) {
  return {static_cast<float>((s.origin_px.x + x + within.x) / s.pixels_per_unit),
          static_cast<float>((s.origin_px.y + y + within.y) / s.pixels_per_unit)};
}

SpurHits hits_at(const RockScene& s, const RockPixel& pixel, int x, int y, glm::dvec2 within) {
  return s.view.at(position_of(s, x, y, within), pixel.band, pixel.depth_m);
}

// A position of a pixel, in the picture's light.
RockLook look_of(const RockScene& s, const RockPixel& pixel, int x, int y, glm::dvec2 within,
                 const SpurHits& hits) {
  const RockKind& kind = *s.parameters.kind;
  const SunPath way = way_to_sun(kind, s.parameters.light, pixel, hits);
  float sun = 1.0F;
  if (way.gained > 0.0F && pixel.shadow > 0.05F)
    sun = sun_past(kind, way,
                   large_height(s.view.field, pixel.band, position_of(s, x, y, within) + way.offset,
                                pixel.depth_m),
                   hits[0].height, close_share(pixel.metres_per_unit));
  return light_rock(kind, s.parameters.light, s.parameters.winter, pixel, hits, sun);
}

// Whether winter snow hides near rock: then it is a slope of snow, with its forms.
bool lies_under_snow(const RockScene& s, const RockPixel& pixel, const RockLook& look) {
  return s.parameters.winter && close_share(pixel.metres_per_unit) > 0.5F && look.snow > 0.5F;
}

RockPixel pixel_at(const RockScene& s, int x, int y, PixelRect made) {
  const GuidanceBuffers& g = s.guidance;
  const std::size_t i = g.depth_m.index(x, y);
  const int u = x - made.x0;
  const int v = y - made.y0;
  const int sheet_x = s.origin_px.x + x;
  const int sheet_y = s.origin_px.y + y;
  RockPixel p;
  p.depth_m = g.depth_m[i];
  p.normal =
      glm::normalize(0.55F * g.normal_detail[i] + 0.30F * g.normal[i] + 0.15F * g.normal_smooth[i]);
  p.slope_deg = g.slope_deg[i];
  p.shadow = s.shadow(x, y);
  p.sky_view = s.sky_view(x, y);
  p.altitude_m = g.altitude_m[i];
  p.east_m = static_cast<double>(g.position_m[i].x) + g.origin_m.x;
  p.north_m = static_cast<double>(g.position_m[i].y) + g.origin_m.y;
  if (s.parameters.light.light_field)
    p.own_light = s.parameters.light.light_field->at({p.east_m, p.north_m});
  p.metres_per_unit = g.footprint_m[i] * static_cast<float>(s.pixels_per_unit);
  p.rock = value_on_surface(s.wide, s.around.rock, sheet_x, sheet_y, p.depth_m);
  p.turf = value_on_surface(s.wide, s.around.turf, sheet_x, sheet_y, p.depth_m);
  p.snow = value_on_surface(s.wide, s.around.snow, sheet_x, sheet_y, p.depth_m);
  p.calm_noise = s.calm(u, v);
  p.bed_noise = s.bed_place(u, v);
  p.bed_show = s.bed_show(u, v);
  p.line_noise = s.lines(u, v);
  p.cover_noise = s.cover(u, v);
  p.wall_noise = s.wall(u, v);
  p.scale = static_cast<float>(s.pixels_per_unit);
  p.band = s.view.bands.at(position_of(s, x, y, {0.5, 0.5}), p.depth_m,
                           p.metres_per_unit * units_per_mm);
  return p;
}

float rock_share(const RockScene& s, glm::vec2 sheet_px, float depth_m) {
  return value_on_surface(s.wide, s.around.rock, static_cast<int>(std::floor(sheet_px.x)),
                          static_cast<int>(std::floor(sheet_px.y)), depth_m);
}

RockPosition border_place(const RockScene& s, const RockPixel& p, int x, int y, float rock,
                          const SpurHits& hits, float funnel, float wall) {
  glm::vec2 sheet_px(s.origin_px + glm::ivec2(x, y));
  const glm::vec2 fall =
      s.view.far.fall()[index_on_surface(s.wide, s.origin_px.x + x, s.origin_px.y + y, p.depth_m)];
  const glm::vec2 reach = fall * (above_units * p.scale);
  RockPosition position;
  position.mapped = s.guidance.land_cover(x, y);
  position.stands = stands_out(hits);
  position.close = close_share(p.metres_per_unit);
  // Near the border of turf is that of a place up or down the slope: cells of elevation data would
  // leave round meadows in a wall.
  if (position.close > 0.0F && has_turf_border(position.mapped)) {
    const float shift = turf_shift_units * position.close *
                        std::clamp(1.5F * position.stands + 0.35F * p.bed_noise, -1.0F, 1.0F);
    const glm::vec2 there = sheet_px - fall * (shift * p.scale);
    const LandCoverClass id =
        s.wide.seen.land_cover[index_on_surface(s.wide, static_cast<int>(std::floor(there.x)),
                                                static_cast<int>(std::floor(there.y)), p.depth_m)];
    if (has_turf_border(id)) {
      sheet_px = there;
      position.mapped = id;
      rock = rock_share(s, there, p.depth_m);
    }
  }
  position.slope_deg = p.slope_deg;
  position.rock = rock;
  position.turf = p.turf;
  position.snow = p.snow;
  position.above =
      rock_share(s, sheet_px - reach, p.depth_m) - rock_share(s, sheet_px + reach, p.depth_m);
  position.funnel = funnel;
  position.wall = wall;
  if (hits[0].spur != nullptr && hits[0].part != SpurPart::foot)
    position.rib = unit(1.0F - std::abs(hits[0].across) / rib_half_width);
  position.cones = s.parameters.kind->cones;
  // Near ribs in meadows are ledges of beds.
  position.bedded = position.close * smoothstep(0.12F, 0.45F, p.turf);
  if (position.bedded > 0.0F)
    position.bed = standing_bed(p.altitude_m, p.east_m, p.north_m, p.metres_per_unit, p.bed_noise);
  return position;
}

// Whether rock may move to a pixel of near turf without any around it.
bool turf_near_rock(const RockScene& s, int x, int y, float depth_m) {
  const GuidanceBuffers& g = s.guidance;
  const float close = close_share(g.footprint_m(x, y) * static_cast<float>(s.pixels_per_unit));
  if (close <= 0.0F || !has_turf_border(g.land_cover(x, y))) return false;
  const glm::vec2 sheet_px(s.origin_px + glm::ivec2(x, y));
  const glm::vec2 way =
      s.view.far.fall()[index_on_surface(s.wide, s.origin_px.x + x, s.origin_px.y + y, depth_m)] *
      (turf_shift_units * close * static_cast<float>(s.pixels_per_unit));
  for (const float share : {-1.0F, -0.5F, 0.5F, 1.0F})
    if (rock_share(s, sheet_px + share * way, depth_m) > min_rock) return true;
  return false;
}

// The direction of strokes on a plane: down the wall, and off the crests of its spurs.
glm::vec2 plane_fall(const RockScene& s, const SpurHits& hits, glm::vec2 mapped) {
  const SpurHit& large = hits[0];
  if (large.spur == nullptr) return mapped;
  glm::vec2 fall = (hits[1].spur != nullptr ? hits[1].spur->fall : large.spur->fall);
  for (int size = 0; size < 2; ++size) {
    const auto k = static_cast<std::size_t>(size);
    if (hits[k].spur != nullptr)
      fall -= stroke_feather * s.parameters.kind->tilt[k] * hits[k].slope;
  }
  const float length = glm::length(fall);
  return length > 1e-3F ? fall / length : mapped;
}

RockScene look_at_rock(const GuidanceBuffers& guidance, const RockView& view,
                       const RockParameters& parameters, glm::ivec2 origin_px, PixelRect made) {
  const double ppu = parameters.light.pixels_per_unit;
  const std::uint64_t seed = parameters.light.seed;
  RockScene s{
      guidance, view, view.far.wide(), parameters, origin_px, ppu, {}, {}, {}, {}, {}, {}, {}, {},
      {},       {}};
  const int reach_px = static_cast<int>(std::ceil((above_units + turf_shift_units + 2.0) * ppu));
  const PixelRect asked =
      wide_rect(grown(moved(made, origin_px.x, origin_px.y), reach_px), s.wide.factor);
  s.around = look_around_rock(
      s.wide, ppu,
      intersection(view.far.whole(),
                   surface_look(moved(asked, -s.wide.origin_px.x, -s.wide.origin_px.y))));
  s.shadow = blur_on_surface(guidance.shadow, guidance.depth_m, shadow_blur_units * ppu, made);
  s.sky_view = blur_on_surface(guidance.sky_view, guidance.depth_m, sky_blur_units * ppu, made);
  const auto noise = [&](Stream stream, double sigma_x, double sigma_y, std::uint64_t part = 0) {
    return make_image_noise(stream_seed(seed, stream, part),
                            origin_px + glm::ivec2(made.x0, made.y0), made.width(), made.height(),
                            ppu, sigma_x, sigma_y);
  };
  s.calm = noise(Stream::rock_calm, 13.0, 13.0);
  s.bed_place = noise(Stream::rock_beds, 9.0, 9.0, 0);
  s.bed_show = noise(Stream::rock_beds, 10.0, 5.0, 1);
  s.lines = noise(Stream::rock_lines, 1.3, 1.3);
  s.cover = noise(Stream::rock_cover, 1.6, 1.0);
  s.funnel = noise(Stream::rock_funnels, funnel_sigma_units.x, funnel_sigma_units.y);
  s.wall = noise(Stream::rock_funnels, wall_sigma_units.x, wall_sigma_units.y, 1);
  return s;
}

}  // namespace

std::initializer_list<GuidanceMember> rock_channels() {
  using B = GuidanceBuffers;
  static const std::initializer_list<GuidanceMember> channels = {
      &B::depth_m,       &B::position_m, &B::normal,     &B::normal_detail,
      &B::normal_smooth, &B::altitude_m, &B::land_cover, &B::shadow,
      &B::sky_view,      &B::slope_deg,  &B::fall_line,  &B::footprint_m};
  return channels;
}

RockRelief make_rock_relief(const GuidanceBuffers& guidance, const WideView& wide,
                            const RockParameters& parameters, glm::ivec2 origin_px,
                            Progress& progress, PixelRect wanted) {
  using B = GuidanceBuffers;
  require_channels(guidance, rock_channels(), "relief of rock");
  require_channels(wide.seen,
                   {&B::depth_m, &B::land_cover, &B::fall_line, &B::normal, &B::footprint_m},
                   "relief of rock");
  const PixelRect whole{0, 0, guidance.width(), guidance.height()};
  if (wanted.empty()) wanted = whole;
  const int width = wanted.width();
  const int height = wanted.height();
  RockRelief relief{
      Grid<LandCoverClass>(width, height), Grid<glm::vec2>(width, height),
      Grid<float>(width, height, 0.0F),    Grid<std::uint32_t>(width, height, 0U),
      Grid<float>(width, height, 0.0F),    Grid<glm::vec2>(width, height, glm::vec2(0.0F))};
  parallel_ranges(height, 64, [&](int begin, int end) {
    for (int y = begin; y != end; ++y) {
      std::copy_n(guidance.land_cover.row(wanted.y0 + y) + wanted.x0, width,
                  relief.land_cover.row(y));
      std::copy_n(guidance.fall_line.row(wanted.y0 + y) + wanted.x0, width,
                  relief.fall_line.row(y));
    }
  });
  const double ppu = parameters.light.pixels_per_unit;
  // One more pixel on each side: edges are found from neighbours.
  const PixelRect around = intersection(whole, grown(wanted, 1));
  const PixelRect made = rocky_part(guidance, wide, around, origin_px, ppu);
  if (made.empty()) return relief;
  progress.begin("relief of rock", 2.0 * made.height());
  // Spurs outside the window cast shadows into it.
  const RockView view = view_rock(guidance, wide, parameters, origin_px,
                                  grown(made, static_cast<int>(std::ceil(cast_reach_units * ppu))));
  const RockScene scene = look_at_rock(guidance, view, parameters, origin_px, made);
  Grid<std::uint32_t> edges(made.width(), made.height(), 0U);
  Grid<std::uint8_t> bare(made.width(), made.height(), 0);
  constexpr glm::dvec2 centre_of_pixel{0.5, 0.5};
  parallel_rows(made.height(), [&](int row) {
    const int y = made.y0 + row;
    for (int x = made.x0; x < made.x1; ++x) {
      const std::size_t i = guidance.depth_m.index(x, y);
      if (guidance.is_sky(i)) continue;
      const float rock = value_on_surface(scene.wide, scene.around.rock, origin_px.x + x,
                                          origin_px.y + y, guidance.depth_m[i]);
      if (rock <= min_rock && !may_be_bare(guidance, i, ppu) &&
          !turf_near_rock(scene, x, y, guidance.depth_m[i]))
        continue;
      const RockPixel pixel = pixel_at(scene, x, y, made);
      const SpurHits hits = hits_at(scene, pixel, x, y, centre_of_pixel);
      const float funnel = scene.funnel(x - made.x0, row);
      const LandCoverClass shown =
          rock_border(border_place(scene, pixel, x, y, rock, hits, funnel, pixel.wall_noise));
      edges(x - made.x0, row) = edge_key(hits);
      if (x < wanted.x0 || y < wanted.y0 || x >= wanted.x1 || y >= wanted.y1) continue;
      const int u = x - wanted.x0;
      const int v = y - wanted.y0;
      relief.land_cover(u, v) = shown;
      if (shown != LandCoverClass::rock) continue;
      const RockLook look = look_of(scene, pixel, x, y, centre_of_pixel, hits);
      if (lies_under_snow(scene, pixel, look)) {
        relief.land_cover(u, v) = LandCoverClass::snow;
        continue;
      }
      bare(x - made.x0, row) = 1;
      relief.facet(u, v) = facet_of(hits);
      for (int size = 0; size < 2; ++size)
        if (hits[static_cast<std::size_t>(size)].spur != nullptr)
          relief.height(u, v) += hits[static_cast<std::size_t>(size)].height *
                                 spur_spacing(*parameters.kind, size, pixel.band);
      relief.fall_line(u, v) = plane_fall(scene, hits, guidance.fall_line[i]);
      relief.tone(u, v) = look.tone;
      relief.cover(u, v) = {look.turf, look.snow};
    }
    progress.advance(1.0);
  });
  // Four samples per pixel where planes meet: with one, crisp edges show steps.
  parallel_rows(made.height(), [&](int row) {
    const int y = made.y0 + row;
    for (int x = std::max(made.x0, wanted.x0); x < std::min(made.x1, wanted.x1); ++x) {
      const int u = x - made.x0;
      if (bare(u, row) == 0) continue;
      if (!is_edge(edges, u, row)) continue;
      const RockPixel pixel = pixel_at(scene, x, y, made);
      float tone = 0.0F;
      glm::vec2 cover(0.0F);
      for (const glm::dvec2 within : {glm::dvec2(0.25, 0.25), glm::dvec2(0.75, 0.25),
                                      glm::dvec2(0.25, 0.75), glm::dvec2(0.75, 0.75)}) {
        const RockLook look =
            look_of(scene, pixel, x, y, within, hits_at(scene, pixel, x, y, within));
        tone += look.tone;
        cover += glm::vec2(look.turf, look.snow);
      }
      relief.tone(x - wanted.x0, y - wanted.y0) = 0.25F * tone;
      relief.cover(x - wanted.x0, y - wanted.y0) = 0.25F * cover;
    }
    progress.advance(1.0);
  });
  return relief;
}

int rock_near_margin_px(const RockParameters& parameters) {
  return surface_reach_px(sky_blur_units * parameters.light.pixels_per_unit) + 3;
}

int rock_margin_px(const RockParameters& parameters) {
  const double ppu = parameters.light.pixels_per_unit;
  const int factor = rock_factor(ppu);
  const int around = static_cast<int>(std::ceil((above_units + turf_shift_units + 2.0) * ppu)) +
                     factor * (rock_around_reach(ppu, factor) + surface_look_rows + 4);
  const int apron = static_cast<int>(std::ceil(apron_units * ppu)) + factor;
  const int spurs =
      rock_view_margin_px(parameters) + static_cast<int>(std::ceil(cast_reach_units * ppu));
  return std::max({spurs, around, apron, rock_near_margin_px(parameters)}) + 2;
}

}  // namespace belvedere
