#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "renderer/base/land_cover_class.h"

namespace belvedere {

// Colours of a class at tone 0, .34, .66 and 1, encoded sRGB, interpolated there (look/recipe.md, Palettes).
using ToneRamp = std::array<glm::vec3, 4>;

// A class's ramps by altitude: each holds at its altitude, between them it blends linearly.
struct ClassPalette {
  struct Stop {
    double altitude_m;
    ToneRamp ramp;
  };
  std::vector<Stop> stops;  // by rising altitude, at least one
};

struct Palette {
  std::string name;
  bool winter = false;
  std::array<ClassPalette, land_cover_class_count> classes;  // [sky] unused
  std::vector<std::pair<double, glm::vec3>> sky;             // 0 top … 1 horizon, encoded sRGB
  glm::vec3 cloud_light{1.0F};
  glm::vec3 cloud_shade{0.7F};
  glm::vec3 haze_near{0.56F, 0.66F, 0.79F};                  // at 30 km
  glm::vec3 haze_far{0.73F, 0.80F, 0.89F};                   // at 100 km
  glm::vec3 range_mist{0.79F, 0.84F, 0.90F};                 // between ranges
};

// Built-in name ("summer", "winter"; data/palettes/*.toml) or a .toml file; Error(usage) with file:line:column.
Palette read_palette(const std::string& name_or_path);
// Encoded sRGB of a class at an altitude and tone (tone clamped to 0…1).
glm::vec3 palette_colour(const Palette& palette, LandCoverClass id, double altitude_m, double tone);

}  // namespace belvedere
