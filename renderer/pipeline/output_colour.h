#pragma once

#include <cstdint>
#include <vector>

#include "renderer/image/display_conversion.h"
#include "renderer/scene/scene_file.h"

namespace belvedere {

// Colour conversion of the panorama's files: read before the work begins, so that an invalid file
// costs no rendering time.
struct OutputColour {
  DisplayParameters display;  // working space to encoded sRGB
  std::vector<std::uint8_t>
      profile;              // of the device or space that the TIFF is converted to; empty: sRGB
  DeviceParameters device;  // how it is converted
  double ink_limit_percent = 0.0;  // of a press; 0: the profile's limit
};
// The scene's OpenColorIO config and ICC profile of RGB or CMYK, each tested on a pixel.
// Error(input) naming the file where one is invalid.
OutputColour read_output_colour(const LoadedScene& scene);

}  // namespace belvedere
