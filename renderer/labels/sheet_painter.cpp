#include "renderer/labels/sheet_painter.h"

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text/hex_colour.h"
#include "renderer/labels/placed_text.h"

namespace belvedere {
namespace {

// Side of a tile. What is painted in a tile depends only on its position on the sheet.
constexpr int tile_px = 128;

// Cairo counts in 256ths of a pixel: positions are rounded to them on the sheet, so that no tile
// rounds differently from its neighbour.
double on_grid(double value) { return std::round(value * 256.0) / 256.0; }

// Something to fill or to stroke in one colour.
struct Stroke {
  Outline outline;
  std::string colour;
  bool fills = true;
  double width_px = 0.0;  // of a stroke
  std::vector<double> dashes_px;
  double opacity = 1.0;
  bool round_caps = true;
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;  // bounds of its pixels
};

Stroke prepared(Outline outline, std::string colour, bool fills, double width_px) {
  Stroke stroke{.outline = std::move(outline),
                .colour = std::move(colour),
                .fills = fills,
                .width_px = width_px,
                .dashes_px = {}};
  stroke.left = stroke.top = std::numeric_limits<double>::infinity();
  stroke.right = stroke.bottom = -stroke.left;
  for (OutlineStep& step : stroke.outline)
    for (int i = 0; i < points_of(step.kind); ++i) {
      glm::dvec2& p = step.points[static_cast<std::size_t>(i)];
      p = {on_grid(p.x), on_grid(p.y)};
      stroke.left = std::min(stroke.left, p.x);
      stroke.right = std::max(stroke.right, p.x);
      stroke.top = std::min(stroke.top, p.y);
      stroke.bottom = std::max(stroke.bottom, p.y);
    }
  const double reach = .5 * width_px + 1.5;
  stroke.left -= reach;
  stroke.top -= reach;
  stroke.right += reach;
  stroke.bottom += reach;
  return stroke;
}

Outline outline_of(const std::vector<glm::dvec2>& points, bool closed) {
  Outline outline;
  for (const glm::dvec2 p : points)
    outline.push_back({outline.empty() ? OutlineStep::move : OutlineStep::line, {p}});
  if (closed) outline.push_back({OutlineStep::close, {}});
  return outline;
}

// Four Bézier curves, which deviate from a circle by at most .03 % of its radius (k = 4/3 (√2 -
// 1)).
Outline circle_outline(glm::dvec2 m, double r) {
  constexpr double k = 0.5522847498307936;
  const auto at = [&](double x, double y) { return m + r * glm::dvec2(x, y); };
  return {{OutlineStep::move, {at(1, 0)}},
          {OutlineStep::curve, {at(1, k), at(k, 1), at(0, 1)}},
          {OutlineStep::curve, {at(-k, 1), at(-1, k), at(-1, 0)}},
          {OutlineStep::curve, {at(-1, -k), at(-k, -1), at(0, -1)}},
          {OutlineStep::curve, {at(k, -1), at(1, -k), at(1, 0)}},
          {OutlineStep::close, {}}};
}

glm::dvec3 rgb_of(const std::string& colour) {
  const std::optional<glm::vec3> rgb = colour_of_hex(colour);
  if (!rgb) throw Error(ErrorKind::bug, "a drawing", "the colour \"" + colour + '"', "#rrggbb");
  return glm::dvec3(*rgb);
}

void trace(cairo_t* cairo, const Outline& outline, glm::dvec2 origin) {
  cairo_new_path(cairo);
  for (const OutlineStep& step : outline) {
    const auto p = [&](std::size_t i) { return step.points[i] - origin; };
    switch (step.kind) {
      case OutlineStep::move:
        cairo_move_to(cairo, p(0).x, p(0).y);
        break;
      case OutlineStep::line:
        cairo_line_to(cairo, p(0).x, p(0).y);
        break;
      case OutlineStep::curve:
        cairo_curve_to(cairo, p(0).x, p(0).y, p(1).x, p(1).y, p(2).x, p(2).y);
        break;
      case OutlineStep::close:
        cairo_close_path(cairo);
        break;
    }
  }
}

void paint_stroke(cairo_t* cairo, const Stroke& stroke, glm::dvec2 origin) {
  const glm::dvec3 rgb = rgb_of(stroke.colour);
  cairo_set_source_rgba(cairo, rgb.r, rgb.g, rgb.b, stroke.opacity);
  trace(cairo, stroke.outline, origin);
  if (stroke.fills) {
    cairo_fill(cairo);
    return;
  }
  cairo_set_line_width(cairo, stroke.width_px);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(cairo, stroke.round_caps && stroke.dashes_px.empty() ? CAIRO_LINE_CAP_ROUND
                                                                          : CAIRO_LINE_CAP_BUTT);
  cairo_set_dash(cairo, stroke.dashes_px.data(), static_cast<int>(stroke.dashes_px.size()), 0.0);
  cairo_stroke(cairo);
}

int tile_of(int pixel) { return pixel >= 0 ? pixel / tile_px : -((tile_px - 1 - pixel) / tile_px); }

}  // namespace

struct SheetPainter::State {
  std::vector<Stroke> strokes;
};

SheetPainter::SheetPainter(const Drawing& drawing) : state_(std::make_unique<State>()) {
  std::vector<Stroke>& strokes = state_->strokes;
  std::unique_ptr<TextMeasure> measure;
  for (const DrawnShape& shape : drawing.shapes) {
    if (const DrawnPath* path = std::get_if<DrawnPath>(&shape);
        path != nullptr && path->points.size() > 1) {
      const Outline outline = outline_of(path->points, path->closed);
      const std::size_t first = strokes.size();
      if (!path->fill.empty()) strokes.push_back(prepared(outline, path->fill, true, 0.0));
      if (!path->stroke.empty() && path->width_px > 0.0) {
        strokes.push_back(prepared(outline, path->stroke, false, path->width_px));
        strokes.back().dashes_px = path->dashes_px;
      }
      for (std::size_t i = first; i < strokes.size(); ++i) strokes[i].opacity = path->opacity;
    }
    if (const DrawnCircle* circle = std::get_if<DrawnCircle>(&shape)) {
      const Outline outline = circle_outline(circle->centre, circle->radius_px);
      if (!circle->fill.empty()) strokes.push_back(prepared(outline, circle->fill, true, 0.0));
      if (!circle->stroke.empty())
        strokes.push_back(prepared(outline, circle->stroke, false, circle->width_px));
    }
    if (const DrawnText* text = std::get_if<DrawnText>(&shape)) {
      if (!measure) measure = std::make_unique<TextMeasure>();
      const Outline outline = outline_of(place_letters(*text, *measure));
      if (outline.empty()) continue;
      if (!text->halo.empty() && text->halo_px > 0.0)
        strokes.push_back(prepared(outline, text->halo, false, 2.0 * text->halo_px));
      strokes.push_back(prepared(outline, text->colour, true, 0.0));
    }
  }
}

SheetPainter::~SheetPainter() = default;

void SheetPainter::paint(Grid<glm::vec3>& encoded, glm::ivec2 at) const {
  const PixelRect whole{at.x, at.y, at.x + encoded.width(), at.y + encoded.height()};
  const int first_x = tile_of(whole.x0);
  const int first_y = tile_of(whole.y0);
  const int columns = tile_of(whole.x1 - 1) - first_x + 1;
  const int rows = tile_of(whole.y1 - 1) - first_y + 1;
  parallel_ranges<int>(columns * rows, 1, [&](int begin, int end) {
    std::vector<std::uint32_t> pixels(static_cast<std::size_t>(tile_px) * tile_px);
    for (int t = begin; t < end; ++t) {
      const int x0 = (first_x + t % columns) * tile_px;
      const int y0 = (first_y + t / columns) * tile_px;
      const auto touches = [&](const Stroke& s) {
        return s.left < x0 + tile_px && s.right > x0 && s.top < y0 + tile_px && s.bottom > y0;
      };
      if (std::none_of(state_->strokes.begin(), state_->strokes.end(), touches)) continue;
      std::fill(pixels.begin(), pixels.end(), 0U);
      cairo_surface_t* surface =
          cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels.data()),
                                              CAIRO_FORMAT_ARGB32, tile_px, tile_px, 4 * tile_px);
      cairo_t* cairo = cairo_create(surface);
      for (const Stroke& stroke : state_->strokes)
        if (touches(stroke)) paint_stroke(cairo, stroke, {x0, y0});
      const cairo_status_t status = cairo_status(cairo);
      cairo_destroy(cairo);
      cairo_surface_flush(surface);
      cairo_surface_destroy(surface);
      if (status != CAIRO_STATUS_SUCCESS)
        throw Error(ErrorKind::bug, "names in the picture", cairo_status_to_string(status), "");
      // Colours are premultiplied by their alpha.
      const PixelRect shown = intersection({x0, y0, x0 + tile_px, y0 + tile_px}, whole);
      for (int y = shown.y0; y < shown.y1; ++y)
        for (int x = shown.x0; x < shown.x1; ++x) {
          const std::uint32_t value =
              pixels[static_cast<std::size_t>(y - y0) * tile_px + static_cast<std::size_t>(x - x0)];
          const std::uint32_t alpha = value >> 24;
          if (alpha == 0) continue;
          const glm::vec3 over =
              glm::vec3((value >> 16) & 255U, (value >> 8) & 255U, value & 255U) / 255.0F;
          glm::vec3& pixel = encoded(x - at.x, y - at.y);
          pixel = alpha == 255 ? over : over + pixel * (1.0F - static_cast<float>(alpha) / 255.0F);
        }
    }
  });
}

}  // namespace belvedere
