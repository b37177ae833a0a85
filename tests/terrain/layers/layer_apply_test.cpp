#include "terrain/layers/layer_apply.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "terrain/layers/layer_coverage.h"
#include "tests/files.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

// Two tiles and a bit in each direction.
Dem hills() {
  Dem dem;
  dem.altitude_m = Grid<float>(1100, 700);
  dem.filled = Grid<std::uint8_t>(1100, 700, 0);
  dem.transform = {500'000.0, 5'200'000.0, 20.0, 20.0};
  for (const auto [x, y] : test::cells(1100, 700))
    dem.altitude_m(x, y) =
        static_cast<float>(1500.0 + 700.0 * std::sin(x / 80.0) * std::cos(y / 60.0) + 0.5 * x);
  return dem;
}

SurfaceLayers three() {
  SurfaceLayers layers;
  layers.name = "three";
  layers.ground_painted_as = rock;
  layers.inputs = {{"altitude", 0.0, 4000.0}, {"relief_750", -300.0, 300.0}};
  layers.layers.resize(2);
  layers.layers[0].name = "wood";
  layers.layers[0].painted_as = forest;
  layers.layers[0].noise = {300.0, 4, 0.6, 0.8};
  layers.layers[0].functions = {LayerHat{-INFINITY, 1700.0, 0.0, 600.0}, {}};
  layers.layers[1].name = "ice";
  layers.layers[1].painted_as = glacier;
  layers.layers[1].noise = {300.0, 4, 0.6, 0.8};
  layers.layers[1].functions = {LayerHat{2000.0, INFINITY, 500.0, 0.0},
                                LayerHat{-INFINITY, 0.0, 0.0, 80.0}};
  return layers;
}

// The frequency of drawn classes equals their coverage, sharpened or not.
TEST(LayerApply, FrequenciesAreShares) {
  const Dem dem = hills();
  const LayerProgram program = compile_layers(three());
  const LayerGround ground = make_layer_ground(dem, {}, program.inputs);
  const auto coverage =
      layer_coverage(program, layer_inputs(ground), dem.transform, {0, 0, 1100, 700}, 1);
  const auto shares = class_shares(program, layer_shares(program, coverage));
  const LayerApplyResult result = apply_layers(
      three(), dem, {}, {}, [](const LayerStrip&) {}, silent_progress());
  for (const LandCoverClass id : {rock, forest, glacier}) {
    const Grid<float>& share = shares[static_cast<std::size_t>(id)];
    double mean = 0.0;
    for (const float s : share) mean += static_cast<double>(s) / static_cast<double>(share.size());
    EXPECT_GT(mean, 0.015) << class_name(id);
    EXPECT_NEAR(result.class_share[static_cast<std::size_t>(id)], mean, 0.03) << class_name(id);
  }
}

// Additional results of land cover with rough layers: the cover of each, and the beds; layers
// painted as water have no colour of their own then.
TEST(LayerApply, ReliefIsTheCoverageOfRoughLayers) {
  const Dem dem = hills();
  SurfaceLayers layers = three();
  layers.layers[1].roughness_m = 2.0;
  layers.layers[1].roughness_scale_m = 50.0;
  layers.layers[0].painted_as = water;
  layers.layers[0].rgb = 0x0000ff;
  layers.ground_rgb = 0x808080;
  LayerApplyParameters parameters;
  parameters.colour = parameters.relief = true;
  const LandCover cover = layer_land_cover(layers, dem, {}, parameters, silent_progress());
  ASSERT_EQ(cover.relief.bumps.size(), 1U);
  EXPECT_EQ(cover.relief.bumps[0].height_m, 2.0);
  EXPECT_EQ(cover.relief.bumps[0].length_m, 50.0);
  const LayerProgram program = compile_layers(layers);
  const auto coverage =
      layer_coverage(program, layer_inputs(make_layer_ground(dem, {}, program.inputs)),
                     dem.transform, {0, 0, 1100, 700}, 1);
  EXPECT_EQ(cover.relief.bumps[0].share, coverage[1]);
  EXPECT_TRUE(cover.relief.lake_depth_m.same_size(dem.altitude_m));
  for (const GroundColour& colour : cover.colours.cells)
    ASSERT_GE(colour.r + 1, colour.b) << "no blue";
  parameters.relief = false;
  EXPECT_TRUE(
      layer_land_cover(layers, dem, {}, parameters, silent_progress()).relief.lake_depth_m.empty());
}

// Classes, scenes and pictures from above see the same layers: a file with bumps that later layers
// depend on, cell by cell; and between cells a picture agrees where its cells have the same centre,
// without noise.
TEST(LayerApply, PicturesAndScenesAgreeOnACell) {
  Dem dem = hills();
  dem.altitude_m = part_of(dem.altitude_m, {0, 0, 120, 90});
  dem.filled = Grid<std::uint8_t>(120, 90, 0);
  SurfaceLayers layers = three();
  layers.inputs.push_back({"slope", 0.0, 60.0});
  layers.layers[0].functions.emplace_back();
  layers.layers[0].roughness_m = 30.0;
  layers.layers[0].roughness_scale_m = 150.0;
  layers.layers[1].functions = {{}, {}, LayerHat{25.0, INFINITY, 20.0, 0.0}};
  layers.layers[1].when = "altitude > 1500";
  layers.layers[1].roughness_m = 1.0;
  layers.layers[1].roughness_scale_m = 60.0;
  const LayerProgram program = compile_layers(layers);
  const LayerGround ground = make_layer_ground(dem, {}, program.inputs);
  const PixelRect all{0, 0, 120, 90};
  const LayerSurface seen = layer_surface(program, ground, 1, all, 1);
  const LayeredCells layered = evaluate_layers(program, ground, 1, all, 1);
  EXPECT_EQ(seen.altitude_m, layered.altitude_m);
  LayerApplyParameters parameters;
  parameters.colour = true;
  apply_layers(
      layers, dem, {}, parameters,
      [&](const LayerStrip& strip) {
        for (const auto [x, y] : test::cells(120, strip.classes.height()))
          ASSERT_EQ(strip.colour[0](x, y), static_cast<int>(seen.colour(x, strip.y0 + y).x + 0.5F));
      },
      silent_progress());
  parameters.relief = true;
  const LandCover scene = layer_land_cover(layers, dem, {}, parameters, silent_progress());
  ASSERT_EQ(scene.relief.bumps.size(), 2U);
  EXPECT_EQ(scene.relief.bumps[1].share, layered.coverage[1]);
  // The bumps of wood decide where ice lies.
  const auto level = layer_coverage(program, layer_inputs(ground), dem.transform, all, 1);
  double moved = 0.0;
  for (std::size_t i = 0; i < level[1].size(); ++i)
    moved += static_cast<double>(std::abs(level[1][i] - layered.coverage[1][i]));
  EXPECT_GT(moved / static_cast<double>(level[1].size()), 0.01);

  SurfaceLayers plain = three();
  for (SurfaceLayer& layer : plain.layers) layer.noise.amplitude = 0.0;
  const LayerProgram still = compile_layers(plain);
  const LayerGround again = make_layer_ground(dem, {}, still.inputs);
  const LayeredCells coarse = evaluate_layers(still, again, 1, all, 1);
  const LayeredCells fine = evaluate_layers(still, again, 3, {0, 0, 360, 270}, 1);
  for (const auto [x, y] : test::cells({10, 10, 110, 80})) {  // borders are extended
    ASSERT_NEAR(fine.altitude_m(3 * x + 1, 3 * y + 1), coarse.altitude_m(x, y), 2e-3);
    for (std::size_t i = 0; i < coarse.inputs.size(); ++i)
      ASSERT_NEAR(fine.inputs[i](3 * x + 1, 3 * y + 1), coarse.inputs[i](x, y), 2e-3) << i;
    for (std::size_t k = 0; k < 2; ++k)
      ASSERT_NEAR(fine.coverage[k](3 * x + 1, 3 * y + 1), coarse.coverage[k](x, y), 1e-4) << k;
  }
}

// Strips and tiles do not affect the result: coverages and colours are those of the whole, for any
// number of threads.
TEST(LayerApply, TilesAndThreadsLeaveNoTrace) {
  const Dem dem = hills();
  const LayerProgram program = compile_layers(three());
  const LayerGround ground = make_layer_ground(dem, {}, program.inputs);
  const auto coverage = layer_coverage(program, layer_inputs(ground, {0, 0, 1100, 700}),
                                       dem.transform, {0, 0, 1100, 700}, 1);
  LayerApplyParameters parameters;
  parameters.coverage = true;
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    Grid<LandCoverClass> classes(1100, 700);
    apply_layers(
        three(), dem, {}, parameters,
        [&](const LayerStrip& strip) {
          std::copy(strip.classes.begin(), strip.classes.end(), classes.row(strip.y0));
          for (std::size_t k = 0; k < coverage.size(); ++k)
            for (const auto [x, y] : test::cells(1100, strip.coverage[k].height()))
              ASSERT_EQ(strip.coverage[k](x, y),
                        static_cast<int>(255.F * coverage[k](x, strip.y0 + y) + 0.5F))
                  << x << ' ' << y;
        },
        silent_progress());
    return classes;
  };
  EXPECT_EQ(run(1), run(4));
}

TEST(LayerApply, CellsWithoutAClassTakeTheNearest) {
  SurfaceLayers layers = three();
  layers.ground_painted_as.reset();
  const LandCover cover = layer_land_cover(layers, hills(), {}, {}, silent_progress());
  EXPECT_EQ(std::count(cover.classes.cells.begin(), cover.classes.cells.end(), sky), 0);
  EXPECT_EQ(std::count(cover.classes.cells.begin(), cover.classes.cells.end(), rock), 0);
  for (SurfaceLayer& layer : layers.layers) layer.painted_as.reset();
  EXPECT_THROW(layer_land_cover(layers, hills(), {}, {}, silent_progress()), Error);
}

TEST(LayerApply, SettingsAreOfTheFilesParameters) {
  SurfaceLayers layers = three();
  layers.parameters = {{"line_m", 1000.0}};
  set_layer_parameters(layers, {{"line_m", 1200.0}});
  EXPECT_EQ(layers.parameters[0].second, 1200.0);
  const Error error = test::error_of([&] { set_layer_parameters(layers, {{"lime_m", 1.0}}); });
  EXPECT_THAT(error.found(), testing::HasSubstr("did you mean \"line_m\""));
}

}  // namespace
}  // namespace belvedere
