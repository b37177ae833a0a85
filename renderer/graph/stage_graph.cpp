#include "renderer/graph/stage_graph.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "renderer/trace/camera.h"

namespace belvedere {
namespace {

double pixels_of(PixelRect rect) {
  return rect.empty() ? 0.0 : static_cast<double>(rect.width()) * rect.height();
}

PixelRect grown_by(PixelRect rect, Reach reach) {
  return {rect.x0 - reach.columns, rect.y0 - reach.rows, rect.x1 + reach.columns,
          rect.y1 + reach.rows};
}

// A rectangle extended to all tiles that it touches.
PixelRect with_whole_tiles(PixelRect rect, int tile_px) {
  const auto up = [&](int px) { return (px + tile_px - 1) / tile_px * tile_px; };
  return {rect.x0 / tile_px * tile_px, rect.y0 / tile_px * tile_px, up(rect.x1), up(rect.y1)};
}

std::string drawn_id(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

std::string describe_reach(Reach reach, double pixels_per_unit) {
  const auto units = [&](int px) {
    return fmt::format("{:.0f}", std::ceil(px / pixels_per_unit - 0.01));
  };
  if (reach.columns == reach.rows) return reach.rows == 0 ? "" : units(reach.rows);
  return (reach.columns == 0 ? "" : units(reach.columns) + ", ") + units(reach.rows) +
         " up and down";
}

// A source as an arrow to its reader.
std::string draw_source(const StageNode::Source& source, const std::string& reader,
                        double pixels_per_unit) {
  std::string label = describe_reach(source.reach, pixels_per_unit);
  if (source.wide_reach != source.reach)
    label += " or " + describe_reach(source.wide_reach, pixels_per_unit);
  return fmt::format("  {} -->{} {}\n", drawn_id(source.stage->declaration().name),
                     label.empty() ? "" : "|" + label + "|", reader);
}

}  // namespace

PixelRect bounding_rect(const PixelRect& a, const PixelRect& b) {
  if (a.empty() || b.empty()) return a.empty() ? b : a;
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

void check_inside(PixelRect window, PixelRect rect) {
  if (intersection(window, rect) == rect) return;
  throw Error(ErrorKind::bug, "stage graph",
              fmt::format("columns {} to {} and rows {} to {} are read", rect.x0, rect.x1, rect.y0,
                          rect.y1),
              fmt::format("no more than was declared: columns {} to {}, rows {} to {}", window.x0,
                          window.x1, window.y0, window.y1));
}

StageNode::StageNode(Declaration declaration, std::vector<Source> sources)
    : declaration_(std::move(declaration)), sources_(std::move(sources)) {}

PixelRect StageNode::window(const Source& source, const Tile& tile) const {
  const PixelRect around = grown_by(tile.rect, tile.wide ? source.wide_reach : source.reach);
  return intersection(source.stage->sheet(),
                      wide_rect(around, source.stage->declaration().scale / declaration_.scale));
}

PixelRect StageNode::demand(const Source& source, PixelRect wanted) const {
  const PixelRect made =
      declaration_.whole_tiles ? with_whole_tiles(wanted, declaration_.tile_px) : wanted;
  return window(source, {intersection(sheet(), made), true});
}

Tile StageNode::tile_of(PixelRect rect) const {
  if (!declaration_.condition) return {rect, false};
  const Condition& condition = *declaration_.condition;
  return {rect,
          condition.holds(intersection(condition.stage->sheet(), grown_by(rect, condition.reach)))};
}

void StageNode::prepare_sources(const Tile& tile) const {
  for (const Source& source : sources_)
    if (source.stage != nullptr) source.stage->prepare(window(source, tile));
}

double StageNode::bytes_to_make(int side) const {
  const PixelRect centre{(sheet().x1 - side) / 2, (sheet().y1 - side) / 2, (sheet().x1 + side) / 2,
                         (sheet().y1 + side) / 2};
  const Tile tile{intersection(sheet(), centre), true};
  double held = 0.0;
  double max = 0.0;
  double largest = pixels_of(tile.rect);
  for (const Source& source : sources_) {
    if (source.stage == nullptr) continue;
    const PixelRect read = window(source, tile);
    // A view is made while the windows before it are held.
    if (source.stage->declaration().tile_px == 0)
      max =
          std::max(max, held + source.stage->bytes_to_make(std::max(read.width(), read.height())));
    held += pixels_of(read) * source.bytes_per_pixel;
    largest = std::max(
        largest, source.stage->declaration().scale == declaration_.scale ? pixels_of(read) : 0.0);
  }
  // A view fills its reader's window.
  const double result = declaration_.tile_px > 0 ? pixels_of(tile.rect) * bytes_per_pixel() : 0.0;
  return std::max(max, held + largest * declaration_.work_bytes_per_pixel + result);
}

void StageGraph::keep_only(std::span<const Request> requests) {
  for (const auto& stage : stages_) stage->wanted_ = {};
  for (const Request& request : requests)
    request.stage->wanted_ =
        bounding_rect(request.stage->wanted_, intersection(request.stage->sheet(), request.rect));
  // Each stage comes after all that it reads, so this is one pass from the outputs back to the
  // first stage.
  for (auto stage = stages_.rbegin(); stage != stages_.rend(); ++stage) {
    const StageNode& reader = **stage;
    (*stage)->keep_only(reader.wanted_);
    if (reader.wanted_.empty()) continue;
    const auto need = [&](const StageNode::Source& source) {
      if (source.stage != nullptr)
        source.stage->wanted_ =
            bounding_rect(source.stage->wanted_, reader.demand(source, reader.wanted_));
    };
    for (const StageNode::Source& source : reader.sources()) need(source);
    if (const auto& condition = reader.declaration().condition)
      need({condition->stage, condition->reach, condition->reach});
  }
}

double StageGraph::bytes_to_make(const StageNode& output, int side) const {
  double max = output.bytes_to_make(side);
  for (const auto& stage : stages_)
    if (stage->declaration().tile_px > 0)
      max = std::max(max, stage->bytes_to_make(std::max(1, side / stage->declaration().scale)));
  return max;
}

std::string StageGraph::draw(double pixels_per_unit) const {
  std::string drawing = "flowchart TD\n";
  for (const auto& stage : stages_) {
    const StageNode::Declaration& declared = stage->declaration();
    const std::string id = drawn_id(declared.name);
    drawing += declared.tile_px > 0 ? fmt::format("  {}[{}]\n", id, declared.name)
                                    : fmt::format("  {}({})\n", id, declared.name);
    for (const StageNode::Source& source : stage->sources())
      if (source.stage != nullptr) drawing += draw_source(source, id, pixels_per_unit);
  }
  return drawing;
}

}  // namespace belvedere
