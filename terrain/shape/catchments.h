#pragma once

#include <utility>

#include "base/grid.h"
#include "terrain/io/dem.h"

namespace belvedere {

// Catchment areas of a DEM, computed on first use and kept, because class rules and the terrain
// model both need them and drainage runs on one thread. The DEM must outlive it. Not thread-safe.
class Catchments {
 public:
  explicit Catchments(const Dem& dem) : dem_(dem) {}
  // Whether km2() was computed.
  Catchments(const Dem& dem, Grid<float> km2) : dem_(dem), km2_(std::move(km2)) {}
  Catchments(const Catchments&) = delete;
  Catchments& operator=(const Catchments&) = delete;

  // flow_accumulation_km2() of the DEM with its entries.
  const Grid<float>& km2();
  // The same for the last caller; releases it.
  Grid<float> take_km2();

 private:
  const Dem& dem_;
  Grid<float> km2_;
};

}  // namespace belvedere
