#include "terrain/layers/fit/minimize.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace belvedere {
namespace {

TEST(Minimize, RosenbrocksValleyEndsAtItsFloor) {
  // f = Σ 100 (x_{i+1} - x_i²)² + (1 - x_i)²: 0 at (1, 1, …), a valley whose walls are a thousand
  // times steeper than its floor.
  const ValueAndGradient rosenbrock = [](std::span<const double> x, std::span<double> gradient) {
    double value = 0.0;
    for (double& g : gradient) g = 0.0;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      const double off = x[i + 1] - x[i] * x[i];
      value += 100.0 * off * off + (1.0 - x[i]) * (1.0 - x[i]);
      gradient[i] += -400.0 * off * x[i] - 2.0 * (1.0 - x[i]);
      gradient[i + 1] += 200.0 * off;
    }
    return value;
  };
  const MinimizeResult result =
      minimize({-1.2, 1.0, -0.7, 2.0}, rosenbrock, {.steps = 300, .tolerance = 0.0});
  EXPECT_LT(result.value, 1e-18);
  for (const double x : result.at) EXPECT_NEAR(x, 1.0, 1e-8);
  EXPECT_LT(result.evaluations, 200);  // of plain steepest descent it takes tens of thousands
}

TEST(Minimize, QuadraticOfKnownSolution) {
  // f = Σ c_i (x_i - i)² / 2 with curvatures over four decades.
  const ValueAndGradient bowl = [](std::span<const double> x, std::span<double> gradient) {
    double value = 0.0;
    for (std::size_t i = 0; i != x.size(); ++i) {
      const double c = std::pow(10.0, static_cast<double>(i % 5));
      const double off = x[i] - static_cast<double>(i);
      gradient[i] = c * off;
      value += 0.5 * c * off * off;
    }
    return value;
  };
  const MinimizeResult result =
      minimize(std::vector<double>(20, 0.0), bowl, {.steps = 200, .tolerance = 0.0});
  for (std::size_t i = 0; i != result.at.size(); ++i)
    EXPECT_NEAR(result.at[i], static_cast<double>(i), 1e-7);
}

TEST(Minimize, StaysWhereThereIsNothingToGain) {
  const ValueAndGradient flat = [](std::span<const double>, std::span<double> gradient) {
    for (double& g : gradient) g = 0.0;
    return 3.0;
  };
  const MinimizeResult result = minimize({1.0, 2.0}, flat);
  EXPECT_EQ(result.steps, 0);
  EXPECT_EQ(result.at, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(result.value, 3.0);
}

TEST(Minimize, TakesNoMoreStepsThanAllowed) {
  const ValueAndGradient quartic = [](std::span<const double> x, std::span<double> gradient) {
    gradient[0] = 4.0 * x[0] * x[0] * x[0];
    return x[0] * x[0] * x[0] * x[0];
  };
  EXPECT_LE(minimize({10.0}, quartic, {.steps = 3, .tolerance = 0.0}).steps, 3);
}

}  // namespace
}  // namespace belvedere
