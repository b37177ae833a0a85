#include "renderer/labels/margin_blocks.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <iterator>

#include "base/math_exact.h"

namespace belvedere {
namespace {

constexpr double widest = 0.7;  // a line with its edges, of the box's height

std::vector<glm::dvec2> rectangle(glm::dvec2 low, glm::dvec2 high) {
  return {low, {high.x, low.y}, high, {low.x, high.y}};
}

DrawnPath filled(std::vector<glm::dvec2> points, const std::string& colour) {
  return {.points = std::move(points), .closed = true, .fill = colour, .stroke = {}};
}

DrawnPath stroked(std::vector<glm::dvec2> points, const std::string& colour, double width_px,
                  double opacity = 1.0) {
  return {.points = std::move(points),
          .fill = {},
          .stroke = colour,
          .width_px = width_px,
          .opacity = opacity};
}

// A slightly curved line: bed, edges and fill on top of each other, all of it inside the box.
void draw_line(const FeatureSwatch& swatch, glm::dvec2 size, double px_per_mm,
               std::vector<DrawnShape>& shapes) {
  double fill = std::max(swatch.width_mm * px_per_mm, swatch.min_px);
  double casing = swatch.casing_mm * px_per_mm;
  double bed = swatch.bed.empty() ? 0.0 : swatch.bed_mm * px_per_mm;
  const double all = fill + 2.0 * std::max(casing, bed);
  const double fits = std::min(1.0, widest * size.y / all);
  fill *= fits;
  casing *= fits;
  bed *= fits;
  // Round ends extend half a width beyond the last position.
  const double inset = .5 * all * fits + .04 * size.x;
  std::vector<glm::dvec2> way;
  constexpr int steps = 24;
  const double swing = std::max(0.0, .5 * size.y - .5 * all * fits - .08 * size.y);
  for (int k = 0; k <= steps; ++k) {
    const double t = static_cast<double>(k) / steps;
    // From bottom to top by the smoothest cubic.
    way.emplace_back(inset + t * (size.x - 2.0 * inset),
                     .5 * size.y + swing * (1.0 - 2.0 * t * t * (3.0 - 2.0 * t)));
  }
  if (bed > 0.0) shapes.push_back(stroked(way, swatch.bed, fill + 2.0 * bed));
  if (casing > 0.0)
    shapes.push_back(stroked(way, swatch.casing, fill + 2.0 * casing, swatch.opacity));
  DrawnPath line = stroked(std::move(way), swatch.fill, fill, swatch.opacity);
  if (swatch.dash_mm.y > 0.0)
    line.dashes_px = {swatch.dash_mm.x * px_per_mm, swatch.dash_mm.y * px_per_mm};
  shapes.push_back(std::move(line));
}

// A slightly sagging rope between two stations, with a pylon at the centre.
void draw_cable(const FeatureSwatch& swatch, glm::dvec2 size, double px_per_mm,
                std::vector<DrawnShape>& shapes) {
  const double width = std::min(std::max(swatch.width_mm * px_per_mm, swatch.min_px), .12 * size.y);
  const glm::dvec2 low(.1 * size.x, .72 * size.y);
  const glm::dvec2 high(.9 * size.x, .28 * size.y);
  const glm::dvec2 centre = .5 * (low + high) + glm::dvec2(0.0, .04 * size.y);
  shapes.push_back(stroked({low, centre, high}, swatch.fill, width));
  if (swatch.has_pylons)
    shapes.push_back(stroked({centre, {centre.x, centre.y + .3 * size.y}}, swatch.fill, width));
  const double r = std::max(1.6 * width, .06 * size.y);
  for (const glm::dvec2 station : {low, high})
    shapes.push_back(filled(rectangle(station - r, station + r), swatch.fill));
}

// Walls in the colour of the edges under a roof in that of the fill, as houses are painted.
void draw_house(const FeatureSwatch& swatch, glm::dvec2 size, double px_per_mm,
                std::vector<DrawnShape>& shapes) {
  const double width = std::clamp(1.6 * swatch.width_mm * px_per_mm, .5 * size.y, .5 * size.x);
  const double side = std::min(width, .6 * size.y);
  const glm::dvec2 foot(.5 * size.x, .78 * size.y);
  shapes.push_back(filled(
      rectangle(foot - glm::dvec2(.5 * width, .55 * side), foot + glm::dvec2(.5 * width, 0.0)),
      swatch.casing));
  shapes.push_back(filled(
      {foot + glm::dvec2(-.62 * width, -.5 * side), foot + glm::dvec2(-.4 * width, -.95 * side),
       foot + glm::dvec2(.4 * width, -.95 * side), foot + glm::dvec2(.62 * width, -.5 * side)},
      swatch.fill));
}

}  // namespace

std::vector<DrawnShape> draw_swatch(const FeatureSwatch& swatch, glm::dvec2 size_px,
                                    double px_per_mm) {
  std::vector<DrawnShape> shapes;
  if (!swatch.ground.empty())
    shapes.push_back(filled(rectangle({0.0, 0.0}, size_px), swatch.ground));
  switch (swatch.form) {
    case SwatchForm::line:
      draw_line(swatch, size_px, px_per_mm, shapes);
      break;
    case SwatchForm::cable:
      draw_cable(swatch, size_px, px_per_mm, shapes);
      break;
    case SwatchForm::house:
      draw_house(swatch, size_px, px_per_mm, shapes);
      break;
  }
  return shapes;
}

namespace {

constexpr double usual_width_mm = 600.0;
constexpr double max_enlarged = 1.5;
constexpr double hairline_mm = 0.14;
constexpr double heading_share = 0.7;     // of the text's size
constexpr double heading_spacing = 0.16;  // between its letters, of its size
constexpr double column_gap = 1.5;        // between columns of the legend, of the text's size
constexpr double longest_bar_mm = 52.0;
constexpr double half_circle_deg = 180.0;
constexpr double pi = 3.14159265358979323846;

std::vector<glm::dvec2> box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

double turned(double azimuth_deg) { return azimuth_deg - 360.0 * std::floor(azimuth_deg / 360.0); }

const char* quarter(double azimuth_deg) {
  constexpr std::array names = {"north", "north-east", "east", "south-east",
                                "south", "south-west", "west", "north-west"};
  return names[static_cast<std::size_t>(std::lround(turned(azimuth_deg) / 45.0)) % names.size()];
}

// Two significant figures: "50 km".
std::string about(double length_m) {
  const double unit = length_m >= 10000.0 ? 1000.0 : 100.0;
  return length_text(unit * std::round(length_m / unit));
}

}  // namespace

double bar_length_m(double px_per_m, double max_px) {
  double length = 1.0;
  const double max = max_px / px_per_m;
  if (!(max > 1.0)) return 1.0;
  while (true) {
    for (const double factor : {2.0, 2.5, 2.0}) {
      if (length * factor > max) return length;
      length *= factor;
    }
  }
}

std::string length_text(double length_m) {
  return length_m >= 1000.0 ? fmt::format("{:.3g}\u00A0km", length_m / 1000.0)
                            : fmt::format("{:.3g}\u00A0m", length_m);
}

glm::dvec2 swatch_size_mm(const MarginStyle& style) {
  return {2.8 * style.text_mm, 1.65 * style.text_mm};
}

MarginSetter::MarginSetter(const MarginStyle& style, double px_per_mm, double picture_width_px)
    : style_(style),
      scale_(px_per_mm * std::clamp(std::sqrt(picture_width_px / px_per_mm / usual_width_mm), 1.0,
                                    max_enlarged)) {}

DrawnText MarginSetter::text(const std::string& words, glm::dvec2 at, double size_px, double anchor,
                             bool italic) const {
  return {.text = words,
          .type = {.family = style_.family, .size_px = size_px, .italic = italic},
          .at = at,
          .anchor = anchor,
          .colour = style_.ink};
}

double MarginSetter::width(const std::string& words, double size_px, bool italic) const {
  return measure_.measure(words, {.family = style_.family, .size_px = size_px, .italic = italic})
      .width_px;
}

DrawnPath MarginSetter::rule(glm::dvec2 from, glm::dvec2 to) const {
  return {.points = {from, to}, .fill = {}, .stroke = style_.ink, .width_px = mm(hairline_mm)};
}

MarginBlock MarginSetter::title(const MarginContent& content, double max_px) const {
  MarginBlock block;
  if (!content.title.empty()) {
    const double wanted_px = mm(style_.title_mm);
    const double wide = width(content.title, wanted_px);
    const double size_px = wanted_px * std::min(1.0, max_px / wide);
    // Capitals of a serif are two thirds of the size; they begin where headings do.
    block.size = {width(content.title, size_px), .92 * size_px};
    block.shapes.push_back(text(content.title, {0.0, .68 * size_px}, size_px));
  }
  if (!content.subtitle.empty()) {
    DrawnText subtitle = text(capitals(content.subtitle), {}, 1.15 * text_px());
    subtitle.type.spacing = heading_spacing;
    double wide = measure_.measure(subtitle.text, subtitle.type).width_px;
    if (wide > max_px) subtitle.type.size_px *= max_px / wide;
    wide = std::min(wide, max_px);
    const double y = block.size.y + .1 * text_px();
    block.size.x = std::max(block.size.x, wide);
    if (!content.title.empty()) block.shapes.push_back(rule({0.0, y}, {block.size.x, y}));
    subtitle.at = {0.0, y + 1.6 * text_px()};
    block.size.y = subtitle.at.y + .4 * text_px();
    block.shapes.push_back(std::move(subtitle));
  }
  return block;
}

double MarginSetter::add_heading(const std::string& words, MarginBlock& block) const {
  DrawnText heading = text(capitals(words), {}, heading_share * text_px());
  heading.type.family = style_.heading;
  heading.type.weight = 700;
  heading.type.spacing = heading_spacing;
  heading.at = {0.0, .72 * heading.type.size_px};
  block.size.x = std::max(block.size.x, measure_.measure(heading.text, heading.type).width_px);
  block.shapes.push_back(std::move(heading));
  return 1.75 * text_px();
}

void MarginSetter::underline(MarginBlock& block) const {
  const double y = 1.05 * text_px();
  block.shapes.push_back(rule({0.0, y}, {block.size.x, y}));
}

glm::dvec2 MarginSetter::swatch_px() const { return glm::round(swatch_size_mm(style_) * scale_); }

MarginBlock MarginSetter::classes(const std::vector<LegendEntry>& entries, std::size_t rows) const {
  std::vector<Swatch> swatches;
  const glm::dvec2 size = swatch_px();
  for (const LegendEntry& entry : entries)
    swatches.push_back({entry.name,
                        {DrawnPath{.points = box(0.0, 0.0, size.x, size.y),
                                   .closed = true,
                                   .fill = entry.at.empty() ? entry.colour : std::string(),
                                   .stroke = {}}},
                        entry.at});
  return legend("Land cover", std::move(swatches), rows);
}

MarginBlock MarginSetter::features(const std::vector<FeatureSwatch>& entries, PixelRect ground,
                                   std::size_t rows) const {
  std::vector<Swatch> swatches;
  for (FeatureSwatch entry : entries) {
    if (!ground.empty()) entry.ground.clear();
    swatches.push_back({entry.name, draw_swatch(entry, swatch_px(), scale_), ground});
  }
  return legend("Features", std::move(swatches), rows);
}

MarginBlock MarginSetter::legend(const std::string& heading, std::vector<Swatch> entries,
                                 std::size_t rows) const {
  MarginBlock block;
  if (entries.empty()) return block;
  const glm::dvec2 swatch = swatch_px();
  const double gap = .55 * text_px();
  const double top = add_heading(heading, block);
  double x = 0.0;
  for (std::size_t first = 0; first < entries.size(); first += rows) {
    double longest = 0.0;
    for (std::size_t i = first; i < std::min(first + rows, entries.size()); ++i) {
      Swatch& entry = entries[i];
      const glm::dvec2 at = glm::round(
          glm::dvec2(x, top + static_cast<double>(i - first) * (swatch.y + .5 * text_px())));
      for (DrawnShape& shape : entry.shapes) {
        move_shape(shape, at);
        block.shapes.push_back(std::move(shape));
      }
      const glm::dvec2 end = at + swatch;
      if (!entry.at.empty())
        block.crops.push_back({entry.at,
                               {static_cast<int>(at.x), static_cast<int>(at.y),
                                static_cast<int>(end.x), static_cast<int>(end.y)}});
      block.shapes.push_back(DrawnPath{.points = box(at.x, at.y, end.x, end.y),
                                       .closed = true,
                                       .fill = {},
                                       .stroke = style_.ink,
                                       .width_px = mm(hairline_mm)});
      block.shapes.push_back(
          text(entry.name, {end.x + gap, .5 * (at.y + end.y) + .3 * text_px()}, text_px()));
      longest = std::max(longest, width(entry.name, text_px()));
      block.size.y = std::max(block.size.y, end.y);
    }
    x += swatch.x + gap + longest + column_gap * text_px();
  }
  block.size.x = std::max(block.size.x, x - column_gap * text_px());
  underline(block);
  return block;
}

MarginBlock MarginSetter::scales(const std::vector<ScaleBar>& bars) const {
  MarginBlock block;
  if (bars.empty()) return block;
  double y = add_heading("Scale across the view", block);
  const double small_px = .85 * text_px();
  for (const ScaleBar& bar : bars) {
    const double length_m = bar_length_m(bar.px_per_m, mm(longest_bar_mm));
    const double length = length_m * bar.px_per_m;
    const double thick = mm(.8);
    y += .7 * small_px;
    // The unit stands at the end alone.
    const bool in_km = length_m >= 1000.0;
    for (const double share : {0.0, .5, 1.0}) {
      const std::string figure = fmt::format("{:g}", share * length_m / (in_km ? 1000.0 : 1.0));
      const std::string words = share < 1.0 ? figure : figure + (in_km ? "\u00A0km" : "\u00A0m");
      const double left = share * length - (share > 0.0 ? .5 * width(figure, small_px) : 0.0);
      block.shapes.push_back(text(words, {left, y}, small_px));
      block.size.x = std::max(block.size.x, left + width(words, small_px));
    }
    y += .35 * small_px;
    // Four pieces, dark and light in turn, as on maps, between ticks.
    for (int k = 0; k < 4; ++k)
      block.shapes.push_back(DrawnPath{
          .points = box(.25 * k * length, y + .5 * thick, .25 * (k + 1) * length, y + 1.5 * thick),
          .closed = true,
          .fill = k % 2 == 0 ? style_.ink : style_.paper,
          .stroke = style_.ink,
          .width_px = mm(hairline_mm)});
    for (const double share : {0.0, .5, 1.0})
      block.shapes.push_back(rule({share * length, y}, {share * length, y + 1.5 * thick}));
    y += 1.5 * thick + 1.1 * small_px;
    const std::string said = fmt::format("{} from the viewer", about(bar.distance_m));
    block.shapes.push_back(text(said, {0.0, y}, small_px, 0.0, true));
    block.size.x = std::max({block.size.x, length, width(said, small_px, true)});
    block.size.y = y;
    y += 1.1 * text_px();
  }
  underline(block);
  return block;
}

void MarginSetter::add_rose(const MarginContent& content, glm::dvec2 centre, double r,
                            std::vector<DrawnShape>& shapes) const {
  const auto toward = [&](double azimuth_deg) {
    const double angle = (azimuth_deg - content.view_azimuth_deg) * pi / half_circle_deg;
    return glm::dvec2(exact::sin(angle), -exact::cos(angle));
  };
  const double line = mm(hairline_mm);
  const auto circle = [&](glm::dvec2 at, double radius, const std::string& fill,
                          const std::string& stroke) {
    shapes.push_back(DrawnCircle{
        .centre = at, .radius_px = radius, .fill = fill, .stroke = stroke, .width_px = line});
  };
  circle(centre, r, {}, style_.ink);
  circle(centre, .9 * r, {}, style_.ink);
  for (int k = 0; k < 32; ++k) {
    const glm::dvec2 way = toward(11.25 * k);
    shapes.push_back(rule(centre + .9 * r * way, centre + (k % 4 == 0 ? 1.0 : .95) * r * way));
  }
  // Needles of two halves, one in shade; those of the quarters over the others.
  const auto needle = [&](double azimuth_deg, double length) {
    const glm::dvec2 tip = centre + length * r * toward(azimuth_deg);
    for (const double side : {-45.0, 45.0})
      shapes.push_back(
          DrawnPath{.points = {centre, centre + .17 * r * toward(azimuth_deg + side), tip},
                    .closed = true,
                    .fill = side > 0.0 ? style_.ink : style_.paper,
                    .stroke = style_.ink,
                    .width_px = line});
  };
  for (const double azimuth : {45.0, 135.0, 225.0, 315.0}) needle(azimuth, .56);
  for (const double azimuth : {90.0, 180.0, 270.0, 0.0})
    needle(azimuth, azimuth == 0.0 ? 1.0 : .86);
  const std::array<std::pair<const char*, double>, 4> letters = {
      {{"E", 90.0}, {"S", 180.0}, {"W", 270.0}, {"N", 0.0}}};
  for (const auto& [letter, azimuth] : letters) {
    const double size = (azimuth == 0.0 ? 1.1 : .8) * text_px();
    shapes.push_back(
        text(letter, centre + (r + .75 * text_px()) * toward(azimuth) + glm::dvec2(0.0, .33 * size),
             size, .5));
  }
  // The sun on the ring, on paper of its own.
  const glm::dvec2 sun = centre + r * toward(content.sun_azimuth_deg);
  const double disc = .115 * r;
  circle(sun, 2.5 * disc, style_.paper, {});
  for (int k = 0; k < 12; ++k) {
    const glm::dvec2 way = toward(30.0 * k);
    shapes.push_back(DrawnPath{.points = {sun + 1.5 * disc * way, sun + 2.2 * disc * way},
                               .fill = {},
                               .stroke = style_.sun,
                               .width_px = 1.6 * line});
  }
  circle(sun, disc, style_.sun, style_.ink);
}

MarginBlock MarginSetter::directions(const MarginContent& content) const {
  MarginBlock block;
  const double top = add_heading("View", block);
  const double r = 2.7 * text_px();
  const double room = r + 1.3 * text_px();  // with its letters
  const glm::dvec2 centre(room, top + room - .5 * text_px());
  add_rose(content, centre, r, block.shapes);
  const double x = 2.0 * room + .4 * text_px();
  const std::array<std::pair<std::string, std::string>, 2> lines = {
      {{fmt::format("looking {}", quarter(content.view_azimuth_deg)),
        fmt::format("{:.0f}°", turned(content.view_azimuth_deg))},
       {fmt::format("sun in the {}", quarter(content.sun_azimuth_deg)),
        fmt::format("{:.0f}° high", content.sun_altitude_deg)}}};
  double y = centre.y - 1.5 * text_px();
  for (const auto& [what, degrees] : lines) {
    block.shapes.push_back(text(what, {x, y}, text_px()));
    block.shapes.push_back(text(degrees, {x, y + 1.05 * text_px()}, .85 * text_px(), 0.0, true));
    block.size.x = std::max(
        {block.size.x, x + width(what, text_px()), x + width(degrees, .85 * text_px(), true)});
    y += 2.6 * text_px();
  }
  block.size.y = centre.y + room;
  underline(block);
  return block;
}

MarginBlock MarginSetter::sources(const std::vector<std::string>& all, double max_px) const {
  const double size = .72 * text_px();
  MarginBlock block;
  std::string line;
  const auto end_line = [&] {
    if (line.empty()) return;
    block.size.y += 1.4 * size;
    block.shapes.push_back(text(line, {0.0, block.size.y - .35 * size}, size, 0.0, true));
    block.size.x = max_px;
    line.clear();
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::string rest = all[i] + (i + 1 < all.size() ? "  ·" : "");
    while (!rest.empty()) {
      const std::size_t space = rest.find(' ', 1);
      const std::string word = rest.substr(0, space);
      rest = space == std::string::npos ? std::string() : rest.substr(space);
      if (!line.empty() && width(line + word, size, true) > max_px) end_line();
      line += line.empty() ? word.substr(word.find_first_not_of(' ') == std::string::npos
                                             ? 0
                                             : word.find_first_not_of(' '))
                           : word;
    }
    if (i + 1 < all.size()) line += "  ";
  }
  end_line();
  return block;
}

}  // namespace belvedere
