#pragma once

#include <glm/vec3.hpp>
#include <string>

namespace belvedere {

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
