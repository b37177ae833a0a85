#include "renderer/exemplar/classes_by_paint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <glm/geometric.hpp>
#include <set>

#include "base/error.h"
#include "base/land_cover_class.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/exemplar/name_questions.h"
#include "renderer/image/image_io.h"
#include "renderer/image/srgb.h"
#include "tests/paths.h"
#include "texture/segment/segment_figures.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

std::uint8_t number(LandCoverClass id) { return static_cast<std::uint8_t>(id); }

constexpr int class_width = 300;
constexpr int class_height = 180;

// Sky, rock, then meadow with round woods, and a piece of a river.
LandCoverClass truth(int x, int y) {
  if (y < 40) return sky;
  if (y < 80) return rock;
  if (y >= 150 && y < 153 && x < 60) return water;
  const int dx = x % 60 - 30, dy = (y - 80) % 70 - 35;
  return dx * dx + dy * dy < 22 * 22 ? forest : pasture;
}

glm::vec3 paint_of(LandCoverClass id, int x, int y) {
  const auto stroke = 0.1F * static_cast<float>(random_uniform(1, x / 3, y) - 0.5);
  const glm::vec3 colour = id == sky      ? glm::vec3(0.6F, 0.75F, 0.95F)
                           : id == rock   ? glm::vec3(0.5F, 0.45F, 0.45F)
                           : id == forest ? glm::vec3(0.15F, 0.3F, 0.15F)
                           : id == water  ? glm::vec3(0.2F, 0.4F, 0.6F)
                                          : glm::vec3(0.6F, 0.7F, 0.3F);
  return colour + stroke;
}

// The map shows everything `off` pixels too far to the right and below.
struct PaintedGround {
  Grid<glm::vec3> painting{class_width, class_height};
  PlaceClasses places{Grid<std::uint8_t>(class_width, class_height),
                      Grid<float>(class_width, class_height)};
};

PaintedGround painted_ground(int off) {
  PaintedGround out;
  for (int y = 0; y < class_height; ++y)
    for (int x = 0; x < class_width; ++x) {
      out.painting(x, y) = paint_of(truth(x, y), x, y);
      out.places.labels(x, y) = number(truth(std::max(x - off, 0), std::max(y - off, 0)));
      out.places.altitude_m(x, y) = static_cast<float>(2000 - 10 * y);
    }
  return out;
}

double share_right(const Grid<std::uint8_t>& found) {
  double right = 0.0;
  for (int y = 0; y < class_height; ++y)
    for (int x = 0; x < class_width; ++x) right += found(x, y) == number(truth(x, y)) ? 1.0 : 0.0;
  return right / (class_width * class_height);
}

TEST(ClassesByPaint, FollowThePaintWhereTheMapIsOff) {
  const PaintedGround ground = painted_ground(3);
  const double by_map = share_right(ground.places.labels);
  const double by_paint = share_right(classes_by_paint(ground.painting, ground.places));
  EXPECT_LT(by_map, 0.93);
  EXPECT_GT(by_paint, 0.97);
}

TEST(ClassesByPaint, AreThoseOfTheMapWhereItIsRight) {
  const PaintedGround ground = painted_ground(0);
  EXPECT_GT(share_right(classes_by_paint(ground.painting, ground.places)), 0.99);
}

TEST(ClassesByPaint, InventNoClassAndKeepWaterAndUnused) {
  PaintedGround ground = painted_ground(0);
  // The painter's lake, in the colour of water, which the map does not know; woods of the map's
  // class that nothing but three pixels shows.
  for (int y = 90; y < 130; ++y)
    for (int x = 100; x < 140; ++x) ground.painting(x, y) = paint_of(water, x, y);
  for (int x = 10; x < 13; ++x) ground.places.labels(x, 100) = number(glacier);
  for (int y = 60; y < 70; ++y)
    for (int x = 0; x < 10; ++x) ground.places.labels(x, y) = unused_label;
  const Grid<std::uint8_t> found = classes_by_paint(ground.painting, ground.places);
  EXPECT_EQ(std::count(found.begin(), found.end(), number(glacier)), 0);
  for (int x = 0; x < 58; ++x) EXPECT_EQ(found(x, 151), number(water));
  for (int x = 0; x < class_width; ++x) EXPECT_NE(found(x, 110), number(water));
  EXPECT_EQ(found(4, 65), unused_label);
  EXPECT_EQ(std::count(found.begin(), found.end(), number(snow)), 0);
}

TEST(ClassesByPaint, AreTheSameForAnyThreads) {
  const PaintedGround ground = painted_ground(2);
  const Grid<std::uint8_t> all = classes_by_paint(ground.painting, ground.places);
  const ThreadLimit one(1);
  EXPECT_EQ(classes_by_paint(ground.painting, ground.places), all);
}

TEST(ClassesByPaint, FitAPaintingLargerThanTheMapsPicture) {
  const PaintedGround ground = painted_ground(0);
  Grid<glm::vec3> large(2 * class_width, 2 * class_height);
  for (int y = 0; y < large.height(); ++y)
    for (int x = 0; x < large.width(); ++x) large(x, y) = ground.painting(x / 2, y / 2);
  const Grid<std::uint8_t> found = classes_by_paint(large, ground.places);
  double right = 0.0;
  for (int y = 0; y < large.height(); ++y)
    for (int x = 0; x < large.width(); ++x)
      right += found(x, y) == number(truth(x / 2, y / 2)) ? 1.0 : 0.0;
  EXPECT_GT(right / static_cast<double>(large.size()), 0.98);
}

using enum LandCoverClass;

std::uint8_t id(LandCoverClass one) { return static_cast<std::uint8_t>(one); }
glm::dvec3 oklab_of(double r, double g, double b) {
  return to_oklab(glm::vec3(static_cast<float>(r), static_cast<float>(g), static_cast<float>(b)));
}

// Blue sky, snow on rock, dark forest, light meadow, and a lake below.
int part(int y) { return y / 24; }
Grid<glm::vec3> bands() {
  const glm::vec3 colours[5] = {{.55F, .7F, .9F},
                                {.45F, .42F, .42F},
                                {.12F, .25F, .1F},
                                {.6F, .75F, .35F},
                                {.2F, .35F, .55F}};
  Grid<glm::vec3> out(160, 120);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x)
      out(x, y) = colours[part(y)] +
                  glm::vec3(static_cast<float>(random_index(20, 5, x / 2, y / 2)) / 400.F);
  return out;
}

std::vector<std::uint8_t> inferred_class_of(const PaintingSegments& segments, std::size_t count) {
  return name_groups(segments, count, {}).classes;
}

TEST(PaintingSegments, ClassesAreGuessedByPlaceAndColour) {
  const Grid<glm::vec3> picture = bands();
  const PaintingSegments segments = segment_painting(picture, {}, usual_theta, "p.png");
  const Grid<std::uint8_t> mask =
      class_mask(segments, cut_tree(segments.tree, 5), inferred_class_of(segments, 5));
  const LandCoverClass truth[5] = {sky, rock, forest, pasture, water};
  int wrong = 0;
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) wrong += mask(x, y) == id(truth[part(y)]) ? 0 : 1;
  EXPECT_LT(wrong, 160 * 6);
}

TEST(PaintingSegments, GuessesFollowTheirRules) {
  const auto infer = [](glm::dvec3 lab, double height, double edge, double down = 1.0,
                        double rough = 0.5) {
    return static_cast<LandCoverClass>(infer_class({lab, height, edge, 1.0, down, rough}));
  };
  EXPECT_EQ(infer(oklab_of(.5, .65, .9), .2, .5), sky);
  EXPECT_EQ(infer(oklab_of(.95, .95, .95), .2, .5), sky);
  EXPECT_EQ(infer(oklab_of(.95, .95, .95), .7, 0), snow);
  EXPECT_EQ(infer(oklab_of(.8, .8, .78), .6, 0), sky);  // haze over the horizon
  EXPECT_EQ(infer(oklab_of(.8, .8, .78), .6, 0, 1.0, 1.5),
            snow);                                                   // snow among rocks is rougher
  EXPECT_EQ(infer(oklab_of(.5, .55, .6), .3, .06, 1.0, 1.6), rock);  // a cliff in blue shade
  EXPECT_EQ(infer(oklab_of(.58, .56, .48), .2, .1, 1.0, 2.4), forest);  // leaves against the sky
  EXPECT_EQ(infer(oklab_of(.27, .24, .17), .7, 0, 1.0, 1.3), forest);   // under old varnish
  EXPECT_EQ(infer(oklab_of(.56, .45, .42), .9, 0), sand);
  EXPECT_EQ(infer(oklab_of(.5, .65, .9), .7, 0), water);
  EXPECT_EQ(infer(oklab_of(.5, .6, .75), .4, 0, 1.0, 1.0), rock);  // a mountain in blue air
  EXPECT_EQ(infer(oklab_of(.44, .45, .48), .7, 0, 2.0),
            water);  // hardly blue, but strokes are horizontal
  EXPECT_EQ(infer(oklab_of(.44, .45, .48), .7, 0, 1.0), rock);
  EXPECT_EQ(infer(oklab_of(.1, .25, .1), .6, 0), forest);
  EXPECT_EQ(infer(oklab_of(.55, .75, .3), .6, 0), pasture);
  EXPECT_EQ(infer(oklab_of(.85, .75, .55), .6, 0), sand);
}

TEST(PaintingSegments, WhatIsTransparentIsNeverCopiedFrom) {
  const Grid<glm::vec3> picture = bands();
  Grid<float> alpha(160, 120, 1.F);
  alpha(7, 9) = 0.5F;
  const PaintingSegments segments = segment_painting(picture, alpha, usual_theta, "p.png");
  const Grid<std::uint8_t> mask =
      class_mask(segments, cut_tree(segments.tree, 9), inferred_class_of(segments, 9));
  EXPECT_EQ(mask(7, 9), unused_label);
  EXPECT_EQ(std::count(mask.begin(), mask.end(), unused_label), 1);
}

TEST(PaintingSegments, EveryCutGivesEachGroupItsGuess) {
  const PaintingSegments segments = segment_painting(bands(), {}, usual_theta, "p.png");
  ASSERT_EQ(segments.inferred.size(), 2 * segments.tree.pieces - 1);
  for (const std::size_t count : {std::size_t{1}, std::size_t{7}, segments.tree.pieces}) {
    EXPECT_EQ(inferred_class_of(segments, count).size(), count);
    const Partition groups = cut_tree(segments.tree, count);
    EXPECT_EQ(std::set<std::uint16_t>(groups.begin(), groups.end()).size(), count);
  }
}

TEST(PaintingSegments, WhatCannotBeSegmentedIsRefusedByName) {
  const auto refused = [](const Grid<glm::vec3>& picture, const Grid<float>& alpha = {}) {
    try {
      segment_painting(picture, alpha, usual_theta, "some/painting.png");
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refused(Grid<glm::vec3>(90, 20, glm::vec3(.1F))), testing::HasSubstr("90 × 20"));
  EXPECT_THAT(refused(Grid<glm::vec3>(90, 90, glm::vec3(.1F))),
              testing::HasSubstr("single colour"));
  EXPECT_THAT(refused(bands(), Grid<float>(160, 120, 0.F)), testing::HasSubstr("transparent"));
}

// Long and narrow: the short side limits the reduction.
TEST(PaintingSegments, NarrowPaintingsKeepTheirShortSide) {
  Grid<glm::vec3> strip(12000, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 12000; ++x) strip(x, y) = glm::vec3(x < 5000 ? .2F : .7F);
  const PaintingSegments segments = segment_painting(strip, {}, usual_theta, "p.png");
  EXPECT_NE(segments.pieces(4990, 20), segments.pieces(5010, 20));
}

// The paintings whose masks were drawn by hand (five labels in one, four in the other; specks are
// left out).
void expect_agreement(const std::string& name, double merged_of_30, double merged_of_16,
                      double one_to_one_of_6, bool shadow_is_rock) {
  const std::string folder = test::data_folder() + "/paintings/";
  if (!std::filesystem::exists(folder + name + ".jpg"))
    GTEST_SKIP() << folder + name << ".jpg is missing";
  const Grid<glm::vec3> picture = read_picture(folder + name + ".jpg");
  // Drawn in flat colours and then blurred by a camera: the nearest of the main ones counts.
  const Grid<glm::vec3> drawn = read_picture(folder + name + "_labels.png");
  std::vector<glm::vec3> colours = {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {.75F, .75F, .75F}};
  if (name != "gogh") colours = {{1, 1, 1}, {1, .2F, .12F}, {.75F, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Grid<std::uint8_t> labels(drawn.width(), drawn.height());
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < colours.size(); ++k)
      if (glm::distance(drawn[i], colours[k]) < glm::distance(drawn[i], colours[best])) best = k;
    labels[i] = static_cast<std::uint8_t>(shadow_is_rock && best == 2 ? 1 : best);
  }
  const PaintingSegments segments = segment_painting(picture, {}, usual_theta, name);
  const auto agreement = [&](std::size_t count) {
    const Partition groups = cut_tree(segments.tree, count);
    Grid<std::uint16_t> of(picture.width(), picture.height());
    for (std::size_t i = 0; i < of.size(); ++i) of[i] = groups[segments.pieces[i]];
    return segment_agreement(of, labels);
  };
  EXPECT_GT(agreement(30).merged, merged_of_30);
  EXPECT_GT(agreement(16).merged, merged_of_16);
  EXPECT_GT(agreement(6).one_to_one, one_to_one_of_6);
}

// The inferred classes as written, without corrections: the share of hand-labelled pixels with the
// right class.
TEST(PaintingSegments, MostOfMonetsCoastIsNamedRight) {
  const std::string folder = test::data_folder() + "/paintings/monet_etretat";
  if (!std::filesystem::exists(folder + ".jpg")) GTEST_SKIP() << folder << ".jpg is missing";
  const Grid<glm::vec3> drawn = read_picture(folder + "_labels.png");
  const std::vector<std::pair<glm::vec3, LandCoverClass>> meant = {{{1, 1, 1}, sky},
                                                                   {{1, .2F, .12F}, rock},
                                                                   {{.75F, 0, 0}, rock},
                                                                   {{0, 1, 0}, sand},
                                                                   {{0, 0, 1}, water}};
  const PaintingSegments segments =
      segment_painting(read_picture(folder + ".jpg"), {}, usual_theta, "monet");
  const Grid<std::uint8_t> mask =
      class_mask(segments, cut_tree(segments.tree, 30),
                 inferred_class_of(segments, 30));  // as `exemplar segment` does
  Grid<std::uint8_t> labels(drawn.width(), drawn.height());
  Grid<std::uint16_t> named(drawn.width(), drawn.height());
  double right = 0.0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < meant.size(); ++k)
      if (glm::distance(drawn[i], meant[k].first) < glm::distance(drawn[i], meant[best].first))
        best = k;
    right += mask[i] == id(meant[best].second) ? 1.0 : 0.0;
    labels[i] = static_cast<std::uint8_t>(best);
    named[i] = mask[i];
  }
  EXPECT_GT(right / static_cast<double>(drawn.size()), .85);
  // The mask separates the boulder from the cliff, which class names do not.
  EXPECT_GT(segment_agreement(named, labels).one_to_one, .60);
  std::replace(labels.begin(), labels.end(), std::uint8_t{2}, std::uint8_t{1});
  EXPECT_GT(segment_agreement(named, labels).one_to_one, .77);
}

TEST(PaintingSegments, AgreesWithMonetsMask) {
  expect_agreement("monet_etretat", 0.80, 0.60, 0.45, false);
}
TEST(PaintingSegments, AgreesWithMonetsMaskWhereShadowedRockIsRock) {
  expect_agreement("monet_etretat", 0.88, 0.82, 0.60, true);
}
TEST(PaintingSegments, AgreesWithGoghsMask) { expect_agreement("gogh", 0.84, 0.84, 0.62, false); }

}  // namespace

}  // namespace belvedere
