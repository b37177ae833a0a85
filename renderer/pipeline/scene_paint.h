#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/progress.h"
#include "renderer/exemplar/scan.h"
#include "renderer/image/display_conversion.h"
#include "renderer/paint/palette.h"
#include "renderer/scene/scene_file.h"
#include "renderer/style/style.h"

namespace belvedere {

// The paint of a scene, read and checked before the terrain is.
struct ScenePaint {
  std::vector<ScannedPainting> paintings;  // one for each exemplar block; empty where the scene
                                           // copies neither strokes nor colours
  Palette palette;                         // the scene's, or the paintings' colours in it
  std::optional<Style> style = {};         // a painter's, over everything
};
ScenePaint read_scene_paint(const LoadedScene& scene, Progress& progress);
// The palette alone, for parts that are never copied. Reads paintings only if the colours are taken
// from them.
Palette read_scene_palette(const LoadedScene& scene, Progress& progress);

// Refuses a scene's files without reading its terrain, for all reasons in one place, so that a
// check passes nothing that rendering refuses: missing files, and paintings that cannot be read
// whole, if their colours or strokes are used. Cheap compared with reading them.
void require_inputs(const LoadedScene& scene);

// Colour conversion of the panorama's files, read before the work begins, so that an invalid file
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
