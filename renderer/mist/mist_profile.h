#pragma once

namespace belvedere {

// Density of mist below its surface: 0 above, rising over `edge_m` to full density.
struct MistProfile {
  double full_per_m;  // extinction
  double edge_m;      // ≥ 0
};
// Extinction from `visibility_m`: a contrast of .02 remains (the visual range of Koschmieder 1924),
// so extinction is ln 50 / visibility_m.
MistProfile make_mist_profile(double visibility_m, double edge_m);
double extinction_at(const MistProfile& profile, double below_m);
// Optical depth of a straight path of length_m whose depth below the surface changes linearly from
// one end to the other: exact.
double optical_depth(const MistProfile& profile, double length_m, double below_from_m,
                     double below_to_m);

}  // namespace belvedere
