#include "terrain/shape/catchments.h"

#include <utility>

#include "terrain/shape/hydrology.h"

namespace belvedere {

const Grid<float>& Catchments::km2() {
  if (km2_.empty()) km2_ = flow_accumulation_km2(dem_.altitude_m, dem_.cell_m(), dem_.entries);
  return km2_;
}

Grid<float> Catchments::take_km2() {
  km2();
  return std::exchange(km2_, {});
}

}  // namespace belvedere
