#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace belvedere {

// What grows on a field. Grass first: most of a valley in the mountains is green.
enum class Crop : std::uint8_t { hay, grass, clover, aftermath, ripe, stubble, ploughed };
inline constexpr std::size_t crop_count = 7;

// The fields of a valley floor, a pure function of seed and place, so that the base picture colours the same fields that the painter
// hedges. Blocks some seven fields wide, each with its own direction and way of being parted: strips, large fields, or one undivided
// meadow.
struct Parcel {
  Crop crop = Crop::hay;  // the same all over the parcel
  float shade = 0.0F;     // -1…1, darker or lighter than others of its crop, the same all over the parcel
  float border_m = 0.0F;  // distance to the nearest border of the parcel, m, ≥ 0; far from any in an undivided block
  float width_m = 0.0F;   // of the narrow side of a usual field
  float lane_m = 0.0F;    // distance to the border of the block, m, ≥ 0: where lanes run
  bool hedged = false;    // whether trees and bushes grow along its borders
};

// `metres_per_unit` is what a unit of the sheet (0.5 mm) shows: far away parcels double in size, as a painter would rather draw few than
// dots. 0: as on the ground, 90 m wide. `grain` is GuidanceBuffers::grain there; fields run along it or across, any way where it is 0.
Parcel parcel_at(std::uint64_t seed, double east_m, double north_m, float metres_per_unit, glm::vec2 grain = glm::vec2(0.F));

// Factor of a crop on the colour of the valley floor, encoded sRGB.
glm::vec3 crop_colour(Crop crop);
// The mean over the crops as they are sown: what fields too small to tell apart melt into.
glm::vec3 mean_crop_colour();

}  // namespace belvedere
