#pragma once

#include <string>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"
#include "texture/composite/make_composite.h"
#include "texture/statistical/clique_model.h"
#include "texture/statistical/learn_texture.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {

// Labels of a crop, 0 … names.size() - 1 in the order of names; no_label: unknown, belongs to none.
struct LabelledCrop {
  const Grid<Rgb8>& picture;
  const Grid<std::uint8_t>& states;  // empty: all pixels count
  const Grid<std::uint8_t>& labels;
  std::vector<std::string> names;
};

inline constexpr int label_inset_px =
    3;  // distance from its borders at which a label's texture is learnt
inline constexpr int transition_px =
    6;  // half width of the strip from which the texture of borders is learnt

struct CompositeParameters {
  LearnParameters learn{};
  bool choose = true;  // choose the initial noise of each label's texture (choose_seed.h);
                       // otherwise `begin` is used for all
  TextureSeed begin = TextureSeed::white;
  float begin_px = 0.F;  // half length of streaks, radius of discs
};

// Models of each label under its mask, of borders, and of the map. Error(input) for labels of
// another size than the crop, for one label or more than 16, and for labels with too few pixels to
// learn from (min_crop_px), with their names.
CompositeModel learn_composite(const LabelledCrop& crop, const CompositeParameters& parameters,
                               Progress& progress = silent_progress());

// Labels that can all be learnt, from any (up to 255, such as segments): while one has too few
// pixels that far from its borders, or a single colour, the smallest of those is joined to the
// label with which it has the longest border. Numbered from 0 in their order; pixels of no_label
// stay. `names` is not read.
Grid<std::uint8_t> join_small_labels(const LabelledCrop& crop);

// Errors of layout, which a composite reduces and a texture of one kind cannot: of the distribution
// of colours over height, and of the relation of distant pixels. L1 distances, 0…2, of a picture to
// its crop, which may be of another size.
struct LayoutFigures {
  double profile = 0.0;    // of colours in cells of 32 levels, in sixteen strips of height
  double far_pairs = 0.0;  // of differences of pixels 16, 32, 64 and 128 apart along rows and
                           // columns, in the crop's three bands
};
LayoutFigures layout_figures(const Grid<Rgb8>& crop, const Grid<Rgb8>& made);

}  // namespace belvedere
