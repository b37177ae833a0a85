#pragma once

#include <glm/vec3.hpp>
#include <string>

namespace belvedere {

struct SunPosition {
  double azimuth_deg = 0.0;   // clockwise from north
  double altitude_deg = 0.0;  // above the horizon, without refraction
};

// PSA algorithm (Blanco-Muriel et al. 2001, updated coefficients 2020): valid 2020–2050 within .01°. UTC.
// time: ISO 8601 with zone, "2024-07-15T09:30:00Z" or "…+02:00". Error(usage) for anything else.
SunPosition sun_position(double longitude_deg, double latitude_deg, const std::string& time);
// Unit vector towards the sun, x east, y north, z up.
glm::dvec3 sun_direction(const SunPosition& sun);

}  // namespace belvedere
