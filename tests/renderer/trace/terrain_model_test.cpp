#include "renderer/trace/terrain_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/guidance_channels.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/guidance_ground.h"

namespace belvedere {
namespace {

constexpr double cell_m = 30.0;

template <class Altitude>
TerrainModel model_of(int width, int height, Altitude&& altitude) {
  Raster<float> raster;
  raster.transform = {650000.0, 5320000.0, cell_m, cell_m};
  raster.cells = Grid<float>(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) raster.cells(x, y) = static_cast<float>(altitude(x, y));
  LandCover land_cover;
  land_cover.classes.transform = raster.transform;
  land_cover.classes.cells = Grid<LandCoverClass>(width, height, LandCoverClass::alpine_grass);
  Dem dem = make_dem(std::move(raster));
  Grid<float> generalized = dem.altitude_m;
  return make_terrain_model(std::make_shared<const Dem>(std::move(dem)), std::move(generalized),
                            std::make_shared<const LandCover>(std::move(land_cover)), 1.0);
}

TEST(TerrainModel, LandCoverWithoutCellsIsRefused) {
  Raster<float> raster;
  raster.transform = {650000.0, 5320000.0, cell_m, cell_m};
  raster.cells = Grid<float>(4, 4, 500.F);
  const auto dem = std::make_shared<const Dem>(make_dem(std::move(raster)));
  EXPECT_THROW(make_terrain_model(dem, dem->altitude_m, std::make_shared<const LandCover>(), 1.0),
               Error);
}

TEST(TerrainModel, FlowOnATiltedPlaneIsTheLogarithmOfTheStripAbove) {
  // Falls to the south: each column of cells drains by itself, and row y has y + 1 cells above it
  // and in it.
  const TerrainModel model = model_of(9, 60, [](int, int y) { return 500.0 - 3.0 * y; });
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 9; ++x)
      EXPECT_NEAR(model.flow(x, y), std::log10(cell_m * cell_m * (y + 1)), 1e-5) << x << ' ' << y;
}

TEST(TerrainModel, FlowGathersInAValley) {
  // Flanks 1 in 2 and a floor that falls to the south, where all of 61 × 80 cells drain except for
  // what leaves at the sides.
  const TerrainModel model =
      model_of(61, 80, [](int x, int y) { return 900.0 - y + 15.0 * std::abs(x - 30); });
  EXPECT_NEAR(model.flow(30, 79), std::log10(61.0 * 80.0 * cell_m * cell_m), 0.01);
  EXPECT_LT(model.flow(5, 40), std::log10(6.0 * cell_m * cell_m));
}

TEST(TerrainModel, FlowIsReadWhereTheGroundCameFrom) {
  TerrainModel model = model_of(40, 60, [](int, int y) { return 500.0 - 3.0 * y; });
  const glm::dvec2 viewer{650600.0, 5319000.0};
  const DeformedSurface surface =
      deform(model.generalized_m, model.dem->transform, viewer, {viewer, 0.0}, DeformParameters{});
  CameraParameters p;
  p.width = p.height = 16;
  p.eye = {650600.0, 5323000.0, 3500.0};
  p.azimuth_deg = 180.0;
  const auto camera = make_camera(p);
  const auto flow_at = [&](double column, double row) {
    GuidanceBuffers out;
    for (const GuidanceChannel& channel : guidance_channels())
      fill_channel(out, channel, 1, 1, channel.sky);
    sample_ground(model, surface, *camera, column, row, out, 0);
    return out.flow[0];
  };
  EXPECT_NEAR(flow_at(20.0, 29.0), std::log10(30.0 * cell_m * cell_m), 1e-5);
  EXPECT_NEAR(flow_at(20.3, 29.5), 0.5 * std::log10(30.0 * 31.0) + std::log10(cell_m * cell_m),
              1e-5)
      << "the mean of the logarithms";
  model.came_from = Grid<glm::vec2>(
      40, 60, glm::vec2(0.F, -10.F));  // all of it ten cells farther south than it was
  EXPECT_NEAR(flow_at(20.0, 29.0), std::log10(20.0 * cell_m * cell_m), 1e-5);
}

}  // namespace
}  // namespace belvedere
