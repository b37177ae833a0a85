#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/grid_part.h"
#include "base/parallel.h"
#include "base/random.h"
#include "terrain/layers/fit/ground_fit.h"
#include "terrain/layers/layer_apply.h"
#include "terrain/layers/layer_coverage.h"
#include "terrain/layers/layer_relief.h"
#include "tools/bench/bench.h"
#include "tools/bench/bench_terrain.h"

namespace belvedere::bench {

std::vector<Measurement> bench_layers(const Options&);

namespace {

// Twelve layers in three generations, five sampled functions each, noise of four octaves. `fields`:
// each layer has its own noise, so that none is shared.
SurfaceLayers twelve_layers(LayerModel model, bool fields) {
  SurfaceLayers layers;
  layers.model = model;
  layers.inputs = {{"altitude", 0.0, 3000.0},
                   {"slope", 0.0, 60.0},
                   {"north", -1.0, 1.0},
                   {"relief_750", -300.0, 300.0},
                   {"above_valley", 0.0, 800.0}};
  constexpr int parents[12] = {-1, 0, 1, 0, -1, 4, 4, -1, 7, 8, 8, -1};
  for (int k = 0; k < 12; ++k) {
    SurfaceLayer layer;
    layer.name = fmt::format("layer {}", k);
    layer.parent = parents[k];
    layer.painted_as = static_cast<LandCoverClass>(1 + k % 6);
    layer.noise = {fields ? 400.0 + k : 400.0, 4, 0.8, 0.9};
    for (int i = 0; i < 5; ++i) {
      LayerSamples samples;
      if (model == LayerModel::additive) {
        samples.at_0 = -4.0;
        samples.at_255 = 4.0;
      }
      for (int s = 0; s < 256; ++s)
        samples.samples[static_cast<std::size_t>(s)] = static_cast<std::uint8_t>(
            std::lround(200.0 + 55.0 * std::sin(0.02 * s + 1.7 * k + 0.9 * i)));
      layer.functions.emplace_back(samples);
    }
    layers.layers.push_back(layer);
  }
  return layers;
}

// The terrain with known classes: three altitude belts with ragged borders, by the five usual
// inputs of a product.
KnownGround belts(const Dem& dem, const LayerGround& ground,
                  const std::vector<Grid<float>>& inputs) {
  KnownGround known;
  known.cell_m = dem.cell_m();
  known.altitude_m = dem.altitude_m;
  known.input_names = ground.names;
  known.inputs = inputs;
  known.classes = {{"low", LandCoverClass::forest},
                   {"middle", LandCoverClass::pasture},
                   {"high", LandCoverClass::rock}};
  known.labels.resize(dem.altitude_m.size());
  const LayerInput range = layer_input_range("altitude", dem.altitude_m);
  for (int y = 0; y < dem.height(); ++y)
    for (int x = 0; x < dem.width(); ++x) {
      const double position =
          (static_cast<double>(dem.altitude_m(x, y)) - range.low) / (range.high - range.low);
      const double ragged = position + 0.08 * random_normal(1, x, y);
      known.labels[dem.altitude_m.index(x, y)] =
          static_cast<std::uint8_t>(std::clamp(static_cast<int>(3.0 * ragged), 0, 2));
    }
  return known;
}

}  // namespace

std::vector<Measurement> bench_layers(const Options& options) {
  std::vector<Measurement> out;
  for (const int size : options.sizes) {
    const Dem dem = make_bench_dem(size);
    const auto cells = static_cast<double>(dem.altitude_m.size());
    const auto add = [&](const char* name, const std::function<void()>& work) {
      out.push_back({fmt::format("{}²/{}", size, name),
                     cells / measure_fastest(options.repeats, {work})[0].cpu_s * 1e-6,
                     "Mcells/CPU s"});
    };
    const SurfaceLayers layers = twelve_layers(LayerModel::product, false);
    const LayerGround ground = make_layer_ground(dem, {}, compile_layers(layers).inputs);
    const std::vector<Grid<float>> inputs = layer_inputs(ground);
    const auto coverage = [&](const SurfaceLayers& of) {
      const LayerProgram program = compile_layers(of);
      parallel_tiles(size, size, 512, [&](const PixelRect& tile) {
        std::vector<Grid<float>> part;
        for (const Grid<float>& grid : inputs) part.push_back(part_of(grid, tile));
        layer_colour(program, layer_coverage(program, part, dem.transform, tile, 1));
      });
    };
    add("layer_inputs", [&] { layer_inputs(make_layer_ground(dem, {}, ground.names)); });
    add("layer_coverage_and_colour", [&] { coverage(layers); });
    add("layer_coverage_and_colour_own_noise",
        [&] { coverage(twelve_layers(LayerModel::product, true)); });
    add("layer_coverage_and_colour_additive",
        [&] { coverage(twelve_layers(LayerModel::additive, false)); });
    add("layers_apply", [&] {
      apply_layers(
          layers, dem, {}, {}, [](const LayerStrip&) {}, silent_progress());
    });
    // At the resolution panoramas use: pixels of 8 m.
    GroundRelief relief{dem.transform, {{5.0, 60.0, 7, Grid<float>(size, size, 1.F)}}, {}};
    add("bump_slope", [&] {
      Grid<glm::dvec2> slopes(size, size);
      parallel_rows(size, [&](int y) {
        for (int x = 0; x < size; ++x)
          slopes(x, y) = bump_slope(relief, dem.transform.to_crs(x + 0.3, y + 0.4), 8.0);
      });
    });
    // Functions are fitted on about ten thousand sampled cells: a larger map costs less per cell.
    const KnownGround known = belts(dem, ground, inputs);
    for (const LayerModel model : {LayerModel::product, LayerModel::additive}) {
      const GroundFitParameters how{.model = model};
      const double cpu_s =
          measure_fastest(options.repeats, {[&] { fit_ground(known, how); }})[0].cpu_s;
      out.push_back({fmt::format("{}²/layers_fit_{}", size,
                                 model == LayerModel::product ? "product" : "additive"),
                     cpu_s / cells * 1e6, "CPU s/Mcell"});
    }
  }
  return out;
}

}  // namespace belvedere::bench
