#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/progress.h"

namespace belvedere::tools {

// Copies another layer of the same paintings by a stored match field.
struct ReplayFiles {
  std::string match;                // as synthesize --match writes it
  std::vector<std::string> layers;  // one for each painting that the matches copy from, in their
                                    // order, each of its painting's size
  std::string out;  // .png (8 bit), .tif (16 bit), .exr (layers of floating-point numbers: every
                    // channel in its own type)
};
struct ReplayResult {
  int width = 0;
  int height = 0;
  std::size_t without_texel = 0;  // value of pixels that copy nothing: 0 in every channel
};

// Values are copied unchanged, without colour conversion: 8 and 16 bits are exact in a TIFF, all
// channels of an OpenEXR layer in an OpenEXR file. Notes report what a narrower result loses.
// Error(usage) where layers do not fit the matches or the result's format cannot hold them,
// Error(input) for damaged files, Error(output).
ReplayResult replay_layers(const ReplayFiles& files, Progress& progress);

}  // namespace belvedere::tools
