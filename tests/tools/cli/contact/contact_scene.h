#pragma once

namespace belvedere::test {

// A scene that renders in a second, for tests of sheets of pictures; tests append what they need.
constexpr const char* contact_scene = R"(
version = 1
[terrain.synthetic]
width = 120
height = 100
cell_m = 90
seed = 3
[camera]
position = [5000, -6000]
height_m = 6000
pitch_deg = -24
[sampling]
pixel_samples = 1
shadow_rays = 1
sky_directions = 4
[output]
width = 120
height = 64
sheet_width_mm = 60
)";

}  // namespace belvedere::test
