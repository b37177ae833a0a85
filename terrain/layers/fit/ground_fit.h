#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/land_cover_class.h"
#include "terrain/layers/fit/fit_cells.h"
#include "terrain/layers/fit/fit_functions.h"
#include "terrain/layers/fit/fit_measures.h"
#include "terrain/layers/fit/forest.h"
#include "terrain/layers/fit/picture_sun.h"
#include "terrain/layers/surface_layers.h"

namespace belvedere {

struct FitClass {
  std::string name;
  std::optional<LandCoverClass> painted_as;
  std::uint32_t rgb = 0x808080;  // used without a picture
  std::optional<glm::vec3> shown =
      {};  // 0…255, in place of the picture's colours in a file, which
           // may be false; children keep their lightness relative to it
};

// An orthophoto, cell for cell.
struct FitPicture {
  Grid<glm::vec3> rgb;
  std::optional<double> sun_azimuth_deg;  // from the shadows of clouds
};

// Ground with known classes for learning. All grids are of one size.
struct KnownGround {
  double cell_m = 0.0;
  Grid<float> altitude_m;
  std::vector<std::string> input_names;
  std::vector<Grid<float>> inputs;
  std::vector<FitClass> classes;
  std::vector<std::uint8_t> labels;  // no_class: not used for learning
  std::optional<FitPicture>
      picture;  // without one, layers have the colours of their classes and no children
};

enum class FunctionSource : std::uint8_t {
  fitted,     // by likelihood
  histogram,  // as published
};
struct GroundFitParameters {
  LayerModel model = LayerModel::product;
  FunctionSource functions = FunctionSource::fitted;
  double smoothing = 2.0;                // of histograms (HistogramParameters)
  std::optional<double> roughness = {};  // of fitted functions (FitFunctionParameters); none: the
                                         // model's own
  int children = 4;  // colours per class; half as many if it covers less than a twentieth; 1: none
  double forest_share =
      0.0;  // 0…1: weight of a forest averaged with the model's shares; not possible in a file
};

// The result: functions of classes, and within each class functions of its colours.
struct GroundFit {
  std::vector<LayerInput> ranges;
  ClassFunctions classes;
  std::vector<ClassFunctions> children;  // [class]; without functions if it has one colour
  std::vector<int> parent;               // [leaf]: its class; leaves of a class are contiguous
  std::vector<glm::dvec3> colours;  // [leaf], 0…255, as on level ground under the picture's sun
  std::vector<std::size_t> cells;   // [leaf] training cells
  PictureSun sun;
  LightAnswers light;  // [class]
  double forest_share = 0.0;
  Forest forest;  // of leaves
};
// Fits to the cells where `learn` is not 0 (null: everywhere). Error(input) if fewer than 100 cells
// or fewer than two classes remain.
GroundFit fit_ground(const KnownGround& ground, const GroundFitParameters& parameters,
                     const Grid<std::uint8_t>* learn = nullptr);

// Values quantized to samples within their ranges: the arguments of a file's functions.
std::vector<std::vector<std::uint8_t>> sample_indices(const std::vector<Grid<float>>& inputs,
                                                      const std::vector<LayerInput>& ranges);

struct GroundPrediction {
  ClassShares classes;
  Grid<glm::vec3> even;      // expected colours on level ground (with a picture)
  Grid<glm::vec3> expected;  // the same in the light of the picture's sun
};
GroundPrediction predict_ground(const KnownGround& ground, const GroundFit& fit);

// The fit as a layers file. A class is a layer, its colours are layers under it (P27, P32).
SurfaceLayers surface_layers_of(const KnownGround& ground, const GroundFit& fit,
                                const std::string& name);

// Cross-validation: a division of the ground into `parts`, numbered from 0, each evaluated with a
// fit to the others.
struct HoldOut {
  std::string name;
  int parts = 0;
  Grid<std::uint8_t> part;  // of each cell
};
// A chessboard of squares: neighbouring squares are similar, so its result is optimistic.
HoldOut chessboard(int width, int height, int square_cells = 64);
// West, east: tests whether a fit transfers to other ground.
HoldOut west_and_east(int width, int height);
HoldOut north_and_south(int width, int height);

// Each part predicted by a fit to the others.
struct HeldOutResult {
  GroundPrediction prediction;  // shares and colours of each cell by a fit without it
  ClassMeasures measures;
  ClassMeasures matched;  // with offsets that give each class its area on the whole ground
  std::vector<BlockDifference> differences;  // with a picture: blocks of 1, 16, 32, 64 cells
  double gradient_share = 0.0;  // gradient energy of the expected colours over the picture's
};
// Error(input) if a part leaves nothing to learn from.
HeldOutResult evaluate_held_out(const KnownGround& ground, const GroundFitParameters& parameters,
                                const HoldOut& hold_out);

// Baseline without inputs: a class's share in 32 bands of altitude. Every model must be better.
HeldOutResult judge_bands(const KnownGround& ground, const HoldOut& hold_out);

}  // namespace belvedere
