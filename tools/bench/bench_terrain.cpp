#include "tools/bench/bench_terrain.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <system_error>

#include "base/grid.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/image/guidance_io.h"
#include "renderer/image/image_io.h"
#include "terrain/climate/radiation.h"
#include "terrain/climate/rain.h"
#include "terrain/layers/fit/ground_fit.h"
#include "terrain/layers/layer_apply.h"
#include "terrain/layers/layer_coverage.h"
#include "terrain/layers/layer_noise.h"
#include "terrain/synthetic/synthetic.h"
#include "tools/bench/bench.h"

namespace belvedere::bench {

Dem make_bench_dem(int size) {
  SyntheticParameters parameters;
  parameters.width = size;
  parameters.height = size;
  return make_ridged_noise(parameters);
}

DeformedSurface make_bench_surface(const Dem& dem) {
  const glm::dvec2 centre = dem.transform.to_crs(0.5 * dem.width(), 0.5 * dem.height());
  DeformParameters parameters;
  parameters.exaggeration = 1.6;
  return deform(dem.altitude_m, dem.transform, centre, {centre, 0.0}, parameters);
}

CameraParameters bench_view(const Dem& dem, int width, int height) {
  const double side_m = dem.width() * dem.cell_m();
  const glm::dvec2 north = dem.transform.to_crs(0.5 * dem.width(), 0.0);
  CameraParameters parameters;
  parameters.width = width;
  parameters.height = height;
  parameters.eye = {north.x, north.y + 0.4 * side_m, 6000.0 + 0.25 * side_m};
  parameters.azimuth_deg = 180.0;
  parameters.pitch_deg = -22.0;
  parameters.field_of_view_deg = 50.0;
  return parameters;
}

std::vector<Ray> bundle_rays(const Camera& camera) {
  std::vector<Ray> rays;
  for (int y = 0; y < camera.size().y; y += 4) {
    for (int x = 0; x < camera.size().x; x += 4) {
      for (int k = 0; k < 16; ++k) rays.push_back(camera.ray({x + k % 4 + 0.5, y + k / 4 + 0.5}));
    }
  }
  return rays;
}

std::vector<Measurement> bench_climate(const Options&);

std::vector<Measurement> bench_climate(const Options& options) {
  std::vector<Measurement> out;
  for (const int size : options.sizes) {
    const Dem dem = make_bench_dem(size);
    // At the centre of the Alps, one degree from south to north.
    MapPosition position;
    position.width = position.height = size;
    position.cell_m = {dem.transform.cell_x, dem.transform.cell_y};
    position.latitude_deg = {.at_first = 47.5, .per_column = 0.0, .per_row = -1.0 / size};
    const std::vector<Cost> cost = measure_fastest(
        options.repeats, {[&] { potential_radiation(dem.altitude_m, position, {}); },
                          [&] { upslope_rain(dem.altitude_m, position.cell_m, {}); }});
    const double megacells = static_cast<double>(dem.altitude_m.size()) * 1e-6;
    out.push_back(
        {fmt::format("{}²/radiation_of_a_year", size), cost[0].cpu_s / megacells, "CPU s/Mcell"});
    out.push_back(
        {fmt::format("{}²/upslope_rain", size), cost[1].cpu_s / megacells, "CPU s/Mcell"});
  }
  return out;
}

std::vector<Measurement> bench_deform(const Options&);

std::vector<Measurement> bench_deform(const Options& options) {
  std::vector<Measurement> out;
  for (const int size : options.sizes) {
    const Dem dem = make_bench_dem(size);
    const double side_m = size * dem.cell_m();
    const glm::dvec2 north = dem.transform.to_crs(0.5 * size, 0.0);
    const glm::dvec2 viewer(north.x, north.y + 0.4 * side_m);
    DeformParameters bent;
    bent.exaggeration = 1.6;
    bent.earth_curvature = true;
    bent.bend.points = {{0.4 * side_m, std::nullopt, 20.0},
                        {0.7 * side_m, std::nullopt, 12.0},
                        {side_m, std::nullopt, 6.0},
                        {1.4 * side_m, std::nullopt, 0.0}};
    // Three handles and three summits, each with a radius of a twentieth of the terrain.
    DeformParameters moved = bent;
    for (int i = 0; i < 3; ++i) {
      const glm::dvec2 position =
          dem.transform.to_crs(size * (0.25 + 0.25 * i), size * (0.3 + 0.2 * i));
      moved.handles.push_back({.centre = position,
                               .rotate_deg = 50.0,
                               .radius_m = 0.125 * side_m,
                               .core_m = 0.06 * side_m});
      moved.summits.push_back(
          {{position.x + 0.1 * side_m, position.y}, 0.125 * side_m, 1.3, 500.0});
    }
    const auto run = [&](const DeformParameters& parameters) {
      deform(dem.altitude_m, dem.transform, viewer, {viewer, 0.0}, parameters);
    };
    const std::vector<Cost> cost =
        measure_fastest(options.repeats, {[&] { run(bent); }, [&] { run(moved); }});
    const double cells = static_cast<double>(dem.altitude_m.size());
    out.push_back({fmt::format("{}²/bend", size), cells / cost[0].cpu_s * 1e-6, "Mcells/CPU s"});
    out.push_back({fmt::format("{}²/bend_handles_summits", size), cells / cost[1].cpu_s * 1e-6,
                   "Mcells/CPU s"});
  }
  return out;
}

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

std::vector<Measurement> bench_files(const Options&);

namespace {

// Smooth shapes with some grain, like a painting: neither noise nor one colour, so that compression
// has its usual work.
float shade(int x, int y, std::uint64_t channel) {
  const double smooth = 0.5 + 0.3 * std::sin(x * 0.01) * std::cos(y * 0.013);
  return static_cast<float>(smooth + 0.1 * random_uniform(1, x / 3, y / 3, channel) +
                            0.01 * random_uniform(2, x, y, channel));
}

Grid<glm::vec3> make_picture(int width, int height) {
  Grid<glm::vec3> out(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      out(x, y) = glm::vec3(shade(x, y, 0), shade(x, y, 1), shade(x, y, 2));
  }
  return out;
}

// The channels that are largest in a file: distances, positions, directions, ids, tone.
GuidanceBuffers make_guidance(int width, int height) {
  GuidanceBuffers g;
  g.depth_m = Grid<float>(width, height);
  g.altitude_m = Grid<float>(width, height);
  g.tone = Grid<float>(width, height);
  g.position_m = Grid<glm::vec3>(width, height);
  g.normal = Grid<glm::vec3>(width, height);
  g.land_cover = Grid<LandCoverClass>(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      g.depth_m(x, y) = 1e4f * shade(x, y, 3);
      g.altitude_m(x, y) = 2e3f * shade(x, y, 4);
      g.tone(x, y) = shade(x, y, 5);
      g.position_m(x, y) =
          glm::vec3(20.0f * static_cast<float>(x), 1e4f * shade(x, y, 3), 2e3f * shade(x, y, 4));
      g.normal(x, y) = glm::vec3(shade(x, y, 6) - 0.5f, shade(x, y, 7) - 0.5f, 0.8f);
      g.land_cover(x, y) = static_cast<LandCoverClass>((x / 50 + y / 30) % land_cover_class_count);
    }
  }
  return g;
}

}  // namespace

// Megabytes are those of the values before compression, in the types of the file. The time includes
// the check of what was written.
std::vector<Measurement> bench_files(const Options& options) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("belvedere-bench-{}", ::getpid());
  std::filesystem::create_directories(folder);
  const std::string path = folder.string() + "/";
  std::vector<Measurement> out;
  for (const int size : options.sizes) {
    const Grid<glm::vec3> picture = make_picture(size, size / 2);
    const GuidanceBuffers guidance = make_guidance(size, size / 2);
    const double pixels = static_cast<double>(picture.size());
    struct File {
      const char* name;
      double bytes;  // a pixel
      std::function<void()> work;
    };
    const std::vector<File> files = {
        {"tiff_write", 6.0, [&] { write_tiff16(path + "a.tif", picture, {}); }},
        {"png_write", 3.0, [&] { write_png8(path + "a.png", picture, {}); }},
        {"exr_write", 6.0, [&] { write_exr(path + "a.exr", picture, {}); }},
        {"guidance_write", 32.0, [&] { write_guidance(path + "g.exr", guidance, {}); }},
        {"tiff_read", 6.0, [&] { read_picture(path + "a.tif"); }},
        {"guidance_read", 32.0, [&] { read_guidance(path + "g.exr"); }},
    };
    for (const File& file : files) {
      const Cost cost = measure_fastest(options.repeats, {file.work})[0];
      out.push_back({fmt::format("{}/{}", size, file.name), pixels * file.bytes / cost.cpu_s * 1e-6,
                     "MB/CPU s"});
      out.push_back({fmt::format("{}/{}_wall", size, file.name),
                     pixels * file.bytes / cost.wall_s * 1e-6, "MB/s"});
    }
  }
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
  return out;
}

}  // namespace belvedere::bench
