#include "renderer/ground/river_banks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace belvedere {
namespace {

CoverRiver river_along(const std::function<glm::dvec2(double)>& way, double length_m,
                       float half_m) {
  CoverRiver river;
  for (double s = 0.0; s <= length_m; s += 20.0) {
    river.positions.push_back(way(s));
    river.half_width_m.push_back(half_m);
  }
  return river;
}
CoverRiver straight(double length_m, float half_m) {
  return river_along([](double s) { return glm::dvec2(s, 0.0); }, length_m, half_m);
}

// Means over the middle of a river, away from its source and its end.
struct Means {
  double half_m = 0.0;
  double aside_m = 0.0;  // of the line, to the north
  double varies_m = 0.0;
};
Means means_of(const CoverRiver& river) {
  Means m;
  const std::size_t from = river.positions.size() / 4;
  const std::size_t to = 3 * river.positions.size() / 4;
  const auto count = static_cast<double>(to - from);
  for (std::size_t i = from; i < to; ++i) {
    m.half_m += static_cast<double>(river.half_width_m[i]) / count;
    m.aside_m += river.positions[i].y / count;
  }
  for (std::size_t i = from; i < to; ++i)
    m.varies_m += std::abs(static_cast<double>(river.half_width_m[i]) - m.half_m) / count;
  return m;
}

TEST(RiverBanks, KeepTheMeanWidthAndVary) {
  const Means m = means_of(with_banks({straight(60000.0, 25.0F)}, 1)[0]);
  EXPECT_NEAR(m.half_m, 25.0, 2.0);
  EXPECT_NEAR(m.aside_m, 0.0, 1.5);
  EXPECT_GT(m.varies_m, 1.0);
  EXPECT_LT(m.varies_m, 5.0);
}

// The longest reach, in widths, from whose chord the line departs by less than an eighth of a
// width.
double straightest(const CoverRiver& river, double width_m) {
  double longest = 0.0;
  for (std::size_t i = 0; i < river.positions.size(); ++i)
    for (std::size_t j = i + 2; j < river.positions.size(); ++j) {
      const glm::dvec2 way = river.positions[j] - river.positions[i];
      const double length = std::hypot(way.x, way.y);
      double off = 0.0;
      for (std::size_t k = i + 1; k < j; ++k) {
        const glm::dvec2 at = river.positions[k] - river.positions[i];
        off = std::max(off, std::abs(way.x * at.y - way.y * at.x) / length);
      }
      if (off > 0.125 * width_m) break;
      longest = std::max(longest, length / width_m);
    }
  return longest;
}

TEST(RiverBanks, InferredCoursesAreNowhereStraight) {
  CoverRiver line;
  for (int k = 0; k <= 250; ++k) {
    line.positions.emplace_back(500.0, 8000.0 - 20.0 * k);
    line.half_width_m.push_back(10.0F);
  }
  EXPECT_GT(straightest(with_banks({line}, 1)[0], 20.0), 50.0);
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U}) {
    const CoverRiver river = with_banks({line}, seed, 1.0)[0];
    EXPECT_LT(straightest(river, 20.0), 20.0) << seed;
    EXPECT_EQ(river.positions.front(), line.positions.front());
    for (const glm::dvec2 position : river.positions) EXPECT_NEAR(position.x, 500.0, 26.0) << seed;
  }
}

// On a circle that turns left the inner bank is the left one: the line moves outwards.
TEST(RiverBanks, InnerBanksComeForward) {
  constexpr double radius_m = 200.0;
  const auto circle = [&](double s) {
    return radius_m * glm::dvec2(std::cos(s / radius_m), std::sin(s / radius_m));
  };
  const CoverRiver river = with_banks({river_along(circle, 1100.0, 25.0F)}, 1)[0];
  double mean_m = 0.0;
  double half_m = 0.0;
  int count = 0;
  for (std::size_t i = river.positions.size() / 3; i < 2 * river.positions.size() / 3; ++i) {
    mean_m += std::hypot(river.positions[i].x, river.positions[i].y);
    half_m += static_cast<double>(river.half_width_m[i]);
    ++count;
  }
  EXPECT_GT(mean_m / count, radius_m + 4.0);
  EXPECT_LT(half_m / count, 0.92 * 25.0) << "bends are narrow";
}

TEST(RiverBanks, SourcesAreNarrowAndEndsStay) {
  const CoverRiver river = with_banks({straight(4000.0, 25.0F)}, 1)[0];
  EXPECT_LT(river.half_width_m.front(), 14.0F);
  EXPECT_EQ(river.positions.front(), glm::dvec2(0.0, 0.0));
  EXPECT_EQ(river.positions.back(), glm::dvec2(4000.0, 0.0));
}

TEST(RiverBanks, TributariesEnterDownstream) {
  const CoverRiver main = straight(6000.0, 40.0F);
  const CoverRiver tributary =
      river_along([](double s) { return glm::dvec2(3000.0, 2000.0 - s); }, 2000.0, 15.0F);
  const std::vector<CoverRiver> rivers = with_banks({main, tributary}, 1);
  const CoverRiver& turned = rivers[1];
  const std::size_t last = turned.positions.size() - 1;
  EXPECT_NEAR(turned.positions[last].x, 3000.0 + 0.62 * 8.0 * 40.0, 60.0);
  EXPECT_LT(std::abs(turned.positions[last].y), 40.0) << "in the main river";
  const glm::dvec2 way = turned.positions[last] - turned.positions[last - 4];
  EXPECT_GT(way.x, std::abs(way.y)) << "at less than 45°";
}

TEST(RiverBanks, ShortRiversAndNoneAtAllStay) {
  EXPECT_TRUE(with_banks({}, 1).empty());
  const CoverRiver shorter = straight(60.0, 25.0F);
  EXPECT_EQ(with_banks({shorter}, 1)[0].positions, shorter.positions);
}

}  // namespace
}  // namespace belvedere
