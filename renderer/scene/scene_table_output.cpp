#include "renderer/image/icc/device_colour.h"
#include "renderer/image/picture_formats.h"
#include "renderer/scene/scene_table.h"

namespace belvedere {

std::vector<SceneSection> make_output_sections() {
  std::vector<SceneSection> sections;
  sections.push_back({.name = "output",
                      .meaning = "The sheet.",
                      .keys = {
                          {.name = "width",
                           .field = AT(output.width),
                           .range = {16, 65535},
                           .unit = "px",
                           .meaning = "Width of the picture."},
                          {.name = "height",
                           .field = AT(output.height),
                           .range = {16, 65535},
                           .unit = "px",
                           .meaning = "Height of the picture."},
                          {.name = "sheet_width_mm",
                           .field = AT(output.sheet_width_mm),
                           .range = {10, 20000},
                           .unit = "mm",
                           .meaning = "Width in print; the size of strokes and trees and the "
                                      "resolution in dpi follow from it."},
                          {.name = "formats",
                           .field = AT(output.formats),
                           .meaning = "Formats of the picture, by file extension; see below.",
                           .choices = picture_extensions()},
                          {.name = "profile",
                           .field = AT(output.profile),
                           .meaning = "ICC file that the TIFF is converted to: RGB of a printer, "
                                      "or CMYK of a press. Default: `colours`.",
                           .text = TextKind::file},
                          {.name = "colours",
                           .field = AT(output.colours),
                           .meaning = "Colour space of the TIFF if there is no `profile`.",
                           .text = TextKind::choice,
                           .choices = colour_space_names()},
                          {.name = "intent",
                           .field = AT(output.intent),
                           .meaning = "Rendering intent for colours outside the profile or space.",
                           .text = TextKind::choice,
                           .choices = rendering_intent_names()},
                          {.name = "black_point",
                           .field = AT(output.black_point),
                           .meaning = "Maps the picture's black to the darkest colour of profile "
                                      "or space (black point compensation)."},
                          {.name = "ink_limit",
                           .field = AT(output.ink_limit),
                           .range = {0, 400},
                           .unit = "%",
                           .meaning = "Total ink above which pixels are counted and reported; 0: "
                                      "the maximum of the press profile's own tables."},
                          {.name = "ocio_config",
                           .field = AT(output.ocio_config),
                           .meaning = "OpenColorIO config to use instead of the program's own.",
                           .text = TextKind::file},
                      }});
  return sections;
}

}  // namespace belvedere
