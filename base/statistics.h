#pragma once

#include <vector>

namespace belvedere {

// The middle one of the values in order; of an even number the mean of the two in the middle. Of none: 0.
double median(std::vector<double> values);

// The value below which `share` (0…1) of the others lie, at the nearest rank. Of none: 0.
double percentile(std::vector<double> values, double share);

}  // namespace belvedere
