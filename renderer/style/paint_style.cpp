#include "renderer/style/paint_style.h"

#include <algorithm>
#include <glm/common.hpp>

#include "base/grid.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/image/srgb.h"
#include "renderer/paint/picture_filter.h"
#include "renderer/paint/picture_noise.h"
#include "renderer/style/stroke_direction.h"

namespace belvedere {
namespace {

constexpr double detail_share = 0.5;
constexpr double relief_sigma_px = 0.45;  // avoids glitter of single pixels
// Size of the canvas threads, units: along and across.
constexpr double thread_units = 3.2;
constexpr double thread_width_units = 1.0;

double detail_sigma_px(const StylePaintParameters& parameters) {
  return 1.6 * parameters.pixels_per_unit + 0.6;
}

// Distance each way over which the slope of the paint is measured: about 1.2 units of the sheet.
int relief_step_px(const StylePaintParameters& parameters) {
  return std::max(1, static_cast<int>(1.2 * parameters.pixels_per_unit + 0.5));
}

Grid<float> canvas_weave(const StylePaintParameters& parameters, PixelRect rect) {
  const auto threads = [&](std::uint64_t way, double x, double y) {
    return make_image_noise(stream_seed(parameters.seed, Stream::style_weave, way),
                            {rect.x0, rect.y0}, rect.width(), rect.height(),
                            parameters.pixels_per_unit, x, y);
  };
  Grid<float> weave = threads(0, thread_width_units, thread_units);
  const Grid<float> across = threads(1, thread_units, thread_width_units);
  for (std::size_t i = 0; i < weave.size(); ++i) weave[i] = 0.5F * (weave[i] + across[i]);
  return weave;
}

}  // namespace

Grid<glm::vec3> finish_style(const Style& style, const StyleWindow& window,
                             const StyleCanvas& canvas, PixelRect canvas_rect,
                             const StylePaintParameters& parameters, PixelRect wanted) {
  const glm::ivec2 origin = window.origin_px;
  const GuidanceBuffers& guidance = window.guidance;
  const PixelRect window_rect =
      moved({0, 0, guidance.width(), guidance.height()}, origin.x, origin.y);
  const PixelRect around =
      intersection(window_rect, grown(wanted, style_detail_margin_px(parameters)));
  Grid<float> light(around.width(), around.height());
  for (int y = around.y0; y < around.y1; ++y)
    for (int x = around.x0; x < around.x1; ++x)
      light(x - around.x0, y - around.y0) = window.ground.colour(x - origin.x, y - origin.y).x;
  const Grid<float> smoothed =
      blur_in_picture(light, detail_sigma_px(parameters), {around.x0, around.y0});
  const Grid<float> height =
      blur_in_picture(canvas.height, relief_sigma_px, {canvas_rect.x0, canvas_rect.y0});
  const Grid<float> weave =
      parameters.weave > 0.0 ? canvas_weave(parameters, wanted) : Grid<float>();
  const int step = relief_step_px(parameters);
  const auto detail = static_cast<float>(detail_share * (1.0 - 0.2 * style.vapour));
  const auto share = static_cast<float>(parameters.brushwork);
  Grid<glm::vec3> out(wanted.width(), wanted.height());
  parallel_ranges(wanted.height(), 8, [&](int begin, int end) {
    for (int y = wanted.y0 + begin; y < wanted.y0 + end; ++y)
      for (int x = wanted.x0; x < wanted.x1; ++x) {
        const std::size_t i = guidance.depth_m.index(x - origin.x, y - origin.y);
        const int u = x - canvas_rect.x0;
        const int v = y - canvas_rect.y0;
        glm::vec3 paint = canvas.colour(u, v);
        if (!guidance.is_sky(i)) {
          const std::size_t k = light.index(x - around.x0, y - around.y0);
          paint.x += detail * (light[k] - smoothed[k]);
        }
        const float slope = height.clamped(u - step, v) - height.clamped(u + step, v) +
                            height.clamped(u, v - step) - height.clamped(u, v + step);
        // Light from the upper left brightens slopes that face it.
        paint.x -= static_cast<float>(parameters.paint_relief) * std::clamp(slope, -0.8F, 0.8F) *
                   (0.5F + paint.x);
        if (!weave.empty())
          paint.x += static_cast<float>(parameters.weave) * weave(x - wanted.x0, y - wanted.y0);
        const glm::vec3 mixed = glm::mix(window.ground.colour[i], paint, share);
        out(x - wanted.x0, y - wanted.y0) = glm::clamp(from_oklab(glm::dvec3(mixed)), 0.0F, 1.0F);
      }
  });
  return out;
}

int style_finish_margin_px(const StylePaintParameters& parameters) {
  return relief_step_px(parameters) + blur_reach_px(relief_sigma_px);
}

int style_detail_margin_px(const StylePaintParameters& parameters) {
  return blur_reach_px(detail_sigma_px(parameters));
}

StyleGround prepare_style(const Style& style, const GuidanceBuffers& guidance,
                          const Grid<glm::vec3>& render, const Grid<float>& veil,
                          const StylePaintParameters& parameters, glm::ivec2 origin_px,
                          PixelRect wanted) {
  const StyleGround ground =
      make_style_ground(style, guidance, render, veil, parameters, origin_px);
  const Grid<glm::vec2> along =
      make_stroke_direction(style, guidance, ground.colour, parameters, origin_px);
  return {part_of(ground.colour, wanted), part_of(ground.smoothed, wanted), part_of(along, wanted)};
}

int style_preparation_margin_px(const Style& style, const StylePaintParameters& parameters) {
  return style_ground_margin_px(style, parameters) + stroke_direction_margin_px(parameters);
}

Grid<glm::vec3> lay_style(const Style& style, const GuidanceBuffers& guidance,
                          const StyleGround& ground, const StylePaintParameters& parameters,
                          glm::ivec2 origin_px, PixelRect wanted) {
  const StyleWindow window{guidance, ground, origin_px};
  const PixelRect asked = moved(wanted, origin_px.x, origin_px.y);
  const PixelRect painted = intersection(grown(asked, style_finish_margin_px(parameters)),
                                         {0, 0, parameters.sheet_px.x, parameters.sheet_px.y});
  const StyleCanvas canvas = paint_style_strokes(style, window, parameters, painted);
  return finish_style(style, window, canvas, painted, parameters, asked);
}

int style_laying_margin_px(const Style& style, const StylePaintParameters& parameters) {
  return std::max(style_finish_margin_px(parameters) + style_stroke_margin_px(style, parameters),
                  style_detail_margin_px(parameters));
}

Grid<glm::vec3> paint_style(const Style& style, const GuidanceBuffers& guidance,
                            const Grid<glm::vec3>& render, const Grid<float>& veil,
                            const StylePaintParameters& parameters, glm::ivec2 origin_px,
                            PixelRect wanted) {
  const StyleGround ground = prepare_style(style, guidance, render, veil, parameters, origin_px,
                                           {0, 0, guidance.width(), guidance.height()});
  return lay_style(style, guidance, ground, parameters, origin_px, wanted);
}

int style_margin_px(const Style& style, const StylePaintParameters& parameters) {
  return style_preparation_margin_px(style, parameters) + style_laying_margin_px(style, parameters);
}

}  // namespace belvedere
