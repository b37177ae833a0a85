#include <fmt/format.h>

#include <cmath>

#include "base/grid_part.h"
#include "terrain/layers/layer_apply.h"
#include "terrain/layers/layer_coverage.h"
#include "tools/bench/bench.h"
#include "tools/bench/bench_terrain.h"

namespace belvedere::bench {

std::vector<Measurement> bench_layers(const Options&);

namespace {

// Twelve layers in three generations, five sampled functions each, noise of four octaves. `fields`: a noise of each layer's own, so that
// none is shared.
SurfaceLayers twelve_layers(LayerModel model, bool fields) {
  SurfaceLayers layers;
  layers.model = model;
  layers.inputs = {
      {"altitude", 0.0, 3000.0}, {"slope", 0.0, 60.0}, {"north", -1.0, 1.0}, {"relief_750", -300.0, 300.0}, {"above_valley", 0.0, 800.0}};
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
        samples.samples[static_cast<std::size_t>(s)] =
            static_cast<std::uint8_t>(std::lround(200.0 + 55.0 * std::sin(0.02 * s + 1.7 * k + 0.9 * i)));
      layer.functions.emplace_back(samples);
    }
    layers.layers.push_back(layer);
  }
  return layers;
}

}  // namespace

std::vector<Measurement> bench_layers(const Options& options) {
  std::vector<Measurement> out;
  for (const int size : options.sizes) {
    const Dem dem = make_bench_dem(size);
    const auto cells = static_cast<double>(dem.altitude_m.size());
    const auto add = [&](const char* name, const std::function<void()>& work) {
      out.push_back({fmt::format("{}²/{}", size, name), cells / measure_fastest(options.repeats, {work})[0].cpu_s * 1e-6, "Mcells/CPU s"});
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
    add("layer_coverage_and_colour_own_noise", [&] { coverage(twelve_layers(LayerModel::product, true)); });
    add("layer_coverage_and_colour_additive", [&] { coverage(twelve_layers(LayerModel::additive, false)); });
    add("layers_apply", [&] {
      apply_layers(
          layers, dem, {}, {}, [](const LayerStrip&) {}, silent_progress());
    });
  }
  return out;
}

}  // namespace belvedere::bench
