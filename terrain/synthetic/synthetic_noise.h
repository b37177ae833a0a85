#pragma once

#include <cstdint>

// Noise for synthetic terrain; a pure function of seed and position, so it does not depend on grid,
// tiles or threads.
namespace belvedere::synthetic {

// Gradient noise (Perlin 2002) with one lattice point per unit, mean 0, about -1…1.
float gradient_noise(std::uint64_t seed, double x, double y);
// A sum of `octaves` of it, each with half the length and `gain` times the amplitude of the
// previous, divided by the sum of the amplitudes.
float fractal_noise(std::uint64_t seed, double x, double y, int octaves, float gain = 0.5F);
// Ridged multifractal (Musgrave 1998), 0…1: crests at 1, and more detail on crests than in hollows.
float ridged_noise(std::uint64_t seed, double x, double y, int octaves, float gain = 0.5F);

}  // namespace belvedere::synthetic
