#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "terrain/cover/map_cover.h"

namespace belvedere {

// Rivers as they are drawn, with two banks that move by themselves: the inner bank of a bend comes
// forward, where gravel lies, and the outer one is cut, so that bends are narrower than straight
// reaches; both are broken by noise. The mean width of these stays, so that a map still reads a
// river as one line. Sources are narrow. A tributary turns
// downstream before it enters a wider river. A pure function of lines, widths and seed; ends that
// join nothing stay where they are. `winding`: deviation in half widths, 0…2, by which a course
// winds besides, so that none drawn from cells is straight over more than 20 widths.
std::vector<CoverRiver> with_banks(std::vector<CoverRiver> rivers, std::uint64_t seed,
                                   double winding = 0.0);

// Noise of deviation 1, blurred by about sigma_m: octaves fixed to the map, mixed, so that a river
// whose width changes, or of which a window knows a part, does not slide along it. `part`: > 7,
// those of banks and shores.
double bank_noise(std::uint64_t seed, std::uint64_t part, glm::dvec2 at, double sigma_m);

}  // namespace belvedere
