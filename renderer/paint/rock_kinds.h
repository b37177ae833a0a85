#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>

namespace belvedere {

// One colour that facets of rock take: a factor on the palette's ramp, and up to which share of the facets.
struct RockHue {
  glm::vec3 factor;
  float up_to;  // 0…1, rising; the last is 1
};

// How a kind of rock stands and looks. Lengths in mm of the sheet, as painters think of them; they grow on near walls and shrink on far
// ones. A new kind is a row in rock_kinds.cpp, its name among what scenes may choose, and a line in docs/rock.md.
struct RockKind {
  std::string_view name;      // as written in scenes
  std::string_view meaning;   // for docs
  float size;                 // factor on the sizes of spurs, .5…2
  float slender;              // lengths down the wall count this much: small is slender, .3…1
  float feather;              // how far small spurs turn down the flanks of large ones, 0…1
  std::array<float, 3> tilt;  // how far the flanks of the three sizes of spurs turn away from the wall, 0…1
  float beds;                 // how plainly beds are drawn, 0…2
  float bed_mm;               // thickness of a bed as it is seen
  float through;              // share of beds that run through whole walls rather than from gully to gully, 0…1
  float tread;                // how far treads of beds turn up to the sky, 0…1
  float diagonals;            // ramps and chimneys that cross a wall, 0…2
  float cones;                // debris beneath gullies, 0…2
  std::array<RockHue, 6> hues;
};

std::span<const RockKind> rock_kinds();
// Of a name; Error(input) for one that is not in the table.
const RockKind& find_rock_kind(std::string_view name);

// The colour that a facet takes, a factor on the ramp. Facets that hang together (upper half of the number) lean to one colour. In the
// shade, where warm and cool are all that tells planes apart, blue stands against violet: `shade` 0…1.
glm::vec3 rock_hue(const RockKind& kind, std::uint32_t facet, float shade);

}  // namespace belvedere
