#pragma once

#include <vector>

#include "base/pixel_rect.h"
#include "texture/composite/composite_model.h"
#include "texture/statistical/make_texture.h"

namespace belvedere {

// Windows of a composite over a map of any size: each label by its texture without end (make_texture.h), borders remade in fixed tiles. Any
// window has the same pixels as the whole, in any order, because a tile is a function of the labels in and around it alone. As a whole it
// is not the picture of make_composite, which fits each texture to the pixels that it has there.

// Tables of each label's texture, some 13 MB each.
struct CompositeRecord {
  std::vector<TextureRecord> labels;
};
CompositeRecord record_composite(const CompositeModel& model, const TextureParameters& parameters, Progress& progress = silent_progress());

// `labels`: the whole map, a byte a pixel; `window` lies in it. Error(limit) over most_texture_pixels, Error(bug) for labels that the model
// has not. Progress: tiles.
Grid<Rgb8> make_composite_window(const CompositeModel& model, const CompositeRecord& record, const Grid<std::uint8_t>& labels,
                                 PixelRect window, const TextureParameters& parameters, Progress& progress = silent_progress());
inline constexpr int composite_margin_px = 48;  // that a tile looks around itself

}  // namespace belvedere
