#include "renderer/features/feature_matte.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "tests/grids.h"
#include "tests/renderer/features/test_ground.h"

namespace belvedere {
namespace {

FeatureStyle matte_style() {
  return parse_feature_style(R"(version = 1
[kinds.road]
width_mm = 4
casing_mm = 1
shrink = 0
hand = 0
[kinds.run]
draw = "band"
width_mm = 8
casing_mm = 0
shrink = 0
hand = 0
[kinds.building]
draw = "building"
)",
                             "test.toml");
}
enum MatteKinds : int { matte_road, matte_run, matte_building };

class FeatureMatte : public testing::Test {
 protected:
  static DrawnFeatures drawn(const test::TestGround& ground,
                             const std::vector<std::pair<int, std::vector<glm::dvec2>>>& lines) {
    std::vector<Feature> features;
    for (const auto& [kind, positions] : lines)
      features.push_back(test::line_feature(kind, positions, matte_style()));
    return draw_features(test::set_of(matte_style(), std::move(features)), ground.sight(),
                         {.px_per_mm = 2.0});
  }
  // The share of one kind.
  static int share_of(const MattePixel& pixel, int kind) {
    int share = 0;
    for (std::size_t k = 0; k < 2; ++k)
      if (pixel.id[k] == kind + 1) share += pixel.share[k];
    return share;
  }
  test::TestGround ground_{[](glm::dvec2) { return 0.0; }};
  Grid<float> depth_m_ = ground_.guidance().depth_m;
};

TEST_F(FeatureMatte, AKindCoversItsLinesWithTheirEdges) {
  const DrawnFeatures features = drawn(ground_, {{matte_road, {{-1500.0, 0.0}, {1500.0, 0.0}}}});
  const Grid<MattePixel> matte = make_feature_matte(features, depth_m_, ground_.sheet());
  double covered = 0.0;
  for (int y = 0; y < matte.height(); ++y) covered += share_of(matte(200, y), matte_road) / 255.0;
  EXPECT_NEAR(covered, 12.0, 0.6) << "4 mm and two edges of 1 mm, at 2 px a mm";
}

// A road over a run 16 px wide: where its edge covers part of a pixel, both shares make the whole.
TEST_F(FeatureMatte, WhatLiesOnTopHidesWhatIsBelow) {
  const DrawnFeatures features = drawn(ground_, {{matte_road, {{-1500.0, 0.0}, {1500.0, 0.0}}},
                                                 {matte_run, {{-1500.0, 0.0}, {1500.0, 0.0}}}});
  const Grid<MattePixel> matte = make_feature_matte(features, depth_m_, ground_.sheet());
  const int middle = static_cast<int>(ground_.pixel({0.0, 0.0, 0.0}).y);
  EXPECT_EQ(share_of(matte(200, middle), matte_road), 255);
  EXPECT_EQ(share_of(matte(200, middle), matte_run), 0);
  for (int y = middle - 7; y <= middle + 7; ++y)
    EXPECT_NEAR(share_of(matte(200, y), matte_road) + share_of(matte(200, y), matte_run), 255, 2)
        << y;
  EXPECT_EQ(share_of(matte(200, middle - 7), matte_run), 255);
}

TEST_F(FeatureMatte, AnyPartIsThatOfTheWhole) {
  const DrawnFeatures features = drawn(ground_, {{matte_road, {{-900.0, -500.0}, {900.0, 900.0}}},
                                                 {matte_run, {{-500.0, 900.0}, {700.0, 0.0}}}});
  const Grid<MattePixel> whole = make_feature_matte(features, depth_m_, ground_.sheet());
  const PixelRect part{131, 77, 290, 222};
  const ThreadLimit one(1);
  EXPECT_EQ(make_feature_matte(features, part_of(depth_m_, part), part), part_of(whole, part));
  EXPECT_EQ(make_feature_matte({}, depth_m_, ground_.sheet()),
            Grid<MattePixel>(depth_m_.width(), depth_m_.height()));
}

// A wall of 8 × 6 px, its right edge in the middle of a pixel; nearer ground hides its left half.
TEST_F(FeatureMatte, AHouseCoversItsFaces) {
  DrawnFeatures features;
  features.style = matte_style();
  features.net = {1, 1};
  features.lines_in.resize(1);
  features.houses_in = {{0}};
  features.houses = {{.kind = matte_building,
                      .foot = {14.F, 20.F},
                      .distance_m = 1000.F,
                      .reach_px = 10.F,
                      .shades = {},
                      .faces = {{.corners = {glm::vec2(10.F, 20.F), glm::vec2(18.5F, 20.F),
                                             glm::vec2(18.5F, 14.F), glm::vec2(10.F, 14.F)}}}}};
  Grid<float> depth_m(30, 30, 1050.F);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 14; ++x) depth_m(x, y) = 900.F;
  const Grid<MattePixel> matte = make_feature_matte(features, depth_m, {0, 0, 30, 30});
  for (const auto [x, y] : test::cells(30, 30)) {
    const bool high = y >= 14 && y < 20;
    const int expected = !high || x < 14 || x > 18 ? 0 : x == 18 ? 128 : 255;
    EXPECT_EQ(share_of(matte(x, y), matte_building), expected) << x << " " << y;
  }
}

}  // namespace
}  // namespace belvedere
