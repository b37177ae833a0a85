#pragma once

#include <vector>

#include "base/pixel_rect.h"
#include "texture/composite/composite_model.h"
#include "texture/statistical/make_texture.h"

namespace belvedere {

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
