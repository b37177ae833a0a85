#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"
#include "terrain/climate/climate.h"
#include "terrain/cover/layer_inputs.h"
#include "terrain/io/dem.h"
#include "terrain/shape/sea.h"

namespace belvedere {

// Inputs of surface layers that need more than altitudes: climate and sun of the DEM's place. Fitting, applying and scenes all take them
// from here, so that what was learned means the same where it is used.

// Rasters that say better what an input is; empty: it is computed. Values as they are, resampled to the DEM's cells, their voids filled.
struct LayerClimateFiles {
  std::string temperature = {};  // °C, mean of the year
  std::string rain = {};         // mm a year
  std::string radiation = {};    // in the unit the layers were fitted with
  std::string sky_view = {};     // 0…1
};

// Where the climate comes from when temperature or rain has to be computed; asked at most once.
using ClimateMaker = std::function<Climate()>;

// The inputs among `names` that hang on climate or sun, on the DEM's cells, and no others. Temperature is the mean of the year's months and
// rain the year's, from the climate at each cell's place and altitude; radiation (MJ/m² a year, with shadows) and sky view are those of
// the ground smoothed by 45 m, whose stripes would else be steep. Temperature and rain are rounded to 1/65536, so that a machine's last
// bits reach no picture; the same bits for any threads. 4 bytes a cell for each. A DEM without CRS lies at `latitude_deg`.
// `whole`: of a window, the larger terrain that it is part of: the climate is that terrain's, and its ground throws shadows. treeline, lake
// and sea are what class rules have by these names, lakes with the default parameters; `sea` says where to look for it.
struct LayerClimateGrids {
  Grid<float> temperature_c;
  Grid<float> rain_mm;
  Grid<float> radiation;
  Grid<float> sky_view;
  Grid<float> treeline_m;
  Grid<float> lake;
  Grid<float> sea;
  std::vector<std::string> sources;  // of the climate, a line each, for people; empty where it was not asked for
  LayerClimate view() const;         // of these grids, which must outlive it
};
LayerClimateGrids make_layer_climate(const Dem& dem, const std::vector<std::string>& names, const LayerClimateFiles& files,
                                     std::optional<double> latitude_deg, const ClimateMaker& climate, Progress& progress,
                                     const Dem* whole = nullptr, const SeaParameters& sea = {});

// Whether any of that has to be computed: then it must be known where on Earth the DEM lies. And whether the climate is asked for.
bool needs_place(const std::vector<std::string>& names, const LayerClimateFiles& files);
bool needs_climate(const std::vector<std::string>& names, const LayerClimateFiles& files);

}  // namespace belvedere
