#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace belvedere {

// A part of the map with its own light: a circle, or the area that an odd number of rings encloses.
struct LightRegion {
  glm::dvec2 centre{0.0};  // of the circle, scene CRS
  double radius_m = 0.0;   // of the circle, where there are no rings
  std::vector<std::vector<glm::dvec2>> rings =
      {};                   // scene CRS, each of 3 positions or more without the closing one
  double blend_m = 2000.0;  // width of the fade outside, 0…1e6
  glm::dvec3 sun_direction{0.0, 0.0, 1.0};  // unit, towards its sun; z > 0
  double strength = 1.0;                    // of its sunlight, relative to the picture's, 0…2
  double warmth = 0.0;                      // of its sunlight, -1 cool … 1 warm
};

// The shadow of a cloud that is not drawn itself: soft at its edge, with a shape from noise.
struct CloudShadow {
  glm::dvec2 centre{0.0};    // scene CRS
  double radius_m = 1000.0;  // of the centre of its soft edge, about
  double strength = 0.7;     // share of the sunlight that it removes, 0…1
  double blend_m = 1000.0;   // width of its soft edge, 0…1e6
};

// The sunlight at a ground position.
struct GroundLight {
  glm::dvec3 sun{0.0, 0.0, 1.0};  // unit, towards it
  float strength = 1.0F;          // relative to the picture's sunlight, 0…2
  float warmth = 0.0F;            // -1 cool … 1 warm
  float side = 1.0F;              // direction in the picture: -1 from the left … 1 from the right
};

// Light that varies with position, as painters turn it for a range that would be in shade. Made
// once per picture; a pure function of the position, so any pixel of any part can use it. Regions
// blend in their order, a later one over earlier ones: directions as weighted sums of unit vectors,
// normalized; the rest linearly.
class LightField {
 public:
  // `right`: unit, to the right of the picture, on the map. Throws Error(usage) where a sun is not
  // above the horizon.
  LightField(glm::dvec3 sun_direction, glm::dvec2 right, std::vector<LightRegion> regions,
             std::vector<CloudShadow> clouds, std::uint64_t seed);

  GroundLight at(glm::dvec2 position_m) const;
  // Weight of a region's light at a position: 1 inside, falling to 0 over blend_m outside.
  static double weight(const LightRegion& region, glm::dvec2 position_m);
  // Whether any position has another sun direction than the picture.
  bool turns_sun() const { return !regions_.empty(); }

 private:
  struct Box {
    glm::dvec2 low, high;
    bool has(glm::dvec2 p) const {
      return p.x >= low.x && p.y >= low.y && p.x <= high.x && p.y <= high.y;
    }
  };
  double cloud_share(const CloudShadow& cloud, glm::dvec2 position_m) const;

  GroundLight picture_;
  glm::dvec2 right_;
  std::vector<LightRegion> regions_;
  std::vector<CloudShadow> clouds_;
  std::vector<Box> region_boxes_, cloud_boxes_;  // without effect outside them
  std::vector<float> sides_;                     // of the regions
  std::uint64_t seed_;
};

// Radius of the sun's disc in pictures: painters' shadows have softer edges than those of the true
// sun, whose radius is 0.27°.
inline constexpr double painted_sun_radius_deg = 1.72;

struct SunPosition {
  double azimuth_deg = 0.0;   // 0…360, clockwise from north
  double altitude_deg = 0.0;  // -90…90, above the horizon, of the sun's centre, seen from the
                              // ground, without refraction
};

// PSA algorithm (Blanco-Muriel et al. 2001, coefficients of 2020): within .01° of the IAU's
// standards in 2020–2050, .02° in 1900–2100. UTC. Longitude -180…180, east positive; latitude
// -90…90. time: ISO 8601, date and time to the minute or second (a decimal fraction may follow),
// and a zone: "2024-07-15T09:30:00Z", "2024-07-15T11:30+02:00". Error(usage) for anything else, for
// years outside 1900–2100, or for coordinates out of range.
SunPosition sun_position(double longitude_deg, double latitude_deg, const std::string& time);
// Unit vector towards the sun, x east, y north, z up.
glm::dvec3 sun_direction(const SunPosition& sun);

}  // namespace belvedere
