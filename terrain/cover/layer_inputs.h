#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/pixel_rect.h"
#include "terrain/cover/ground_variables.h"
#include "terrain/io/dem.h"

namespace belvedere {

// Grids of the DEM's size that the ground alone does not say; null: unknown.
struct LayerClimate {
  const Grid<float>* temperature_c = nullptr;  // mean of the year
  const Grid<float>* rain_mm = nullptr;        // of the year
  const Grid<float>* radiation = nullptr;      // potential direct, of the year, MJ/m²; any unit that fitting and applying share
  const Grid<float>* sky_view = nullptr;       // 0…1
  const Grid<float>* treeline_m = nullptr;
  const Grid<float>* lake = nullptr;  // 1 on lakes, else 0
  const Grid<float>* sea = nullptr;   // 1 at sea, else 0
};

// A DEM made ready to be asked for inputs: what reaches far (means over kilometres, catchments) is kept at a coarser resolution that hangs
// on the whole DEM alone, so that any rectangle gets the bits of the whole. Keeps pointers to the DEM and the grids, which must outlive it.
struct LayerGround {
  // A grid of blocks of `factor` × `factor` cells over the whole DEM, read by cubic B-spline; empty where no input needs it.
  struct Coarse {
    int factor = 1;
    Grid<float> values;
  };
  const Dem* dem = nullptr;
  LayerClimate climate;
  std::vector<std::string> names;  // of the inputs, in the order in which layer_inputs() gives them
  std::vector<Coarse> coarse;      // one for each input
};
// Error(usage) naming the input that is unknown, or that the climate does not give. `whole`: of a window, the larger terrain that it is
// part of; means of more ground than the window's halo has are taken over it, and catchments have what flows in.
LayerGround make_layer_ground(const Dem& dem, const LayerClimate& climate, const std::vector<std::string>& names,
                              const Dem* whole = nullptr);

// The inputs at the cells of a rectangle inside the DEM, a grid of its size each. Thread-safe.
std::vector<Grid<float>> layer_inputs(const LayerGround& ground, const PixelRect& cells);
// The same over the whole DEM, by tiles.
std::vector<Grid<float>> layer_inputs(const LayerGround& ground);

// The range that samples are spread over: the percentiles .1 and 99.9 of the values where `use` is not 0 (null: everywhere); widened where
// all are equal, so that low < high. Error(input) where no cell is used.
LayerInput layer_input_range(const std::string& name, const Grid<float>& values, const Grid<std::uint8_t>* use = nullptr);

}  // namespace belvedere
