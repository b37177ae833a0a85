#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "renderer/paint/picture_noise.h"

namespace belvedere {

// How the surface of a sea of fog heaps: rounded heaps with creases between, in sizes that a painter would give them, some 12 to 70 units
// of the sheet at every distance, and yet fixed to the ground: octaves of noise come and go with how many metres a unit shows.
// Remembers lattice values: one for each thread.
class MistBillows {
 public:
  // strength 0…3; highest_m: what heaps are never much higher than, > 0.
  MistBillows(std::uint64_t seed, double strength, double highest_m);
  // Height over the smooth surface, m, about 0 on the mean, within ± reach_m(). metres_per_unit: of the ground in .5 mm of the sheet, > 0.
  double height_m(glm::dvec2 place, double metres_per_unit);
  // What no heap or hollow goes beyond, m.
  double reach_m() const { return reach_m_; }
  bool flat() const { return strength_ <= 0.0; }
  // Length of the heaps that weigh most, m.
  static double length_m(double metres_per_unit);

 private:
  double patches(glm::dvec2 place, double octave);

  double strength_;
  double highest_m_;
  double reach_m_;
  std::vector<GroundNoise> octaves_;
};

}  // namespace belvedere
