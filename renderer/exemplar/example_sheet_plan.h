#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/pixel_rect.h"
#include "renderer/scene/scene_file.h"

namespace belvedere {

// The content of an example sheet: panels side by side, each a small view of its own. One file with
// `scene`, the scene that all panels share, and for each panel its different settings.
// docs/exemplars.md describes the file.
struct ExampleSheetPanel {
  std::string name;
  std::vector<std::string> settings;       // key.path=value, as for --set
  std::vector<std::string> snow_settings;  // additional settings where the palette is one of winter
};
struct ExampleSheetPlan {
  static constexpr std::uint64_t largest_seed =
      (std::uint64_t{1} << 53) - 1;  // exact in every reader of numbers
  int width = 4096;                  // px
  int height = 4096;
  double dots_per_inch = 50.8;     // strokes are sized in mm: 50.8 is two pixels per millimetre
  std::string palette = "summer";  // built-in name or file
  std::uint64_t seed = 7;          // of terrains and strokes; at most largest_seed
  double light_from_deg = -125.0;  // the sun's azimuth, clockwise from each panel's view direction:
                                   // the same side in all of them
  int columns = 4;
  std::string scene;                      // TOML
  std::vector<ExampleSheetPanel> panels;  // row by row
};

// The built-in example sheet (data/sheet/).
ExampleSheetPlan built_in_example_sheet_plan();
// Parses a plan strictly: Error(usage) with position for unknown keys, a panel that names no
// terrain or view of the file, incomplete rows.
ExampleSheetPlan parse_example_sheet_plan(std::string_view text, const std::string& name);
ExampleSheetPlan read_example_sheet_plan(const std::string& path);
// The text of a plan, which reads back as the same plan.
std::string write_example_sheet_plan(const ExampleSheetPlan& plan);

// The rectangle of a panel's picture, surrounded by a margin of bare paper. Rows of panels begin at
// multiples of 64 pixels if the example sheet is large enough, so that files can be written row by
// row.
PixelRect panel_cell(const ExampleSheetPlan& plan, int panel);  // with its margin
PixelRect panel_rect(const ExampleSheetPlan& plan, int panel);
// The scene of a panel. winter: of the palette. Error(usage) that names the panel for a bad
// setting.
LoadedScene panel_scene(const ExampleSheetPlan& plan, int panel, bool winter);

}  // namespace belvedere
