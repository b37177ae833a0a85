#include "renderer/features/paint_features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "base/parallel.h"
#include "tests/grids.h"
#include "tests/renderer/features/test_ground.h"

namespace belvedere {
namespace {

using test::line_feature;
using test::painted;
using test::set_of;
using test::TestGround;

constexpr glm::vec3 bare{0.4F};

FeatureStyle painted_style() {
  return parse_feature_style(R"(version = 1
[kinds.road]
width_mm = 4
casing_mm = 1
shrink = 0
hand = 0
clear_mm = 3
fill = "#ffffff"
casing = "#000000"
[kinds.path]
width_mm = 2
casing_mm = 0
shrink = 0
hand = 0
dash_mm = [6, 6]
fill = "#ff0000"
[kinds.run]
draw = "band"
width_mm = 6
casing_mm = 0
shrink = 0
soft_mm = 2
hand = 0
fill = "#0080ff"
[kinds.lift]
draw = "cable"
width_mm = 1
casing_mm = 0
clear_mm = 2
shrink = 0
fill = "#101010"
[kinds.river]
draw = "river"
clear_mm = 3
shrink = 0
[kinds.rough]
width_mm = 4
casing_mm = 0
shrink = 0
hand = 0.5
fill = "#ffffff"
)",
                             "test.toml");
}
enum Kinds : int { road, path, run, lift, river, rough };

TestGround level() {
  return TestGround([](glm::dvec2) { return 0.0; });
}

DrawnFeatures draw(const TestGround& ground, std::vector<Feature> features) {
  return draw_features(set_of(painted_style(), std::move(features)), ground.sight(),
                       {.px_per_mm = 2.0});
}
Feature line(int kind, std::vector<glm::dvec2> positions) {
  return line_feature(kind, std::move(positions), painted_style());
}

glm::vec3 at(const Grid<glm::vec3>& picture, glm::dvec2 pixel) {
  return picture(static_cast<int>(pixel.x), static_cast<int>(pixel.y));
}

std::size_t differing(const Grid<glm::vec3>& a, const Grid<glm::vec3>& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i] ? 1 : 0;
  return count;
}

TEST(PaintFeatures, ARoadIsAsWideAsTheStyleSays) {
  const TestGround ground = level();
  const Grid<glm::vec3> picture =
      painted(ground, draw(ground, {line(road, {{-1500.0, 0.0}, {1500.0, 0.0}})}));
  // Level and perpendicular to the view: a row of the picture.
  double light = 0.0;
  int covered = 0;
  for (int y = 0; y < picture.height(); ++y) {
    light += std::max(0.F, (picture(200, y).y - 0.4F) / 0.6F);
    covered += picture(200, y) != bare ? 1 : 0;
  }
  EXPECT_NEAR(light, 8.0, 0.6) << "4 mm at 2 px a mm";
  EXPECT_NEAR(covered, 12.5, 0.6) << "with edges of 1 mm; a pixel at each end is shared";
}

// All casings, then all fills: a crossing is open, and so is the joint of a T.
TEST(PaintFeatures, CasingsOfCrossingRoadsJoin) {
  const TestGround ground = level();
  const Feature a = line(road, {{-1200.0, 0.0}, {1200.0, 0.0}});
  const Feature b = line(road, {{0.0, -700.0}, {0.0, 900.0}});
  const Grid<glm::vec3> alone = painted(ground, draw(ground, {a}));
  const Grid<glm::vec3> both = painted(ground, draw(ground, {a, b}));
  const glm::dvec2 crossing = ground.pixel({0.0, 0.0, 0.0});
  // Where the first road alone has its edge, the second continues.
  const glm::dvec2 edge = crossing + glm::dvec2(0.0, 5.0);
  EXPECT_LT(at(alone, edge).y, 0.2F);
  EXPECT_GT(at(both, edge).y, 0.9F);
  EXPECT_GT(at(both, crossing).y, 0.9F);
  // And a fill is never darkened by the other's casing.
  for (std::size_t i = 0; i < alone.size(); ++i)
    EXPECT_TRUE(alone[i].y <= 0.9F || both[i].y > 0.9F) << i;
}

TEST(PaintFeatures, TheOrderOfTheFileDoesNotMatter) {
  const TestGround ground(
      [](glm::dvec2 p) { return 80.0 * std::sin(p.x / 300.0) * std::sin(p.y / 250.0); });
  std::vector<Feature> features = {
      line(road, {{-1200.0, 0.0}, {1200.0, 300.0}}), line(path, {{-900.0, 500.0}, {900.0, -300.0}}),
      line(road, {{0.0, -700.0}, {100.0, 900.0}}), line(run, {{-500.0, -300.0}, {700.0, 900.0}}),
      line(lift, {{-700.0, -500.0}, {200.0, 1200.0}})};
  const Grid<glm::vec3> first = painted(ground, draw(ground, features));
  std::reverse(features.begin(), features.end());
  EXPECT_EQ(differing(first, painted(ground, draw(ground, features))), 0U);
  std::swap(features[0], features[2]);
  EXPECT_EQ(differing(first, painted(ground, draw(ground, features))), 0U);
  EXPECT_GT(differing(first, Grid<glm::vec3>(first.width(), first.height(), bare)), 2000U);
}

TEST(PaintFeatures, AnyRectangleAndAnyThreadsShowTheWhole) {
  const TestGround ground(
      [](glm::dvec2 p) { return 80.0 * std::sin(p.x / 300.0) * std::sin(p.y / 250.0); });
  const DrawnFeatures drawn = draw(ground, {line(rough, {{-1200.0, 0.0}, {1200.0, 300.0}}),
                                            line(path, {{-900.0, 500.0}, {900.0, -300.0}}),
                                            line(run, {{-500.0, -300.0}, {700.0, 900.0}}),
                                            line(lift, {{-700.0, -500.0}, {200.0, 1200.0}})});
  const Grid<glm::vec3> whole = painted(ground, drawn);
  for (const PixelRect rect :
       {PixelRect{37, 51, 222, 260}, PixelRect{150, 90, 391, 131}, PixelRect{199, 0, 200, 300}}) {
    const ThreadLimit one(1);
    const Grid<glm::vec3> part = painted(ground, drawn, rect, rect);
    std::size_t wrong = 0;
    for (const auto [x, y] : test::cells(rect))
      wrong += part(x - rect.x0, y - rect.y0) != whole(x, y) ? 1 : 0;
    EXPECT_EQ(wrong, 0U);
  }
  const PixelRect asked{100, 100, 180, 170};
  const Grid<glm::vec3> some = painted(ground, drawn, ground.sheet(), asked);
  for (const auto [x, y] : test::cells(some)) {
    const bool inside = x >= asked.x0 && x < asked.x1 && y >= asked.y0 && y < asked.y1;
    ASSERT_EQ(some(x, y), inside ? whole(x, y) : bare) << x << ' ' << y;
  }
}

// As a layer over the ground they give the picture, also where something in front covers half and
// where bands tint.
TEST(PaintFeatures, TheirPaintAddsUpToALayer) {
  const TestGround ground = level();
  const DrawnFeatures drawn = draw(ground, {line(rough, {{-1200.0, 0.0}, {1200.0, 300.0}}),
                                            line(path, {{-900.0, 500.0}, {900.0, -300.0}}),
                                            line(run, {{-500.0, -300.0}, {700.0, 900.0}}),
                                            line(lift, {{-700.0, -500.0}, {200.0, 1200.0}})});
  for (const float seen : {1.F, 0.6F}) {
    PaintParts parts(ground.sheet());
    const Grid<glm::vec3> picture =
        painted(ground, drawn, ground.sheet(), ground.sheet(), seen, {}, &parts);
    EXPECT_EQ(differing(picture, painted(ground, drawn, seen)), 0U) << "a layer changes no pixel";
    const Grid<glm::vec4>& sum = parts.sum(PaintPart::features);
    double opacity = 0.0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
      const glm::vec3 laid = glm::vec3(sum[i]) + (1.F - sum[i].w) * bare;
      ASSERT_LT(glm::length(laid - picture[i]), 1e-5F) << i;
      ASSERT_TRUE(sum[i].w > 0.F || picture[i] == bare) << i;
      opacity += sum[i].w;
    }
    EXPECT_GT(opacity, 2000.0);
  }
}

TEST(PaintFeatures, AMountainStandsBeforeTheRoadBehindIt) {
  const auto ridge = [](glm::dvec2 p) {
    return std::abs(p.y) < 300.0 && p.x > 0.0 ? 700.0 * (1.0 - std::abs(p.y) / 300.0) : 0.0;
  };
  const TestGround ground(ridge);
  const Grid<glm::vec3> picture =
      painted(ground, draw(ground, {line(road, {{-1200.0, 700.0}, {1200.0, 700.0}})}));
  const GuidanceBuffers guidance = ground.guidance();
  const float behind_m = 3600.F;
  std::size_t drawn = 0;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    if (picture[i] == bare) continue;
    ++drawn;
    EXPECT_GT(guidance.depth_m[i], behind_m) << "nothing on the ridge before the road";
  }
  EXPECT_GT(drawn, 500U);
  EXPECT_EQ(at(picture, ground.pixel({600.0, 700.0, 0.0})), bare);
}

TEST(PaintFeatures, WhatStandsHidesWaysAndNotLifts) {
  const TestGround ground = level();
  const DrawnFeatures way = draw(ground, {line(road, {{-1200.0, 0.0}, {1200.0, 0.0}}),
                                          line(run, {{0.0, -500.0}, {0.0, 500.0}})});
  const Grid<glm::vec3> hidden = painted(ground, way, 0.F);
  for (std::size_t i = 0; i < hidden.size(); ++i) EXPECT_EQ(hidden[i], bare);
  const DrawnFeatures cable = draw(ground, {line(lift, {{-700.0, 0.0}, {700.0, 200.0}})});
  EXPECT_EQ(differing(painted(ground, cable, 0.F), painted(ground, cable, 1.F)), 0U);
}

TEST(PaintFeatures, WhatStandsNearerThanALiftHidesIt) {
  const TestGround ground = level();
  const DrawnFeatures cable = draw(ground, {line(lift, {{-700.0, 0.0}, {700.0, 200.0}})});
  const Grid<glm::vec3> free = painted(ground, cable);
  Grid<float> seen(free.width(), free.height(), 1.F);
  EXPECT_EQ(differing(free, painted(ground, cable, ground.sheet(), ground.sheet(), 1.F, seen)), 0U);
  // Its left half is behind trees.
  for (int y = 0; y < seen.height(); ++y) std::fill_n(seen.row(y), seen.width() / 2, 0.F);
  const Grid<glm::vec3> half = painted(ground, cable, ground.sheet(), ground.sheet(), 1.F, seen);
  std::size_t right = 0;
  for (const auto [x, y] : test::cells(half)) {
    EXPECT_EQ(half(x, y), x < half.width() / 2 ? bare : free(x, y));
    right += x >= half.width() / 2 && half(x, y) != bare ? 1 : 0;
  }
  EXPECT_GT(right, 50U);
}

TEST(PaintFeatures, TellsHowFarRopesHang) {
  const TestGround ground = level();
  const DrawnFeatures cable = draw(ground, {line(lift, {{-700.0, 0.0}, {700.0, 0.0}}),
                                            line(road, {{-700.0, 400.0}, {700.0, 400.0}})});
  const Grid<float> overhead = find_overhead(cable, ground.sheet());
  ASSERT_EQ(overhead.width(), ground.sheet().width());
  const Grid<glm::vec3> picture =
      painted(ground, draw(ground, {line(lift, {{-700.0, 0.0}, {700.0, 0.0}})}));
  const double distance_m = glm::length(glm::dvec3(0.0, -3000.0, 1500.0));
  std::size_t ropes = 0;
  for (std::size_t i = 0; i < picture.size(); ++i)
    if (picture[i] != bare) {
      ASSERT_NEAR(static_cast<double>(overhead[i]), distance_m, 0.05 * distance_m)
          << "wherever its paint is";
      ++ropes;
    }
  EXPECT_GT(ropes, 100U);
  EXPECT_TRUE(std::isinf(overhead(200, 5)));
  const glm::dvec2 way = ground.pixel({0.0, 400.0, 0.0});
  EXPECT_TRUE(std::isinf(overhead(static_cast<int>(way.x), static_cast<int>(way.y))))
      << "roads are not overhead";
  EXPECT_TRUE(
      find_overhead(draw(ground, {line(road, {{-700.0, 0.0}, {700.0, 0.0}})}), ground.sheet())
          .empty());
  const PixelRect part{140, 90, 291, 201};
  const Grid<float> window = find_overhead(cable, part);
  for (const auto [x, y] : test::cells(part.width(), part.height()))
    ASSERT_EQ(window(x, y), overhead(part.x0 + x, part.y0 + y));
}

TEST(PaintFeatures, GroundBelowARopeIsClearedOfTrees) {
  const TestGround ground = level();
  const DrawnFeatures cable = draw(ground, {line(lift, {{-700.0, 0.0}, {700.0, 0.0}})});
  const Grid<std::uint8_t> cleared = find_cleared(cable, ground.guidance().depth_m, ground.sheet());
  const glm::dvec2 foot = ground.pixel({100.0, 0.0, 0.0});
  const auto at_foot = [&](double down) {
    return cleared(static_cast<int>(foot.x), static_cast<int>(foot.y + down));
  };
  EXPECT_EQ(at_foot(0.0), 1);
  EXPECT_EQ(at_foot(9.0), 1) << "2.5 times 2 mm below, at 2 px a mm";
  EXPECT_EQ(at_foot(14.0), 0);
  EXPECT_EQ(at_foot(-8.0), 0);
}

// A river 60 m wide across the view: its water and a bank on either side, 2.5 times as far below
// it; nothing of it is painted.
TEST(PaintFeatures, BanksOfRiversAreCleared) {
  const TestGround ground = level();
  const CoverRiver centreline{.positions = {{-1500.0, 0.0}, {0.0, 0.0}, {1500.0, 0.0}},
                              .half_width_m = {30.F, 30.F, 30.F},
                              .kind = river};
  const DrawnFeatures drawn =
      draw_features(set_of(painted_style(), {line(river, {{-1500.0, 0.0}, {1500.0, 0.0}})}),
                    ground.sight(), {.px_per_mm = 2.0}, {&centreline, 1});
  const Grid<float> depth_m = ground.guidance().depth_m;
  const double centre_m = glm::length(glm::dvec3(0.0, 3000.0, 1500.0));
  const Grid<std::uint8_t> cleared = find_cleared(drawn, depth_m, ground.sheet());
  const double far_bank = ground.pixel({0.0, 30.0, 0.0}).y;
  const double near_bank = ground.pixel({0.0, -30.0, 0.0}).y;
  EXPECT_GT(near_bank - far_bank, 3.0);
  for (int y = 0; y < cleared.height(); ++y) {
    const double up = far_bank - (y + 0.5);
    const double down = y + 0.5 - near_bank;
    const double farther = std::abs(static_cast<double>(depth_m(200, y)) / centre_m - 1.0);
    if (std::abs(up - 6.0) < 1.0 || std::abs(down - 15.0) < 1.0 || std::abs(farther - 0.04) < 0.005)
      continue;
    EXPECT_EQ(cleared(200, y) != 0, up < 6.0 && down < 15.0 && farther < 0.04) << y;
  }
  EXPECT_EQ(differing(painted(ground, drawn), Grid<glm::vec3>(400, 300, bare)), 0U);
  EXPECT_EQ(drawn.counts[0][river].drawn, 0U);
}

TEST(PaintFeatures, BandsTintAndLetTheReliefShowThrough) {
  const TestGround ground = level();
  const Grid<glm::vec3> picture =
      painted(ground, draw(ground, {line(run, {{-1200.0, 0.0}, {1200.0, 0.0}})}));
  const glm::vec3 centre = at(picture, ground.pixel({0.0, 0.0, 0.0}));
  EXPECT_NEAR(centre.x, 0.F, 1e-3F);
  EXPECT_NEAR(centre.y, 0.4F * 128.F / 255.F, 1e-3F);
  EXPECT_NEAR(centre.z, 0.4F, 1e-3F);
  // Its edge is soft: over some pixels it blends into the ground.
  int between = 0;
  for (int y = 0; y < picture.height(); ++y)
    between += picture(200, y).x > 0.05F && picture(200, y).x < 0.35F ? 1 : 0;
  EXPECT_GE(between, 4);
}

TEST(PaintFeatures, DashesAreAsLongAsTheStyleSays) {
  const TestGround ground = level();
  const Grid<glm::vec3> picture =
      painted(ground, draw(ground, {line(path, {{-1200.0, 0.0}, {1200.0, 0.0}})}));
  const int row = static_cast<int>(ground.pixel({0.0, 0.0, 0.0}).y);
  int changes = 0;
  int on = 0;
  int first = -1;
  int last = -1;
  for (int x = 1; x < picture.width(); ++x) {
    const bool here = picture(x, row).x > 0.7F;
    const bool before = picture(x - 1, row).x > 0.7F;
    if (here != before) {
      ++changes;
      if (first < 0) first = x;
      last = x;
    }
    on += here ? 1 : 0;
  }
  ASSERT_GT(changes, 6);
  EXPECT_NEAR(static_cast<double>(last - first) / (changes - 1), 12.0, 0.7) << "6 mm at 2 px a mm";
  EXPECT_NEAR(static_cast<double>(on) / (last - first), 0.5, 0.08);
}

TEST(PaintFeatures, TheHandIsUnevenAndLiesOnTheSheet) {
  const TestGround ground = level();
  const Grid<glm::vec3> picture =
      painted(ground, draw(ground, {line(rough, {{-1200.0, 0.0}, {1200.0, 0.0}})}));
  std::vector<double> widths;
  for (int x = 100; x < 300; ++x) {
    double light = 0.0;
    for (int y = 0; y < picture.height(); ++y) light += (picture(x, y).y - 0.4F) / 0.6F;
    widths.push_back(light);
  }
  const auto [low, high] = std::minmax_element(widths.begin(), widths.end());
  EXPECT_GT(*high - *low, 1.0);
  EXPECT_GT(*low, 3.0) << "never broken";
  EXPECT_LT(*high, 12.5);
}

TEST(PaintFeatures, TreesAreClearedOnlyWhereALineNeedsIt) {
  const auto cliff = [](glm::dvec2 p) { return p.y > 60.0 ? 500.0 : 0.0; };
  const TestGround ground(cliff);
  const DrawnFeatures drawn = draw(ground, {line(road, {{-1200.0, 0.0}, {1200.0, 0.0}}),
                                            line(path, {{-1200.0, -600.0}, {1200.0, -600.0}})});
  const GuidanceBuffers guidance = ground.guidance();
  const Grid<std::uint8_t> cleared = find_cleared(drawn, guidance.depth_m, ground.sheet());
  const double row = ground.pixel({0.0, 0.0, 0.0}).y;
  // 4 px of the road itself, 6 px at its sides, 15 px below, where trees would stand in front of
  // it.
  for (int y = 0; y < cleared.height(); ++y) {
    const double away = y + 0.5 - row;
    const bool needed = away > -9.5 && away < 18.5;
    const bool near_edge = std::abs(away + 10.0) < 1.0 || std::abs(away - 19.0) < 1.0;
    const float farther =
        std::abs(guidance.depth_m(200, y) / guidance.depth_m(200, static_cast<int>(row)) - 1.F);
    if (near_edge || std::abs(farther - 0.04F) < 0.005F) continue;
    EXPECT_EQ(cleared(200, y) != 0, needed && farther < 0.04F)
        << y << ", " << away << " px below the line, " << farther;
  }
  const PixelRect part{31, 77, 260, 208};
  Grid<float> depth(part.width(), part.height());
  for (const auto [x, y] : test::cells(depth))
    depth(x, y) = guidance.depth_m(part.x0 + x, part.y0 + y);
  const Grid<std::uint8_t> window = find_cleared(drawn, depth, part);
  for (const auto [x, y] : test::cells(depth))
    ASSERT_EQ(window(x, y), cleared(part.x0 + x, part.y0 + y));
}

// Ground that is drawn higher or lower than traced takes its roads along, and the cleared trees;
// overhead objects stay.
TEST(PaintFeatures, WaysGoAlongWithCrestsOfRock) {
  const TestGround ground = level();
  const DrawnFeatures drawn = draw(ground, {line(road, {{-1200.0, 0.0}, {1200.0, 0.0}})});
  const DrawnFeatures cable = draw(ground, {line(lift, {{-700.0, 0.0}, {700.0, 0.0}})});
  const auto shifted = [&](const DrawnFeatures& features, std::int16_t left, std::int16_t right) {
    Grid<std::int16_t> rows(400, 300, left);
    for (int y = 0; y < 300; ++y) std::fill(rows.row(y) + 200, rows.row(y) + 400, right);
    GuidanceBuffers guidance = ground.guidance();
    const Grid<float> depth = guidance.depth_m;
    for (const auto [x, y] : test::cells(400, 300))
      guidance.depth_m(x, y) = depth(x, std::clamp(y + rows(x, y), 0, 299));
    Grid<glm::vec3> picture(400, 300, bare);
    const Grid<glm::vec3> base = picture;
    const Grid<float> none(400, 300, 0.F);
    const Grid<float> all(400, 300, 1.F);
    paint_features(picture, features, {guidance, base, none, all, {}, &rows}, ground.sheet(),
                   ground.sheet());
    return std::pair(picture, find_cleared(features, guidance.depth_m, ground.sheet(), &rows));
  };
  const auto [plain, cleared] = shifted(drawn, 0, 0);
  EXPECT_EQ(differing(plain, painted(ground, drawn)), 0U);
  const auto [moved, moved_cleared] =
      shifted(drawn, 140, -9);  // 140 rows up over two borders of tiles, 9 down
  std::size_t paint = 0;
  for (int y = 10; y < 290; ++y)
    for (const int x : {50, 120, 199, 200, 260, 390}) {
      const int from = y + (x < 200 ? 140 : -9);
      if (from < 0 || from >= 300) continue;
      EXPECT_EQ(plain(x, from) != bare, moved(x, y) != bare) << x << ' ' << y;
      EXPECT_EQ(cleared(x, from), moved_cleared(x, y)) << x << ' ' << y;
      paint += moved(x, y) != bare ? 1 : 0;
    }
  EXPECT_GT(paint, 20U);
  // A rope stays in its own rows; the ground behind it is farther there, so nothing of it is
  // hidden.
  const auto [rope, rope_cleared] = shifted(cable, 0, -3);
  EXPECT_EQ(differing(rope, shifted(cable, 0, 0).first), 0U);
}

TEST(PaintFeatures, GridsOfOtherSizesAreABug) {
  const TestGround ground = level();
  const DrawnFeatures drawn = draw(ground, {});
  EXPECT_THROW(
      {
        Grid<glm::vec3> picture(10, 10);
        const GuidanceBuffers guidance = ground.guidance();
        const Grid<float> grid(10, 10);
        paint_features(picture, drawn, {guidance, picture, grid, grid, {}}, {0, 0, 10, 10},
                       {0, 0, 10, 10});
      },
      Error);
}

}  // namespace
}  // namespace belvedere
