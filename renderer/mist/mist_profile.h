#pragma once

namespace belvedere {

// How dense mist is below its surface: nothing above, then ever denser over `edge_m`, then its full density.
struct MistProfile {
  double full_per_m;  // extinction
  double edge_m;      // ≥ 0
};
// What is left of light on `sight_m`: a contrast of .02 (the visual range of Koschmieder 1924), so extinction is ln 50 / sight.
MistProfile make_mist_profile(double sight_m, double edge_m);
double extinction_at(const MistProfile& profile, double below_m);
// Optical depth of a straight way of length_m whose depth below the surface changes evenly from one end to the other: exact.
double optical_depth(const MistProfile& profile, double length_m, double below_from_m, double below_to_m);

}  // namespace belvedere
