#include "terrain/layers/layer_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

SurfaceLayers one_colour(std::uint32_t rgb) {
  SurfaceLayers layers;
  layers.ground_rgb = rgb;
  layers.inputs = {{"altitude", 0.0, 1000.0}};
  layers.layers.resize(1);
  layers.layers[0].name = "nowhere";
  layers.layers[0].functions = {LayerHat{4000.0, 5000.0, 0.0, 0.0}};
  return layers;
}

Grid<glm::vec3> drawn(const Dem& dem, const SurfaceLayers& layers,
                      const LayerPictureParameters& parameters) {
  Grid<glm::vec3> all(dem.width() * parameters.finer, dem.height() * parameters.finer);
  draw_layer_picture(
      layers, dem, {}, parameters,
      [&](int y0, const Grid<glm::vec3>& rows) {
        std::copy(rows.begin(), rows.end(), all.row(y0));
      },
      silent_progress());
  return all;
}

Dem ramp(int size, float rise_east, float rise_south) {
  Dem dem;
  dem.altitude_m = Grid<float>(size, size);
  dem.filled = Grid<std::uint8_t>(size, size, 0);
  dem.transform = {1000.0, 5000.0, 10.0, 10.0};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      dem.altitude_m(x, y) =
          400.F + 10.F * (rise_east * static_cast<float>(x) + rise_south * static_cast<float>(y));
  return dem;
}

// Lambert's cosine over that of level ground: level ground keeps its colour, a slope that faces
// light 45° high gets √2 of it, one that faces away only the shade.
TEST(LayerPicture, BrightnessIsLambertsCosine) {
  const LayerPictureParameters light{.light_from = 90.0, .light_height = 45.0, .shade = 0.25};
  EXPECT_NEAR(SlopeLight(light).brightness({0.F, 0.F, 1.F}), 1.0, 1e-6);
  const float half = std::sqrt(0.5F);
  EXPECT_NEAR(SlopeLight(light).brightness({half, 0.F, half}), 0.25 + 0.75 * std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(SlopeLight(light).brightness({-half, 0.F, half}), 0.25, 1e-6);
  LayerPictureParameters twice = light;
  twice.relief = 2.0;
  const glm::vec3 gentle = glm::normalize(glm::vec3(0.2F, 0.1F, 1.F));
  const glm::vec3 steep = glm::normalize(glm::vec3(0.4F, 0.2F, 1.F));
  EXPECT_NEAR(SlopeLight(twice).brightness(gentle), SlopeLight(light).brightness(steep), 1e-6);
}

TEST(LayerPicture, APlaneHasOneColourAtAnyFineness) {
  const Dem plane = ramp(60, 0.3F, 0.F);  // rises to the east: turned to light from the west
  for (const int finer : {1, 3, 8}) {
    const LayerPictureParameters parameters{.finer = finer, .light_from = 270.0};
    const Grid<glm::vec3> picture = drawn(plane, one_colour(0x804020), parameters);
    const float brightness =
        SlopeLight(parameters).brightness(glm::normalize(glm::vec3(-0.3F, 0.F, 1.F)));
    EXPECT_GT(brightness, 1.1F);
    const glm::vec3 centre = picture(30 * finer, 30 * finer);
    EXPECT_NEAR(centre.x, 128.F * brightness, 0.3F) << finer;
    EXPECT_NEAR(centre.y, 64.F * brightness, 0.3F) << finer;
  }
}

// A level lake in a bowl: pale at its shore, deep at the centre; without beds it is its layers'
// ground.
TEST(LayerPicture, LakesShowTheirBeds) {
  Dem bowl = ramp(120, 0.F, 0.F);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 120; ++x) {
      const double out = std::hypot(x - 60.0, y - 60.0);
      if (out > 35.0) bowl.altitude_m(x, y) = static_cast<float>(400.0 + 3.0 * (out - 35.0));
    }
  const LayerPictureParameters parameters{.finer = 2};
  const SurfaceLayers brown = one_colour(0x806040);
  const Grid<glm::vec3> seen = drawn(bowl, brown, parameters);
  const auto luminance = [](const glm::vec3& c) { return c.x + c.y + c.z; };
  EXPECT_GT(seen(120, 120).z, seen(120, 120).x);  // blue
  EXPECT_LT(luminance(seen(120, 120)), luminance(seen(120 - 64, 120)));
  LayerPictureParameters bare = parameters;
  bare.beds = false;
  EXPECT_NEAR(drawn(bowl, brown, bare)(120, 120).x, 128.F, 0.5F);
}

TEST(LayerPicture, ThreadsLeaveNoTrace) {
  Dem rough = ramp(150, 0.1F, 0.2F);
  SurfaceLayers layers = one_colour(0x608040);
  layers.layers[0].name = "stones";
  layers.layers[0].rgb = 0xc0c0c0;
  layers.layers[0].roughness_m = 3.0;
  layers.layers[0].noise = {40.0, 3, 0.5, 0.6};
  layers.layers[0].functions = {LayerHat{0.0, 500.0, 1.0, 50.0}};
  const LayerPictureParameters parameters{.finer = 4, .seed = 5};
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return drawn(rough, layers, parameters);
  };
  const Grid<glm::vec3> one = with(1);
  EXPECT_EQ(one, with(2));
  // The layer's bumps are lit.
  LayerPictureParameters flat = parameters;
  flat.relief = 0.0;
  EXPECT_NE(one, drawn(rough, layers, flat));
}

TEST(LayerPicture, SaysWhatIsAllowed) {
  EXPECT_THROW(check_layer_picture({.finer = 0}), Error);
  EXPECT_THROW(check_layer_picture({.finer = 17}), Error);
  EXPECT_THROW(check_layer_picture({.light_height = 4.0}), Error);
  EXPECT_THROW(check_layer_picture({.shade = 1.5}), Error);
  EXPECT_NO_THROW(check_layer_picture({}));
  EXPECT_THROW(drawn(ramp(4, 0.F, 0.F), SurfaceLayers(), {}), Error);
}

}  // namespace
}  // namespace belvedere
