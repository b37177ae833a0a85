#pragma once

#include "base/progress.h"
#include "texture/composite/composite_model.h"
#include "texture/statistical/make_texture.h"

namespace belvedere {

// Fills a map of labels, made (make_label_map.h) or drawn: each label by its own model under its mask, then 3 pixels on either side of all
// borders anew by the transition model, in colours of the two sides. Error(limit) over most_texture_pixels. Error(bug) for labels that the
// model has not.
Grid<Rgb8> make_composite(const CompositeModel& model, const Grid<std::uint8_t>& labels, const TextureParameters& parameters,
                          Progress& progress = silent_progress());
inline constexpr int remade_border_px = 3;

// Where `zone` is not 0, colours that none of the labels within `reach` pixels has: replaced by the nearest colour that one of them has. A
// transition learnt from all borders of a crop at once mixes what no border shows.
void snap_colours(Grid<Rgb8>& picture, const Grid<std::uint8_t>& labels, const Grid<std::uint8_t>& zone, int reach);

}  // namespace belvedere
