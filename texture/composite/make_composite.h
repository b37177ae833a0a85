#pragma once

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

}  // namespace belvedere
