#include "renderer/labels/legend_swatch.h"

#include <algorithm>

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

}  // namespace belvedere
