#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>

namespace belvedere {

// One colour that facets of rock take: a factor on the palette's ramp, and the cumulative share of
// the facets.
struct RockHue {
  glm::vec3 factor;
  float up_to;  // 0…1, rising; the last is 1
};

// Structure and colours of a kind of rock. Lengths in mm of the sheet; they grow on near walls and
// shrink on far ones. A new kind is a row in rock_kinds.cpp, its name in the scene's list of
// choices, and a line in docs/rock.md.
struct RockKind {
  std::string_view name;     // as written in scenes
  std::string_view meaning;  // for docs
  float size;                // factor on the sizes of spurs, .5…2
  float slender;             // factor on lengths down the wall: small is slender, .3…1
  float feather;             // how far small spurs turn towards the flanks of large ones, 0…1
  std::array<float, 3>
      tilt;       // how far the flanks of the three sizes of spurs turn from the wall, 0…1
  float beds;     // how clearly beds are drawn, 0…2
  float bed_mm;   // apparent thickness of a bed
  float through;  // share of beds that continue through whole walls instead of from gully to gully,
                  // 0…1
  float tread;    // how far the treads of beds turn up to the sky, 0…1
  float diagonals;  // ramps and chimneys that cross a wall, 0…2
  float cones;      // debris below gullies, 0…2
  std::array<RockHue, 6> hues;
};

std::span<const RockKind> rock_kinds();
// Finds a kind by name; Error(input) for one that is not in the table.
const RockKind& find_rock_kind(std::string_view name);

// The colour factor of a facet on the ramp. Connected facets (upper half of the number) share a
// tendency. In the shade, where only warm and cool separate planes, blue alternates with violet:
// `shade` 0…1.
glm::vec3 rock_hue(const RockKind& kind, std::uint32_t facet, float shade);

}  // namespace belvedere
