#pragma once

#include <string>
#include <vector>

#include "renderer/scene/scene_file.h"

// Scenes that several tests use.
namespace belvedere::test {

// A scene that is made in a second: hills of 12 × 12 km, seen from the south in 96 × 80 pixels of 1
// mm. What follows from the region is written: tests set such keys to see what they do.
constexpr const char* small_scene_text = R"(version = 1
[terrain.synthetic]
width = 120
height = 120
cell_m = 100
seed = 3
[camera]
position = [6000, -4000]
height_m = 6000
azimuth_deg = 0
pitch_deg = -22
[deform]
exaggeration = 1
[deform.bend]
radius_m = 0
[sun]
azimuth_deg = 315
altitude_deg = 30
[generalize]
foreground_to_m = 32000
background_from_m = 90000
[air]
from_m = 34000
scale_m = 62000
rim_fade_m = 4000
[sampling]
pixel_samples = 1
shadow_rays = 2
sky_directions = 4
[output]
width = 96
height = 80
sheet_width_mm = 96
)";

// Terrain and camera of the tests that run the program.
inline const std::string small_mountains =
    "[terrain.synthetic]\nwidth = 96\nheight = 96\ncell_m = 200\n"
    "[camera]\nposition = [9000, -9000]\nheight_m = 9000\npitch_deg = -25\n";

inline LoadedScene small_scene(const std::vector<std::string>& settings = {},
                               const std::string& folder = ".") {
  return parse_scene(small_scene_text, "small.toml", folder,
                     {.data_folders = {}, .settings = settings});
}

}  // namespace belvedere::test
