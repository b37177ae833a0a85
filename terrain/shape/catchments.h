#pragma once

#include <utility>

#include "base/grid.h"
#include "terrain/io/dem.h"

namespace belvedere {

// What flows through each cell of a DEM, found when it is first asked for and kept: class rules and the terrain model both ask, and water
// finds its way on one thread. The DEM outlives it. For one thread at a time.
class Catchments {
 public:
  explicit Catchments(const Dem& dem) : dem_(dem) {}
  // Found before: km2().
  Catchments(const Dem& dem, Grid<float> km2) : dem_(dem), km2_(std::move(km2)) {}
  Catchments(const Catchments&) = delete;
  Catchments& operator=(const Catchments&) = delete;

  // flow_accumulation_km2() of the DEM with its entries.
  const Grid<float>& km2();
  // The same for the last who asks; then nothing is kept.
  Grid<float> take_km2();

 private:
  const Dem& dem_;
  Grid<float> km2_;
};

}  // namespace belvedere
