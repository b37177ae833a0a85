#include "terrain/layers/layer_apply.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/error.h"
#include "base/filter.h"
#include "base/parallel.h"
#include "terrain/layers/layer_coverage.h"
#include "terrain/layers/layer_noise.h"

namespace belvedere {
namespace {

constexpr int tile_cells = 512;
// Samples for sharpening: patches of the region, spread evenly.
constexpr int sample_patches = 16;  // across and down
constexpr int sample_cells = 16;    // a patch's side

// Shares of the classes in a rectangle.
std::vector<Grid<float>> shares_of(const LayerProgram& program,
                                   const std::vector<Grid<float>>& coverage) {
  return class_shares(program, layer_shares(program, coverage));
}

LayerDrawing plan_drawing(const LayerProgram& program, const LayerGround& ground,
                          const LayerApplyParameters& parameters) {
  const Dem& dem = *ground.dem;
  const int width = std::min(sample_cells, dem.width());
  const int height = std::min(sample_cells, dem.height());
  constexpr int patches = sample_patches * sample_patches;
  std::vector<Grid<float>> all(static_cast<std::size_t>(land_cover_class_count),
                               Grid<float>(width, height * patches));
  parallel_ranges(patches, 1, [&](int begin, int end) {
    for (int p = begin; p != end; ++p) {
      const auto first = [](int i, int count, int size) {
        return static_cast<int>(static_cast<std::int64_t>(count - size) * i / (sample_patches - 1));
      };
      const int x0 = first(p % sample_patches, dem.width(), width);
      const int y0 = first(p / sample_patches, dem.height(), height);
      const PixelRect cells{x0, y0, x0 + width, y0 + height};
      const auto shares =
          shares_of(program, evaluate_layers(program, ground, 1, cells, parameters.seed).coverage);
      for (std::size_t k = 0; k < all.size(); ++k)
        std::copy(shares[k].begin(), shares[k].end(), all[k].row(p * height));
    }
  });
  LayerDrawingParameters drawing = parameters.drawing;
  drawing.seed = parameters.seed;
  return plan_layer_drawing(drawing, all);
}

template <class T>
void put(const Grid<T>& part, int x0, Grid<T>& into) {
  for (int y = 0; y < part.height(); ++y) std::copy_n(part.row(y), part.width(), into.row(y) + x0);
}

std::uint8_t byte_of(float value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0.F, 255.F) + 0.5F);
}

// Whether a layer adds bumps to the ground.
bool is_rough(const LayerProgram& program, std::size_t layer) {
  return program.paints[layer] && program.layers.layers[layer].roughness_m > 0.0;
}

// The lake beds, and bumps without any cover yet.
GroundRelief make_relief(const LayerProgram& program, const Dem& dem, std::uint64_t seed) {
  GroundRelief relief{dem.transform, {}, lake_depth_m(dem)};
  for (std::size_t k = 0; k < program.layers.layers.size(); ++k) {
    const SurfaceLayer& layer = program.layers.layers[k];
    if (is_rough(program, k))
      relief.bumps.push_back({layer.roughness_m, layer.roughness_scale_m, bump_seed(layer, seed),
                              Grid<float>(dem.width(), dem.height())});
  }
  return relief;
}

// Counts per tile, added in the order of tiles.
struct Counts {
  std::vector<std::uint64_t> outside;
  std::array<std::uint64_t, static_cast<std::size_t>(land_cover_class_count)> classes{};
};

Counts apply_tile(const LayerProgram& program, const LayerGround& ground,
                  const LayerDrawing& drawing, const LayerApplyParameters& parameters,
                  const PixelRect& cells, LayerStrip& strip) {
  const GeoTransform& transform = ground.dem->transform;
  const auto [inputs, coverage, altitude_m] =
      evaluate_layers(program, ground, 1, cells, parameters.seed);
  const Grid<LandCoverClass> classes =
      draw_classes(drawing, shares_of(program, coverage), transform, cells);
  put(classes, cells.x0, strip.classes);
  if (parameters.coverage)
    for (std::size_t k = 0; k < coverage.size(); ++k) {
      Grid<std::uint8_t> bytes(cells.width(), cells.height());
      for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = byte_of(255.F * coverage[k][i]);
      put(bytes, cells.x0, strip.coverage[k]);
    }
  if (parameters.relief) {
    std::size_t rough = 0;
    for (std::size_t k = 0; k < coverage.size(); ++k)
      if (is_rough(program, k)) put(coverage[k], cells.x0, strip.bumps[rough++]);
  }
  if (parameters.colour) {
    const Grid<glm::vec3> colour =
        layer_colour(program, coverage, parameters.relief ? LayersShown::dry : LayersShown::all);
    for (int c = 0; c < 3; ++c) {
      Grid<std::uint8_t> bytes(cells.width(), cells.height());
      for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = byte_of(colour[i][c]);
      put(bytes, cells.x0, strip.colour[static_cast<std::size_t>(c)]);
    }
  }
  Counts counts;
  for (const double share : share_outside(program, inputs))
    counts.outside.push_back(
        static_cast<std::uint64_t>(std::llround(share * static_cast<double>(classes.size()))));
  for (const LandCoverClass id : classes) ++counts.classes[static_cast<std::size_t>(id)];
  return counts;
}

}  // namespace

LayerDrawing plan_drawing(const SurfaceLayers& layers, const Dem& dem, const LayerClimate& climate,
                          const LayerApplyParameters& parameters) {
  const LayerProgram program = compile_layers(layers);
  return plan_drawing(program, make_layer_ground(dem, climate, program.inputs, parameters.whole),
                      parameters);
}

LayerApplyResult apply_layers(const SurfaceLayers& layers, const Dem& dem,
                              const LayerClimate& climate, const LayerApplyParameters& parameters,
                              const std::function<void(const LayerStrip&)>& take,
                              Progress& progress) {
  check_layer_drawing(parameters.drawing);
  if (layers.layers.empty())
    throw Error(ErrorKind::usage, layers.name.empty() ? "layers" : layers.name, "no layers",
                "at least one layer");
  const LayerProgram program = compile_layers(layers);
  progress.begin("sampling the ground", 0.0);
  const LayerGround ground = make_layer_ground(dem, climate, program.inputs, parameters.whole);
  const LayerDrawing drawing =
      parameters.drawn ? *parameters.drawn : plan_drawing(program, ground, parameters);

  const int width = dem.width();
  const int across = (width + tile_cells - 1) / tile_cells;
  Counts all;
  all.outside.assign(layers.inputs.size(), 0);
  progress.begin("applying layers", static_cast<double>(dem.altitude_m.size()));
  for (int y0 = 0; y0 < dem.height(); y0 += tile_cells) {
    const int height = std::min(tile_cells, dem.height() - y0);
    LayerStrip strip{y0, Grid<LandCoverClass>(width, height), {}, {}, {}};
    if (parameters.relief)
      for (std::size_t k = 0; k < layers.layers.size(); ++k)
        if (is_rough(program, k)) strip.bumps.emplace_back(width, height);
    if (parameters.colour) strip.colour.assign(3, Grid<std::uint8_t>(width, height));
    if (parameters.coverage)
      strip.coverage.assign(layers.layers.size(), Grid<std::uint8_t>(width, height));
    std::vector<Counts> counts(static_cast<std::size_t>(across));
    parallel_ranges(across, 1, [&](int begin, int end) {
      for (int i = begin; i != end; ++i) {
        const PixelRect cells{i * tile_cells, y0, std::min(width, (i + 1) * tile_cells),
                              y0 + height};
        counts[static_cast<std::size_t>(i)] =
            apply_tile(program, ground, drawing, parameters, cells, strip);
        progress.advance(static_cast<double>(cells.width()) * cells.height());
      }
    });
    for (const Counts& tile : counts) {
      for (std::size_t i = 0; i < all.outside.size(); ++i) all.outside[i] += tile.outside[i];
      for (std::size_t k = 0; k < all.classes.size(); ++k) all.classes[k] += tile.classes[k];
    }
    take(strip);
  }
  LayerApplyResult result;
  const auto cells = static_cast<double>(dem.altitude_m.size());
  for (const std::uint64_t count : all.outside)
    result.outside.push_back(static_cast<double>(count) / cells);
  for (std::size_t k = 0; k < all.classes.size(); ++k)
    result.class_share[k] = static_cast<double>(all.classes[k]) / cells;
  return result;
}

LandCover layer_land_cover(const SurfaceLayers& layers, const Dem& dem, const LayerClimate& climate,
                           const LayerApplyParameters& parameters, Progress& progress) {
  LandCover cover{{Grid<LandCoverClass>(dem.width(), dem.height()), dem.transform, dem.crs}};
  Grid<LandCoverClass>& cells = cover.classes.cells;
  if (parameters.colour)
    cover.colours = {Grid<GroundColour>(dem.width(), dem.height()), dem.transform, dem.crs};
  if (parameters.relief) cover.relief = make_relief(compile_layers(layers), dem, parameters.seed);
  const auto take = [&](const LayerStrip& strip) {
    std::copy(strip.classes.begin(), strip.classes.end(), cells.row(strip.y0));
    for (std::size_t k = 0; k < strip.bumps.size(); ++k)
      std::copy(strip.bumps[k].begin(), strip.bumps[k].end(),
                cover.relief.bumps[k].share.row(strip.y0));
    if (!parameters.colour) return;
    GroundColour* colours = cover.colours.cells.row(strip.y0);
    for (std::size_t i = 0; i < strip.classes.size(); ++i)
      colours[i] = GroundColour(strip.colour[0][i], strip.colour[1][i], strip.colour[2][i],
                                std::uint8_t{255});
  };
  const LayerApplyResult result = apply_layers(layers, dem, climate, parameters, take, progress);
  for (const std::string& warning : range_warnings(layers, result)) progress.note(warning);
  if (result.class_share[0] == 0.0) return cover;
  if (result.class_share[0] == 1.0)
    throw Error(ErrorKind::usage, layers.name.empty() ? "layers" : layers.name,
                "no layer with a class covers any of the ground",
                "layers with a class, such as class = \"forest\"");
  Grid<std::uint8_t> known(cells.width(), cells.height());
  for (std::size_t i = 0; i < cells.size(); ++i) known[i] = cells[i] == LandCoverClass::sky ? 0 : 1;
  const Grid<std::int32_t> nearest = nearest_marked(known);
  const Grid<LandCoverClass> drawn = cells;
  for (std::size_t i = 0; i < cells.size(); ++i)
    cells[i] = drawn[static_cast<std::size_t>(nearest[i])];
  return cover;
}

std::vector<std::string> range_warnings(const SurfaceLayers& layers,
                                        const LayerApplyResult& result) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < layers.inputs.size(); ++i) {
    if (!(result.outside[i] > LayerApplyResult::much)) continue;
    const LayerInput& input = layers.inputs[i];
    lines.push_back(
        fmt::format("{:.0f} % of the ground has {} outside {:.4g}…{:.4g}, the range of the layers; "
                    "they extrapolate there",
                    100.0 * result.outside[i], input.name, input.low, input.high));
  }
  return lines;
}

}  // namespace belvedere
