#include "renderer/image/picture_formats.h"
#include "renderer/scene/scene_table.h"

namespace belvedere {

std::vector<SceneSection> make_output_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "output",
       .meaning = "The sheet.",
       .keys = {
           {.name = "width", .field = AT(output.width), .range = {16, 65535}, .unit = "px", .meaning = "Width of the picture."},
           {.name = "height", .field = AT(output.height), .range = {16, 65535}, .unit = "px", .meaning = "Height of the picture."},
           {.name = "sheet_width_mm",
            .field = AT(output.sheet_width_mm),
            .range = {10, 20000},
            .unit = "mm",
            .meaning = "Width in print; strokes and trees are sized for it, and the resolution in dpi follows."},
           {.name = "formats",
            .field = AT(output.formats),
            .meaning = "What the picture is written as, by the endings of its files; see below.",
            .choices = picture_endings()},
           {.name = "profile",
            .field = AT(output.profile),
            .meaning = "ICC file of the printer that the TIFF is converted to; without it sRGB.",
            .text = TextKind::file},
           {.name = "ocio_config",
            .field = AT(output.ocio_config),
            .meaning = "OpenColorIO config to use instead of the program's own.",
            .text = TextKind::file},
       }});
  return sections;
}

}  // namespace belvedere
