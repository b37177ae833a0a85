#include "texture/segment/piece_features.h"

#include <gtest/gtest.h>

#include <cmath>

namespace belvedere {
namespace {

// Vertical bands of 20 pixels, each a piece of one colour.
struct Bands {
  Grid<glm::vec3> picture;
  Superpixels pieces;
};
Bands make_bands(const std::vector<glm::vec3>& colours) {
  const int width = 20 * static_cast<int>(colours.size());
  Bands out{Grid<glm::vec3>(width, 40), {Grid<std::uint16_t>(width, 40), colours.size()}};
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < width; ++x) {
      out.picture(x, y) = colours[static_cast<std::size_t>(x / 20)];
      out.pieces.of(x, y) = static_cast<std::uint16_t>(x / 20);
    }
  return out;
}

// No blur, no texture, no position: the rest is known.
constexpr PieceDistanceParameters plain = {.colour_blur_px = 0.0,
                                           .lightness_gain = 10.0,
                                           .colour_gain = 40.0,
                                           .texture_gain = 0.0,
                                           .down_gain = 0.0,
                                           .across_gain = 0.0,
                                           .border_blur_px = 0.0,
                                           .way_gain = 0.0,
                                           .neighbour_gain = 0.0};

TEST(PieceFeatures, FlatColoursAreAsFarApartAsTheyAre) {
  const Bands bands = make_bands({{.5F, 0.F, 0.F}, {.8F, 0.F, 0.F}, {.5F, .1F, 0.F}});
  const PieceFeatures features = measure_pieces(bands.picture, bands.pieces, plain);
  EXPECT_NEAR(features.distance(0, 1), 3.0, 1e-5);
  EXPECT_NEAR(features.distance(0, 2), 4.0, 1e-5);
  EXPECT_NEAR(features.distance(1, 2), 5.0, 1e-5);
  EXPECT_EQ(features.pixels, (std::vector<double>{800, 800, 800}));
}

TEST(PieceFeatures, PlaceCountsByItsGain) {
  const Bands bands = make_bands({glm::vec3(.5F), glm::vec3(.5F)});
  PieceDistanceParameters parameters = plain;
  parameters.across_gain = 0.6;
  EXPECT_NEAR(measure_pieces(bands.picture, bands.pieces, parameters).distance(0, 1), 0.3, 1e-12);
}

TEST(PieceFeatures, TextureOfEqualColourTellsPiecesApartAndItsDirection) {
  Bands bands = make_bands(
      {glm::vec3(.5F, 0, 0), glm::vec3(.5F, 0, 0), glm::vec3(.5F, 0, 0), glm::vec3(.5F, 0, 0)});
  for (int y = 0; y < 40; ++y)
    for (int x = 20; x < 60; ++x)
      bands.picture(x, y).x +=
          (x < 40 ? y : x) / 2 % 2 == 0 ? .1F : -.1F;  // lines along rows, then columns
  PieceDistanceParameters parameters = plain;
  parameters.texture_gain = 1.0;
  parameters.lightness_gain = 0.0;
  const PieceFeatures features = measure_pieces(bands.picture, bands.pieces, parameters);
  EXPECT_GT(features.distance(0, 1), 1.0);
  EXPECT_GT(features.distance(1, 2), 1.0);
}

// Equal colours, one beyond a bar of another: the path crosses two borders.
TEST(PieceFeatures, ContoursBetweenPartThem) {
  const Bands bands = make_bands({{.5F, 0.F, 0.F}, {.6F, 0.F, 0.F}, {.5F, 0.F, 0.F}});
  PieceDistanceParameters parameters = plain;
  parameters.way_gain = 0.5;
  parameters.way_free = 0.2;
  const PieceFeatures features = measure_pieces(bands.picture, bands.pieces, parameters);
  // Each border is a step of 10 · .1 = 1, minus the free part.
  EXPECT_NEAR(piece_distances(bands.picture, bands.pieces, features, parameters)(0, 2),
              0.5 * 2.0 * 0.8, 1e-5);
  parameters.way_max = 1.0;
  EXPECT_NEAR(piece_distances(bands.picture, bands.pieces, features, parameters)(0, 2), 0.5, 1e-5);
}

TEST(PieceFeatures, NeighboursWithoutContourAreCloser) {
  const Bands bands = make_bands({{.5F, 0.F, 0.F}, {.6F, 0.F, 0.F}, {.5F, 0.F, 0.F}});
  PieceDistanceParameters parameters = plain;
  parameters.neighbour_gain = 1.0;
  parameters.neighbour_step = 2.0;
  const PieceFeatures features = measure_pieces(bands.picture, bands.pieces, parameters);
  const PairWeights distance = piece_distances(bands.picture, bands.pieces, features, parameters);
  EXPECT_NEAR(distance(0, 1), 1.0 - (2.0 - 1.0), 1e-5);
  EXPECT_NEAR(distance(0, 2), 0.0, 1e-5);
}

}  // namespace
}  // namespace belvedere
