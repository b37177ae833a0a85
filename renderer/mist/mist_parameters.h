#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>

namespace belvedere {

enum class MistKind : std::uint8_t {
  sea,     // everything up to an altitude: summits stand out of it as islands
  valley,  // a thin layer on the floors of valleys, in banks
  lee      // a cloud that hangs on a summit, drawn out by the wind
};

// One mist of a picture. Altitudes and heights are those of the true ground, before it is raised and bent: mist follows the ground.
struct MistParameters {
  MistKind kind = MistKind::sea;
  double to_m = 1500.0;             // of a sea: altitude of its surface
  double height_m = 160.0;          // in valleys: above their floor; > 0
  double sight_m = 450.0;           // how far one sees in it (a contrast of .02 is left): > 0
  double edge_m = 170.0;            // over this height below its surface it grows dense, 0…1000
  double billows = 1.0;             // how high its surface heaps, 0…3
  double patches = 0.0;             // how torn it is, 0 closed … 1 a few banks
  std::optional<glm::dvec2> place;  // scene CRS: middle of what is misty, or the summit
  double radius_m = 0.0;            // around that place; 0: no end
  double size_m = 3000.0;           // of a lee cloud: how long it is, > 0
  double wind_from_deg = 270.0;     // of a lee cloud: clockwise from north
};

}  // namespace belvedere
