#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "renderer/paint/picture_noise.h"

namespace belvedere {

// The heaped surface of a sea of fog: rounded heaps with creases between, in the sizes that a
// painter uses, some 12 to 70 units of the sheet at every distance, and yet fixed to the ground:
// octaves of noise fade in and out with the metres per unit. Caches lattice values: use one per
// thread.
class MistBillows {
 public:
  // strength 0…3; highest_m: approximate upper limit of the heaps, > 0.
  MistBillows(std::uint64_t seed, double strength, double highest_m);
  // Height over the smooth surface, m, about 0 on average, within ± reach_m(). metres_per_unit: of
  // the ground in 0.5 mm of the sheet, > 0.
  double height_m(glm::dvec2 position, double metres_per_unit);
  // Bound of heaps and hollows, m.
  double reach_m() const { return reach_m_; }
  bool flat() const { return strength_ <= 0.0; }
  // Length of the dominant heaps, m.
  static double length_m(double metres_per_unit);

 private:
  double patches(glm::dvec2 position, double octave);

  double strength_;
  double highest_m_;
  double reach_m_;
  std::vector<GroundNoise> octaves_;
};

}  // namespace belvedere
