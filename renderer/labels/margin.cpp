#include "renderer/labels/margin.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>

namespace belvedere {
namespace {

constexpr double rule_mm = 0.14;       // thin lines
constexpr double outer_line_mm = 0.4;  // of the frame
constexpr double outer_gap_mm = 1.2;   // between the two lines of the frame
constexpr double line_gap_mm = 6.0;    // between lines of blocks
constexpr double block_gap_mm = 11.0;  // minimum distance of blocks

DrawnPath framing_line(glm::dvec2 low, glm::dvec2 high, double out_px, const std::string& colour,
                       double width_px) {
  const glm::dvec2 a = low - out_px;
  const glm::dvec2 b = high + out_px;
  return {.points = {a, {b.x, a.y}, b, {a.x, b.y}},
          .closed = true,
          .fill = {},
          .stroke = colour,
          .width_px = width_px};
}

double width_of(const std::vector<MarginBlock>& blocks, std::size_t first, std::size_t end,
                double gap) {
  double width = gap * static_cast<double>(end - first - 1);
  for (std::size_t i = first; i < end; ++i) width += blocks[i].size.x;
  return width;
}

// Extent of blocks broken into lines: the widest line and the sum of the heights.
glm::dvec2 extent_of(const std::vector<MarginBlock>& blocks, const std::vector<std::size_t>& ends,
                     double gap, double line_gap) {
  glm::dvec2 extent(0.0);
  std::size_t first = 0;
  for (const std::size_t end : ends) {
    extent.x = std::max(extent.x, width_of(blocks, first, end, gap));
    double highest = 0.0;
    for (; first < end; ++first) highest = std::max(highest, blocks[first].size.y);
    extent.y += highest + line_gap;
  }
  return extent;
}

// The ends of the lines that blocks are broken into: as few as fit, and of those that whose widest
// line is narrowest.
std::vector<std::size_t> broken(const std::vector<MarginBlock>& blocks, double gap, double max_px) {
  if (blocks.empty()) return {};
  std::vector<std::size_t> best;
  double best_width = 0.0;
  for (unsigned breaks = 0; breaks < 1U << (blocks.size() - 1); ++breaks) {
    std::vector<std::size_t> ends;
    for (std::size_t i = 1; i < blocks.size(); ++i)
      if ((breaks >> (i - 1) & 1U) != 0) ends.push_back(i);
    ends.push_back(blocks.size());
    // Blocks that are alone too wide stand alone.
    const double width = extent_of(blocks, ends, gap, 0.0).x;
    const auto badness = [&](double wide, std::size_t lines) {
      return std::tuple(std::max(max_px, wide), lines, wide);
    };
    if (!best.empty() && badness(width, ends.size()) >= badness(best_width, best.size())) continue;
    best = std::move(ends);
    best_width = width;
  }
  return best;
}

std::vector<MarginBlock> blocks_of(const MarginContent& content, const MarginSetter& set,
                                   std::size_t rows, double max_px) {
  std::vector<MarginBlock> blocks = {set.title(content, max_px), set.classes(content.classes, rows),
                                     set.features(content.features, content.features_at, rows),
                                     set.scales(content.scales)};
  if (content.directions) blocks.push_back(set.directions(content));
  std::erase_if(blocks, [](const MarginBlock& block) { return block.shapes.empty(); });
  return blocks;
}

// Places a block on the paper.
void place(MarginBlock block, glm::dvec2 at, Margin& margin) {
  for (DrawnShape& shape : block.shapes) {
    move_shape(shape, at);
    margin.drawing.shapes.push_back(std::move(shape));
  }
  for (LegendCrop& crop : block.crops) {
    crop.to =
        moved(crop.to, static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y)));
    margin.crops.push_back(crop);
  }
}

}  // namespace

Margin lay_out_margin(const MarginContent& content, const MarginStyle& style, glm::ivec2 picture_px,
                      double px_per_mm, double frame_px) {
  const MarginSetter set(style, px_per_mm, picture_px.x);
  const double inner = picture_px.x;
  const double gap = set.mm(block_gap_mm);
  const double line_gap = set.mm(line_gap_mm);
  // The number of rows of the legend with which the strip is lowest and not wider than the picture.
  std::vector<MarginBlock> blocks;
  std::vector<std::size_t> ends;
  std::pair<double, double> best;  // what is too wide, and the height
  for (const std::size_t rows : {4U, 5U, 6U, 8U, 12U}) {
    std::vector<MarginBlock> tried = blocks_of(content, set, rows, inner);
    std::vector<std::size_t> breaks = broken(tried, gap, inner);
    const glm::dvec2 extent = extent_of(tried, breaks, gap, line_gap);
    const std::pair found(std::max(inner, extent.x), extent.y);
    if (!ends.empty() && found >= best) continue;
    best = found;
    blocks = std::move(tried);
    ends = std::move(breaks);
  }

  const int frame = static_cast<int>(std::lround(frame_px));
  Margin margin{.left = frame, .top = frame, .right = frame, .bottom = frame, .drawing = {}};
  double y = frame + picture_px.y + std::max(.75 * frame, set.mm(4.0));
  std::size_t first = 0;
  for (const std::size_t end : ends) {
    const double width = width_of(blocks, first, end, gap);
    double height = 0.0;
    for (std::size_t i = first; i < end; ++i) height = std::max(height, blocks[i].size.y);
    // The remaining space goes between the blocks: the first at the left edge of the picture, the
    // last at its right edge.
    const double between =
        end - first > 1 ? gap + std::max(0.0, inner - width) / static_cast<double>(end - first - 1)
                        : 0.0;
    double x = frame;
    for (std::size_t i = first; i < end; ++i) {
      const double block_width = blocks[i].size.x;
      // Whole pixels, so that pieces of the picture lie in their frames.
      place(std::move(blocks[i]), {std::round(x), std::round(y)}, margin);
      x += block_width + between;
    }
    y += height + line_gap;
    first = end;
  }
  MarginBlock sources = set.sources(content.sources, inner);
  if (!sources.shapes.empty()) {
    margin.drawing.shapes.push_back(DrawnPath{.points = {{frame, y}, {frame + inner, y}},
                                              .fill = {},
                                              .stroke = style.ink,
                                              .width_px = set.mm(rule_mm)});
    y += set.mm(1.2);
    const double height = sources.size.y;
    place(std::move(sources), {frame, y}, margin);
    y += height;
  }
  margin.bottom = static_cast<int>(std::ceil(y + .5 * frame)) - frame - picture_px.y;
  if (margin.drawing.shapes.empty()) margin.bottom = frame;
  if (frame > 0) {
    const glm::dvec2 low(frame);
    const glm::dvec2 high = low + glm::dvec2(picture_px);
    const double thin = set.mm(rule_mm);
    const double thick = set.mm(outer_line_mm);
    margin.drawing.shapes.push_back(framing_line(low, high, .5 * thin, style.ink, thin));
    const double out = set.mm(outer_gap_mm) + .5 * thick;
    if (out + thick < frame)
      margin.drawing.shapes.push_back(framing_line(low, high, out, style.ink, thick));
  }
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
