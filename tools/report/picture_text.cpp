#include "tools/report/picture_text.h"

#include <cmath>

#include "base/text/hex_colour.h"
#include "renderer/labels/sheet_painter.h"

namespace belvedere::tools {
namespace {

constexpr int capital_px = 7;  // at scale 1

TextStyle type_of(int scale) { return {.family = "sans-serif", .size_px = 9.0 * scale}; }

}  // namespace

int text_width(const std::string& text, int scale) {
  return text.empty()
             ? 0
             : static_cast<int>(std::ceil(TextMeasure().measure(text, type_of(scale)).width_px));
}

void draw_text(Grid<glm::vec3>& picture, int x, int y, const std::string& text, glm::vec3 colour,
               int scale) {
  if (text.empty()) return;
  const DrawnText line{.text = text,
                       .type = type_of(scale),
                       .at = {x, y + capital_px * scale},
                       .colour = hex_colour(colour)};
  SheetPainter({.size_px = {picture.width(), picture.height()}, .shapes = {line}})
      .paint(picture, {0, 0});
}

}  // namespace belvedere::tools
