#include "renderer/style/style_cumulus.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/grids.h"
#include "tests/renderer/style/styled_sheet.h"

namespace belvedere {
namespace {

constexpr int cumulus_width = 600;
constexpr int cumulus_height = 240;

StyleSky cumulus_sky() {
  StyleSky sky = test::make_style().sky;
  sky.upper_edges = 0.35;
  sky.clear = glm::vec3(-0.08F, 0.0F, -0.06F);
  sky.clear_share = 0.3;
  sky.changes.front().length_x = 0.04;
  sky.changes.front().length_y = 0.06;
  return sky;
}

StylePaintParameters cumulus_parameters() {
  StylePaintParameters parameters = test::make_style_parameters(cumulus_width, cumulus_height);
  parameters.sky_rows = cumulus_height;
  return parameters;
}

const SkyWindow whole_sky{{0, 0}, cumulus_width, cumulus_height};

TEST(StyleCumulus, OnlySkiesWithSteepUpperEdgesHaveThem) {
  StyleSky sky = cumulus_sky();
  EXPECT_EQ(cumulus_share(sky), 1.0);
  sky.upper_edges = 0.12;  // the most of the calm skies fitted so far
  EXPECT_EQ(cumulus_share(sky), 0.0);
  sky.upper_edges = 0.35;
  sky.changes.clear();
  EXPECT_EQ(cumulus_share(sky), 0.0);
}

TEST(StyleCumulus, GiveWayToLevelCloudsTowardsTheHorizon) {
  const StyleCumulus cumulus(cumulus_sky(), whole_sky, cumulus_parameters());
  EXPECT_EQ(cumulus.share(0), 1.0F);
  EXPECT_EQ(cumulus.share(cumulus_height / 3), 1.0F);
  EXPECT_LT(cumulus.share(cumulus_height * 3 / 4), 0.6F);
  EXPECT_EQ(cumulus.share(cumulus_height - 1), 0.0F);
}

TEST(StyleCumulus, LeaveThePaintingsShareOfTheSkyClear) {
  const StyleCumulus cumulus(cumulus_sky(), whole_sky, cumulus_parameters());
  double hidden = 0.0;
  for (const auto [x, y] : test::cells(cumulus_width, cumulus_height))
    hidden += cumulus.cover(x, y) >= 0.5F ? 1.0 : 0.0;
  EXPECT_NEAR(hidden / (cumulus_width * cumulus_height), 0.7, 0.02);
}

TEST(StyleCumulus, AreSharpAndLitAboveAndSoftBelow) {
  const StyleCumulus cumulus(cumulus_sky(), whole_sky, cumulus_parameters());
  double steepest_upper = 0.0;
  double steepest_lower = 0.0;
  double light_upper = 0.0;
  double light_lower = 0.0;
  int upper = 0;
  int lower = 0;
  std::vector<float> down;
  for (const auto [x, y] : test::cells({0, 1, cumulus_width, cumulus_height})) {
    const float step = cumulus.cover(x, y) - cumulus.cover(x, y - 1);
    if (step > 0.05F) {
      ++upper;
      steepest_upper += step;
      light_upper += cumulus.deviate(x, y);
    } else if (step < -0.05F) {
      ++lower;
      steepest_lower -= step;
      light_lower += cumulus.deviate(x, y);
    }
  }
  ASSERT_GT(upper, 500);
  ASSERT_GT(lower, 500);
  EXPECT_GT(steepest_upper / upper, 1.3 * steepest_lower / lower);
  EXPECT_GT(light_upper / upper, light_lower / lower + 0.8);
}

TEST(StyleCumulus, LightIsANormalDeviateWhereThereIsCloud) {
  const StyleCumulus cumulus(cumulus_sky(), whole_sky, cumulus_parameters());
  std::vector<double> deviates;
  for (const auto [x, y] : test::cells(cumulus_width, cumulus_height))
    if (cumulus.cover(x, y) >= 0.5F) deviates.push_back(cumulus.deviate(x, y));
  std::sort(deviates.begin(), deviates.end());
  EXPECT_NEAR(deviates[deviates.size() / 2], 0.0, 0.1);
  EXPECT_NEAR(deviates[deviates.size() * 9 / 10], 1.282, 0.15);
}

TEST(StyleCumulus, AWindowHasTheBitsOfTheWhole) {
  const StyleCumulus cumulus(cumulus_sky(), whole_sky, cumulus_parameters());
  const StyleCumulus part(cumulus_sky(), {{210, 33}, 40, 30}, cumulus_parameters());
  for (int y = 0; y < 30; ++y) {
    ASSERT_EQ(part.share(y), cumulus.share(33 + y));
    for (int x = 0; x < 40; ++x) {
      ASSERT_EQ(part.cover(x, y), cumulus.cover(210 + x, 33 + y));
      ASSERT_EQ(part.deviate(x, y), cumulus.deviate(210 + x, 33 + y));
    }
  }
}

}  // namespace
}  // namespace belvedere
