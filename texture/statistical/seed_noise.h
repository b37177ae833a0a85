#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>

#include "base/grid.h"
#include "texture/statistical/clique_model.h"

namespace belvedere {

// Where on an endless texture a picture lies: its upper left pixel, of level 0 (then a multiple of 2^levels) unless another is named.
struct TexturePlace {
  int x = 0;
  int y = 0;
};

// The direction of strokes at a place of the texture (pixels of level 0), as a unit vector; the zero vector: none, so no streak.
using DirectionField = std::function<glm::vec2(double x, double y)>;

// The field of a model's own strokes, where nothing else says how they run: its direction, bent by smooth noise as far as they spread.
DirectionField own_directions(const CliqueModel& model, std::uint64_t seed);

// What a texture's noise is made of.
struct SeedNoise {
  TextureSeed kind = TextureSeed::white;
  float px = 0.F;              // half length of streaks, radius of discs, at level 0
  DirectionField direction{};  // of streaks; empty: level ones
  std::uint64_t seed = 1;
};

// Noise of one band at one level, 0…1: white and even; or its mean along streaks, widened again to the spread of white noise; or, under
// discs that lie upon each other like fallen leaves, one value a disc. A function of place, level, band and seed alone, so that windows of
// one texture agree.
Grid<float> seed_noise(const SeedNoise& noise, TexturePlace place, int width, int height, int level, int band);

}  // namespace belvedere
