#include "terrain/generalize/generalize_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/grids.h"
#include "tests/terrain/generalize/plan_curvature.h"

// Values of rows with a closed form; results of whole bands: generalize_analytic_test.cpp,
// generalize_real_test.cpp.
namespace belvedere {
namespace {

constexpr double rows_cell_m = 20.0;

// f(x, y) in metres, x east and y north of the grid's centre.
template <class F>
Grid<float> surface(int size, F&& f) {
  return test::grid_of(size, size, [&](int x, int y) {
    return f((x - size / 2) * rows_cell_m, (size / 2 - y) * rows_cell_m);
  });
}

Grid<float> plan_curvature(const Grid<float>& altitude_m) {
  return test::curvature_by_rows(altitude_m, rows_cell_m, true);
}
Grid<float> bounded_plan_curvature(const Grid<float>& altitude_m) {
  return test::curvature_by_rows(altitude_m, rows_cell_m, false);
}

TEST(PlanCurvature, OfAConeIsOneOverTheRadius) {
  // Hills are convex, hollows concave, whatever the slope.
  for (const double steepness : {0.2, 1.0}) {
    const Grid<float> hill =
        surface(201, [&](double x, double y) { return 3000.0 - steepness * std::hypot(x, y); });
    const Grid<float> hollow =
        surface(201, [&](double x, double y) { return steepness * std::hypot(x, y); });
    const Grid<float> kp = plan_curvature(hill);
    const Grid<float> kp_hollow = plan_curvature(hollow);
    for (const auto& [x, y] :
         {std::pair{100, 50}, std::pair{180, 100}, std::pair{140, 150}, std::pair{40, 160}}) {
      const double radius = std::hypot(x - 100, y - 100) * rows_cell_m;
      EXPECT_NEAR(kp(x, y) * radius, 1.0, 2e-3) << x << ' ' << y;
      EXPECT_NEAR(kp_hollow(x, y) * radius, -1.0, 2e-3) << x << ' ' << y;
    }
  }
}

TEST(PlanCurvature, OfAParaboloidIsOneOverTheRadius) {
  const Grid<float> hill =
      surface(201, [](double x, double y) { return 3000.0 - 2e-4 * (x * x + y * y); });
  const Grid<float> kp = plan_curvature(hill);
  for (const auto& [x, y] :
       {std::pair{100, 50}, std::pair{180, 100}, std::pair{140, 150}, std::pair{40, 160}}) {
    EXPECT_NEAR(kp(x, y) * std::hypot(x - 100, y - 100) * rows_cell_m, 1.0, 2e-3) << x << ' ' << y;
  }
  // On the summit the contour is a point: no direction, no curvature.
  EXPECT_EQ(kp(100, 100), 0.F);
}

TEST(PlanCurvature, OfAQuadricIsExact) {
  // z = a x² + b y² + c x y + d x + e y: the 3 × 3 fit returns its derivatives exactly.
  const double a = 3e-4, b = -1e-4, c = 2e-4, d = 0.3, e = -0.2;
  const Grid<float> quadric = surface(
      61, [&](double x, double y) { return a * x * x + b * y * y + c * x * y + d * x + e * y; });
  const Grid<float> kp = plan_curvature(quadric);
  const Grid<float> bounded = bounded_plan_curvature(quadric);
  for (const auto& [column, row] : {std::pair{30, 30}, std::pair{10, 44}, std::pair{50, 12}}) {
    const double x = (column - 30) * rows_cell_m;
    const double y = (30 - row) * rows_cell_m;
    const double p = 2 * a * x + c * y + d;
    const double q = 2 * b * y + c * x + e;
    const double n = q * q * 2 * a - 2 * p * q * c + p * p * 2 * b;
    const double g = std::hypot(p, q);
    EXPECT_NEAR(kp(column, row), -n / (g * g * g), 2e-6) << column;
    EXPECT_NEAR(bounded(column, row), -n / (g * g), 1e-6) << column;
  }
}

TEST(PlanCurvature, BoundedFormStaysFiniteWhereTheOtherDiverges) {
  const Grid<float> saddle =
      surface(21, [](double x, double y) { return 1e-3 * (x * x - y * y) + 1e-5 * x; });
  const Grid<float> bounded = bounded_plan_curvature(saddle);
  // Inside the border, where the window is whole.
  for (const auto [x, y] : test::cells({1, 1, 20, 20}))
    ASSERT_LE(std::abs(bounded(x, y)), 2e-3F * 1.01F);
}

TEST(BreakLine, IsTheCurvatureAgainstAFullOneAndAtMostOne) {
  // A cone, whose contours have radii of 200 m and more: full at 20 cells.
  const Grid<float> hill =
      surface(101, [](double x, double y) { return 3000.0 - 0.5 * std::hypot(x, y); });
  const Grid<float> hollow =
      surface(101, [](double x, double y) { return 3000.0 + 0.5 * std::hypot(x, y); });
  for (const bool plan : {true, false}) {
    const double full_per_m = (plan ? 1.0 : 0.5) / 400.0;
    const BreakLineScale scale{plan, 1.F / 20.F, 1.F / 20.F, static_cast<float>(1.0 / full_per_m)};
    for (const Grid<float>* ground : {&hill, &hollow}) {
      std::vector<float> row(99);
      break_line_row(ground->row(49) + 1, ground->row(50) + 1, ground->row(51) + 1, 99, scale,
                     row.data());
      for (const int cells : {10, 15, 25, 40}) {
        const double c = std::min(20.0 / cells, 1.0);
        EXPECT_NEAR(row[static_cast<std::size_t>(49 + cells)], c, 4e-3) << plan << ' ' << cells;
        EXPECT_NEAR(row[static_cast<std::size_t>(49 - cells)], c, 4e-3) << plan << ' ' << cells;
      }
    }
  }
}

TEST(PowerRow, IsThePowerForAnyExponent) {
  for (const float exponent : {0.1F, 0.25F, 0.5F, 0.75F, 1.5F, 4.F}) {
    std::vector<float> values;
    for (int i = 0; i <= 1000; ++i) values.push_back(static_cast<float>(i) / 1000.F);
    power_row(values.data(), static_cast<int>(values.size()), exponent);
    for (int i = 0; i <= 1000; ++i)
      ASSERT_NEAR(values[static_cast<std::size_t>(i)],
                  std::pow(i / 1000.0, static_cast<double>(exponent)), 1e-5)
          << i << ' ' << exponent;
    EXPECT_EQ(values.front(), 0.F);
    EXPECT_EQ(values.back(), 1.F);
  }
}

// The share of the ridge set at the centre of L = height + p x + r x²/2 + t y²/2, where P = p² r,
// if the mean is that of p x + (r x² + t y²) / 2 with curvatures of its own.
float share_at_centre(double height, double p, double r, double mean_r, double mean_t) {
  using Rows = std::vector<std::vector<float>>;
  const auto rows = [&](double base, double bend_x, double bend_y) {
    Rows z(3, std::vector<float>(3));
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        z[static_cast<std::size_t>(1 - y)][static_cast<std::size_t>(x + 1)] =
            static_cast<float>(base + p * x + 0.5 * (bend_x * x * x + bend_y * y * y));
    return z;
  };
  const Rows band = rows(height, r, 0.0);
  const Rows mean = rows(height, mean_r, mean_t);
  const float* const band_rows[3] = {band[0].data() + 1, band[1].data() + 1, band[2].data() + 1};
  const float* const mean_rows[3] = {mean[0].data() + 1, mean[1].data() + 1, mean[2].data() + 1};
  float out = -1.F;
  convex_share_row(band_rows, mean_rows, 1, 1.F, 1.F, &out);
  return out;
}

TEST(ConvexShare, IsOneOrNoneWhereTheFormIsClear) {
  // Curvature of 1 m per cell² against .02 of 2 m: the surrounding ground has no weight.
  for (const double around : {-1.0, 1.0}) {
    EXPECT_EQ(share_at_centre(2.0, 3.0, -1.0, around, 0.0), 1.F);
    EXPECT_EQ(share_at_centre(2.0, 3.0, 1.0, around, 0.0), 0.F);
    EXPECT_EQ(share_at_centre(-2.0, 3.0, 0.041, around, 0.0), 0.F);
  }
}

TEST(ConvexShare, GoesToWhatIsAroundWhereTheFormIsNotClear) {
  // .01 of .02 · 2 m: a quarter by the cell itself.
  EXPECT_NEAR(share_at_centre(2.0, 3.0, 0.01, -1.0, 0.0), 0.75F, 1e-4F);
  EXPECT_NEAR(share_at_centre(2.0, 3.0, -0.01, 1.0, 0.0), 0.25F, 1e-4F);
  EXPECT_EQ(share_at_centre(2.0, 3.0, -0.01, -1.0, 0.0), 1.F);
  EXPECT_EQ(share_at_centre(2.0, 3.0, 0.01, 1.0, 0.0), 0.F);
  // On the crest and along the bottom P is 0, and the curvature across decides.
  EXPECT_EQ(share_at_centre(2.0, 0.0, -1.0, -0.5, 0.25), 1.F);
  EXPECT_EQ(share_at_centre(-2.0, 0.0, 1.0, 0.5, -0.25), 0.F);
}

}  // namespace
}  // namespace belvedere
