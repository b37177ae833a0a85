#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "terrain/io/dem.h"
#include "terrain/layers/layer_climate.h"
#include "tools/cli/terrain_operators.h"

namespace belvedere::tools {

class CommandOptions;

// Options of climate and sun of the commands on layers: --stations, --temperature, --rain,
// --radiation, --sky-view, --sunshine, --latitude.
struct GroundClimateOptions {
  LayerClimateFiles files;
  std::string stations;
  std::optional<double> latitude_deg;
  std::vector<float> sunshine;  // one share or twelve; empty: a clear sky
};
void add_ground_climate(CommandOptions& command, GroundClimateOptions& options);

// The inputs among `names` that depend on climate or sun: given by the user, else from stations,
// else the climate of the place. A raster of 12 bands is monthly, as in a scene. Error(usage) where
// the latitude of the DEM is not known.
LayerClimateGrids climate_of(const GroundClimateOptions& options, const Dem& dem,
                             const std::vector<std::string>& names, Progress& progress);

// The DEM that layers are fitted to or applied to, voids filled and marked. One without a
// coordinate system is used as it is, its cells in metres; all others like a scene's.
Dem read_layer_dem(const std::string& path, const ElevationOptions& options, Progress& progress);

}  // namespace belvedere::tools
