#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>

namespace belvedere {

enum class MistKind : std::uint8_t {
  sea,     // everything up to an altitude: summits rise from it as islands
  valley,  // a thin layer on the floors of valleys, in banks
  lee      // a cloud attached to a summit, drawn out by the wind
};

// One mist of a picture. Altitudes and heights are those of the undeformed ground, before
// exaggeration and bending: mist follows the ground.
struct MistParameters {
  MistKind kind = MistKind::sea;
  double to_m = 1500.0;         // of a sea: altitude of its surface
  double height_m = 160.0;      // in valleys: above their floor; > 0
  double visibility_m = 450.0;  // visibility in it (remaining contrast .02): > 0
  double edge_m = 170.0;  // height below its surface over which it reaches full density, 0…1000
  double billows = 1.0;   // strength of the heaps of its surface, 0…3
  double patches = 0.0;   // gaps: 0 closed … 1 a few banks
  std::optional<glm::dvec2> position;  // scene CRS: centre of the misty area, or the summit
  double radius_m = 0.0;               // around that position; 0: unbounded
  double size_m = 3000.0;              // of a lee cloud: length, > 0
  double wind_from_deg = 270.0;        // of a lee cloud: clockwise from north
};

}  // namespace belvedere
