#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "terrain/layers/fit/fit_cells.h"
#include "terrain/layers/surface_layers.h"

namespace belvedere {

// The dependence of each class on each input, in one of the models of layers files.
struct ClassFunctions {
  LayerModel model = LayerModel::product;
  std::vector<int> order;    // classes in painting order; the first is the ground (product)
  std::vector<double> bias;  // [class]
  std::vector<std::vector<LayerSamples>> functions;  // [class][input]
  int saturated = 0;  // number of histogram functions whose mean cannot reach 1/2
};

struct FitFunctionParameters {
  int knots = 32;  // of each function, linear between them; 2…256
  double roughness =
      6e-4;  // weight of squared differences of neighbouring knots (in units of logits), ≥ 0
  int steps = 150;           // maximum number of iterations
  std::size_t max = 60'000;  // maximum number of cells used
};

// C = b · ΠF of each class, every F in (0, 1), by maximum likelihood, each class against those
// under it: cells of its own have probability C, cells of classes below 1 - C, and cells of classes
// above are left out. Classes are painted from the largest area to the smallest. A class without
// cells covers nothing.
ClassFunctions fit_product(const FitCells& cells, const FitFunctionParameters& parameters = {});

// ln share = b + ΣT up to a constant common to all classes, fitted for all classes together by
// maximum likelihood (multinomial logit, a generalized additive model). Tables are stored in 8 bits
// over the range of each.
ClassFunctions fit_additive(const FitCells& cells, const FitFunctionParameters& parameters = {
                                                       .roughness = 2e-3, .steps = 120});

struct HistogramParameters {
  double smoothing = 2.0;  // standard deviation of the blur over samples, ≥ 0: functions of small
                           // classes are noisy without it
};
// The published heuristic (Dachsbacher, Bolch and Stamminger 2006): the histogram of a class over
// the input, scaled and clamped so that its mean is 1/2. If more than half of the samples are empty
// that is impossible: the function is 1 where the class occurs, and is counted in `saturated`.
ClassFunctions histogram_functions(const FitCells& cells,
                                   const HistogramParameters& parameters = {});

// Sets the functions and the bias of a layer. Functions without effect are left out: those of a
// product that are 1 throughout, and those of a sum that change a share by less than two hundredths
// over the whole range.
void set_functions(SurfaceLayer& layer, const ClassFunctions& functions, std::size_t of);

// Classes from the largest to the smallest; ties to the lower class.
std::vector<int> by_falling_area(const std::vector<std::size_t>& counts);

struct MinimizeParameters {
  int steps = 150;          // maximum, ≥ 1
  double tolerance = 1e-9;  // stops if a step gains less than this share of the value, ≥ 0
};
struct MinimizeResult {
  std::vector<double> at;
  double value = 0.0;
  int steps = 0;
  int evaluations = 0;
};

// Returns the value at x, ≥ 0, and writes the gradient, both of finite numbers; throws nothing.
using ValueAndGradient =
    std::function<double(std::span<const double> x, std::span<double> gradient)>;

// Unconstrained minimum of a smooth function by limited-memory BFGS (Nocedal 1980) of libLBFGS.
// Single-threaded, and the only library function is the square root: the same bits wherever the
// function gives them.
MinimizeResult minimize(const std::vector<double>& start, const ValueAndGradient& function,
                        const MinimizeParameters& parameters = {});

}  // namespace belvedere
