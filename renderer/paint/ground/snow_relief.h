#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

namespace belvedere {

// The shape of snow at a position: wind forms swells and drifts that a 30 m DEM does not contain.
struct SnowForm {
  glm::vec2 slope{0.0F};  // added to the slope of the ground to the east and to the north, m per m
  float height = 0.0F;    // of the large swells: about -1.5 in a hollow … 1 on a crest
};

// Where the wind blows, unit, to the east and to the north: 35° aside of where the light goes, so
// that drifts lie across raking light.
glm::dvec2 snow_wind(glm::dvec3 sun_direction);

// Swells and drifts of a picture's snow, of about the same size on the sheet at every distance, yet
// fixed to the ground. Each is the lower of two smooth forms, one stretched across the wind; this
// gives broad flanks and sharp crests. Drifts gather in the hollows of swells, and some areas are
// calm. A pure function of seed, wind and position. It caches lattice values: do not share between
// threads.
class SnowRelief {
 public:
  // `wind`: the direction in which it blows, unit, to the east and to the north.
  SnowRelief(std::uint64_t seed, glm::dvec2 wind);
  ~SnowRelief();
  SnowRelief(const SnowRelief&) = delete;
  SnowRelief& operator=(const SnowRelief&) = delete;

  // `metres_per_unit`: ground in a unit of the sheet (0.5 mm), > 0; `pixels_per_unit`: forms of
  // about a pixel are left out.
  SnowForm at(glm::dvec2 position_m, double metres_per_unit, double pixels_per_unit);

 private:
  class Field;
  struct Layer;
  static constexpr int octaves = 40;
  struct Sample {
    glm::vec2 slope;
    float height;
  };
  Sample layer_at(int size, int power, glm::dvec2 position_m);
  Sample size_at(int size, glm::dvec2 position_m, double metres_per_unit);

  std::uint64_t seed_;
  glm::dvec2 wind_;
  std::array<std::vector<std::unique_ptr<Layer>>, 3> layers_;
};

}  // namespace belvedere
