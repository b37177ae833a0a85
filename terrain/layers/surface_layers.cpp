#include "terrain/layers/surface_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/math_exact.h"

namespace belvedere {
namespace {

// Natural logarithms below it are negligible: exp(-12) is 6e-6.
constexpr double lowest_log = -12.0;

// One side of a hat: distance of x inside the bound, over the width.
double ramp(double inside, double width) {
  if (!(width > 0.0)) return inside >= 0.0 ? 1.0 : 0.0;
  return inside / width + 0.5;
}

[[noreturn]] void fail(const std::string& where, const std::string& found,
                       const std::string& allowed) {
  throw Error(ErrorKind::usage, where, found, allowed);
}

void check_function(const LayerFunction& function, LayerModel model, const std::string& position) {
  if (const auto* hat = std::get_if<LayerHat>(&function)) {
    if (!(hat->low <= hat->high))
      fail(position, fmt::format("hat from {} to {}", hat->low, hat->high), "low ≤ high");
    for (const double width : {hat->low_width, hat->high_width})
      if (!(width >= 0.0) || !std::isfinite(width))
        fail(position, fmt::format("transition of {}", width), "0 or more");
  } else if (const auto* samples = std::get_if<LayerSamples>(&function)) {
    if (!std::isfinite(samples->at_0) || !std::isfinite(samples->at_255))
      fail(position, "samples have values that are not finite", "finite numbers");
    const bool unit = std::min(samples->at_0, samples->at_255) >= 0.0 &&
                      std::max(samples->at_0, samples->at_255) <= 1.0;
    if (model == LayerModel::product && !unit)
      fail(position, fmt::format("samples from {} to {}", samples->at_0, samples->at_255),
           "values from 0 to 1 in a product");
  }
}

}  // namespace

std::array<std::uint8_t, 256> samples_of_knots(const std::vector<std::uint8_t>& knots) {
  std::array<std::uint8_t, 256> samples{};
  const int steps = static_cast<int>(knots.size()) - 1;
  for (int i = 0; i < 256; ++i) {
    // Position (2 i + 1) / 512 of the range, in whole numbers: 512ths of the distance from one knot
    // to the next.
    const int at = (2 * i + 1) * steps;
    const int first = at / 512;
    const int share = at % 512;
    const int low = knots[static_cast<std::size_t>(first)];
    const int high = knots[static_cast<std::size_t>(std::min(first + 1, steps))];
    samples[static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>((low * (512 - share) + high * share + 256) / 512);
  }
  return samples;
}

double layer_function_value(const LayerFunction& function, const LayerInput& input,
                            LayerModel model, double x) {
  if (const auto* hat = std::get_if<LayerHat>(&function)) {
    const double value = std::clamp(
        std::min(ramp(x - hat->low, hat->low_width), ramp(hat->high - x, hat->high_width)), 0.0,
        1.0);
    if (model == LayerModel::product) return value;
    return value > 0.0 ? std::max(lowest_log, exact::log(value)) : lowest_log;
  }
  if (const auto* sampled = std::get_if<LayerSamples>(&function)) {
    const double u = std::clamp((x - input.low) / (input.high - input.low), 0.0, 1.0);
    const double at = std::clamp(u * 256.0 - 0.5, 0.0, 255.0);
    const int i = std::min(static_cast<int>(at), 254);
    const double part = at - i;
    const auto sample = [&](int k) {
      return static_cast<double>(sampled->samples[static_cast<std::size_t>(k)]);
    };
    const double mixed = sample(i) + part * (sample(i + 1) - sample(i));
    return sampled->at_0 + mixed / 255.0 * (sampled->at_255 - sampled->at_0);
  }
  return model == LayerModel::product ? 1.0 : 0.0;
}

std::optional<LandCoverClass> layer_class(const SurfaceLayers& layers, std::size_t layer) {
  for (int i = static_cast<int>(layer); i >= 0;
       i = layers.layers[static_cast<std::size_t>(i)].parent)
    if (const auto& own = layers.layers[static_cast<std::size_t>(i)].painted_as) return own;
  return layers.ground_painted_as;
}

void set_layer_parameters(SurfaceLayers& layers,
                          const std::vector<std::pair<std::string, double>>& settings) {
  layers.parameters = with_settings(std::move(layers.parameters), settings,
                                    fmt::format("the layers \"{}\"", layers.name));
}

void check_surface_layers(const SurfaceLayers& layers, const std::string& where) {
  std::set<std::string> inputs;
  for (const LayerInput& input : layers.inputs) {
    require_layer_input(input.name, where);
    if (!inputs.insert(input.name).second)
      fail(where, "the input \"" + input.name + "\" is repeated", "each input once");
    if (!(input.low < input.high) || !std::isfinite(input.high - input.low))
      fail(where + ", input " + input.name, fmt::format("from {} to {}", input.low, input.high),
           "low < high");
  }
  std::set<std::string> names;
  for (std::size_t i = 0; i < layers.layers.size(); ++i) {
    const SurfaceLayer& layer = layers.layers[i];
    const std::string position = fmt::format("{}, layer {}", where, layer.name);
    if (layer.name.empty())
      fail(fmt::format("{}, layer {}", where, i + 1), "missing name", "a name");
    if (!names.insert(layer.name).second) fail(position, "duplicate name", "unique names");
    if (layer.parent < -1 || layer.parent >= static_cast<int>(i))
      fail(position, "its parent is not painted before it", "an earlier layer");
    // Depth first: the parent is the previous layer, or one of its ancestors.
    int open = static_cast<int>(i) - 1;
    while (open > layer.parent) open = layers.layers[static_cast<std::size_t>(open)].parent;
    if (open != layer.parent)
      fail(position, "layer not adjacent to its parent", "layers in depth-first order");
    if (layer.functions.size() != layers.inputs.size())
      fail(position, fmt::format("{} functions", layer.functions.size()),
           fmt::format("one for each of {} inputs", layers.inputs.size()));
    if (layer.painted_as == LandCoverClass::sky) fail(position, "class sky", "a ground class");
    if (!(layer.noise.scale_m > 0.0) || layer.noise.octaves < 1 || layer.noise.octaves > 12)
      fail(position,
           fmt::format("noise of {} m and {} octaves", layer.noise.scale_m, layer.noise.octaves),
           "more than 0 m, 1…12 octaves");
    if (!(layer.noise.gain > 0.0) || !(layer.noise.gain <= 2.0))
      fail(position, fmt::format("noise with a gain of {}", layer.noise.gain), "above 0, up to 2");
    if (!std::isfinite(layer.noise.amplitude) || !std::isfinite(layer.noise.bias) ||
        !std::isfinite(layer.noise.scale_m))
      fail(position, "noise has numbers that are not finite", "finite numbers");
    if (!(layer.roughness_m >= 0.0) || !(layer.roughness_scale_m > 0.0) ||
        !std::isfinite(layer.roughness_m + layer.roughness_scale_m))
      fail(position,
           fmt::format("roughness with height {} m and length {} m", layer.roughness_m,
                       layer.roughness_scale_m),
           "a height of 0 m or more, a length above 0 m");
    for (std::size_t k = 0; k < layer.functions.size(); ++k)
      check_function(layer.functions[k], layers.model,
                     fmt::format("{}, {}", position, layers.inputs[k].name));
  }
}

RuleProgram compile_layer_expressions(const SurfaceLayers& layers, const std::string& where,
                                      const RulePlaces& positions) {
  std::vector<RuleCondition> conditions;
  for (const SurfaceLayer& layer : layers.layers)
    conditions.push_back({layer.when, "layer " + layer.name});
  return compile_expressions(expression_names(KnownTo::layers), layers.parameters, layers.terms,
                             conditions, where, positions);
}

std::vector<Grid<std::uint8_t>> evaluate_layer_expressions(
    const RuleProgram& program, const std::vector<const Grid<float>*>& grids,
    const GeoTransform& transform, const PixelRect& cells, std::uint64_t seed, std::size_t first) {
  std::vector<Grid<std::uint8_t>> out(program.conditions.size());
  for (std::size_t k = first; k < out.size(); ++k)
    if (program.conditions[k]) out[k] = Grid<std::uint8_t>(cells.width(), cells.height());
  const RuleGrids known(program, program.all_needs(), transform, cells, seed, grids);
  RuleRows rows(known);
  std::array<float, rule_block> result{};
  for (int y = 0; y < cells.height(); ++y) {
    rows.start(y);
    for (int begin = 0; begin < cells.width(); begin += rule_block) {
      const int count = std::min(rule_block, cells.width() - begin);
      rows.go_to(begin);
      for (std::size_t k = first; k < out.size(); ++k) {
        if (!program.conditions[k]) continue;
        rows.evaluate(*program.conditions[k], result.data());
        std::uint8_t* target = out[k].row(y) + begin;
        for (int x = 0; x < count; ++x)
          target[x] = result[static_cast<std::size_t>(x)] > 0.F ? 1 : 0;
      }
    }
  }
  return out;
}

}  // namespace belvedere
