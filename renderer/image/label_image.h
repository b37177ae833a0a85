#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {

// Label masks that share their labels.
struct LabelImages {
  std::vector<Grid<std::uint8_t>> labels;  // one for each file
  std::vector<Rgb8> colours;  // label k was drawn in colours[k]; empty where files hold numbers
};

// Masks as numbers (grey or palette images, 0 … 254, 255 unused), or drawn in flat colours in a
// paint program: then the colours that fill any square of 3 × 3 pixels, in any of the files, are
// the labels, in ascending order of red, green, blue. Pixels of other colours are soft edges of the
// drawing and take the label of the nearest flat one. Where a drawing was compressed with losses
// (JPEG), flat colours that are rare and within max_lossy_steps of a frequent one are this one;
// noted. Error(input) for files of both kinds together, numbers over 255, drawings without flat
// colours or with more than 64.
LabelImages read_label_images(const std::vector<std::string>& paths,
                              Progress& progress = silent_progress());

// How far compression with losses moves a flat colour, steps of 8 bits in each channel.
constexpr int max_lossy_steps = 12;

// A mask of classes by their numbers (read_grey), 255 unused; `others` are numbers that the reader
// allows as well. Error(input) for further numbers, with how many pixels have them and where the
// first is.
Grid<std::uint8_t> read_class_mask(const std::string& path,
                                   const std::vector<std::uint8_t>& others = {});

// A grey picture of any format as shares of the range of its type, 0…1: black is 0, white is 1,
// whatever values occur in it. A palette gives its greys. Error(input) for colours, and for what
// read_picture refuses.
Grid<float> read_grey_share(const std::string& path);

}  // namespace belvedere
