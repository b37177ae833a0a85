#include "renderer/paint/reflection.h"

#include <algorithm>
#include <cmath>

#include "base/guidance_channels.h"
#include "base/parallel.h"
#include "renderer/paint/picture_filter.h"

namespace belvedere {
namespace {

constexpr double reflection_units = 34.0;  // reach of the shore's image into the water
constexpr float fade_units = 22.0F;        // distance over which it fades
constexpr double meadow_units =
    30.0;  // width of level shore beyond which the slope behind is still reflected …
constexpr float meadow_half_units = 14.0F;  // … at half strength from here
constexpr float level_deg = 8.0F;           // flatter shores have no image
constexpr float foreshortening =
    1.25F;  // seen from above, the image of a slope is shorter than the slope

bool is_water(const GuidanceBuffers& g, int x, int y) {
  return g.land_cover(x, y) == LandCoverClass::water;
}

}  // namespace

Mirrored find_reflections(const GuidanceBuffers& guidance, double pixels_per_unit,
                          PixelRect wanted) {
  require_channels(
      guidance,
      {&GuidanceBuffers::depth_m, &GuidanceBuffers::land_cover, &GuidanceBuffers::slope_deg},
      "reflections");
  const int width = guidance.width();
  const int height = guidance.height();
  if (wanted.empty()) wanted = {0, 0, width, height};
  const int reach_px = static_cast<int>(std::ceil(reflection_units * pixels_per_unit));
  const int meadow_px = static_cast<int>(std::ceil(meadow_units * pixels_per_unit));
  const auto ppu = static_cast<float>(pixels_per_unit);
  const auto is_level = [&](int x, int y) { return guidance.slope_deg(x, y) < level_deg; };
  Mirrored mirrored{Grid<std::int32_t>(width, height, -1), Grid<float>(width, height, 0.0F),
                    Grid<float>(width, height, open_water), Grid<float>(width, height, open_water)};
  parallel_rows(wanted.height(), [&](int row) {
    const int y = wanted.y0 + row;
    for (int x = wanted.x0; x < wanted.x1; ++x) {
      if (!is_water(guidance, x, y)) continue;
      int below = 1;
      while (below <= reach_px && y + below < height && is_water(guidance, x, y + below)) ++below;
      if (below <= reach_px && y + below < height &&
          same_surface(guidance.depth_m(x, y), guidance.depth_m(x, y + below)))
        mirrored.to_near(x, y) = static_cast<float>(below) / ppu;
      int above = 1;
      while (above <= reach_px && y - above >= 0 && is_water(guidance, x, y - above)) ++above;
      const int shore = y - above;
      // A silhouette in front of the water is not a shore: it is nearer than the water.
      if (above > reach_px || shore < 0 ||
          !same_surface(guidance.depth_m(x, y), guidance.depth_m(x, shore)))
        continue;
      mirrored.to_far(x, y) = static_cast<float>(above) / ppu;
      // A level meadow has no image: the slope behind it is reflected.
      int foot = shore;
      while (shore - foot < meadow_px && foot > 0 && is_level(x, foot) &&
             !is_water(guidance, x, foot) &&
             same_surface(guidance.depth_m(x, foot), guidance.depth_m(x, foot - 1)))
        --foot;
      if (is_level(x, foot) || is_water(guidance, x, foot)) continue;
      const int mirrored_row = std::max(
          foot - static_cast<int>(std::lround(foreshortening * static_cast<float>(above))), 0);
      int top = foot;
      while (top > mirrored_row && !is_water(guidance, x, top - 1) &&
             same_surface(guidance.depth_m(x, top), guidance.depth_m(x, top - 1)))
        --top;
      mirrored.source(x, y) = static_cast<std::int32_t>(guidance.depth_m.index(x, top));
      // Steep shores have dark images, level ones hardly any: the image of a meadow is only a line.
      const float into_units = static_cast<float>(above / pixels_per_unit);
      const float cut_short =
          top > mirrored_row ? std::max(0.0F, 1.0F - static_cast<float>(top - mirrored_row) /
                                                         static_cast<float>(pixels_per_unit) / 6.0F)
                             : 1.0F;
      mirrored.share(x, y) = std::max(0.0F, 1.0F - into_units / fade_units) * cut_short /
                             (1.0F + static_cast<float>(shore - foot) / ppu / meadow_half_units);
    }
  });
  return mirrored;
}

int reflection_margin_px(double pixels_per_unit) {
  const int reach_px = static_cast<int>(std::ceil(reflection_units * pixels_per_unit));
  const int meadow_px = static_cast<int>(std::ceil(meadow_units * pixels_per_unit));
  return reach_px + meadow_px +
         static_cast<int>(std::ceil(foreshortening * static_cast<float>(reach_px))) + 1;
}

}  // namespace belvedere
