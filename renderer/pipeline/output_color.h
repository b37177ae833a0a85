#pragma once

#include <cstdint>
#include <vector>

#include "renderer/image/color.h"
#include "renderer/scene/scene_file.h"

namespace belvedere {

// What the panorama's colours are written as: to be read before the work begins, so that a bad file costs no rendering.
struct OutputColor {
  ColorParameters display;            // working space to encoded sRGB
  std::vector<std::uint8_t> profile;  // of the device or space that the TIFF is converted to; empty: sRGB
  DeviceParameters device;            // how it is converted
  double ink_limit_percent = 0.0;     // of a press; 0: the profile's own
};
// The scene's OpenColorIO config and ICC profile of RGB or CMYK, each tried on a pixel. Error(input) naming the file where one is bad.
OutputColor read_output_color(const LoadedScene& scene);

}  // namespace belvedere
