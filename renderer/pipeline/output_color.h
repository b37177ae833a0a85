#pragma once

#include <cstdint>
#include <vector>

#include "renderer/image/color.h"
#include "renderer/scene/scene_file.h"

namespace belvedere {

// What the panorama's colours are written as: to be read before the work begins, so that a bad file costs no rendering.
struct OutputColor {
  ColorParameters display;            // working space to encoded sRGB
  std::vector<std::uint8_t> profile;  // of the device that the TIFF is converted to; empty: sRGB
};
// The scene's OpenColorIO config and ICC profile, each tried on a pixel. Error(input) naming the file where one is bad.
OutputColor read_output_color(const LoadedScene& scene);

}  // namespace belvedere
