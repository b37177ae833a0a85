#include "renderer/labels/margin.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <utility>

#include "base/math_exact.h"

namespace belvedere {
namespace {

// A block of the strip, relative to its upper left corner.
struct Block {
  glm::dvec2 size{0.0};
  std::vector<DrawnShape> shapes;
};

std::vector<glm::dvec2> rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

// Draws blocks in one style at one scale.
class Typesetter {
 public:
  Typesetter(const MarginStyle& style, double px_per_mm) : style_(style), scale_(px_per_mm) {}

  double mm(double length) const { return length * scale_; }
  double text_px() const { return mm(style_.text_mm); }
  double line_px() const { return 1.5 * text_px(); }

  DrawnText text(const std::string& words, glm::dvec2 at, double size_px,
                 double anchor = 0.0) const {
    return {.text = words, .type = type(size_px), .at = at, .anchor = anchor, .colour = style_.ink};
  }
  double width(const std::string& words, double size_px) const {
    return measure_.measure(words, type(size_px)).width_px;
  }

  Block title(const MarginContent& content) const {
    Block block;
    const double title_px = mm(style_.title_mm);
    const double subtitle_px = .45 * title_px;
    if (!content.title.empty()) {
      block.size = {width(content.title, title_px), title_px};
      block.shapes.push_back(text(content.title, {0.0, .8 * title_px}, title_px));
    }
    if (!content.subtitle.empty()) {
      block.shapes.push_back(
          text(content.subtitle, {0.0, block.size.y + 1.1 * subtitle_px}, subtitle_px));
      block.size = {std::max(block.size.x, width(content.subtitle, subtitle_px)),
                    block.size.y + 1.5 * subtitle_px};
    }
    return block;
  }

  // Swatches with their names, in columns of at most five, side by side; each in a fine frame.
  Block classes(const std::vector<LegendEntry>& entries) const {
    std::vector<std::pair<std::string, std::vector<DrawnShape>>> rows;
    const glm::dvec2 size = swatch_px();
    for (const LegendEntry& entry : entries)
      rows.push_back({entry.name,
                      {DrawnPath{.points = rectangle(0.0, 0.0, size.x, size.y),
                                 .closed = true,
                                 .fill = entry.colour,
                                 .stroke = {}}}});
    return legend(std::move(rows), size);
  }
  Block features(const std::vector<FeatureSwatch>& entries) const {
    std::vector<std::pair<std::string, std::vector<DrawnShape>>> rows;
    const glm::dvec2 size(1.5 * swatch_px().x, swatch_px().y);
    for (const FeatureSwatch& entry : entries)
      rows.emplace_back(entry.name, draw_swatch(entry, size, scale_));
    return legend(std::move(rows), size);
  }

  Block scales(const std::vector<ScaleBar>& bars) const {
    constexpr double longest_mm = 70.0;
    Block block;
    double y = 0.0;
    for (const ScaleBar& bar : bars) {
      const double length_m = bar_length_m(bar.px_per_m, mm(longest_mm));
      const double length = length_m * bar.px_per_m;
      const double thick = mm(1.0);
      const std::string said = fmt::format("{} across, {} from the viewer", length_text(length_m),
                                           length_text(bar.distance_m));
      // Four pieces, dark and light in turn, as on maps.
      y += text_px();
      block.shapes.push_back(text(said, {0.0, y}, text_px()));
      y += .5 * text_px();
      for (int k = 0; k < 4; ++k)
        block.shapes.push_back(
            DrawnPath{.points = rectangle(.25 * k * length, y, .25 * (k + 1) * length, y + thick),
                      .closed = true,
                      .fill = k % 2 == 0 ? style_.ink : style_.paper,
                      .stroke = style_.ink,
                      .width_px = mm(.15)});
      y += thick + .9 * text_px();
      block.size = {std::max({block.size.x, length, width(said, text_px())}), y};
    }
    return block;
  }

  // A compass rose seen from above with the line of sight upward: north in its direction, the sun
  // on its side.
  Block directions(const MarginContent& content) const {
    Block block;
    const double r = 2.4 * line_px() / 1.5;
    const glm::dvec2 centre(1.3 * r, 1.5 * r);
    const auto toward = [&](double azimuth_deg) {
      const double angle =
          (azimuth_deg - content.view_azimuth_deg) * 3.14159265358979323846 / 180.0;
      return glm::dvec2(exact::sin(angle), -exact::cos(angle));
    };
    block.shapes.push_back(DrawnCircle{
        .centre = centre, .radius_px = r, .fill = {}, .stroke = style_.ink, .width_px = mm(.15)});
    const glm::dvec2 north = toward(0.0);
    const glm::dvec2 side(-north.y, north.x);
    block.shapes.push_back(
        DrawnPath{.points = {centre + .85 * r * north, centre - .85 * r * north + .28 * r * side,
                             centre - .55 * r * north, centre - .85 * r * north - .28 * r * side},
                  .closed = true,
                  .fill = style_.ink,
                  .stroke = {}});
    block.shapes.push_back(
        text("N", centre + 1.25 * r * north + glm::dvec2(0.0, .35 * text_px()), text_px(), .5));
    const glm::dvec2 sun = centre + 1.0 * r * toward(content.sun_azimuth_deg);
    block.shapes.push_back(DrawnCircle{.centre = sun,
                                       .radius_px = .2 * r,
                                       .fill = style_.sun,
                                       .stroke = style_.ink,
                                       .width_px = mm(.15)});
    const double x = 2.9 * r;
    const std::string looks = fmt::format("looking {} ({:.0f}°)", quarter(content.view_azimuth_deg),
                                          turned(content.view_azimuth_deg));
    const std::string light = fmt::format(
        "sun in the {}, {:.0f}° high", quarter(content.sun_azimuth_deg), content.sun_altitude_deg);
    block.shapes.push_back(text(looks, {x, centre.y - .3 * text_px()}, text_px()));
    block.shapes.push_back(text(light, {x, centre.y + line_px() - .3 * text_px()}, text_px()));
    block.size = {x + std::max(width(looks, text_px()), width(light, text_px())), 3.0 * r};
    return block;
  }

  // Credits of all sources one after the other, broken into lines.
  Block sources(const std::vector<std::string>& all, double max_px) const {
    const double size = .8 * text_px();
    Block block;
    std::string line;
    const auto end_line = [&] {
      if (line.empty()) return;
      block.size.y += 1.4 * size;
      block.shapes.push_back(text(line, {0.0, block.size.y - .35 * size}, size));
      block.size.x = max_px;
      line.clear();
    };
    for (std::size_t i = 0; i < all.size(); ++i) {
      std::string rest = all[i] + (i + 1 < all.size() ? "  ·" : "");
      while (!rest.empty()) {
        const std::size_t space = rest.find(' ', 1);
        const std::string word = rest.substr(0, space);
        rest = space == std::string::npos ? std::string() : rest.substr(space);
        if (!line.empty() && width(line + word, size) > max_px) end_line();
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

 private:
  glm::dvec2 swatch_px() const { return {2.0 * text_px(), 1.1 * text_px()}; }

  Block legend(std::vector<std::pair<std::string, std::vector<DrawnShape>>> entries,
               glm::dvec2 swatch) const {
    constexpr std::size_t rows = 5;
    Block block;
    const double gap = .5 * text_px();
    double x = 0.0;
    double widest = 0.0;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      if (i > 0 && i % rows == 0) {
        x += swatch.x + gap + widest + 1.3 * text_px();
        widest = 0.0;
      }
      const double y = static_cast<double>(i % rows) * line_px();
      auto& [name, shapes] = entries[i];
      for (DrawnShape& shape : shapes) {
        move_shape(shape, {x, y});
        block.shapes.push_back(std::move(shape));
      }
      block.shapes.push_back(DrawnPath{.points = rectangle(x, y, x + swatch.x, y + swatch.y),
                                       .closed = true,
                                       .fill = {},
                                       .stroke = style_.ink,
                                       .width_px = mm(.12)});
      block.shapes.push_back(text(name, {x + swatch.x + gap, y + .85 * swatch.y}, text_px()));
      widest = std::max(widest, width(name, text_px()));
      block.size = {x + swatch.x + gap + widest, std::max(block.size.y, y + line_px())};
    }
    return block;
  }

  TextStyle type(double size_px) const { return {.family = style_.family, .size_px = size_px}; }
  static double turned(double azimuth_deg) {
    return azimuth_deg - 360.0 * std::floor(azimuth_deg / 360.0);
  }
  static const char* quarter(double azimuth_deg) {
    constexpr std::array names = {"north", "north-east", "east", "south-east",
                                  "south", "south-west", "west", "north-west"};
    return names[static_cast<std::size_t>(std::lround(turned(azimuth_deg) / 45.0)) % names.size()];
  }

  const MarginStyle& style_;
  double scale_;
  TextMeasure measure_;
};

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

Margin lay_out_margin(const MarginContent& content, const MarginStyle& style, glm::ivec2 picture_px,
                      double px_per_mm, double frame_px) {
  const Typesetter set(style, px_per_mm);
  std::vector<Block> blocks;
  const auto add = [&](Block block) {
    if (!block.shapes.empty()) blocks.push_back(std::move(block));
  };
  add(set.title(content));
  add(set.classes(content.classes));
  add(set.features(content.features));
  add(set.scales(content.scales));
  if (content.directions) add(set.directions(content));

  const int frame = static_cast<int>(std::lround(frame_px));
  Margin margin{.left = frame, .top = frame, .right = frame, .bottom = frame, .drawing = {}};
  const double inner = picture_px.x;
  const double gap = set.mm(12.0);
  std::vector<DrawnShape>& shapes = margin.drawing.shapes;
  double y = frame + picture_px.y + .8 * frame;
  for (std::size_t first = 0; first < blocks.size();) {
    std::size_t end = first;
    double width = 0.0;
    double height = 0.0;
    while (end < blocks.size() && (end == first || width + gap + blocks[end].size.x <= inner)) {
      width += (end == first ? 0.0 : gap) + blocks[end].size.x;
      height = std::max(height, blocks[end].size.y);
      ++end;
    }
    // The remaining space goes between the blocks: title at the left edge of the picture, the last
    // at its right edge.
    const double between =
        end - first > 1 ? gap + std::max(0.0, inner - width) / static_cast<double>(end - first - 1)
                        : 0.0;
    double x = frame;
    for (std::size_t i = first; i < end; ++i) {
      for (DrawnShape& shape : blocks[i].shapes) {
        move_shape(shape, {x, y});
        shapes.push_back(std::move(shape));
      }
      x += blocks[i].size.x + between;
    }
    y += height + .6 * set.line_px();
    first = end;
  }
  Block sources = set.sources(content.sources, inner);
  for (DrawnShape& shape : sources.shapes) {
    move_shape(shape, {frame, y});
    shapes.push_back(std::move(shape));
  }
  y += sources.size.y;
  margin.bottom = static_cast<int>(std::ceil(y + .6 * frame)) - frame - picture_px.y;
  if (shapes.empty()) margin.bottom = frame;
  // A fine line around the picture.
  const double line = set.mm(.2);
  if (frame > 0)
    shapes.push_back(DrawnPath{
        .points = rectangle(frame - .5 * line, frame - .5 * line, frame + picture_px.x + .5 * line,
                            frame + picture_px.y + .5 * line),
        .closed = true,
        .fill = {},
        .stroke = style.ink,
        .width_px = line});
  margin.drawing.size_px = {picture_px.x + margin.left + margin.right,
                            picture_px.y + margin.top + margin.bottom};
  return margin;
}

std::vector<ScaleBar> find_scales(const GeoMap& map, glm::dvec2 eye, double skyline_px,
                                  glm::ivec2 size_px) {
  std::vector<ScaleBar> bars;
  const double low = .95 * size_px.y;
  for (const double y : {low, skyline_px + (low - skyline_px) / 7.0}) {
    const std::optional<GeoPosition> at = map.to_geo({.5 * size_px.x, y});
    if (!at || glm::length(at->position - eye) <= 0.0) continue;
    const glm::dvec2 ahead = glm::normalize(at->position - eye);
    const glm::dvec2 across = .005 * at->distance_m * glm::dvec2(-ahead.y, ahead.x);
    const auto a = map.to_image(glm::dvec3(at->position - across, at->altitude_m));
    const auto b = map.to_image(glm::dvec3(at->position + across, at->altitude_m));
    if (!a || !b) continue;
    const double px_per_m = glm::length(b->pixel - a->pixel) / (2.0 * glm::length(across));
    if (px_per_m > 0.0) bars.push_back({at->distance_m, px_per_m});
  }
  return bars;
}

}  // namespace belvedere
