#include "renderer/labels/sheet_painter.h"

#include <cairo.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <limits>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text/hex_colour.h"
#include "renderer/image/srgb.h"
#include "renderer/labels/drawing_svg.h"

namespace belvedere {
namespace {

constexpr float levels = 65535.0F;  // of a blurred colour
constexpr double always = 0.10;     // share of the way to white, or of black, in any case
constexpr double max_gain = 1.7;    // factor up to which light is added before white
constexpr double blur = 1.2;        // radius, of a halo's width
constexpr double flare = 0.05;      // of WCAG's contrast

glm::dvec3 linear_of(glm::vec3 colour) {
  return {srgb_decoded(static_cast<double>(colour.r)), srgb_decoded(static_cast<double>(colour.g)),
          srgb_decoded(static_cast<double>(colour.b))};
}

double luminance_of_linear(glm::dvec3 c) { return .2126 * c.r + .7152 * c.g + .0722 * c.b; }

using Levels = std::array<std::uint32_t, 3>;

// A box filter along a line, whose first `2 radius` results are lost; sums are exact.
void filter_line(std::vector<Levels>& line, int radius) {
  const auto width = static_cast<std::size_t>(2 * radius + 1);
  std::vector<Levels> out(line.size() - (width - 1));
  Levels sum{};
  for (std::size_t i = 0; i < line.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      sum[c] += line[i][c];
      if (i + 1 < width) continue;
      out[i + 1 - width][c] =
          (sum[c] + static_cast<std::uint32_t>(radius)) / static_cast<std::uint32_t>(width);
      sum[c] -= line[i + 1 - width][c];
    }
  line = std::move(out);
}

}  // namespace

double luminance(glm::vec3 colour) { return luminance_of_linear(linear_of(colour)); }

double contrast(glm::vec3 a, glm::vec3 b) {
  const double light = std::max(luminance(a), luminance(b));
  const double dark = std::min(luminance(a), luminance(b));
  return (light + flare) / (dark + flare);
}

glm::vec3 halo_colour(glm::vec3 paint, const HaloAim& aim) {
  const double letters = luminance(aim.letters) + flare;
  glm::dvec3 c = linear_of(paint);
  const double now = luminance_of_linear(c);
  if (aim.lightens) {
    const double wanted =
        std::min(1.0, std::max(aim.contrast * letters - flare, now + always * (1.0 - now)));
    const double brightest = std::max({c.r, c.g, c.b, 1e-6});
    if (now > 0.0) c *= std::clamp(wanted / now, 1.0, std::min(max_gain, 1.0 / brightest));
    const double reached = luminance_of_linear(c);
    if (reached < wanted) c = glm::mix(c, glm::dvec3(1.0), (wanted - reached) / (1.0 - reached));
  } else if (now > 0.0) {
    c *= std::clamp((letters / aim.contrast - flare) / now, 0.0, 1.0 - always);
  }
  return {srgb_encoded(c.r), srgb_encoded(c.g), srgb_encoded(c.b)};
}

int halo_blur_px(double halo_px) {
  return std::max(1, static_cast<int>(std::lround(blur * halo_px)));
}

Grid<glm::vec3> blurred(const PictureWindow& picture, PixelRect rect, int radius_px) {
  const int reach = halo_reach_px(radius_px);
  const int columns = rect.width() + 2 * reach;
  const int rows = rect.height() + 2 * reach;
  const auto level = [](float value) {
    return static_cast<std::uint32_t>(std::clamp(value, 0.0F, 1.0F) * levels + .5F);
  };
  // Rows first; all of them, as columns read them.
  std::vector<std::vector<Levels>> lines(static_cast<std::size_t>(rows));
  for (int y = 0; y < rows; ++y) {
    std::vector<Levels>& line = lines[static_cast<std::size_t>(y)];
    const int from_y =
        std::clamp(rect.y0 - reach + y - picture.at.y, 0, picture.pixels.height() - 1);
    for (int x = 0; x < columns; ++x) {
      const int from_x =
          std::clamp(rect.x0 - reach + x - picture.at.x, 0, picture.pixels.width() - 1);
      const glm::vec3 c = picture.pixels(from_x, from_y);
      line.push_back({level(c.r), level(c.g), level(c.b)});
    }
    for (int pass = 0; pass < 3; ++pass) filter_line(line, radius_px);
  }
  Grid<glm::vec3> out(rect.width(), rect.height());
  std::vector<Levels> column;
  for (int x = 0; x < rect.width(); ++x) {
    column.clear();
    for (const std::vector<Levels>& line : lines)
      column.push_back(line[static_cast<std::size_t>(x)]);
    for (int pass = 0; pass < 3; ++pass) filter_line(column, radius_px);
    for (int y = 0; y < rect.height(); ++y) {
      const Levels& c = column[static_cast<std::size_t>(y)];
      out(x, y) = glm::vec3(c[0], c[1], c[2]) / levels;
    }
  }
  return out;
}

namespace {

// Side of a tile. What is painted in a tile depends only on its position on the sheet.
constexpr int tile_px = 128;
// Letters darker than this are dark ones, on ground that must be light: the luminance whose
// contrasts to black and to white are equal.
constexpr double middle_luminance = 0.179;

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
  bool below = true;                                        // below the halos of the painting
  bool is_plain_halo = false;                               // left out where there is a painting
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

bool touches(const Stroke& s, const PixelRect& tile) {
  return s.left < tile.x1 && s.right > tile.x0 && s.top < tile.y1 && s.bottom > tile.y0;
}

// The pixels of a tile, painted by Cairo.
class Surface {
 public:
  Surface()
      : pixels_(static_cast<std::size_t>(tile_px) * tile_px),
        surface_(cairo_image_surface_create_for_data(
            reinterpret_cast<unsigned char*>(pixels_.data()), CAIRO_FORMAT_ARGB32, tile_px, tile_px,
            4 * tile_px)),
        cairo_(cairo_create(surface_)) {}
  ~Surface() {
    cairo_destroy(cairo_);
    cairo_surface_destroy(surface_);
  }
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

  cairo_t* cairo() const { return cairo_; }
  // After the last stroke.
  void finish() const {
    const cairo_status_t status = cairo_status(cairo_);
    cairo_surface_flush(surface_);
    if (status != CAIRO_STATUS_SUCCESS)
      throw Error(ErrorKind::bug, "names in the picture", cairo_status_to_string(status), "");
  }
  std::uint32_t pixel(int x, int y) const {
    return pixels_[static_cast<std::size_t>(y) * tile_px + static_cast<std::size_t>(x)];
  }

 private:
  std::vector<std::uint32_t> pixels_;
  cairo_surface_t* surface_;
  cairo_t* cairo_;
};

// Letters around which the painting is their halo.
struct PaintedHalo {
  Stroke outline;  // as wide as the halo reaches
  double halo_px = 0.0;
  HaloAim aim;
};

// Strength of a halo at a distance from the letters' edge, of halo_px: full beside the letters,
// then fading, so that it has no edge of its own.
constexpr std::array<glm::dvec2, 6> fades = {
    {{2.2, .12}, {1.9, .3}, {1.6, .52}, {1.3, .74}, {1.05, .9}, {.8, 1.0}}};

// The strength of a halo in a tile, one value a pixel.
void paint_strength(const PaintedHalo& halo, cairo_t* cairo, glm::dvec2 origin) {
  double before = 0.0;
  for (const glm::dvec2 fade : fades) {
    Stroke stroke = halo.outline;
    stroke.width_px = 2.0 * fade.x * halo.halo_px;
    stroke.opacity = before < 1.0 ? (fade.y - before) / (1.0 - before) : 0.0;
    before = fade.y;
    paint_stroke(cairo, stroke, origin);
  }
  Stroke inside = halo.outline;
  inside.fills = true;
  paint_stroke(cairo, inside, origin);
}

int tile_of(int pixel) { return pixel >= 0 ? pixel / tile_px : -((tile_px - 1 - pixel) / tile_px); }

}  // namespace

struct SheetPainter::State {
  std::vector<Stroke> strokes;
  std::vector<PaintedHalo> halos;

  void paint_tile(Grid<glm::vec3>& encoded, glm::ivec2 at, glm::ivec2 corner,
                  const PictureWindow* picture) const {
    const PixelRect tile{corner.x, corner.y, corner.x + tile_px, corner.y + tile_px};
    const PixelRect shown =
        intersection(tile, {at.x, at.y, at.x + encoded.width(), at.y + encoded.height()});
    const auto paint_strokes = [&](bool below) {
      const auto is_part = [&](const Stroke& s) {
        return s.below == below && !(s.is_plain_halo && picture != nullptr) && touches(s, tile);
      };
      if (std::none_of(strokes.begin(), strokes.end(), is_part)) return;
      const Surface surface;
      for (const Stroke& stroke : strokes)
        if (is_part(stroke)) paint_stroke(surface.cairo(), stroke, corner);
      surface.finish();
      // Colours are premultiplied by their alpha.
      for (int y = shown.y0; y < shown.y1; ++y)
        for (int x = shown.x0; x < shown.x1; ++x) {
          const std::uint32_t value = surface.pixel(x - corner.x, y - corner.y);
          const std::uint32_t alpha = value >> 24;
          if (alpha == 0) continue;
          const glm::vec3 over =
              glm::vec3((value >> 16) & 255U, (value >> 8) & 255U, value & 255U) / 255.0F;
          glm::vec3& pixel = encoded(x - at.x, y - at.y);
          pixel = alpha == 255 ? over : over + pixel * (1.0F - static_cast<float>(alpha) / 255.0F);
        }
    };
    paint_strokes(true);
    if (picture != nullptr)
      for (const PaintedHalo& halo : halos)
        if (touches(halo.outline, tile)) paint_halo(halo, encoded, at, corner, shown, *picture);
    paint_strokes(false);
  }

  static void paint_halo(const PaintedHalo& halo, Grid<glm::vec3>& encoded, glm::ivec2 at,
                         glm::ivec2 corner, PixelRect shown, const PictureWindow& picture) {
    const Surface surface;
    paint_strength(halo, surface.cairo(), corner);
    surface.finish();
    const Stroke& reach = halo.outline;
    const PixelRect rect = intersection(
        shown,
        {static_cast<int>(std::floor(reach.left)), static_cast<int>(std::floor(reach.top)),
         static_cast<int>(std::ceil(reach.right)), static_cast<int>(std::ceil(reach.bottom))});
    if (rect.empty()) return;
    const Grid<glm::vec3> ground = blurred(picture, rect, halo_blur_px(halo.halo_px));
    for (int y = rect.y0; y < rect.y1; ++y)
      for (int x = rect.x0; x < rect.x1; ++x) {
        const std::uint32_t alpha = surface.pixel(x - corner.x, y - corner.y) >> 24;
        if (alpha == 0) continue;
        glm::vec3& pixel = encoded(x - at.x, y - at.y);
        pixel = glm::mix(pixel, halo_colour(ground(x - rect.x0, y - rect.y0), halo.aim),
                         static_cast<float>(alpha) / 255.0F);
      }
  }
};

SheetPainter::SheetPainter(const Drawing& drawing) : state_(std::make_unique<State>()) {
  std::vector<Stroke>& strokes = state_->strokes;
  std::unique_ptr<TextMeasure> measure;
  std::size_t first_above = std::numeric_limits<std::size_t>::max();
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
      const std::size_t text_begins = strokes.size();
      const Outline outline = outline_of(place_letters(*text, *measure));
      if (outline.empty()) continue;
      const bool on_paint = text->halo_contrast > 0.0 && text->halo_px > 0.0;
      if (!text->halo.empty() && text->halo_px > 0.0) {
        strokes.push_back(prepared(outline, text->halo, false, 2.0 * text->halo_px));
        strokes.back().is_plain_halo = on_paint;
      }
      strokes.push_back(prepared(outline, text->colour, true, 0.0));
      if (!on_paint) continue;
      if (state_->halos.empty()) first_above = std::min(first_above, text_begins);
      const glm::vec3 letters(rgb_of(text->colour));
      state_->halos.push_back(
          {.outline = prepared(outline, "#000000", false, 2.0 * fades.front().x * text->halo_px),
           .halo_px = text->halo_px,
           .aim = {letters, text->halo_contrast, luminance(letters) < middle_luminance}});
    }
  }
  for (std::size_t i = first_above; i < strokes.size(); ++i) strokes[i].below = false;
}

SheetPainter::~SheetPainter() = default;

int SheetPainter::halo_reach() const {
  int reach = 0;
  for (const PaintedHalo& halo : state_->halos)
    reach = std::max(reach, halo_reach_px(halo_blur_px(halo.halo_px)));
  return reach;
}

void SheetPainter::paint(Grid<glm::vec3>& encoded, glm::ivec2 at,
                         const PictureWindow* picture) const {
  const PixelRect whole{at.x, at.y, at.x + encoded.width(), at.y + encoded.height()};
  const int first_x = tile_of(whole.x0);
  const int first_y = tile_of(whole.y0);
  const int columns = tile_of(whole.x1 - 1) - first_x + 1;
  const int rows = tile_of(whole.y1 - 1) - first_y + 1;
  parallel_ranges<int>(columns * rows, 1, [&](int begin, int end) {
    for (int t = begin; t < end; ++t) {
      const glm::ivec2 corner = tile_px * glm::ivec2(first_x + t % columns, first_y + t / columns);
      state_->paint_tile(encoded, at, corner, picture);
    }
  });
}

}  // namespace belvedere
