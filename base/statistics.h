#pragma once

#include <vector>

namespace belvedere {

// The median; the mean of the two middle values where their number is even; 0 without values.
double median(std::vector<double> values);

// The value below which `share` (0…1) of the values lie, at the nearest rank; 0 without values.
double percentile(std::vector<double> values, double share);

}  // namespace belvedere
