#pragma once

#include <string>

#include "renderer/paint/air_parameters.h"

namespace belvedere {

// What a scene does not say and its view has all the same: as one could write it.
struct DerivedValue {
  std::string key;  // dotted
  std::string value;
  std::string why;
};

// Between which distances generalization goes over from the foreground's to the background's.
struct GeneralizeDistances {
  double foreground_to_m = 32000.0;
  double background_from_m = 90000.0;
};

// What goes by the distance of a view's horizon.
struct ViewDistances {
  AirParameters air;
  GeneralizeDistances generalize;
};

}  // namespace belvedere
