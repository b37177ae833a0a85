#pragma once

#include <cstdint>

#include "base/grid.h"
#include "terrain/synthetic/synthetic_drainage.h"

// River erosion of synthetic terrain. All functions give the same bits for any number of threads.
namespace belvedere::synthetic {

struct ErosionParameters {
  double cell_m = 30.0;
  double unit_m = 1.0;  // horizontal scale of the landscape: 1 in nature, less for small maps
  float hillslope_km2 = 0.7F;  // below this catchment slopes no longer steepen
  float step = 1.F;            // length of the time step
  float steepest = 1.2F;       // maximum slope along the flow path, tan
};

// Values needed together in the order of the drainage are stored together.
struct ErosionCell {
  float altitude_m;  // new; infinity if not known yet
  float risen_m;
  float incision;
  float limit_m;  // maximum rise, metres per cell
  std::int32_t receiver;
};

// One time step of uplift and stream-power incision, dz/dt = U - K A^0.6 S, implicit in the slope
// (Braun & Willett 2013), with a limit of slope. At a catchment of 1 km² an incision wave travels
// 240 m per step where softness is 1. `memory`: scratch memory reused from step to step; its values
// are ignored.
void erode(Grid<float>& altitude_m, const Drainage& drainage, const Grid<float>& catchment_km2,
           const Grid<float>& uplift_m, const Grid<float>& softness,
           const ErosionParameters& parameters, Grid<ErosionCell>& memory);

// Hillslope creep: z += rate · mean difference to the eight neighbours, isotropic; outlets and the
// border are fixed.
void creep(Grid<float>& altitude_m, float rate);

}  // namespace belvedere::synthetic
