#include "terrain/climate/growing_season.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/terrain/climate/synthetic_months.h"

namespace belvedere {
namespace {

using test::constant;

constexpr double pi = std::numbers::pi;

// Monthly means, in closed form, of mean + swing · cos(2π · waves · (t - phase)), t in years.
Months means_of_wave(double mean, double swing, int waves, double phase) {
  Months months{};
  for (std::size_t m = 0; m < 12; ++m) {
    const double w = 2.0 * pi * waves;
    const double from = static_cast<double>(m) / 12.0 - phase;
    months[m] = mean + swing * 12.0 / w * (std::sin(w * (from + 1.0 / 12.0)) - std::sin(w * from));
  }
  return months;
}

TEST(DailyCourse, IsTheWaveWhoseMeansWereGiven) {
  for (const int waves : {1, 2, 5}) {
    const auto days = daily_c(means_of_wave(3.0, 9.0, waves, 0.07));
    for (std::size_t d = 0; d < 365; d += 7) {
      const double t = (static_cast<double>(d) + 0.5) / 365.0 - 0.07;
      EXPECT_NEAR(days[d], 3.0 + 9.0 * std::cos(2.0 * pi * waves * t), 1e-9) << waves << " " << d;
    }
  }
}

TEST(GrowingSeason, OfAWaveIsItsClosedForm) {
  // Of 10 · cos above .9: cos θ = .09 on each side; the mean is 10 · sin θ / θ.
  const GrowingSeason season = growing_season(means_of_wave(0.0, 10.0, 1, 0.55));
  const double half = std::acos(0.09);
  EXPECT_NEAR(season.days, 365.0 * half / pi, 0.02);
  EXPECT_NEAR(season.mean_c, 10.0 * std::sin(half) / half, 2e-3);
}

TEST(GrowingSeason, WithoutSeasons) {
  EXPECT_NEAR(growing_season(constant(7.0)).days, 365.0, 1e-9);
  EXPECT_NEAR(growing_season(constant(7.0)).mean_c, 7.0, 1e-9);
  EXPECT_EQ(growing_season(constant(0.5)).days, 0.0);
  EXPECT_EQ(growing_season(constant(0.5)).mean_c, 0.0);
}

TEST(Treeline, ExcessCountsKelvin) {
  EXPECT_NEAR(treeline_excess_k(constant(6.4)), 0.0, 1e-5);
  EXPECT_NEAR(treeline_excess_k(constant(1.4)), 5.0, 1e-5);
  EXPECT_NEAR(treeline_excess_k(constant(26.4)), -20.0, 1e-5);
  const Months wave = means_of_wave(-2.0, 14.0, 1, 0.55);
  Months colder = wave;
  for (double& t : colder) t -= 3.25;
  EXPECT_NEAR(treeline_excess_k(colder) - treeline_excess_k(wave), 3.25, 1e-5);
}

TEST(Treeline, ShortSummersNeedTheirDays) {
  // Summers 14 K above a cold year: warm enough, but shorter than 94 days, so that days decide and
  // not the mean.
  const Months wave = means_of_wave(-31.0, 45.0, 1, 0.55);
  const double excess = treeline_excess_k(wave);
  Months at_line = wave;
  for (double& t : at_line) t += excess;
  const GrowingSeason season = growing_season(at_line);
  EXPECT_NEAR(season.days, 94.0, 0.01);
  EXPECT_GT(season.mean_c, 6.4);
}

TEST(HighestAltitude, IsFoundToAMillimetre) {
  EXPECT_NEAR(highest_m([](double m) { return m < 1234.567; }), 1234.567, 2e-3);
  EXPECT_NEAR(highest_m([](double m) { return m < -50.0 || (m > 3000.0 && m < 3333.3); }), 3333.3,
              2e-3);
  EXPECT_EQ(highest_m([](double) { return true; }), 9000.0);
  EXPECT_EQ(highest_m([](double) { return false; }), -2000.0);
}

}  // namespace
}  // namespace belvedere
