#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"
#include "terrain/climate/climate.h"
#include "terrain/climate/radiation.h"
#include "terrain/cover/layer_inputs.h"
#include "terrain/io/dem.h"
#include "terrain/shape/sea.h"

namespace belvedere {

// Inputs of surface layers that need more than altitudes: climate and sun at the DEM's position.
// Fitting, applying and scenes all use these functions, so that inputs mean the same when fitted
// and when applied.

// Rasters with better values of an input; empty: it is computed. Values are resampled to the DEM's
// cells, their voids filled.
struct LayerClimateFiles {
  std::string temperature = {};  // °C, annual mean
  std::string rain = {};         // mm per year
  std::string radiation = {};    // in the unit used for fitting
  std::string sky_view = {};     // 0…1
};

// Source of the climate if temperature or rain must be computed; called at most once.
using ClimateMaker = std::function<Climate()>;

// The inputs among `names` that depend on climate or sun, on the DEM's cells, and no others.
// Temperature is the annual mean and rain the annual sum, from the climate at each cell's position
// and altitude. Radiation (MJ/m² per year, with shadows, under the clouds of `sunshine`) and sky
// view are those of the ground smoothed by 45 m, because stripes of the DEM would be steep slopes.
// Temperature and rain are rounded to 1/65536, so that the last bits of a machine do not affect a
// picture; the same bits for any threads. 4 bytes per cell for each. A DEM without CRS lies at
// `latitude_deg`. `whole`: of a window, the larger terrain that contains it: the climate is that
// terrain's, and its ground casts shadows. treeline, lake and sea are defined as in class rules,
// lakes with the default parameters; `sea` has the search parameters.
struct LayerClimateGrids {
  Grid<float> temperature_c;
  Grid<float> rain_mm;
  Grid<float> radiation;
  Grid<float> sky_view;
  Grid<float> treeline_m;
  Grid<float> lake;
  Grid<float> sea;
  std::vector<std::string> sources;  // of the climate, one line each, for reports; empty if unused
  LayerClimate view() const;         // of these grids, which must outlive it
};
LayerClimateGrids make_layer_climate(const Dem& dem, const std::vector<std::string>& names,
                                     const LayerClimateFiles& files,
                                     std::optional<double> latitude_deg,
                                     const ClimateMaker& climate, Progress& progress,
                                     const Dem* whole = nullptr, const SeaParameters& sea = {},
                                     const MonthShares& sunshine = always_sunny);

// Whether any of them must be computed, so that the DEM's position on Earth is needed; and whether
// the climate is needed.
bool needs_place(const std::vector<std::string>& names, const LayerClimateFiles& files);
bool needs_climate(const std::vector<std::string>& names, const LayerClimateFiles& files);

}  // namespace belvedere
