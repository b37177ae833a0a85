#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "base/random.h"

namespace belvedere::test {

// Guidance buffers of synthetic ranges, one behind the other, under a sky: every channel that tone
// and base picture read, with silhouettes, all classes, slopes and cast shadows. A pure function of
// the pixel, so a part can be compared with the whole.
inline GuidanceBuffers make_hills(int width, int height, double pixels_per_unit = 1.0) {
  GuidanceBuffers g;
  const auto scalar = [&] { return Grid<float>(width, height, 0.0F); };
  const auto vector = [&] { return Grid<glm::vec3>(width, height, glm::vec3(0.0F)); };
  g.depth_m = Grid<float>(width, height, std::numeric_limits<float>::infinity());
  g.position_m = g.normal = g.normal_detail = g.normal_smooth = vector();
  g.altitude_m = g.slope_deg = g.relief_s_m = g.relief_m_m = g.relief_l_m = g.valley_height_m =
      g.footprint_m = g.tone = g.rim_m = g.built = scalar();
  g.shadow = g.sky_view = Grid<float>(width, height, 1.0F);
  g.land_cover = Grid<LandCoverClass>(width, height, LandCoverClass::sky);
  g.fall_line = g.grain = Grid<glm::vec2>(width, height, glm::vec2(0.0F));
  constexpr int ranges = 4;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t i = g.depth_m.index(x, y);
      g.normal[i] = g.normal_detail[i] = g.normal_smooth[i] = {0.0F, 0.0F, 1.0F};
      const double u = (x + 0.5) / pixels_per_unit;
      const double v = (y + 0.5) / pixels_per_unit;
      for (int range = ranges - 1; range >= 0; --range) {  // from the nearest
        const double crest = 30.0 + 28.0 * range + 9.0 * gaussian_noise(40, u, 100.0 * range, 14.0);
        if (v < crest) continue;
        const double depth = 20000.0 + 25000.0 * (ranges - 1 - range) - 40.0 * (v - crest);
        const double e = (u - 100.0) * depth / 2500.0;
        const double n = -depth + 60.0 * (v - crest);
        const double nx = 0.5 * gaussian_noise(41, e, n, 900.0);
        const double ny = 0.4 + 0.3 * gaussian_noise(42, e, n, 900.0);
        const glm::vec3 smooth = glm::normalize(glm::vec3(nx, ny, 1.0));
        g.depth_m[i] = static_cast<float>(depth);
        g.position_m[i] = {static_cast<float>(e), static_cast<float>(n),
                           static_cast<float>(2400.0 - 12.0 * (v - crest))};
        g.altitude_m[i] = g.position_m[i].z;
        g.normal_smooth[i] = smooth;
        g.normal[i] =
            glm::normalize(smooth + glm::vec3(0.2 * gaussian_noise(43, e, n, 250.0), 0.0, 0.0));
        g.normal_detail[i] = glm::normalize(
            smooth + glm::vec3(0.4 * gaussian_noise(44, e, n, 120.0), 0.2 * nx, 0.0));
        g.slope_deg[i] = static_cast<float>(25.0 + 15.0 * gaussian_noise(45, e, n, 500.0));
        g.relief_s_m[i] = static_cast<float>(8.0 * gaussian_noise(46, e, n, 180.0));
        g.relief_m_m[i] = static_cast<float>(60.0 * gaussian_noise(47, e, n, 750.0));
        g.relief_l_m[i] = static_cast<float>(150.0 * gaussian_noise(48, e, n, 1800.0));
        g.shadow[i] = gaussian_noise(49, e, n, 700.0) > 0.7 ? 0.0F : 1.0F;
        g.sky_view[i] =
            static_cast<float>(std::min(1.0, 0.8 + 0.1 * gaussian_noise(50, e, n, 400.0)));
        g.rim_m[i] = static_cast<float>(std::abs(e - 2000.0));  // it ends in the east
        g.footprint_m[i] = static_cast<float>(depth / 2500.0 / pixels_per_unit);
        g.built[i] =
            static_cast<float>(std::max(0.0, std::min(1.0, 0.5 * gaussian_noise(52, e, n, 600.0))));
        g.grain[i] = 0.5F * glm::vec2(nx, ny);
        const double kind = 5.5 + 3.0 * gaussian_noise(51, e, n, 800.0);
        g.land_cover[i] =
            static_cast<LandCoverClass>(std::min(11, std::max(1, static_cast<int>(kind))));
        if (g.slope_deg[i] > 8.0F) g.fall_line[i] = glm::normalize(glm::vec2(0.6 * nx, 1.0));
        break;
      }
    }
  return g;
}

template <class T>
Grid<T> cut(const Grid<T>& grid, PixelRect rect) {
  if (grid.empty()) return {};
  Grid<T> part(rect.width(), rect.height());
  for (int y = 0; y < part.height(); ++y)
    for (int x = 0; x < part.width(); ++x) part(x, y) = grid(rect.x0 + x, rect.y0 + y);
  return part;
}

inline GuidanceBuffers cut(const GuidanceBuffers& g, PixelRect r) {
  GuidanceBuffers part;
  for (const GuidanceChannel& channel : guidance_channels())
    std::visit([&](auto member) { part.*member = cut(g.*member, r); }, channel.member);
  return part;
}

// The part of a picture that a rectangle needs when each pixel depends on neighbours within
// `margin_px`.
inline PixelRect with_margin(PixelRect r, int margin_px, int width, int height) {
  return {std::max(r.x0 - margin_px, 0), std::max(r.y0 - margin_px, 0),
          std::min(r.x1 + margin_px, width), std::min(r.y1 + margin_px, height)};
}

// A plain slope, evenly lit, without sky: for one rule at a time.
inline GuidanceBuffers make_slope(int width, int height, LandCoverClass id, glm::vec3 normal,
                                  float slope_deg) {
  GuidanceBuffers g;
  g.depth_m = Grid<float>(width, height, 20000.0F);
  g.position_m = Grid<glm::vec3>(width, height, glm::vec3(0.0F, 0.0F, 1200.0F));
  g.normal = g.normal_detail = g.normal_smooth =
      Grid<glm::vec3>(width, height, glm::normalize(normal));
  g.altitude_m = Grid<float>(width, height, 1200.0F);
  g.slope_deg = Grid<float>(width, height, slope_deg);
  g.relief_s_m = g.relief_m_m = g.relief_l_m = g.valley_height_m = Grid<float>(width, height, 0.0F);
  g.shadow = g.sky_view = Grid<float>(width, height, 1.0F);
  g.land_cover = Grid<LandCoverClass>(width, height, id);
  g.fall_line = Grid<glm::vec2>(width, height, glm::vec2(0.0F, 1.0F));
  g.tone = Grid<float>(width, height, 0.6F);
  g.footprint_m = Grid<float>(width, height, 15.0F);  // near enough for every form to be drawn
  g.rim_m = Grid<float>(width, height, 1e6F);
  g.built = Grid<float>(width, height, 0.5F);
  g.grain = Grid<glm::vec2>(width, height, glm::vec2(0.0F));
  return g;
}

inline double mean(const Grid<float>& grid) {
  double sum = 0.0;
  for (const float value : grid) sum += value;
  return sum / static_cast<double>(grid.size());
}

}  // namespace belvedere::test
