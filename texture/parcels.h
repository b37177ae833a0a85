#pragma once

#include <cstdint>

namespace belvedere {

// The fields of a valley floor: strips in bent rows, a pure function of seed and place, so that the base picture colours the same fields
// that the painter hedges.
struct Parcel {
  float crop = 0.0F;      // -.5 fresh meadow … +.5 ripe corn, the same all over the parcel
  float border_m = 0.0F;  // distance to the nearest border of the parcel, m, ≥ 0
  float width_m = 0.0F;   // of its narrow side
  bool hedged = false;    // whether trees and bushes grow along its borders
};

// `metres_per_unit` is what a unit of the sheet (0.5 mm) shows: far away parcels double in size, as a painter would rather draw few than
// dots. 0: as on the ground, 90 m wide.
Parcel parcel_at(std::uint64_t seed, double east_m, double north_m, float metres_per_unit);

}  // namespace belvedere
