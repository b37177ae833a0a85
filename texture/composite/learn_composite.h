#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "texture/composite/composite_model.h"
#include "texture/statistical/label_borders.h"
#include "texture/statistical/learn_texture.h"

namespace belvedere {

// Labels of a crop, 0 … names.size() - 1 in the order of names; no_label: not known, belongs to nothing.
struct LabelledCrop {
  const Grid<Rgb8>& picture;
  const Grid<std::uint8_t>& states;  // empty: all pixels count
  const Grid<std::uint8_t>& labels;
  std::vector<std::string> names;
};

inline constexpr int label_inset_px = 3;  // a label's texture is learnt so far off its borders
inline constexpr int transition_px = 6;   // and that of borders so far to either side of them

struct CompositeParameters {
  LearnParameters learn{};
  bool choose = true;  // how each label's texture begins (choose_seed.h); else all as `begin` says
  TextureSeed begin = TextureSeed::white;
  float begin_px = 0.F;  // half length of streaks, radius of discs
};

// A model of each label under its mask, of borders, and of the map. Error(input) for labels of another size than the crop, one label or
// more than 16, and labels that leave too little to learn from (min_crop_px), each with its name.
CompositeModel learn_composite(const LabelledCrop& crop, const CompositeParameters& parameters, Progress& progress = silent_progress());

}  // namespace belvedere
