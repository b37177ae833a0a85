#pragma once

#include <cstdint>

#include "base/grid.h"
#include "base/progress.h"
#include "texture/composite/label_map.h"
#include "texture/statistical/make_texture.h"

namespace belvedere {

struct LabelMapParameters {
  std::uint64_t seed = 1;
  bool layout = true;   // vertical distribution; without it, labels lie anywhere
  bool rings = true;    // shape of borders; without it, they are smooth and octagonal
  double effort = 1.0;  // factor on the sweeps at each scale, 0.1…10
  std::int64_t finest_pixels = max_texture_pixels;  // lattices of more are not sampled, their
                                                    // borders are those of the coarser one
};

// A map of labels of any size with the statistics of the model: a Gibbs field sampled from coarse
// to fine, on lattices of every 16th, 8th … pixel, where an offset of so many pixels is one step;
// each finer lattice begins with the result of the coarser one. Error(limit) if every 16th pixel
// is over max_texture_pixels. Progress: pixels of all lattices.
Grid<std::uint8_t> make_label_map(const LabelMapModel& model, int width, int height,
                                  const LabelMapParameters& parameters,
                                  Progress& progress = silent_progress());

}  // namespace belvedere
