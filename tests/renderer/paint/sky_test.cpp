#include "renderer/paint/sky.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "tests/grids.h"
#include "tests/renderer/exemplar/painted_hills.h"

namespace belvedere {
namespace {

constexpr float sky_depth = std::numeric_limits<float>::infinity();

// Heaps here and there: clouds themselves are tested in clouds_test.cpp.
SkyParameters fair_sky() {
  SkyParameters p;
  p.kind = SkyKind::fair;
  return p;
}

SkyParameters small_sky() {
  SkyParameters p = fair_sky();
  p.picture_size = {600, 300};
  p.horizon_px = 120.0;
  return p;
}

TEST(Sky, GradientEndsInItsStops) {
  const Palette palette = read_palette("summer");
  EXPECT_EQ(sky_gradient(palette, 0.0), palette.sky.front().second);
  EXPECT_EQ(sky_gradient(palette, -1.0), palette.sky.front().second);
  EXPECT_EQ(sky_gradient(palette, 1.0), palette.sky.back().second);
  EXPECT_EQ(sky_gradient(palette, 2.0), palette.sky.back().second);
  const glm::vec3 centre = sky_gradient(palette, 0.45);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(centre[k], 0.5F * (palette.sky[1].second[k] + palette.sky[2].second[k]), 1e-6F);
}

TEST(Sky, WithoutCloudsItIsTheGradient) {
  const Palette palette = read_palette("winter");
  SkyParameters p = small_sky();
  p.clouds = 0.0;
  const Grid<glm::vec3> sky = make_sky(Grid<float>(600, 150, sky_depth), palette, p, {0, 0});
  for (int x = 0; x < 600; x += 7) {
    EXPECT_LT(glm::length(sky(x, 0) - palette.sky.front().second), 0.05F);
    EXPECT_LT(glm::length(sky(x, 119) - palette.sky.back().second), 0.01F);
    EXPECT_LT(glm::length(sky(x, 149) - air_beyond(palette, 149.5 / 120.0)), 1e-6F)
        << "below the horizon";
  }
}

TEST(Sky, CloudsHaveFlatBasesAndShrinkTowardsTheHorizon) {
  const std::vector<Cloud> clouds = make_clouds(fair_sky());
  ASSERT_GT(clouds.size(), 10U);
  double far = 0.0, near = 0.0;
  int far_count = 0, near_count = 0;
  for (const Cloud& cloud : clouds) {
    for (const CloudHead& head : cloud.heads) EXPECT_LE(head.centre.y, cloud.base_px);
    const double width = cloud.to.x - cloud.from.x;
    if (cloud.base_px > 198.0 * 0.84) far += width, ++far_count;
    if (cloud.base_px < 198.0 * 0.72) near += width, ++near_count;
  }
  ASSERT_GT(far_count, 0);
  ASSERT_GT(near_count, 0);
  EXPECT_GT(near / near_count, 1.5 * far / far_count);
}

// Height over width and the position of the highest head: the features that distinguish two clouds
// at a glance.
TEST(Sky, NoTwoCloudsAreAlike) {
  const std::vector<Cloud> clouds = make_clouds(fair_sky());
  std::vector<glm::dvec2> shapes;
  for (const Cloud& cloud : clouds) {
    const CloudHead* top = &cloud.heads.front();
    for (const CloudHead& head : cloud.heads)
      if (head.centre.y - head.radius.y < top->centre.y - top->radius.y) top = &head;
    const double width = cloud.to.x - cloud.from.x;
    shapes.emplace_back((cloud.base_px - cloud.from.y) / width,
                        (top->centre.x - cloud.from.x) / width);
  }
  double low = 1.0, high = 0.0, left = 1.0, right = 0.0;
  int alike = 0, pairs = 0;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    low = std::min(low, shapes[i].x), high = std::max(high, shapes[i].x);
    left = std::min(left, shapes[i].y), right = std::max(right, shapes[i].y);
    for (std::size_t k = i + 1; k < shapes.size(); ++k, ++pairs)
      alike += glm::length(shapes[i] - shapes[k]) < 0.02 ? 1 : 0;
  }
  EXPECT_GT(high, 2.5 * low) << "heaps and drawn-out banks";
  EXPECT_GT(right - left, 0.35) << "the highest head is left, right or in the centre";
  EXPECT_LT(alike, 0.06 * pairs);
}

// The columns with clouds, as a mask: no other seed may share more of it than chance would.
TEST(Sky, EverySeedHasASkyOfItsOwn) {
  const auto columns = [](std::uint64_t seed) {
    SkyParameters p = fair_sky();
    p.seed = seed;
    std::vector<bool> mask(2400, false);
    for (const Cloud& cloud : make_clouds(p))
      for (int x = std::max(0, static_cast<int>(cloud.from.x)); x < std::min(2400.0F, cloud.to.x);
           ++x)
        if (cloud.base_px < 150.0F) mask[static_cast<std::size_t>(x)] = true;
    return mask;
  };
  int worst = 0;
  for (std::uint64_t a = 1; a < 7; ++a)
    for (std::uint64_t b = a + 1; b < 8; ++b) {
      const std::vector<bool> one = columns(a), other = columns(b);
      int both = 0, either = 0;
      for (std::size_t x = 0; x < one.size(); ++x)
        both += one[x] && other[x], either += one[x] || other[x];
      ASSERT_GT(either, 200) << a << ", " << b;
      worst = std::max(worst, 100 * both / either);
    }
  EXPECT_LT(worst, 75);
}

// The sky must not be too prominent: clear sky and veils change from row to row, hardly along a
// row.
TEST(Sky, VeilsLieLevel) {
  const Palette palette = read_palette("summer");
  for (const std::uint64_t seed : {1, 2, 3}) {
    SkyParameters p = fair_sky();
    p.seed = seed;
    const std::vector<Cloud> clouds = make_clouds(p);
    const Grid<glm::vec3> sky = make_sky(Grid<float>(2400, 198, sky_depth), palette, p, {0, 0});
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (const auto [x, y] : test::cells({4, 4, 2396, 190}, 2)) {
      bool clear = true;
      for (const Cloud& c : clouds)
        clear = clear && (x < c.from.x - 8 || x > c.to.x + 8 || y < c.from.y - 8 || y > c.to.y + 8);
      if (!clear) continue;
      // A remainder of the vertical gradient, which is level by nature, would hide the slope of
      // veils.
      const double gx = sky(x + 4, y).r - sky(x - 4, y).r;
      const double gy =
          sky(x, y + 4).r - sky(x, y - 4).r -
          (sky_gradient(palette, (y + 4.5) / 198.0).r - sky_gradient(palette, (y - 3.5) / 198.0).r);
      xx += gx * gx, xy += gx * gy, yy += gy * gy;
    }
    ASSERT_GT(yy, 0.0);
    // The axis of least change, degrees from level, and how closely the veils follow it.
    EXPECT_LT(std::abs(0.5 * std::atan2(2.0 * xy, yy - xx)) * 57.3, 3.0) << seed;
    EXPECT_GT(yy, 12.0 * xx) << seed;
  }
}

// They start at a position outside the picture, so that all of them lean away from it, and none is
// upright like a ray.
TEST(Sky, StreaksAllLeanOneWay) {
  const Palette palette = read_palette("summer");
  double leaning = 0.0;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const SkyParameters p{.kind = SkyKind::streaks, .seed = seed};
    const double from_px = look_of_sky(p).vanishing_px.x;
    EXPECT_TRUE(from_px < -100.0 || from_px > 2500.0) << from_px;
    const Grid<glm::vec3> sky = make_sky(Grid<float>(2400, 198, sky_depth), palette, p, {0, 0});
    std::array<double, 3> thirds{};
    for (const auto [x, y] : test::cells({8, 10, 2392, 150}, 2)) {
      const double gx = sky(x + 3, y).r - sky(x - 3, y).r;
      const double gy =
          sky(x, y + 3).r - sky(x, y - 3).r -
          (sky_gradient(palette, (y + 3.5) / 198.0).r - sky_gradient(palette, (y - 2.5) / 198.0).r);
      thirds[static_cast<std::size_t>(x / 800)] += gx * gy;
    }
    // Along a streak nothing changes: where it leans to the right as it rises, light increases to
    // the right and downwards alike.
    for (const double third : thirds) leaning += (third > 0.0) == (from_px < 0.0) ? 1.0 : 0.0;
  }
  EXPECT_GE(leaning, 10.0) << "of 12 thirds of skies";
}

TEST(Sky, BelowTheHorizonIsHazeNotSky) {
  const Palette palette = read_palette("summer");
  EXPECT_EQ(air_beyond(palette, 0.4), sky_gradient(palette, 0.4));
  EXPECT_EQ(air_beyond(palette, 1.0), sky_gradient(palette, 1.0));
  const glm::vec3 deep = air_beyond(palette, 3.0);
  EXPECT_LT(glm::length(deep - palette.haze_far),
            0.45F * glm::length(palette.sky.back().second - palette.haze_far));
}

TEST(Sky, CloudsAreLitFromAboveAndShadedBelow) {
  const Palette palette = read_palette("summer");
  const SkyParameters p = fair_sky();
  const Grid<glm::vec3> sky = make_sky(Grid<float>(2400, 198, sky_depth), palette, p, {0, 0});
  double top = 0.0, foot = 0.0;
  int count = 0;
  for (const Cloud& cloud : make_clouds(p)) {
    const int x = static_cast<int>(0.5F * (cloud.from.x + cloud.to.x));
    const float height = cloud.base_px - cloud.from.y;
    const int y_top = static_cast<int>(cloud.base_px - 0.5F * height);
    const int y_foot = static_cast<int>(cloud.base_px - 0.12F * height);
    if (x < 0 || x >= 2400 || y_top < 0 || cloud.base_px > 160.0F) continue;
    top += sky(x, y_top).r;
    foot += sky(x, y_foot).r;
    ++count;
  }
  ASSERT_GT(count, 3);
  EXPECT_GT(top / count, foot / count + 0.02);
}

TEST(Sky, PartEqualsWholeAndTerrainIsLeftOut) {
  const Palette palette = read_palette("summer");
  const SkyParameters p = small_sky();
  Grid<float> depth(600, 150, sky_depth);
  for (int x = 0; x < 600; ++x)
    for (int y = 100; y < 150; ++y) depth(x, y) = 9000.0F;
  const Grid<glm::vec3> whole = make_sky(depth, palette, p, {0, 0});
  EXPECT_EQ(whole(300, 120), glm::vec3(0.0F));
  const PixelRect rect{123, 17, 391, 140};
  EXPECT_EQ(make_sky(test::cut(depth, rect), palette, p, {rect.x0, rect.y0}),
            test::cut(whole, rect));
}

TEST(Sky, SkylineByRaysIsWhereTheCrestProjects) {
  // A level crest 400 m high, 6 km north of the eye and at right angles to the view.
  DeformedSurface surface;
  surface.vertices_m = Grid<glm::vec3>(200, 90);
  for (const auto [x, y] : test::cells(200, 90))
    surface.vertices_m(x, y) = {100.0F * x - 10000.0F, 7000.0F - 100.0F * y,
                                y == 10 ? 400.0F : 0.0F};
  surface.origin = {500000.0, 5000000.0, 0.0};
  const Tracer tracer(surface);
  CameraParameters parameters{.width = 400,
                              .height = 300,
                              .eye = surface.origin + glm::dvec3(0.0, 0.0, 900.0),
                              .pitch_deg = -10.0};
  const auto camera = make_camera(parameters);
  const std::optional<glm::dvec2> crest =
      camera->project(surface.origin + glm::dvec3(0.0, 6000.0, 400.0));
  ASSERT_TRUE(crest);
  EXPECT_NEAR(skyline_row_px(*camera, tracer, -1.0), crest->y, 1.5);
  parameters.pitch_deg = 60.0;
  EXPECT_EQ(skyline_row_px(*make_camera(parameters), tracer, -1.0), -1.0);
}

SkyParameters front_sky(std::uint64_t seed, double sun_image_x) {
  return {.kind = SkyKind::front, .sun_image_x = sun_image_x, .seed = seed};
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
