#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/land_cover_class.h"
#include "base/pixel_rect.h"
#include "terrain/cover/ground_variables.h"
#include "terrain/cover/rule_program.h"
#include "terrain/io/raster.h"

namespace belvedere {

// Cover of the ground as layers that depend on terrain variables: Dachsbacher, Bolch and
// Stamminger, "Procedural reproduction of terrain textures with geographic data" (VMV 2006). A
// layer paints a colour, may be a class of land cover and raises the ground slightly. Its coverage
// follows from functions of inputs (ground_variables.h) and from noise, and never exceeds its
// parent's. docs/layers.md describes the file; layer_coverage.h evaluates it.

// Meaning of the values of the functions.
enum class LayerModel : std::uint8_t {
  // Coverage C = clamp((bias + amplitude · noise) · product of the functions, 0, 1) · C of the
  // parent. A function is 0…1.
  product,
  // ln of the share of a layer among its siblings, up to a common constant: bias + amplitude ·
  // noise + sum of the functions; shares are their softmax, times the parent's. A layer with
  // children paints nothing itself; its children divide its ground. C of a painted layer is its
  // share / (it + the shares of all layers under it), which makes the visible shares exact.
  additive,
};

// 1 between low and high, falling linearly to 0 over a width around each bound, where it is 1/2 (as
// hat() of class rules): the clamped minimum of two linear functions. In the input's unit; a bound
// may be infinite, widths are ≥ 0, and 0 is a step (1 on the bound).
struct LayerHat {
  double low = 0.0;
  double high = 0.0;
  double low_width = 0.0;
  double high_width = 0.0;
};

// 256 values of 8 bits over the input's range. Sample i lies at (i + 1/2) / 256 of it
// (layer_sample_place); values are linear between samples and constant beyond the first and the
// last. A sample of 0 means the value `at_0`, one of 255 `at_255`: 0 and 1 in a product.
struct LayerSamples {
  double at_0 = 0.0;
  double at_255 = 1.0;
  std::array<std::uint8_t, 256> samples{};
  std::vector<std::uint8_t> knots =
      {};  // shorter form in files: the samples are samples_of_knots() then; empty: none
};
// 256 samples from 2…256 values spread evenly from one end of the range to the other, linear
// between them.
std::array<std::uint8_t, 256> samples_of_knots(const std::vector<std::uint8_t>& knots);

// The function of an input: none (1 in a product, 0 in a sum), a hat, or samples. A hat in an
// additive model counts as its logarithm, at least -12.
using LayerFunction = std::variant<std::monostate, LayerHat, LayerSamples>;

// Noise at world coordinates in -1…1: a sum of octaves, each with half the length and `gain` times
// the weight of the previous. Siblings of equal scale, octaves and gain share one field.
struct LayerNoise {
  double scale_m = 200.0;  // length of the coarsest octave, > 0
  int octaves = 4;         // 1…12
  double amplitude = 0.0;  // s: 0 is no noise
  double bias = 1.0;  // b: in a product 1 leaves the result to the functions; any number in a sum
  double gain = 0.5;  // > 0, ≤ 2: its power spectrum falls by 2 - 2 log2(gain) per logarithm of
                      // frequency, in two dimensions
};

struct SurfaceLayer {
  std::string name;
  int parent = -1;                           // index of an earlier layer; -1: the ground itself
  std::optional<LandCoverClass> painted_as;  // none: inherited from its parent
  std::uint32_t rgb = 0x808080;    // 0xrrggbb, sRGB; colours are mixed as these encoded values
  double roughness_m = 0.0;        // ± height of its own bumps at full cover
  double roughness_scale_m = 8.0;  // length of the largest bumps, > 0
  LayerNoise noise;
  std::vector<LayerFunction> functions;  // one for each input of the file, in their order
  std::string when;  // an expression as in class rules: the layer covers nothing where it is ≤ 0;
                     // empty: everywhere
};

struct SurfaceLayers {
  std::string name;
  LayerModel model = LayerModel::product;
  // The ground under all layers, fully covered (C = 1).
  std::uint32_t ground_rgb = 0x808080;
  std::optional<LandCoverClass> ground_painted_as;
  std::vector<LayerInput> inputs;
  std::vector<std::pair<std::string, double>>
      parameters;  // named numbers for expressions; a scene may set them
  std::vector<std::pair<std::string, std::string>>
      terms;  // named sub-expressions, evaluated in order
  std::vector<SurfaceLayer>
      layers;  // in painting order: depth first, a parent before its children, siblings as painted
};

// Position of a sample in its input's range, 0…1.
constexpr double layer_sample_place(int sample) {
  return (static_cast<double>(sample) + 0.5) / 256.0;
}

// The value of a function of the model at x, in the input's unit: the reference for faster
// implementations.
double layer_function_value(const LayerFunction& function, const LayerInput& input,
                            LayerModel model, double x);

// The class of a layer: its own, or that of the nearest ancestor with one, or the ground's.
std::optional<LandCoverClass> layer_class(const SurfaceLayers& layers, std::size_t layer);

// Sets parameters of the file; Error(usage) for an unknown name, with the closest known one.
void set_layer_parameters(SurfaceLayers& layers,
                          const std::vector<std::pair<std::string, double>>& settings);

// Throws Error(usage) naming the layer for inconsistencies: an unknown or repeated input, repeated
// names, ranges out of order, a parent that does not come before its child, an order that is not
// depth first, functions and inputs that differ in number, values out of the ranges above. `where`
// is the file or its name for messages. Expressions are not checked.
void check_surface_layers(const SurfaceLayers& layers, const std::string& where);

// The compiled expressions of a file of layers: a condition for each layer. They may use every
// input of the table, noise of 60, 210, 660 and 1800 m (n60 …, mean 0, standard deviation 1),
// parameters and earlier terms. Error(usage) with the position of the error.
RuleProgram compile_layer_expressions(const SurfaceLayers& layers, const std::string& where,
                                      const RulePlaces& positions = {});

// 1 where a layer's expression is true, 0 where it is not, at the cells of a rectangle; empty for
// layers without one and before `first`. `grids` by slot, of the rectangle's size: those that the
// program needs.
std::vector<Grid<std::uint8_t>> evaluate_layer_expressions(
    const RuleProgram& program, const std::vector<const Grid<float>*>& grids,
    const GeoTransform& transform, const PixelRect& cells, std::uint64_t seed,
    std::size_t first = 0);

}  // namespace belvedere
