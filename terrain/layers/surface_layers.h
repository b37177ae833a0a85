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
#include "terrain/cover/ground_variables.h"

namespace belvedere {

// What covers the ground, layer over layer, said by what is known of each place: Dachsbacher, Bolch and Stamminger, "Procedural
// reproduction of terrain textures with geographic data" (VMV 2006). A layer paints a colour, may be a class of land cover and raises the
// ground a little; how much of a place it covers follows from functions of inputs (ground_variables.h) and from noise, and is never more
// than its parent covers. docs/layers.md describes the file; layer_coverage.h evaluates it.

// What the values of the functions mean.
enum class LayerModel : std::uint8_t {
  // Coverage C = clamp((bias + amplitude · noise) · product of the functions, 0, 1) · C of the parent. A function is 0…1.
  product,
  // ln of the share of a layer among its siblings, up to what they have in common: bias + amplitude · noise + sum of the functions; shares
  // are their softmax, times the parent's. A layer with children paints nothing itself, its children share out its ground. C of what is
  // painted is its share / (it + the shares of all that lies under it), which makes the shares come out exactly.
  additive,
};

// 1 between low and high, falling in a straight line to 0 over a width around each bound, where it is 1/2 (as hat() of class rules): the
// clamped minimum of two linear functions. In the input's unit; a bound may be infinite, widths are ≥ 0, and 0 is a step (1 on the bound).
struct LayerHat {
  double low = 0.0;
  double high = 0.0;
  double low_width = 0.0;
  double high_width = 0.0;
};

// 256 values of 8 bits over the input's range. Sample i stands at (i + 1/2) / 256 of it (layer_sample_place); between samples values are
// linear, beyond the first and the last they stay. A sample of 0 means the value `at_0`, one of 255 `at_255`: 0 and 1 in a product.
struct LayerSamples {
  double at_0 = 0.0;
  double at_255 = 1.0;
  std::array<std::uint8_t, 256> samples{};
  std::vector<std::uint8_t> knots = {};  // what files hold instead where it says all: the samples are samples_of_knots() then; empty: none
};
// 256 samples of so many values (2…256) spread evenly from one end of the range to the other, linear between them.
std::array<std::uint8_t, 256> samples_of_knots(const std::vector<std::uint8_t>& knots);

// Nothing (1 in a product, 0 in a sum), a hat, or samples. A hat in an additive model counts as its logarithm, at least -12.
using LayerFunction = std::variant<std::monostate, LayerHat, LayerSamples>;

// Noise at world coordinates in -1…1: a sum of octaves, each of half the length and half the weight of the one before. Siblings of equal
// scale and octaves share one field.
struct LayerNoise {
  double scale_m = 200.0;  // length of the coarsest octave, > 0
  int octaves = 4;         // 1…12
  double amplitude = 0.0;  // s: 0 is no noise
  double bias = 1.0;       // b: 1 lets the functions alone decide in a product; any number in a sum
};

struct SurfaceLayer {
  std::string name;
  int parent = -1;                           // index of an earlier layer; -1: the ground itself
  std::optional<LandCoverClass> painted_as;  // none: its parent's, through all generations
  std::uint32_t rgb = 0x808080;              // 0xrrggbb, sRGB; colours are mixed as these encoded values
  double roughness_m = 0.0;                  // ± height that its own bumps add where it covers all
  double roughness_scale_m = 8.0;            // length of the largest bumps, > 0
  LayerNoise noise;
  std::vector<LayerFunction> functions;  // one for each input of the file, in their order
  std::string when;                      // an expression of class rules: the layer covers nothing where it is ≤ 0; empty: everywhere
};

struct SurfaceLayers {
  std::string name;
  LayerModel model = LayerModel::product;
  // The ground under all layers, covered wholly (C = 1).
  std::uint32_t ground_rgb = 0x808080;
  std::optional<LandCoverClass> ground_painted_as;
  std::vector<LayerInput> inputs;
  std::vector<std::pair<std::string, double>> parameters;  // named numbers that expressions may use and a scene may set
  std::vector<std::pair<std::string, std::string>> terms;  // named sub-expressions, evaluated in order
  std::vector<SurfaceLayer> layers;  // in the order of painting: depth first, a parent before its children, siblings as they are painted
};

// Where a sample stands in its input's range, 0…1.
constexpr double layer_sample_place(int sample) { return (static_cast<double>(sample) + 0.5) / 256.0; }

// The value of a function of the model at x, in the input's unit: the definition that faster ways are tested against.
double layer_function_value(const LayerFunction& function, const LayerInput& input, LayerModel model, double x);

// The class that a layer is painted as: its own, or that of the nearest ancestor that has one, or the ground's.
std::optional<LandCoverClass> layer_class(const SurfaceLayers& layers, std::size_t layer);

// Gives parameters of the file other values; Error(usage) for a name that is none, with the nearest known.
void set_layer_parameters(SurfaceLayers& layers, const std::vector<std::pair<std::string, double>>& settings);

// Throws Error(usage) naming the layer where something does not hold together: an unknown or repeated input, names repeated, ranges out of
// order, a parent that does not come before its child, an order that is not depth first, functions and inputs that differ in number, values
// out of the ranges above. `where` is the file or what stands for it. Expressions are not looked into.
void check_surface_layers(const SurfaceLayers& layers, const std::string& where);

}  // namespace belvedere
