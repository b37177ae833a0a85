#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace belvedere {

// Crops of a field. Grass comes first: most of a mountain valley is green.
enum class Crop : std::uint8_t { hay, grass, clover, aftermath, ripe, stubble, ploughed };
inline constexpr std::size_t crop_count = 7;

// The fields of a valley floor, a pure function of seed and position, so that the base picture and
// the strokes show the same fields. Blocks about seven fields wide, each with its own direction and
// division: strips, large fields, or one undivided meadow.
struct Parcel {
  Crop crop = Crop::hay;  // constant within a parcel
  float shade = 0.0F;  // -1…1, darker or lighter than others of its crop, constant within a parcel
  float border_m = 0.0F;  // distance to the nearest border of the parcel, m, ≥ 0; large in
                          // an undivided block
  float width_m = 0.0F;   // of the narrow side of a typical field
  float lane_m = 0.0F;    // distance to the border of the block, m, ≥ 0: lanes run there
  bool hedged = false;    // trees and bushes along its borders
};

// `metres_per_unit`: metres of ground in a unit of the sheet (0.5 mm). Parcels double in size with
// distance, as a painter would rather draw a few than dots. 0: true size, 90 m wide. `grain` is
// GuidanceBuffers::grain there; fields run along it or across, in any direction where it is 0.
Parcel parcel_at(std::uint64_t seed, double east_m, double north_m, float metres_per_unit,
                 glm::vec2 grain = glm::vec2(0.F));

// 1 where villages are drawn house by house, so that they need quiet colours: from 1 to 14 m of
// ground in a unit of the sheet; 0 below .5 and above 20.
float village_share(float metres_per_unit);

// Colour factor of a crop on the valley floor, encoded sRGB.
glm::vec3 crop_colour(Crop crop);
// The mean over the crops in their proportions: the colour of fields too small to distinguish.
glm::vec3 mean_crop_colour();

}  // namespace belvedere
