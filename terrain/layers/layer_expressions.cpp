#include "terrain/layers/layer_expressions.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/noise.h"
#include "base/random_streams.h"
#include "terrain/cover/ground_variables.h"
#include "terrain/layers/layer_noise.h"

namespace belvedere {
namespace {

// Noises that expressions know.
std::vector<GroundVariable> noises() {
  std::vector<GroundVariable> rows;
  for (const GroundVariable& row : ground_variables())
    if (row.noise_m > 0.0) rows.push_back(row);
  return rows;
}

// All names in the order of their slots: inputs, noises, terms.
std::vector<std::string> all_names(const SurfaceLayers& layers) {
  std::vector<std::string> names = layer_input_names();
  for (const GroundVariable& noise : noises()) names.emplace_back(noise.name);
  for (const auto& term : layers.terms) names.push_back(term.first);
  return names;
}

// The expressions with their variables numbered by `names`.
void compile(const SurfaceLayers& layers, const std::vector<std::string>& names, const std::string& where,
             const LayerExpressionPlaces& places, LayerExpressions& out) {
  const std::size_t before_terms = names.size() - layers.terms.size();
  RuleNames known{{names.begin(), names.begin() + static_cast<std::ptrdiff_t>(before_terms)}, layers.parameters};
  const auto one = [&](const std::string& text, const std::string& what, const std::vector<ConfigPlace>& from, std::size_t i) {
    return from.empty() ? RuleExpression(text, known, where + ", " + what, {}) : RuleExpression(text, known, where, from[i]);
  };
  for (std::size_t i = 0; i < layers.terms.size(); ++i) {
    out.terms.push_back(one(layers.terms[i].second, "term " + layers.terms[i].first, places.terms, i));
    known.variables.push_back(layers.terms[i].first);
  }
  for (std::size_t i = 0; i < layers.layers.size(); ++i) {
    const SurfaceLayer& layer = layers.layers[i];
    out.when.emplace_back();
    if (!layer.when.empty()) out.when.back() = one(layer.when, "layer " + layer.name, places.when, i);
  }
}

}  // namespace

LayerExpressions compile_layer_expressions(const SurfaceLayers& layers, const std::string& where, const LayerExpressionPlaces& places) {
  const std::vector<std::string> names = all_names(layers);
  LayerExpressions all;
  compile(layers, names, where, places, all);
  // Which inputs and noises are read, also by terms; then once more with the slots of those alone.
  std::vector<bool> read(names.size(), false);
  const auto mark = [&](const RuleExpression& expression) {
    for (const int slot : expression.variables()) read[static_cast<std::size_t>(slot)] = true;
  };
  for (const RuleExpression& term : all.terms) mark(term);
  for (const auto& when : all.when)
    if (when) mark(*when);
  LayerExpressions out;
  const std::size_t inputs = layer_input_names().size();
  const std::size_t before_terms = inputs + noises().size();
  for (std::size_t i = 0; i < before_terms; ++i) {
    if (!read[i]) continue;
    out.variables.push_back(names[i]);
    if (i < inputs) ++out.inputs;
  }
  for (std::size_t i = before_terms; i < names.size(); ++i) out.variables.push_back(names[i]);
  compile(layers, out.variables, where, places, out);
  return out;
}

std::vector<Grid<std::uint8_t>> evaluate_layer_expressions(const LayerExpressions& expressions,
                                                           const std::vector<const Grid<float>*>& inputs, const GeoTransform& transform,
                                                           const PixelRect& cells, std::uint64_t seed) {
  std::vector<Grid<std::uint8_t>> out(expressions.when.size());
  for (std::size_t k = 0; k < out.size(); ++k)
    if (expressions.when[k]) out[k] = Grid<std::uint8_t>(cells.width(), cells.height());
  const std::size_t terms_from = expressions.variables.size() - expressions.terms.size();
  std::vector<NoiseColumns> plans;
  std::vector<std::uint64_t> seeds;
  const std::vector<GroundVariable> known = noises();
  for (std::size_t v = expressions.inputs; v < terms_from; ++v) {
    const auto noise =
        std::find_if(known.begin(), known.end(), [&](const GroundVariable& n) { return expressions.variables[v] == n.name; });
    plans.push_back(plan_raster_noise(transform, cells, noise->noise_m));
    seeds.push_back(stream_seed(seed, Stream::class_noise, static_cast<std::uint64_t>(noise - known.begin())));
  }
  const int padded = (cells.width() + rule_block - 1) / rule_block * rule_block;
  std::vector<std::vector<float>> rows(expressions.variables.size(), std::vector<float>(static_cast<std::size_t>(padded), 0.F));
  std::vector<const float*> pointers(rows.size(), nullptr);
  std::array<float, rule_block> result{};
  RuleExpression::Scratch scratch;
  for (int y = 0; y < cells.height(); ++y) {
    for (std::size_t v = 0; v < expressions.inputs; ++v) std::copy_n(inputs[v]->row(y), cells.width(), rows[v].begin());
    for (std::size_t n = 0; n < plans.size(); ++n)
      gaussian_noise_row(plans[n], seeds[n], transform.to_crs(cells.x0, cells.y0 + y).y, rows[expressions.inputs + n].data());
    for (int begin = 0; begin < padded; begin += rule_block) {
      for (std::size_t v = 0; v < rows.size(); ++v) pointers[v] = rows[v].data() + begin;
      for (std::size_t t = 0; t < expressions.terms.size(); ++t)
        expressions.terms[t].evaluate(pointers, rows[terms_from + t].data() + begin, scratch);
      const int count = std::min(rule_block, cells.width() - begin);
      for (std::size_t k = 0; k < out.size(); ++k) {
        if (!expressions.when[k]) continue;
        expressions.when[k]->evaluate(pointers, result.data(), scratch);
        std::uint8_t* target = out[k].row(y) + begin;
        for (int x = 0; x < count; ++x) target[x] = result[static_cast<std::size_t>(x)] > 0.F ? 1 : 0;
      }
    }
  }
  return out;
}

}  // namespace belvedere
