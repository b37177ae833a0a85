#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/progress.h"

namespace belvedere::tools {

// Another layer of the same paintings laid by a stored match field.
struct ReplayFiles {
  std::string match;                // as synthesize --match writes it
  std::vector<std::string> layers;  // one for each painting the matches copy from, in their order, each of its painting's size
  std::string out;                  // .png (8 bit), .tif (16 bit), .exr (layers of floating-point numbers: every channel in its own type)
};
struct ReplayResult {
  int width = 0;
  int height = 0;
  std::size_t without_texel = 0;  // pixels that copy nothing: 0 in every channel
};

// Values are laid as they stand, colours not converted: 8 and 16 bits come through exactly in a TIFF, all channels of an OpenEXR layer in
// an OpenEXR file. Notes say what a narrower result loses. Error(usage) where layers do not fit the matches or the result's format cannot
// hold them, Error(input) for damaged files, Error(output).
ReplayResult replay_layers(const ReplayFiles& files, Progress& progress);

}  // namespace belvedere::tools
