#pragma once

#include <vector>

#include "base/pixel_rect.h"
#include "base/progress.h"
#include "texture/composite/composite_model.h"
#include "texture/statistical/make_texture.h"

namespace belvedere {

// Fills a map of labels, generated (make_label_map.h) or drawn: each label by its own model under
// its mask, then 3 pixels on either side of all borders again by the transition model, in colours
// of the two sides. Error(limit) over max_texture_pixels. Error(bug) for labels that are not in the
// model.
Grid<Rgb8> make_composite(const CompositeModel& model, const Grid<std::uint8_t>& labels,
                          const TextureParameters& parameters,
                          Progress& progress = silent_progress());
inline constexpr int remade_border_px = 3;

// Where `zone` is not 0, replaces colours that none of the labels within `reach` pixels contains by
// the nearest colour that one of them contains. A transition learnt from all borders of a crop
// together mixes colours that no single border shows.
void snap_colours(Grid<Rgb8>& picture, const Grid<std::uint8_t>& labels,
                  const Grid<std::uint8_t>& zone, int reach);

// Windows of a composite over a map of any size: each label by its unbounded texture
// (make_texture.h), with borders repainted in fixed tiles. Any window has the same pixels as the
// whole, in any order, because a tile depends only on the labels in and around it. The whole
// differs from the picture of make_composite, which fits each texture to its own pixels.

// Tables of each label's texture, some 13 MB each.
struct CompositeRecord {
  std::vector<TextureRecord> labels;
};
CompositeRecord record_composite(const CompositeModel& model, const TextureParameters& parameters,
                                 Progress& progress = silent_progress());

// `labels`: the whole map, one byte per pixel; `window` is inside it. Error(limit) over
// max_texture_pixels, Error(bug) for labels that are not in the model. Progress: tiles.
Grid<Rgb8> make_composite_window(const CompositeModel& model, const CompositeRecord& record,
                                 const Grid<std::uint8_t>& labels, PixelRect window,
                                 const TextureParameters& parameters,
                                 Progress& progress = silent_progress());
inline constexpr int composite_margin_px = 48;  // that a tile reads around itself

}  // namespace belvedere
