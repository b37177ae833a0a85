#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace belvedere {

// A part of the map that has a light of its own: a circle, or what an odd number of rings encloses.
struct LightRegion {
  glm::dvec2 center{0.0};                           // of the circle, scene CRS
  double radius_m = 0.0;                            // of the circle, where there are no rings
  std::vector<std::vector<glm::dvec2>> rings = {};  // scene CRS, each of 3 places and more without the closing one
  double blend_m = 2000.0;                          // its light fades to nothing over so much ground outside, 0…1e6
  glm::dvec3 sun_direction{0.0, 0.0, 1.0};          // unit, towards its sun; z > 0
  double strength = 1.0;                            // of its sunlight, of the picture's, 0…2
  double warmth = 0.0;                              // of its sunlight, -1 cool … 1 warm
};

// The shadow that a cloud nobody sees throws on the ground: soft at its edge, of a shape that noise gives it.
struct CloudShadow {
  glm::dvec2 center{0.0};    // scene CRS
  double radius_m = 1000.0;  // of its middle edge, about
  double strength = 0.7;     // share of the sunlight that it takes, 0…1
  double blend_m = 1000.0;   // width of its soft edge, 0…1e6
};

// The sunlight at a place of the ground.
struct GroundLight {
  glm::dvec3 sun{0.0, 0.0, 1.0};  // unit, towards it
  float strength = 1.0F;          // of the picture's sunlight, 0…2
  float warmth = 0.0F;            // -1 cool … 1 warm
  float side = 1.0F;              // where it comes from in the picture: -1 left … 1 right
};

// Light that differs from place to place, as painters turn it to a range that would stand in shade. Made once for a picture; a value of the
// place alone, so any pixel of any part may ask. Regions blend in their order, a later one over those before it: directions as unit vectors
// weighed, summed and brought to unit length, the rest in proportion.
class LightField {
 public:
  // `right`: unit, to the right of the picture, on the map. Throws Error(usage) where a sun does not stand above the horizon.
  LightField(glm::dvec3 sun_direction, glm::dvec2 right, std::vector<LightRegion> regions, std::vector<CloudShadow> clouds,
             std::uint64_t seed);

  GroundLight at(glm::dvec2 place_m) const;
  // Share of a region's light at a place: 1 inside, falling to 0 over blend_m outside.
  static double weight(const LightRegion& region, glm::dvec2 place_m);
  // Whether any place has another sun than the picture.
  bool turns_sun() const { return !regions_.empty(); }

 private:
  struct Box {
    glm::dvec2 low, high;
    bool has(glm::dvec2 p) const { return p.x >= low.x && p.y >= low.y && p.x <= high.x && p.y <= high.y; }
  };
  double cloud_share(const CloudShadow& cloud, glm::dvec2 place_m) const;

  GroundLight picture_;
  glm::dvec2 right_;
  std::vector<LightRegion> regions_;
  std::vector<CloudShadow> clouds_;
  std::vector<Box> region_boxes_, cloud_boxes_;  // beyond which they do nothing
  std::vector<float> sides_;                     // of the regions
  std::uint64_t seed_;
};

}  // namespace belvedere
