#include "renderer/paint/clouds/clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "base/error.h"

namespace belvedere {
namespace {

SkyParameters sky_of(SkyKind kind, std::uint64_t seed = 1) { return {.kind = kind, .seed = seed}; }

TEST(Clouds, SeedsHaveEveryKindOfSky) {
  std::set<SkyKind> kinds;
  for (std::uint64_t seed = 1; seed <= 24; ++seed)
    kinds.insert(look_of_sky(sky_of(SkyKind::any, seed)).kind);
  EXPECT_EQ(kinds,
            (std::set<SkyKind>{SkyKind::fair, SkyKind::rows, SkyKind::streaks, SkyKind::banks}));
}

TEST(Clouds, KindsAreFoundByName) {
  EXPECT_EQ(find_sky_kind("rows"), SkyKind::rows);
  EXPECT_EQ(find_sky_kind("any"), SkyKind::any);
  EXPECT_EQ(find_sky_kind("evening"), SkyKind::evening);
  EXPECT_THROW(find_sky_kind("thunder"), Error);
}

TEST(Clouds, AKindThatIsAskedForIsTaken) {
  for (std::uint64_t seed = 1; seed < 9; ++seed)
    EXPECT_EQ(look_of_sky(sky_of(SkyKind::banks, seed)).kind, SkyKind::banks);
}

// A wall behind the ranges is low; scattered heaps are at every height.
TEST(Clouds, BanksStandLow) {
  double low = 0.0, fair = 0.0;
  for (std::uint64_t seed = 1; seed < 9; ++seed) {
    const auto share = [&](SkyKind kind) {
      const std::vector<Cloud> clouds = make_clouds(sky_of(kind, seed));
      EXPECT_GT(clouds.size(), 4U);
      const auto below = std::count_if(clouds.begin(), clouds.end(),
                                       [](const Cloud& c) { return c.base_px > 198.0F * 0.80F; });
      return static_cast<double>(below) / static_cast<double>(clouds.size());
    };
    low += share(SkyKind::banks) / 8.0;
    fair += share(SkyKind::fair) / 8.0;
  }
  EXPECT_GT(low, fair + 0.1);
}

// The slopes of lines from the vanishing point to clouds form clusters: neighbours in order of
// slope are closer than for evenly spread clouds.
TEST(Clouds, RowsComeFromTheVanishingPoint) {
  const auto gathered = [](SkyKind kind, std::uint64_t seed) {
    const SkyParameters p = sky_of(kind, seed);
    const SkyLook look = look_of_sky(p);
    EXPECT_GT(look.vanishing_px.y, p.horizon_px) << "below the horizon";
    std::vector<double> slopes;
    for (const Cloud& cloud : make_clouds(p)) {
      const double x = 0.5 * static_cast<double>(cloud.from.x + cloud.to.x);
      slopes.push_back((x - look.vanishing_px.x) /
                       (look.vanishing_px.y - static_cast<double>(cloud.base_px)));
    }
    std::sort(slopes.begin(), slopes.end());
    std::vector<double> gaps;
    for (std::size_t k = 1; k < slopes.size(); ++k) gaps.push_back(slopes[k] - slopes[k - 1]);
    double mean = 0.0, squares = 0.0;
    for (const double gap : gaps) mean += gap / static_cast<double>(gaps.size());
    for (const double gap : gaps)
      squares += (gap - mean) * (gap - mean) / static_cast<double>(gaps.size());
    return std::sqrt(squares) / mean;  // 1 for random positions, more for clusters
  };
  double rows = 0.0;
  for (std::uint64_t seed = 1; seed < 9; ++seed) rows += gathered(SkyKind::rows, seed) / 8.0;
  EXPECT_GT(rows, 1.15);
}

TEST(Clouds, NoneAreAskedFor) {
  SkyParameters p = sky_of(SkyKind::rows);
  p.clouds = 0.0;
  EXPECT_TRUE(make_clouds(p).empty());
}

// Fair-weather heaps: smaller towards the horizon, all over level bases, and fewer and lower in
// winter.
TEST(Clouds, CumulusStandsHighAndShrinksTowardsTheHorizon) {
  double winter_tall = 0.0, tall = 0.0;
  std::size_t winter_count = 0, count = 0;
  for (std::uint64_t seed = 1; seed < 7; ++seed) {
    SkyParameters p = sky_of(SkyKind::cumulus, seed);
    double near = 0.0, far = 0.0;
    int nears = 0, fars = 0;
    for (const Cloud& cloud : make_clouds(p)) {
      const double width = cloud.to.x - cloud.from.x;
      for (const CloudHead& head : cloud.heads)
        EXPECT_LE(head.centre.y, cloud.base_px + 0.2F * head.radius.y);
      if (cloud.base_px < 0.75F * p.horizon_px) near += width, ++nears;
      if (cloud.base_px > 0.90F * p.horizon_px) far += width, ++fars;
      tall += (cloud.base_px - cloud.from.y) / width;
      ++count;
    }
    ASSERT_GT(nears, 2) << seed;
    ASSERT_GT(fars, 2) << seed;
    EXPECT_GT(near / nears, 1.5 * far / fars);
    p.winter = true;
    for (const Cloud& cloud : make_clouds(p)) {
      winter_tall += (cloud.base_px - cloud.from.y) / (cloud.to.x - cloud.from.x);
      ++winter_count;
    }
  }
  EXPECT_LT(winter_count, count);
  EXPECT_LT(winter_tall / static_cast<double>(winter_count),
            0.85 * tall / static_cast<double>(count));
}

TEST(Clouds, EveningBarsAreLongAndLitFromBelow) {
  for (std::uint64_t seed = 1; seed < 5; ++seed) {
    const std::vector<Cloud> bars = make_clouds(sky_of(SkyKind::evening, seed));
    EXPECT_GT(bars.size(), 10U);
    for (const Cloud& bar : bars) {
      EXPECT_EQ(bar.underlit, 1.0F);
      EXPECT_GT(bar.to.x - bar.from.x, 2.5F * (bar.to.y - bar.from.y));
    }
  }
  for (const Cloud& cloud : make_clouds(sky_of(SkyKind::fair))) EXPECT_EQ(cloud.underlit, 0.0F);
}

}  // namespace
}  // namespace belvedere
