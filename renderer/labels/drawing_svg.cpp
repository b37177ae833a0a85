#include "renderer/labels/drawing_svg.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <utility>

#include "base/text/text_encoding.h"

namespace belvedere {

std::vector<PlacedLetter> place_letters(const DrawnText& text, const TextMeasure& measure) {
  std::vector<PlacedLetter> placed;
  std::vector<double> widths;
  double width = 0.0;
  for (TextLetter& letter : measure.letters(text.text, text.type)) {
    widths.push_back(letter.width_px);
    width += letter.width_px;
    placed.push_back({.letter = std::move(letter)});
  }
  if (text.along.empty()) {
    double x = text.at.x - text.anchor * width;
    for (PlacedLetter& letter : placed) {
      letter.at = {x, text.at.y};
      x += letter.letter.width_px;
    }
    return placed;
  }
  const std::vector<LetterPosition> bent = set_along(widths, text.along);
  if (bent.empty()) return {};
  for (std::size_t i = 0; i < placed.size(); ++i) {
    placed[i].tangent = bent[i].tangent;
    placed[i].at = bent[i].at - .5 * widths[i] * bent[i].tangent;
  }
  return placed;
}

Outline outline_of(const std::vector<PlacedLetter>& letters) {
  Outline outline;
  for (const PlacedLetter& letter : letters)
    for (OutlineStep step : letter.letter.outline) {
      for (int i = 0; i < points_of(step.kind); ++i) {
        glm::dvec2& p = step.points[static_cast<std::size_t>(i)];
        p = letter.at + p.x * letter.tangent +
            p.y * glm::dvec2(-letter.tangent.y, letter.tangent.x);
      }
      outline.push_back(step);
    }
  return outline;
}

namespace {

// A hundredth of a pixel is finer than any printer, and gives the same text on every machine.
std::string px(double value) {
  const double rounded = std::round(value * 100.0) / 100.0;
  return fmt::format("{:.2f}", rounded == 0.0 ? 0.0 : rounded);
}

// A sine or cosine: equally fine over the width of a letter.
std::string share(double value) {
  const double rounded = std::round(value * 1e5) / 1e5;
  return fmt::format("{:.5f}", rounded == 0.0 ? 0.0 : rounded);
}

std::string path_data(const std::vector<glm::dvec2>& points, bool closed) {
  std::string data;
  for (const glm::dvec2 p : points) data += (data.empty() ? "M" : "L") + px(p.x) + ' ' + px(p.y);
  return closed ? data + 'Z' : data;
}

std::string paint_svg(const std::string& fill, const std::string& stroke, double width_px) {
  std::string out = fmt::format(" fill=\"{}\"", fill.empty() ? "none" : fill);
  if (!stroke.empty())
    out += fmt::format(" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"", stroke,
                       px(width_px));
  return out;
}

std::string svg_of(const DrawnPath& path) {
  std::string out = "<path d=\"" + path_data(path.points, path.closed) + '"' +
                    paint_svg(path.fill, path.stroke, path.width_px);
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
  return fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{}/>", px(circle.centre.x),
                     px(circle.centre.y), px(circle.radius_px),
                     paint_svg(circle.fill, circle.stroke, circle.width_px));
}

// Relative to the font size: outlines that differ by less are the same letter.
constexpr double same_outline = 2e-3;

// Position of a letter of a line that is set alone: its left end in the line's coordinates, and its
// width. Nothing where its shape then differs.
struct LetterAlone {
  double offset_px = 0.0;
  double width_px = 0.0;
};
std::optional<LetterAlone> set_alone(const TextLetter& letter, const TextStyle& type,
                                     const TextMeasure& measure) {
  TextStyle plain = type;
  plain.spacing = 0.0;
  const std::vector<TextLetter> letters = measure.letters(letter.text, plain);
  if (letters.size() != 1 || letters.front().outline.size() != letter.outline.size())
    return std::nullopt;
  const Outline& alone = letters.front().outline;
  const glm::dvec2 offset = letter.outline.front().points[0] - alone.front().points[0];
  const double max_px = same_outline * type.size_px;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    if (alone[i].kind != letter.outline[i].kind) return std::nullopt;
    for (int k = 0; k < points_of(alone[i].kind); ++k) {
      const auto at = static_cast<std::size_t>(k);
      if (glm::length(letter.outline[i].points[at] - alone[i].points[at] - offset) > max_px)
        return std::nullopt;
    }
  }
  if (std::abs(offset.y) > max_px) return std::nullopt;
  return LetterAlone{offset.x, letters.front().width_px};
}

std::string path_of(const Outline& outline) {
  std::string data;
  for (const OutlineStep& step : outline) {
    data += step.kind == OutlineStep::move    ? "M"
            : step.kind == OutlineStep::line  ? "L"
            : step.kind == OutlineStep::curve ? "C"
                                              : "Z";
    for (int k = 0; k < points_of(step.kind); ++k) {
      const glm::dvec2 p = step.points[static_cast<std::size_t>(k)];
      data += (k == 0 ? "" : " ") + px(p.x) + ' ' + px(p.y);
    }
  }
  return data;
}

// `look`: attributes of the font and its colour.
std::string bent_text_svg(const DrawnText& text, const std::string& look,
                          const TextMeasure& measure) {
  const std::vector<PlacedLetter> placed = place_letters(text, measure);
  std::string letters;
  for (const PlacedLetter& letter : placed) {
    if (letter.letter.outline.empty()) continue;  // a space
    const std::optional<LetterAlone> alone = set_alone(letter.letter, text.type, measure);
    if (!alone) {
      letters = "<path d=\"" + path_of(outline_of(placed)) + "\"/>";
      break;
    }
    // Anchored at its centre, so that a substituted font is spread as evenly.
    const glm::dvec2 centre =
        letter.at + (alone->offset_px + .5 * alone->width_px) * letter.tangent;
    letters +=
        fmt::format("<text transform=\"matrix({0} {1} {2} {0} {3} {4})\">{5}</text>",
                    share(letter.tangent.x), share(letter.tangent.y), share(-letter.tangent.y),
                    px(centre.x), px(centre.y), markup_text(letter.letter.text));
  }
  // Halos lie below all letters: otherwise one would cover a part of its neighbour.
  std::string halo;
  if (!text.halo.empty() && text.halo_px > 0.0)
    halo = fmt::format(
        "<g aria-hidden=\"true\" stroke=\"{}\" stroke-width=\"{}px\" "
        "stroke-linejoin=\"round\">{}</g>",
        text.halo, px(2.0 * text.halo_px), letters);
  return fmt::format("<g role=\"img\"{} text-anchor=\"middle\"><title>{}</title>{}{}</g>", look,
                     markup_text(text.text), halo, letters);
}

// Families as CSS has them: one with a word that begins with a figure, "EB Garamond 08", needs
// quotes.
std::string quoted_families(const std::string& families) {
  std::string out;
  for (std::size_t begin = 0; begin < families.size();) {
    const std::size_t end = std::min(families.find(',', begin), families.size());
    const std::size_t first = std::min(families.find_first_not_of(' ', begin), end);
    out += (out.empty() ? "'" : ", '") + families.substr(first, end - first) + "'";
    begin = end + 1;
  }
  return out;
}

// `measure` provides the measure of letters.
std::string svg_of(const DrawnText& text, const std::function<const TextMeasure&()>& measure) {
  const TextStyle& type = text.type;
  std::string look =
      fmt::format(" font-family=\"{}\" font-size=\"{}px\" fill=\"{}\"",
                  markup_text(quoted_families(type.family)), px(type.size_px), text.colour);
  if (text.text.find_first_of("0123456789") != std::string::npos)
    look += " font-variant-numeric=\"lining-nums\"";
  if (type.weight != 400) look += fmt::format(" font-weight=\"{}\"", type.weight);
  if (type.italic) look += " font-style=\"italic\"";
  if (!text.along.empty()) return bent_text_svg(text, look, measure());
  if (type.spacing > 0.0)
    look += fmt::format(" letter-spacing=\"{}px\"", px(type.spacing * type.size_px));
  // The halo is the letters' own outline, painted before them: SVG 2, supported by browsers,
  // Inkscape and librsvg.
  if (!text.halo.empty() && text.halo_px > 0.0)
    look += fmt::format(
        " paint-order=\"stroke\" stroke=\"{}\" stroke-width=\"{}px\" stroke-linejoin=\"round\"",
        text.halo, px(2.0 * text.halo_px));
  const char* anchor = text.anchor <= .25 ? "start" : text.anchor < .75 ? "middle" : "end";
  return fmt::format("<text x=\"{}\" y=\"{}\"{} text-anchor=\"{}\">{}</text>", px(text.at.x),
                     px(text.at.y), look, anchor, markup_text(text.text));
}

}  // namespace

std::string shapes_svg(const std::vector<DrawnShape>& shapes) {
  std::string out;
  // Fonts are needed only for a curved baseline.
  std::unique_ptr<TextMeasure> fonts;
  const auto measure = [&]() -> const TextMeasure& {
    if (!fonts) fonts = std::make_unique<TextMeasure>();
    return *fonts;
  };
  for (const DrawnShape& shape : shapes) {
    out += "    ";
    if (const DrawnPath* path = std::get_if<DrawnPath>(&shape)) out += svg_of(*path);
    if (const DrawnCircle* circle = std::get_if<DrawnCircle>(&shape)) out += svg_of(*circle);
    if (const DrawnText* text = std::get_if<DrawnText>(&shape)) out += svg_of(*text, measure);
    out += '\n';
  }
  return out;
}

std::string drawing_svg(const Drawing& drawing, double width_mm) {
  return fmt::format(
             "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg "
             "xmlns=\"http://www.w3.org/2000/svg\" "
             "width=\"{:.3f}mm\" height=\"{:.3f}mm\" viewBox=\"0 0 {} {}\">\n",
             width_mm, width_mm * drawing.size_px.y / drawing.size_px.x, px(drawing.size_px.x),
             px(drawing.size_px.y)) +
         shapes_svg(drawing.shapes) + "</svg>\n";
}

}  // namespace belvedere
