#include "renderer/image/icc/device_color.h"
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
            .meaning = "ICC file of the printer that the TIFF is converted to: RGB, or CMYK of a press; without it `colours`.",
            .text = TextKind::file},
           {.name = "colours",
            .field = AT(output.colours),
            .meaning = "Colour space of the TIFF where there is no `profile`.",
            .text = TextKind::choice,
            .choices = color_space_names()},
           {.name = "intent",
            .field = AT(output.intent),
            .meaning = "How colours that profile or space does not have are brought into it.",
            .text = TextKind::choice,
            .choices = rendering_intent_names()},
           {.name = "black_point",
            .field = AT(output.black_point),
            .meaning = "Whether the picture's black becomes the darkest that profile or space has (black point compensation)."},
           {.name = "ink_limit",
            .field = AT(output.ink_limit),
            .range = {0, 400},
            .unit = "%",
            .meaning = "Sum of inks above which pixels are counted and told; 0: what the press profile's own tables reach."},
           {.name = "ocio_config",
            .field = AT(output.ocio_config),
            .meaning = "OpenColorIO config to use instead of the program's own.",
            .text = TextKind::file},
       }});
  return sections;
}

}  // namespace belvedere
