#include "renderer/paint/clouds/front_deck.h"

#include <gtest/gtest.h>

#include <cmath>

namespace belvedere {
namespace {

SkyParameters front_sky(std::uint64_t seed, double sun_image_x) {
  SkyParameters p;
  p.kind = SkyKind::front;
  p.seed = seed;
  p.sun_image_x = sun_image_x;
  return p;
}

// Mean cover of the left and the right third of the sky.
glm::dvec2 covers(const SkyParameters& p) {
  FrontDeck deck(p, look_of_sky(p));
  glm::dvec2 sum(0.0);
  int count = 0;
  for (double y = 2.0; y < 0.75 * p.horizon_px; y += 5.0)
    for (double x = 5.0; x < p.picture_size.x / 3.0; x += 9.0, ++count) {
      sum.x += static_cast<double>(deck.at(x, y).cover);
      sum.y += static_cast<double>(deck.at(p.picture_size.x - x, y).cover);
    }
  return sum / static_cast<double>(count);
}

TEST(FrontDeck, DrawsUpFromTheSideAwayFromTheSun) {
  for (std::uint64_t seed = 1; seed < 7; ++seed) {
    const glm::dvec2 sun_right = covers(front_sky(seed, 1.0));
    EXPECT_GT(sun_right.x, sun_right.y + 0.2) << seed;
    const glm::dvec2 sun_left = covers(front_sky(seed, -1.0));
    EXPECT_GT(sun_left.y, sun_left.x + 0.2) << seed;
  }
}

TEST(FrontDeck, NothingLiesAtTheHorizonAndBelow) {
  const SkyParameters p = front_sky(1, 1.0);
  FrontDeck deck(p, look_of_sky(p));
  for (double x = 0.0; x < p.picture_size.x; x += 50.0) {
    EXPECT_EQ(deck.at(x, 0.98 * p.horizon_px).cover, 0.0F);
    EXPECT_EQ(deck.at(x, 1.5 * p.horizon_px).cover, 0.0F);
  }
}

TEST(FrontDeck, ItsEdgeIsBrighterThanItsBody) {
  double edge = 0.0, body = 0.0;
  int edges = 0, bodies = 0;
  for (std::uint64_t seed = 1; seed < 5; ++seed) {
    const SkyParameters p = front_sky(seed, 1.0);
    FrontDeck deck(p, look_of_sky(p));
    for (double y = 2.0; y < 0.7 * p.horizon_px; y += 3.0)
      for (double x = 0.0; x < p.picture_size.x; x += 7.0) {
        const FrontDeck::Look look = deck.at(x, y);
        if (look.cover > 0.2F && look.cover < 0.6F)
          edge += static_cast<double>(look.light), ++edges;
        if (look.cover > 0.98F) body += static_cast<double>(look.light), ++bodies;
      }
  }
  ASSERT_GT(edges, 100);
  ASSERT_GT(bodies, 100);
  EXPECT_GT(edge / edges, body / bodies + 0.15);
}

}  // namespace
}  // namespace belvedere
