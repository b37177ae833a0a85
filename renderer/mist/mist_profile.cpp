#include "renderer/mist/mist_profile.h"

#include <algorithm>
#include <cmath>

namespace belvedere {
namespace {

constexpr double log_50 = 3.912023005428146;

// Integral of the density from the surface down, in metres of full density.
double sum_below(const MistProfile& profile, double below_m) {
  if (below_m <= 0.0) return 0.0;
  if (below_m < profile.edge_m) return below_m * below_m / (2.0 * profile.edge_m);
  return below_m - 0.5 * profile.edge_m;
}

}  // namespace

MistProfile make_mist_profile(double visibility_m, double edge_m) {
  return {log_50 / visibility_m, edge_m};
}

double extinction_at(const MistProfile& profile, double below_m) {
  if (below_m <= 0.0) return 0.0;
  return profile.full_per_m * (below_m < profile.edge_m ? below_m / profile.edge_m : 1.0);
}

double optical_depth(const MistProfile& profile, double length_m, double below_from_m,
                     double below_to_m) {
  const double change = below_to_m - below_from_m;
  // For a level path the quotient would be of two small differences.
  if (std::abs(change) < 1e-3)
    return length_m * extinction_at(profile, 0.5 * (below_from_m + below_to_m));
  return length_m * profile.full_per_m *
         (sum_below(profile, below_to_m) - sum_below(profile, below_from_m)) / change;
}

}  // namespace belvedere
