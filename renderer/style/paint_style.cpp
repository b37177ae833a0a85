#include "renderer/style/paint_style.h"

#include <algorithm>

#include "base/grid_part.h"
#include "renderer/style/stroke_direction.h"
#include "renderer/style/style_finish.h"
#include "renderer/style/style_strokes.h"

namespace belvedere {

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
