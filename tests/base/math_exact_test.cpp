#include "base/math_exact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "base/random.h"

namespace belvedere {
namespace {

constexpr double pi = std::numbers::pi;

// Positions over a range, the same ones each time.
template <class F>
void over(double low, double high, F&& f) {
  for (int k = 0; k < 20000; ++k) f(low + (high - low) * random_uniform(1, k, 0));
}

// The C library of long doubles is exact to the last bit of a double.
long double true_cos(double x) { return std::cos(static_cast<long double>(x)); }
long double true_sin(double x) { return std::sin(static_cast<long double>(x)); }

double off(double value, long double truth) {
  return static_cast<double>(std::abs(static_cast<long double>(value) - truth));
}

TEST(MathExact, TurnsKeepTheirErrorBound) {
  over(-10.0, 10.0, [](double x) {
    EXPECT_LT(off(exact::cos(x), true_cos(x)), 3e-16) << x;
    EXPECT_LT(off(exact::sin(x), true_sin(x)), 3e-16) << x;
  });
  over(-1e6, 1e6, [](double x) {
    EXPECT_LT(off(exact::cos(x), true_cos(x)), 1e-16 * std::abs(x) + 3e-16) << x;
    EXPECT_LT(off(exact::sin(x), true_sin(x)), 1e-16 * std::abs(x) + 3e-16) << x;
  });
}

TEST(MathExact, QuartersOfATurn) {
  for (int k = -8; k <= 8; ++k) {
    const exact::Turn turn = exact::turn(k * pi / 2.0);
    const double cosines[4] = {1.0, 0.0, -1.0, 0.0};
    EXPECT_NEAR(turn.cosine, cosines[k & 3], 1e-15) << k;
    EXPECT_NEAR(turn.sine, cosines[(k + 3) & 3], 1e-15) << k;
  }
  EXPECT_EQ(exact::cos(0.0), 1.0);
  EXPECT_EQ(exact::sin(0.0), 0.0);
  EXPECT_EQ(exact::sin(-0.7), -exact::sin(0.7));
}

TEST(MathExact, AnglesInAllQuarters) {
  over(-pi, pi, [](double angle) {
    const double x = 3.7 * std::cos(angle);
    const double y = 3.7 * std::sin(angle);
    EXPECT_LT(off(exact::atan2(y, x),
                  std::atan2(static_cast<long double>(y), static_cast<long double>(x))),
              6e-16)
        << angle;
  });
  EXPECT_EQ(exact::atan2(0.0, 0.0), 0.0);
  EXPECT_EQ(exact::atan2(0.0, 2.0), 0.0);
  EXPECT_EQ(exact::atan2(0.0, -2.0), pi);
  EXPECT_EQ(exact::atan2(1.0, 0.0), pi / 2.0);
  EXPECT_EQ(exact::atan2(-1.0, 0.0), -pi / 2.0);
}

TEST(MathExact, AnglesOfSlopesSinesAndCosines) {
  over(-1.5, 1.5, [](double angle) {
    const long double truth = std::tan(static_cast<long double>(angle));
    EXPECT_LT(off(exact::tan(angle), truth), 1e-15 * std::abs(static_cast<double>(truth)) + 1e-300)
        << angle;
  });
  over(-50.0, 50.0, [](double slope) {
    EXPECT_LT(off(exact::atan(slope), std::atan(static_cast<long double>(slope))), 6e-16) << slope;
  });
  over(-1.0, 1.0, [](double x) {
    EXPECT_LT(off(exact::asin(x), std::asin(static_cast<long double>(x))), 1e-15) << x;
    EXPECT_LT(off(exact::acos(x), std::acos(static_cast<long double>(x))), 1e-15) << x;
  });
  EXPECT_EQ(exact::asin(1.0), pi / 2.0);
  EXPECT_EQ(exact::acos(1.0), 0.0);
  EXPECT_EQ(exact::acos(-1.0), pi);
}

TEST(MathExact, RootsAndLengths) {
  over(-6.0, 6.0, [](double decades) {
    const double x = std::pow(10.0, decades);
    const long double truth = std::cbrt(static_cast<long double>(x));
    EXPECT_LT(off(exact::cbrt(x), truth), 4e-16 * static_cast<double>(truth)) << x;
    EXPECT_EQ(exact::cbrt(-x), -exact::cbrt(x));
    const long double length = std::hypot(static_cast<long double>(x), 2.0L);
    EXPECT_LT(off(exact::hypot(x, -2.0), length), 4e-16 * static_cast<double>(length)) << x;
  });
  EXPECT_EQ(exact::cbrt(0.0), 0.0);
  EXPECT_EQ(exact::hypot(3.0, 4.0), 5.0);
}

TEST(MathExact, LogarithmsKeepTheirErrorBound) {
  over(-300.0, 300.0, [](double decades) {
    const double x = std::pow(10.0, decades);
    const long double truth = std::log2(static_cast<long double>(x));
    EXPECT_LT(off(exact::log2(x), truth), 4e-16 * std::abs(static_cast<double>(truth)) + 1e-16)
        << x;
    const long double natural = std::log(static_cast<long double>(x));
    EXPECT_LT(off(exact::log(x), natural), 4e-16 * std::abs(static_cast<double>(natural)) + 1e-16)
        << x;
    const long double decimal = std::log10(static_cast<long double>(x));
    EXPECT_LT(off(exact::log10(x), decimal), 6e-16 * std::abs(static_cast<double>(decimal)) + 1e-16)
        << x;
  });
  for (int k = -1074; k <= 1023; ++k)
    EXPECT_EQ(exact::log2(std::ldexp(1.0, k)), k);  // subnormal ones as well
  EXPECT_LT(off(exact::log2(0x1.8p-1070), std::log2(0x1.8p-1070L)), 4e-13);
}

TEST(MathExact, PowersKeepTheirErrorBound) {
  over(-690.0, 690.0, [](double x) {
    const long double truth = std::exp(static_cast<long double>(x));
    EXPECT_LT(off(exact::exp(x), truth), 4e-16 * (1.0 + std::abs(x)) * static_cast<double>(truth))
        << x;
  });
  over(-6.0, 6.0, [](double decades) {
    const double base = std::pow(10.0, decades);
    for (const double exponent : {0.3, 1.0 / 2.4, 1.3, 2.4}) {
      const long double truth =
          std::pow(static_cast<long double>(base), static_cast<long double>(exponent));
      const double bound =
          1e-15 * (1.0 + std::abs(exponent * std::log2(base))) * static_cast<double>(truth);
      EXPECT_LT(off(exact::pow(base, exponent), truth), bound) << base << " ^ " << exponent;
    }
  });
  for (int k = -1000; k <= 1000; ++k) EXPECT_EQ(exact::exp2(k), std::ldexp(1.0, k));
  EXPECT_EQ(exact::pow(0.0, 1.3), 0.0);
  EXPECT_EQ(exact::exp(-1e5), 0.0);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(exact::exp(1e5), infinity);
  EXPECT_EQ(exact::log(infinity), infinity);
  EXPECT_EQ(exact::log(0.0), -infinity);
  EXPECT_TRUE(std::isnan(exact::log2(-1.0)));
  EXPECT_TRUE(std::isnan(exact::pow(std::nan(""), 2.4)));
  EXPECT_EQ(exact::exp(-exact::pow(infinity, 1.35)), 0.0);
}

// The bits themselves, recorded once: a machine or compiler with other bits fails here.
TEST(MathExact, TheSameBitsEverywhere) {
  std::uint64_t all = 0;
  const auto take = [&](double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    all = mix_bits(all ^ bits);
  };
  over(-20.0, 20.0, [&](double x) {
    take(exact::cos(x));
    take(exact::sin(x));
    take(exact::atan2(x, 3.0));
    take(exact::log2(x * x + 1e-3));
    take(exact::log(x * x + 1e-3));
    take(exact::exp2(x));
    take(exact::exp(x));
    take(exact::pow(x * x, 1.3));
    take(exact::tan(0.05 * x));
    take(exact::asin(0.05 * x));
    take(exact::acos(0.05 * x));
    take(exact::cbrt(x));
    take(exact::hypot(x, 3.0));
  });
  EXPECT_EQ(all, 1000721399535669862ULL);
}

}  // namespace
}  // namespace belvedere
