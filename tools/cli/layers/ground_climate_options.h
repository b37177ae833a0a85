#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "terrain/io/dem.h"
#include "terrain/layers/layer_climate.h"

namespace belvedere::tools {

class CommandOptions;

// What commands on layers are told of climate and sun: --stations, --temperature, --rain, --radiation, --sky-view, --latitude.
struct GroundClimateOptions {
  LayerClimateFiles files;
  std::string stations;
  std::optional<double> latitude_deg;
};
void add_ground_climate(CommandOptions& command, GroundClimateOptions& options);

// The inputs among `names` that hang on climate or sun: what the user gave, else stations, else the climate of the place. A raster of
// 12 bands is one of months, as a scene's. Error(usage) where it is not known where the DEM lies.
LayerClimateGrids climate_of(const GroundClimateOptions& options, const Dem& dem, const std::vector<std::string>& names,
                             Progress& progress);

// The DEM that layers are learned on or laid over, voids filled and marked. One without a coordinate system is taken as it lies, its cells
// in metres; all others as a scene's.
Dem read_layer_dem(const std::string& path, Progress& progress);

}  // namespace belvedere::tools
