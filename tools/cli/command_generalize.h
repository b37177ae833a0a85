#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "terrain/generalize/generalize.h"
#include "terrain/generalize/mask.h"
#include "terrain/io/dem.h"
#include "tools/cli/terrain_operators.h"
#include "tools/options/options.h"

namespace belvedere::tools {

class CommandOptions;

// Command-line options of `generalize`. Weights go from the largest landforms to the smallest;
// empty: not given.
struct GeneralizeOptions : RunOptions {
  std::string in;
  ElevationOptions elevation;  // of `in`
  std::string out;
  std::string preset;
  std::vector<float> global, ridges, valleys;
  std::vector<float> background_global, background_ridges, background_valleys;
  std::string curvature = "bounded";
  GeneralizeParameters bands;
  std::vector<double> viewer;     // E, N
  std::vector<double> distances;  // near, far, m
  std::string mask;
  std::vector<double> mask_slope;
  bool automatic_mask = false;
  bool change_lakes = false;
  TerrainOperators operators;
  std::string report;
};

void add_generalize_options(CommandOptions& command, GeneralizeOptions& options);

// The requested weights. Error(usage) where there are none, where sets differ in number, a weight
// is out of range, or weights depend on distance and there is no viewer.
GeneralizeParameters resolve_bands(const GeneralizeOptions& options);
// The requested slope mask; nothing: no mask.
std::optional<SlopeRange> masked_slopes(const GeneralizeOptions& options);
// Whether exaggeration is suppressed at the foot of slopes.
bool masks_slope_feet(const GeneralizeOptions& options);
// The request on a DEM without voids, whose cells on the ground are given. `read_mask`: the drawn
// mask, called once; an empty grid is none. `dem` is destriped if that is asked for.
struct GeneralizedDem {
  Grid<float> altitude_m;
  GeneralizeGrids grids;
};
GeneralizedDem generalize_dem(const GeneralizeOptions& options, const GeneralizeParameters& bands,
                              Dem& dem, glm::dvec2 cell_m,
                              const std::function<Grid<float>()>& read_mask, Progress& progress);
// The run as a command line, with everything that altitudes depend on, without folders: the same on
// every machine.
std::string describe_generalize(const GeneralizeOptions& options,
                                const GeneralizeParameters& bands);

}  // namespace belvedere::tools
