#include "renderer/exemplar/classes_by_paint.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/land_cover_class.h"
#include "base/parallel.h"
#include "base/random.h"
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

}  // namespace
}  // namespace belvedere
