#pragma once

#include <cstdint>

#include "base/grid.h"
#include "terrain/synthetic/synthetic_drainage.h"

// Rivers cut made-up terrain. All functions give the same bits for any number of threads.
namespace belvedere::synthetic {

struct ErosionParameters {
  double cell_m = 30.0;
  double unit_m = 1.0;         // horizontal scale of the landscape: 1 in nature, less for small maps
  float hillslope_km2 = 0.7F;  // at smaller catchments slopes no longer steepen
  float step = 1.F;            // length of the time step
  float steepest = 1.2F;       // greatest slope along the water's way, tan
};

// What the walk in the water's order asks of a cell lies together.
struct ErosionCell {
  float altitude_m;  // new; infinity where it is not known so far
  float risen_m;
  float incision;
  float limit_m;  // steepest rise, metres a cell
  std::int32_t receiver;
};

// One time step of uplift and stream-power incision, dz/dt = U - K A^0.6 S, implicit in the slope (Braun & Willett 2013), and a
// limit of slope. At a catchment of 1 km² a wave of incision travels 240 m a step where softness is 1.
// `memory`: scratch memory that is reused from step to step; its values do not matter.
void erode(Grid<float>& altitude_m, const Drainage& drainage, const Grid<float>& catchment_km2, const Grid<float>& uplift_m,
           const Grid<float>& softness, const ErosionParameters& parameters, Grid<ErosionCell>& memory);

// Hillslopes creep: z += rate · mean difference to the eight neighbours, isotropic; outlets and the rim stay.
void creep(Grid<float>& altitude_m, float rate);

}  // namespace belvedere::synthetic
