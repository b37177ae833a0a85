#include "texture/composite/composite_window.h"

#include <algorithm>
#include <cstddef>

#include "base/error.h"
#include "base/grid_part.h"
#include "texture/composite/make_composite.h"
#include "texture/statistical/label_borders.h"

namespace belvedere {
namespace {

// The paint of a rectangle of the map, each label under its mask, before borders are repainted.
Grid<Rgb8> fill_labels(const CompositeModel& model, const CompositeRecord& record,
                       const Grid<std::uint8_t>& labels, PixelRect rect,
                       const TextureParameters& parameters) {
  Grid<Rgb8> out(labels.width(), labels.height());
  for (std::size_t label = 0; label < model.labels.size(); ++label) {
    PixelRect box{labels.width(), labels.height(), 0, 0};
    for (int y = 0; y < labels.height(); ++y)
      for (int x = 0; x < labels.width(); ++x)
        if (labels(x, y) == label)
          box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1),
                 std::max(box.y1, y + 1)};
    if (box.empty()) continue;
    const PixelRect asked = grown(moved(box, rect.x0, rect.y0), endless_margin_px);
    const TexturePiece piece =
        make_piece(model.labels[label].model, record.labels[label], asked, parameters);
    for (int y = box.y0; y < box.y1; ++y)
      for (int x = box.x0; x < box.x1; ++x)
        if (labels(x, y) == label)
          out(x, y) = piece.picture(rect.x0 + x - piece.piece.x0, rect.y0 + y - piece.piece.y0);
  }
  return out;
}

}  // namespace

CompositeRecord record_composite(const CompositeModel& model, const TextureParameters& parameters,
                                 Progress& progress) {
  CompositeRecord record;
  progress.begin("preparing textures", static_cast<double>(model.labels.size()));
  for (const CompositeLabel& label : model.labels) {
    record.labels.push_back(record_texture(label.model, parameters));
    progress.advance(1.0);
  }
  return record;
}

Grid<Rgb8> make_composite_window(const CompositeModel& model, const CompositeRecord& record,
                                 const Grid<std::uint8_t>& labels, PixelRect window,
                                 const TextureParameters& parameters, Progress& progress) {
  check_texture_size(window.width(), window.height());
  const PixelRect map{0, 0, labels.width(), labels.height()};
  if (intersection(window, map) != window)
    throw Error(ErrorKind::usage, "the window", "it extends beyond the map", "a part of the map");
  for (const std::uint8_t label : labels)
    if (label >= model.labels.size())
      throw Error(ErrorKind::bug, "make_composite_window", "a label that is not in the model");
  const PixelRect tiles{window.x0 / endless_tile_px, window.y0 / endless_tile_px,
                        (window.x1 - 1) / endless_tile_px + 1,
                        (window.y1 - 1) / endless_tile_px + 1};
  progress.begin("making a window", static_cast<double>(tiles.width()) * tiles.height());
  Grid<Rgb8> out(window.width(), window.height());
  for (int ty = tiles.y0; ty < tiles.y1; ++ty)
    for (int tx = tiles.x0; tx < tiles.x1; ++tx) {
      const PixelRect tile = {tx * endless_tile_px, ty * endless_tile_px,
                              (tx + 1) * endless_tile_px, (ty + 1) * endless_tile_px};
      const PixelRect around = intersection(grown(tile, composite_margin_px), map);
      const Grid<std::uint8_t> own = part_of(labels, around);
      Grid<Rgb8> made = fill_labels(model, record, own, around, parameters);
      const Grid<std::uint8_t> zone = near_borders(own, remade_border_px);
      if (model.transition &&
          std::any_of(zone.begin(), zone.end(), [](std::uint8_t z) { return z != 0; })) {
        const Grid<std::uint8_t> all(around.width(), around.height(), 1);
        made = fill_among(made, zone, all, {around.x0, around.y0}, *model.transition,
                          of_seam(parameters));
        snap_colours(made, own, zone, remade_border_px);
      }
      const PixelRect part = intersection(tile, window);
      for (int y = part.y0; y < part.y1; ++y)
        std::copy_n(made.row(y - around.y0) + (part.x0 - around.x0), part.width(),
                    out.row(y - window.y0) + (part.x0 - window.x0));
      progress.advance(1.0);
    }
  return out;
}

}  // namespace belvedere
