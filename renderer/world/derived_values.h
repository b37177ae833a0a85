#pragma once

#include <string>

#include "renderer/paint/air.h"

namespace belvedere {

// A value of a view that its scene leaves open, as it could be written.
struct DerivedValue {
  std::string key;  // dotted
  std::string value;
  std::string why;
};

// Distances between which generalization changes from the foreground's to the background's.
struct GeneralizeDistances {
  double foreground_to_m = 32000.0;
  double background_from_m = 90000.0;
};

// Values derived from the distance of a view's horizon.
struct ViewDistances {
  AirParameters air;
  GeneralizeDistances generalize;
};

}  // namespace belvedere
