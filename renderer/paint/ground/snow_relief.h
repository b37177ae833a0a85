#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <vector>

namespace belvedere {

// How snow lies at a place: wind gives it swells and drifts that no DEM of 30 m holds.
struct SnowForm {
  glm::vec2 slope{0.0F};  // what they add to the ground's rise to the east and to the north, m a metre
  float height = 0.0F;    // of the large swells: about -1.5 in a hollow … 1 on a crest
};

// Swells and drifts of a picture's snow, about as large on the sheet at every distance, and yet lying on the ground. Each is the lower of
// two smooth forms, one drawn out across the wind: so flanks are broad planes and crests are sharp. Drifts gather in the hollows of swells,
// and some places lie calm. A pure function of seed, wind and place; it remembers lattice values, so it is not to be shared between
// threads.
class SnowRelief {
 public:
  // `wind`: the way it blows, unit, to the east and to the north.
  SnowRelief(std::uint64_t seed, glm::dvec2 wind);
  ~SnowRelief();
  SnowRelief(const SnowRelief&) = delete;
  SnowRelief& operator=(const SnowRelief&) = delete;

  // `metres_per_unit`: ground that a unit of the sheet (0.5 mm) shows, > 0; `pixels_per_unit`: what would be but a pixel is left out.
  SnowForm at(glm::dvec2 place_m, double metres_per_unit, double pixels_per_unit);

 private:
  class Field;
  struct Layer;
  static constexpr int octaves = 40;
  struct Sample {
    glm::vec2 slope;
    float height;
  };
  Sample layer_at(int size, int power, glm::dvec2 place_m);
  Sample size_at(int size, glm::dvec2 place_m, double metres_per_unit);

  std::uint64_t seed_;
  glm::dvec2 wind_;
  std::array<std::vector<std::unique_ptr<Layer>>, 3> layers_;
};

}  // namespace belvedere
