#include "renderer/close/close_relief.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "renderer/close/close_borders.h"
#include "renderer/close/close_look.h"
#include "renderer/paint/picture_filter.h"
#include "renderer/rock/rock_view.h"

namespace belvedere {
namespace {

constexpr double lip_units = 1.2;  // of snow above bare ground

float close_at(const GuidanceBuffers& g, std::size_t i, double pixels_per_unit) {
  return close_share(g.footprint_m[i] * static_cast<float>(pixels_per_unit));
}

int reach_px(double units, double pixels_per_unit) {
  return static_cast<int>(std::ceil(units * pixels_per_unit)) + 1;
}

double roofs_reach_units() {
  return static_cast<double>(std::max(
      {roof_reach_units(border_tongues), close_forms_reach_units(), debris_cones_reach_units()}));
}

}  // namespace

void add_close_relief(RockRelief& relief, const GuidanceBuffers& guidance, const WideView& wide,
                      const RockParameters& parameters, glm::ivec2 origin_px, Progress& progress,
                      PixelRect wanted) {
  const PixelRect whole{0, 0, guidance.width(), guidance.height()};
  if (wanted.empty()) wanted = whole;
  const double ppu = parameters.light.pixels_per_unit;
  // Debris in the gullies of a wall, and snow in winter, have relief too.
  const LandCoverClass on_walls = parameters.winter ? LandCoverClass::snow : LandCoverClass::scree;
  const auto on_wall = [&](int x, int y) {
    return guidance.land_cover(x, y) == LandCoverClass::rock &&
           relief.land_cover(x - wanted.x0, y - wanted.y0) == on_walls;
  };
  const PixelRect close = extent_of(wanted, [&](int x, int y) {
    const std::size_t i = guidance.depth_m.index(x, y);
    return !guidance.is_sky(i) && close_at(guidance, i, ppu) > 0.0F &&
           (close_cover(guidance.land_cover[i], parameters.winter) != CloseCover::other ||
            guidance.land_cover[i] == LandCoverClass::forest || on_wall(x, y));
  });
  if (close.empty()) return;
  // Edges of planes, and the ground above and below, are found from neighbours.
  const int lip_px = reach_px(lip_units, ppu);
  const PixelRect made = intersection(whole, grown(close, lip_px));
  progress.begin("close ground", 2.0 * made.height());

  const PixelRect sheet_rect = moved(made, origin_px.x, origin_px.y);
  const FarView from_afar(wide, ppu, grown(sheet_rect, reach_px(roofs_reach_units(), ppu)));
  const WideView& far = from_afar.wide();
  const Grid<glm::vec2>& fall = from_afar.fall();
  const SpurGround ground{far, fall, ppu, parameters.light.seed};
  const IceAround ice = look_around_ice(ground, sheet_rect);
  const CloseBorders borders =
      make_close_borders(guidance, ground, ice, origin_px, sheet_rect, parameters.light.seed);
  const DebrisCones cones = grow_debris_cones(ground, sheet_rect, parameters.kind->cones);
  const Warp warp(parameters.light.seed);
  // Cones of debris lie over grass.
  const auto covered = [&](LandCoverClass id, int x, int y) {
    if (close_cover(id, false) != CloseCover::grass || cones.cones.empty()) return id;
    const glm::vec2 position{static_cast<float>((origin_px.x + x + 0.5) / ppu),
                             static_cast<float>((origin_px.y + y + 0.5) / ppu)};
    const DebrisHit hit =
        debris_at(cones, parameters.light.seed, warp(position, static_cast<float>(ppu)),
                  guidance.depth_m(x, y));
    return debris_covers(hit) ? LandCoverClass::scree : id;
  };
  Grid<LandCoverClass> shown(made.width(), made.height());
  parallel_rows(made.height(), [&](int row) {
    for (int x = made.x0; x < made.x1; ++x) {
      const std::size_t i = guidance.depth_m.index(x, made.y0 + row);
      LandCoverClass& id = shown(x - made.x0, row);
      id = guidance.land_cover[i];
      if (guidance.is_sky(i)) continue;
      const float near = close_at(guidance, i, ppu);
      id = borders.at(x, made.y0 + row, near);
      if (near > 0.5F) id = covered(id, x, made.y0 + row);
    }
    progress.advance(1.0);
  });
  const auto lies = [&](int x, int y) {
    return close_cover(shown(x - made.x0, y - made.y0), parameters.winter);
  };
  // Borders may bring classes that the window itself does not hold here.
  std::array<bool, close_covers> present{};
  for (const LandCoverClass id : shown)
    present[static_cast<std::size_t>(close_cover(id, parameters.winter))] = true;
  for (const LandCoverClass id : relief.land_cover)
    present[static_cast<std::size_t>(close_cover(id, parameters.winter))] = true;
  const CloseScene scene =
      make_close_scene(guidance, parameters, ground, cones, ice, origin_px, made, present);
  Grid<std::uint32_t> edges(made.width(), made.height(), 0U);
  constexpr glm::dvec2 centre_of_pixel{0.5, 0.5};
  parallel_rows(made.height(), [&](int row) {
    const int y = made.y0 + row;
    for (int x = made.x0; x < made.x1; ++x) {
      const std::size_t i = guidance.depth_m.index(x, y);
      if (guidance.is_sky(i)) continue;
      const float near = close_at(guidance, i, ppu);
      const CloseCover cover = lies(x, y);
      const bool asked = x >= wanted.x0 && y >= wanted.y0 && x < wanted.x1 && y < wanted.y1;
      if (near > 0.0F && asked && cover == CloseCover::other) {
        LandCoverClass& id = relief.land_cover(x - wanted.x0, y - wanted.y0);
        if (shown(x - made.x0, row) == LandCoverClass::forest && id == guidance.land_cover[i])
          id = LandCoverClass::forest;
        if (!on_wall(x, y)) continue;
        const FormLook look =
            look_at_form(scene, x, y, close_cover(on_walls, parameters.winter), centre_of_pixel);
        relief.tone(x - wanted.x0, y - wanted.y0) = near * look.tone;
        if (parameters.winter) relief.facet(x - wanted.x0, y - wanted.y0) = look.plane;
        continue;
      }
      if (near <= 0.0F || cover == CloseCover::other) continue;
      const FormLook look = look_at_form(scene, x, y, cover, centre_of_pixel);
      edges(x - made.x0, row) = look.edges;
      if (!asked) continue;
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
      const CloseCover cover = lies(x, y);
      if (is_edge(edges, u, row)) {
        float tone = 0.0F;
        for (const glm::dvec2 within : {glm::dvec2(0.25, 0.25), glm::dvec2(0.75, 0.25),
                                        glm::dvec2(0.25, 0.75), glm::dvec2(0.75, 0.75)})
          tone += look_at_form(scene, x, y, cover, within).tone;
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
      if (cover == CloseCover::snow && there(1.0F) != CloseCover::snow)
        relief.tone(to_x, to_y) += 0.10F * near;
      if (cover != CloseCover::snow && there(-0.9F) == CloseCover::snow)
        relief.tone(to_x, to_y) -= 0.13F * near;
      // So is turf.
      if (cover == CloseCover::grass && there(1.0F) == CloseCover::scree)
        relief.tone(to_x, to_y) += 0.05F * near;
      if (cover == CloseCover::scree && there(-0.9F) == CloseCover::grass)
        relief.tone(to_x, to_y) -= 0.09F * near;
    }
  });
}

int close_near_margin_px(const RockParameters& parameters) {
  const double ppu = parameters.light.pixels_per_unit;
  return reach_px(lip_units, ppu) + 1;
}

int close_margin_px(const RockParameters& parameters) {
  const double ppu = parameters.light.pixels_per_unit;
  const int factor = rock_factor(ppu);
  const int roofs =
      reach_px(roofs_reach_units(), ppu) + factor * (smooth_fall_reach(ppu, factor) + 3);
  const int blur = factor * std::max({mean_normal_reach(ppu, factor), streams_reach(ppu, factor),
                                      ice_around_reach(ppu, factor)});
  return std::max(roofs, blur) + close_near_margin_px(parameters) + 2;
}

}  // namespace belvedere
