#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/land_cover_class.h"

namespace belvedere {

struct ConfigValue;

// The tones whose colours a ramp holds; between them colour is interpolated linearly in encoded
// sRGB.
inline constexpr std::array<double, 4> ramp_tones = {0.0, 0.34, 0.66, 1.0};

// Colours of a class at ramp_tones, encoded sRGB 0…1.
using ToneRamp = std::array<glm::vec3, 4>;

// Ramps of a class by altitude: linear between the given altitudes, constant beyond them.
struct ClassPalette {
  struct Stop {
    double altitude_m;
    ToneRamp ramp;
  };
  std::vector<Stop> stops;  // by rising altitude, at least one (but none for sky)
};

// Colours of vegetation in addition to the ramps: one class holds trees of several colours.
struct GrowthColours {
  std::vector<glm::vec3> leaves;  // of leafy trees in full light, encoded sRGB: groups of trees
                                  // take one each; in winter their bare twigs
  double leaf_share = 0.0;        // how far leafy trees take these colours, 0…1
  glm::vec3 larch{0.0F};     // of larches in full light, which stand open below the treeline; in
                             // winter their bare twigs
  double larch_share = 0.0;  // how far larches take this colour, 0…1; 0: no larches
};

// Palettes are designed for the northern Alps, whose forest ends here.
inline constexpr double palette_treeline_m = 1820.0;

struct Palette {
  std::string name;
  bool winter = false;
  double treeline_m =
      palette_treeline_m;  // treeline of the region that the palette's altitudes are for
  // In winter lakes from this altitude up are frozen, m. Not a palette key: the scene's climate
  // sets it.
  double lakes_freeze_from_m = std::numeric_limits<double>::infinity();
  std::array<ClassPalette, land_cover_class_count> classes;  // [sky] unused
  std::vector<std::pair<double, glm::vec3>> sky;             // 0 top … 1 horizon, encoded sRGB
  glm::vec3 cloud_light{1.0F};
  glm::vec3 cloud_shade{0.7F};
  glm::vec3 haze_near{0.56F, 0.66F, 0.79F};   // where haze begins
  glm::vec3 haze_far{0.73F, 0.80F, 0.89F};    // far away
  glm::vec3 range_mist{0.79F, 0.84F, 0.90F};  // between ranges
  GrowthColours growth;
  // Factors on AirParameters, 0…2: snow takes less drift of hue than grass, winter air is clearer.
  double haze_share = 1.0;
  double warm_share = 1.0;
  double ground_drift_share = 1.0;
  double forest_drift_share = 1.0;
  double rock_drift_share = 1.0;
};

// Built-in name ("summer", "winter"; data/palettes/*.toml) or a .toml file; Error(usage) with
// file:line:column.
Palette read_palette(const std::string& name_or_path);
// The same from a text; `name` is used in messages.
Palette parse_palette(std::string_view text, const std::string& name);
// The same from the root table of a text that is parsed already, as of a style, whose file reads
// like a palette and more: keys that are none of a palette's must have been taken out.
Palette parse_palette(const ConfigValue& root, const std::string& name);
// The root's keys of a palette.
const std::vector<std::string>& palette_keys();
// Encoded sRGB of a class at an altitude and tone (tone clamped to 0…1). Not for sky.
glm::vec3 palette_colour(const Palette& palette, LandCoverClass id, double altitude_m, double tone);

}  // namespace belvedere
