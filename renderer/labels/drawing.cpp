#include "renderer/labels/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/text/markup.h"

namespace belvedere {
namespace {

// A hundredth of a pixel is finer than any printer, and the same text on every machine.
std::string px(double value) {
  const double rounded = std::round(value * 100.0) / 100.0;
  return fmt::format("{:.2f}", rounded == 0.0 ? 0.0 : rounded);
}

std::string path_data(const std::vector<glm::dvec2>& points, bool closed) {
  std::string data;
  for (const glm::dvec2 p : points) data += (data.empty() ? "M" : "L") + px(p.x) + ' ' + px(p.y);
  return closed ? data + 'Z' : data;
}

std::string paint_svg(const std::string& fill, const std::string& stroke, double width_px) {
  std::string out = fmt::format(" fill=\"{}\"", fill.empty() ? "none" : fill);
  if (!stroke.empty()) out += fmt::format(" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"", stroke, px(width_px));
  return out;
}

std::string svg_of(const DrawnPath& path) {
  std::string out = "<path d=\"" + path_data(path.points, path.closed) + '"' + paint_svg(path.fill, path.stroke, path.width_px);
  if (!path.dashes_px.empty()) {
    std::string dashes;
    for (const double dash : path.dashes_px) dashes += (dashes.empty() ? "" : " ") + px(dash);
    out += " stroke-dasharray=\"" + dashes + '"';
  } else if (!path.stroke.empty() && !path.closed) {
    out += " stroke-linecap=\"round\"";
  }
  if (path.opacity < 1.0) out += fmt::format(" opacity=\"{:g}\"", path.opacity);
  return out + "/>";
}

std::string svg_of(const DrawnCircle& circle) {
  return fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{}/>", px(circle.middle.x), px(circle.middle.y), px(circle.radius_px),
                     paint_svg(circle.fill, circle.stroke, circle.width_px));
}

std::string svg_of(const DrawnText& text, const std::string& id) {
  const TextStyle& type = text.type;
  std::string look =
      fmt::format(" font-family=\"{}\" font-size=\"{}px\" fill=\"{}\"", markup_text(type.family), px(type.size_px), text.colour);
  if (type.bold) look += " font-weight=\"bold\"";
  if (type.italic) look += " font-style=\"italic\"";
  if (type.spacing > 0.0) look += fmt::format(" letter-spacing=\"{}px\"", px(type.spacing * type.size_px));
  // The halo is the letters' own outline, painted before them: SVG 2, which browsers, Inkscape and librsvg know.
  if (!text.halo.empty() && text.halo_px > 0.0)
    look += fmt::format(" style=\"paint-order: stroke; stroke: {}; stroke-width: {}px; stroke-linejoin: round\"", text.halo,
                        px(2.0 * text.halo_px));
  if (!text.along.empty())
    return fmt::format(
        "<path id=\"{0}\" d=\"{1}\" fill=\"none\"/><text{2} text-anchor=\"middle\"><textPath xlink:href=\"#{0}\" "
        "startOffset=\"50%\">{3}</textPath></text>",
        id, path_data(text.along, false), look, markup_text(text.text));
  const char* anchor = text.anchor <= .25 ? "start" : text.anchor < .75 ? "middle" : "end";
  return fmt::format("<text x=\"{}\" y=\"{}\"{} text-anchor=\"{}\">{}</text>", px(text.at.x), px(text.at.y), look, anchor,
                     markup_text(text.text));
}

glm::dvec2 point_at(const std::vector<glm::dvec2>& line, double from_start) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double piece = glm::length(line[i + 1] - line[i]);
    if (from_start <= piece || i + 2 == line.size())
      return piece > 0.0 ? line[i] + (line[i + 1] - line[i]) * (from_start / piece) : line[i];
    from_start -= piece;
  }
  return line.back();
}

}  // namespace

void move_shape(DrawnShape& shape, glm::dvec2 by) {
  if (DrawnPath* path = std::get_if<DrawnPath>(&shape))
    for (glm::dvec2& p : path->points) p += by;
  if (DrawnCircle* circle = std::get_if<DrawnCircle>(&shape)) circle->middle += by;
  if (DrawnText* text = std::get_if<DrawnText>(&shape)) {
    text->at += by;
    for (glm::dvec2& p : text->along) p += by;
  }
}

double length_of(const std::vector<glm::dvec2>& line) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) length += glm::length(line[i + 1] - line[i]);
  return length;
}

std::vector<LetterPlace> set_along(const std::vector<double>& widths_px, const std::vector<glm::dvec2>& line) {
  double all = 0.0;
  for (const double width : widths_px) all += width;
  double from = .5 * (length_of(line) - all);
  if (line.size() < 2 || from < 0.0) return {};
  std::vector<LetterPlace> places;
  for (const double width : widths_px) {
    const glm::dvec2 middle = point_at(line, from + .5 * width);
    const double reach = std::max(.5, .5 * width);
    const glm::dvec2 chord = point_at(line, from + .5 * width + reach) - point_at(line, std::max(0.0, from + .5 * width - reach));
    const double length = glm::length(chord);
    places.push_back({middle, length > 0.0 ? chord / length : glm::dvec2(1.0, 0.0)});
    from += width;
  }
  return places;
}

std::string shapes_svg(const std::vector<DrawnShape>& shapes, const std::string& id) {
  std::string out;
  int bent = 0;
  for (const DrawnShape& shape : shapes) {
    out += "    ";
    if (const DrawnPath* path = std::get_if<DrawnPath>(&shape)) out += svg_of(*path);
    if (const DrawnCircle* circle = std::get_if<DrawnCircle>(&shape)) out += svg_of(*circle);
    if (const DrawnText* text = std::get_if<DrawnText>(&shape))
      out += svg_of(*text, fmt::format("{}-{}", id, text->along.empty() ? 0 : ++bent));
    out += '\n';
  }
  return out;
}

std::string drawing_svg(const Drawing& drawing, double width_mm) {
  return fmt::format(
             "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
             "xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"{:.3f}mm\" height=\"{:.3f}mm\" viewBox=\"0 0 {} {}\">\n",
             width_mm, width_mm * drawing.size_px.y / drawing.size_px.x, px(drawing.size_px.x), px(drawing.size_px.y)) +
         shapes_svg(drawing.shapes, "line") + "</svg>\n";
}

}  // namespace belvedere
