#pragma once

#include <cstdint>

#include "renderer/base/grid.h"

namespace belvedere {

// Catchment area of every cell, km²: priority flood from the rim (Barnes, Lehman & Mulla 2014), so that every cell drains.
Grid<float> flow_accumulation_km2(const Grid<float>& altitude_m, double cell_m);

struct LakeParameters {
  float max_range_m = 0.25F;  // a lake's 3×3 neighbourhood differs by less
  int min_cells = 150;
};
// 1 where water stands: flat (range), opened twice, large enough.
Grid<std::uint8_t> find_lakes(const Grid<float>& altitude_m, const LakeParameters& parameters);

// Distance-based river mask, 0…1 soft: catchments over 110 km² are ±30 m wide, over 500 km² ±60 m.
Grid<float> river_mask(const Grid<float>& catchment_km2, double cell_m);

}  // namespace belvedere
