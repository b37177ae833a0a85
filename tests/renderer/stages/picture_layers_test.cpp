#include "renderer/stages/picture_layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/random.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

constexpr int width = 40;
constexpr int height = 30;
constexpr PixelRect position{2, 3, 2 + width,
                             3 + height};  // of the picture among the pixels that parts hold

double draw(int a, int b, std::uint64_t n) { return random_uniform(7, a, b, n); }

// A canvas under strokes of all parts in any order, as a painting would leave it.
struct PaintedCanvas {
  Grid<glm::vec3> bare{width, height};
  Grid<glm::vec3> picture{width, height};
  Grid<float> haze{width, height, 0.25F};
  MistPaint mist{Grid<float>(width, height), Grid<glm::vec3>(width, height)};
  PaintParts parts{{0, 0, width + 4, height + 5}};
  GuidanceBuffers guidance;
  PaintedCanvas() {
    guidance.depth_m = Grid<float>(width, height, 1000.0F);
    guidance.land_cover = Grid<LandCoverClass>(width, height, LandCoverClass::forest);
    guidance.shadow = Grid<float>(width, height, 0.75F);
    guidance.tone = Grid<float>(width, height, 0.5F);
    for (const auto [x, y] : test::cells(width, height)) {
      const std::size_t i = bare.index(x, y);
      if (y < 5) guidance.depth_m[i] = std::numeric_limits<float>::infinity();
      if (x < 10) guidance.land_cover[i] = LandCoverClass::water;
      if (x > 30) guidance.land_cover[i] = LandCoverClass::glacier;
      for (int c = 0; c < 3; ++c)
        bare[i][c] = static_cast<float>(draw(x, y, static_cast<std::uint64_t>(c)));
      mist.share[i] = y < 15 ? static_cast<float>(draw(x, y, 5)) : 0.F;
      mist.colour[i] = {0.8F, static_cast<float>(draw(x, y, 6)), 0.9F};
      picture[i] = bare[i] + mist.share[i] * (mist.colour[i] - bare[i]);
      for (std::uint64_t s = 0; s < 12; ++s) {
        const auto alpha = static_cast<float>(draw(x, y, 10 + s));
        const glm::vec3 colour(static_cast<float>(draw(x, y, 30 + s)),
                               static_cast<float>(draw(x, y, 50 + s)), 0.4F);
        const auto part = static_cast<PaintPart>(static_cast<int>(draw(x, y, 70 + s) * 7.0));
        if (draw(x, y, 90 + s) < 0.5) continue;
        picture[i] += alpha * (colour - picture[i]);
        parts.cover(x + position.x0, y + position.y0, part, alpha, colour);
      }
    }
  }
  PictureLayers cut(const Grid<glm::vec3>& finished) const {
    return cut_layers(bare, mist, parts, position, guidance, haze, finished);
  }
};

Grid<glm::dvec3> flatten(const PictureLayers& layers) {
  Grid<glm::dvec3> out(width, height, glm::dvec3(0.0));
  for (const PictureLayer& layer : picture_layers()) {
    if (layer.mask) continue;
    const Grid<LayerPixel> pixels =
        make_layer(layer, layers.planes[layer.plane], layers.planes[about_plane]);
    for (std::size_t i = 0; i < out.size(); ++i) lay_over(out[i], pixels[i]);
  }
  return out;
}

double max_off(const Grid<glm::dvec3>& flat, const Grid<glm::vec3>& finished) {
  double off = 0.0;
  for (std::size_t i = 0; i < flat.size(); ++i)
    for (int c = 0; c < 3; ++c)
      off = std::max(
          off, std::abs(flat[i][c] - std::clamp(static_cast<double>(finished[i][c]), 0.0, 1.0)));
  return off * 65535.0;
}

std::size_t plane_of_layer(const std::string& name) {
  return std::find_if(picture_layers().begin(), picture_layers().end(),
                      [&](const PictureLayer& one) { return one.name == name; })
      ->plane;
}

std::size_t seen(const Grid<LayerPixel>& layer) {
  return static_cast<std::size_t>(
      std::count_if(layer.begin(), layer.end(), [](const LayerPixel& p) { return p[3] != 0; }));
}

TEST(PictureLayers, FlattenToThePictureWithoutCorrections) {
  const PaintedCanvas painted;
  const PictureLayers layers = painted.cut(painted.picture);
  EXPECT_LT(max_off(flatten(layers), painted.picture), flatten_steps + 1.0);
  EXPECT_EQ(seen(layers.planes[about_plane - 1]), 0U) << "strokes alone are sufficient";
}

// Softened edges and clamped colours are not sums of strokes.
TEST(PictureLayers, WhatStrokesCannotSayLiesOnTop) {
  const PaintedCanvas painted;
  Grid<glm::vec3> finished = painted.picture;
  finished(3, 3) = {0.1F, 0.9F, 0.2F};
  finished(20, 20) = {1.2F, -0.1F, 0.5F};
  const PictureLayers layers = painted.cut(finished);
  EXPECT_LT(max_off(flatten(layers), finished), flatten_steps + 1.0);
  EXPECT_EQ(seen(layers.planes[about_plane - 1]), 2U);
}

TEST(PictureLayers, LayersOfTheGroundAndMasksAreWhereTheirClassIs) {
  const PaintedCanvas painted;
  const PictureLayers layers = painted.cut(painted.picture);
  const auto layer = [&](const std::string& name) {
    const auto found = std::find_if(picture_layers().begin(), picture_layers().end(),
                                    [&](const PictureLayer& one) { return one.name == name; });
    return make_layer(*found, layers.planes[found->plane], layers.planes[about_plane]);
  };
  EXPECT_EQ(seen(layer("ground")), static_cast<std::size_t>(width * height));
  EXPECT_EQ(seen(layer("sky")), static_cast<std::size_t>(width * 5));
  EXPECT_NEAR(static_cast<double>(seen(layer("mist"))), width * 15, 2.0);
  EXPECT_EQ(seen(layer("water")), static_cast<std::size_t>(10 * (height - 5)));
  EXPECT_EQ(seen(layer("class_water")), static_cast<std::size_t>(10 * (height - 5)));
  EXPECT_EQ(seen(layer("snow_and_ice")), static_cast<std::size_t>(9 * (height - 5)));
  EXPECT_EQ(layer("mask_shadow")(15, 15)[3], 16384);  // a quarter is in cast shadow
  EXPECT_EQ(layer("mask_air")(15, 15)[3], 16384);
  EXPECT_EQ(layer("mask_light")(15, 15)[3], 32768);
  EXPECT_EQ(layer("mask_light")(15, 2)[3], 0) << "sky has no light of the ground";
}

// Strokes of the ground can be changed class by class: each pixel's are in one layer, whatever its
// class.
TEST(PictureLayers, EachPixelsStrokesLieInTheLayerOfItsClass) {
  const PaintedCanvas painted;
  const PictureLayers layers = painted.cut(painted.picture);
  std::size_t apart = 0;
  std::set<std::string> seen_in;
  for (const PictureLayer& layer : picture_layers()) {
    if (layer.plane != plane_of_layer("strokes_ground")) continue;
    const std::size_t count =
        seen(make_layer(layer, layers.planes[layer.plane], layers.planes[about_plane]));
    if (count > 0) seen_in.insert(layer.name);
    apart += count;
  }
  EXPECT_EQ(apart, seen(layers.planes[plane_of_layer("strokes_ground")]));
  EXPECT_EQ(seen_in, (std::set<std::string>{"strokes_forest", "strokes_water", "strokes_ground"}))
      << "glaciers and sky are other ground";
}

TEST(PictureLayers, NamesAreOnesOwn) {
  std::set<std::string> names;
  for (const PictureLayer& layer : picture_layers())
    EXPECT_TRUE(names.insert(layer.name).second) << layer.name;
}

}  // namespace
}  // namespace belvedere
