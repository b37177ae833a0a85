#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>

#include "base/grid.h"
#include "texture/statistical/clique_model.h"

namespace belvedere {

// Position of a picture on an unbounded texture: its upper left pixel, of level 0 (then a multiple
// of 2^levels) unless another is stated.
struct TexturePosition {
  int x = 0;
  int y = 0;
};

// The direction of strokes at a position of the texture (pixels of level 0), as a unit vector;
// zero: no streak.
using DirectionField = std::function<glm::vec2(double x, double y)>;

// The field of a model's own strokes, used if no other direction is given: its direction, bent by
// smooth noise according to their spread.
DirectionField own_directions(const CliqueModel& model, std::uint64_t seed);

// Parameters of a texture's noise.
struct SeedNoise {
  TextureSeed kind = TextureSeed::white;
  float px = 0.F;              // half length of streaks, radius of discs, at level 0
  DirectionField direction{};  // of streaks; empty: horizontal
  std::uint64_t seed = 1;
};

// Noise of one band at one level, 0…1: white and uniform; or its mean along streaks, stretched
// again to the deviation of white noise; or one value per disc, for discs that overlap like fallen
// leaves. A function of position, level, band and seed alone, so that windows of one texture match.
Grid<float> seed_noise(const SeedNoise& noise, TexturePosition position, int width, int height,
                       int level, int band);

}  // namespace belvedere
