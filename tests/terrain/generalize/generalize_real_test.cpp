#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/filter.h"
#include "base/pyramid.h"
#include "terrain/generalize/generalize.h"
#include "tests/terrain/generalize/synthetic_relief.h"

// The method's properties on real ground, against formulas computed here in double.
namespace belvedere {
namespace {

using test::cell_m;
using test::real_ground;
using test::run;

Grid<float> window(const Grid<float>& grid, int x0, int y0, int size) {
  Grid<float> out(size, size);
  for (int y = 0; y < size; ++y) std::copy_n(grid.row(y0 + y) + x0, size, out.row(y));
  return out;
}

// The quadric of Evans and Young, lengths in cells.
struct Quadric {
  double p, q, r, s, t;
};
Quadric quadric(const Grid<float>& g, int x, int y) {
  const auto z = [&](int dx, int dy) { return static_cast<double>(g(x + dx, y + dy)); };
  return {(z(1, -1) + z(1, 0) + z(1, 1) - z(-1, -1) - z(-1, 0) - z(-1, 1)) / 6.0,
          (z(-1, -1) + z(0, -1) + z(1, -1) - z(-1, 1) - z(0, 1) - z(1, 1)) / 6.0,
          (z(-1, -1) + z(1, -1) + z(-1, 0) + z(1, 0) + z(-1, 1) + z(1, 1) -
           2.0 * (z(0, -1) + z(0, 0) + z(0, 1))) /
              3.0,
          (z(1, -1) + z(-1, 1) - z(-1, -1) - z(1, 1)) / 4.0,
          (z(-1, -1) + z(0, -1) + z(1, -1) + z(-1, 1) + z(0, 1) + z(1, 1) -
           2.0 * (z(-1, 0) + z(0, 0) + z(1, 0))) /
              3.0};
}

// A part of the Karwendel's DEM.
constexpr int side = 200;
std::optional<Grid<float>> karwendel() {
  const auto whole = real_ground("innsbruck/innsbruck_utm32_30m.tif");
  if (!whole) return std::nullopt;
  return window(*whole, (whole->width() - side) / 2, (whole->height() - side) / 2, side);
}

// c by its definition, [y][x]: |curvature| · cell / full, at most 1, of expand(G_1); a Gaussian
// over it; then the power. Cells closer to the border than the kernel's radius stay 0.
Grid<double> break_lines(const Grid<float>& sum, const GeneralizeParameters& p) {
  const bool plan = p.curvature == CurvatureForm::plan;
  const double full = p.full_curvature > 0.F ? p.full_curvature : plan ? 0.8 : 0.15;
  Grid<double> c(sum.width(), sum.height());
  for (int y = 1; y + 1 < sum.height(); ++y)
    for (int x = 1; x + 1 < sum.width(); ++x) {
      const Quadric z = quadric(sum, x, y);
      const double n = z.q * z.q * z.r - 2.0 * z.p * z.q * z.s + z.p * z.p * z.t;
      const double g2 = z.p * z.p + z.q * z.q;
      // Lengths are in cells, altitudes in metres: N/g² · cell / full is N/g² / cell of that, N/g³
      // · cell as it stands.
      const double k = plan ? std::abs(n) / std::pow(g2 + 1e-6 * cell_m * cell_m, 1.5)
                            : std::abs(n) / g2 / cell_m;
      c(x, y) = std::min(k / full, 1.0);
    }
  const double sigma = p.blur_cells;
  const int radius = sigma > 0.0 ? static_cast<int>(std::ceil(3.0 * sigma)) : 0;
  Grid<double> out(sum.width(), sum.height());
  for (int y = radius + 1; y + radius + 1 < sum.height(); ++y)
    for (int x = radius + 1; x + radius + 1 < sum.width(); ++x) {
      double weights = 0.0;
      double values = 0.0;
      for (int dy = -radius; dy <= radius; ++dy)
        for (int dx = -radius; dx <= radius; ++dx) {
          const double w =
              radius == 0 ? 1.0 : std::exp(-0.5 * (dx * dx + dy * dy) / (sigma * sigma));
          weights += w;
          values += w * c(x + dx, y + dy);
        }
      out(x, y) = std::pow(values / weights, static_cast<double>(p.exponent));
    }
  return out;
}

TEST(RealGeneralize, WeightsAlongBreakLinesFollowEquationFour) {
  const auto terrain = karwendel();
  if (!terrain) GTEST_SKIP() << "needs innsbruck/innsbruck_utm32_30m.tif";
  const Grid<float> sum = expand(reduce(*terrain), side, side);
  struct Case {
    CurvatureForm form;
    float full, blur, exponent;
  };
  using enum CurvatureForm;
  for (const Case& each :
       {Case{bounded, 0.F, 0.F, 1.F}, Case{bounded, 0.F, 1.F, 1.F}, Case{bounded, .3F, 2.F, 1.F},
        Case{bounded, 0.F, 1.F, .25F}, Case{bounded, 0.F, 1.F, .5F}, Case{bounded, 0.F, 1.F, .75F},
        Case{bounded, 0.F, 0.F, 2.F}, Case{plan, 0.F, 0.F, 1.F}, Case{plan, 0.F, 1.F, .5F},
        Case{plan, 2.F, 1.5F, .6F}}) {
    GeneralizeParameters p;
    p.foreground = p.background = {1.F};
    p.foreground_ridges = p.background_ridges = p.foreground_valleys = p.background_valleys = {4.F};
    p.curvature = each.form;
    p.full_curvature = each.full;
    p.blur_cells = each.blur;
    p.exponent = each.exponent;
    const Grid<float> out = run(*terrain, p);
    const Grid<double> c = break_lines(sum, p);
    std::vector<double> off;
    double min = 1.0;
    double max = 0.0;
    for (int y = 8; y + 8 < side; ++y)
      for (int x = 8; x + 8 < side; ++x) {
        const double band = static_cast<double>((*terrain)(x, y)) - sum(x, y);
        if (std::abs(band) < 2.0) continue;
        const double is = (static_cast<double>(out(x, y)) - (*terrain)(x, y)) / (4.0 * band);
        off.push_back(std::abs(is - c(x, y)));
        min = std::min(min, c(x, y));
        max = std::max(max, c(x, y));
      }
    SCOPED_TRACE(testing::Message() << (each.form == plan ? "plan" : "bounded") << ' ' << each.full
                                    << ' ' << each.blur << ' ' << each.exponent);
    ASSERT_GT(off.size(), 10000U);
    EXPECT_GT(max - min, 0.4);
    // A float's altitude has steps of 1e-4 m; on nearly level ground they turn a contour, in a few
    // cells.
    std::sort(off.begin(), off.end());
    EXPECT_LT(off[off.size() * 99 / 100], 1e-3);
    EXPECT_LT(off.back(), 0.05);
  }
}

// The finest band without the alternation of the pyramid's kernel, by its definition: even cells of
// the coarser level are expanded by [1 6 1] / 8.
Grid<float> even_band(const Grid<float>& terrain) {
  const Grid<float> coarser = reduce(terrain);
  const auto line = [](int at, auto&& value) {
    return at % 2 == 0
               ? 0.125 * value(at / 2 - 1) + 0.75 * value(at / 2) + 0.125 * value(at / 2 + 1)
               : 0.5 * (value(at / 2) + value(at / 2 + 1));
  };
  Grid<float> band(terrain.width(), terrain.height());
  for (int y = 2; y + 2 < terrain.height(); ++y)
    for (int x = 2; x + 2 < terrain.width(); ++x)
      band(x, y) = static_cast<float>(
          terrain(x, y) - line(y, [&](int v) {
            return line(x, [&](int u) { return static_cast<double>(coarser(u, v)); });
          }));
  return band;
}

// What P of the profile curvature is on a band's quadric; its sign is opposite.
double profile_of(const Grid<float>& band, int x, int y) {
  const Quadric z = quadric(band, x, y);
  return z.p * z.p * z.r + 2.0 * z.p * z.q * z.s + z.q * z.q * z.t;
}

struct SideShares {
  int cells = 0;
  double changed = 0.0;  // share of the cells of the side without weights that changed at all
  double by_half = 0.0;  // by more than half
  double raw = 0.0;      // that changed, if sides are told by the band with its alternation
};
SideShares wrong_sides(const Grid<float>& terrain, bool concave) {
  const Grid<float> band = make_laplacian_pyramid(terrain, 1).bands[0];
  const Grid<float> even = even_band(terrain);
  GeneralizeParameters p;
  p.foreground = p.background = {1.F};
  p.foreground_ridges = p.background_ridges = {concave ? 1.F : 0.F};
  p.foreground_valleys = p.background_valleys = {concave ? 0.F : 1.F};
  p.exponent = 0.F;  // c = 1
  const Grid<float> out = run(terrain, p);
  SideShares shares;
  int raw_cells = 0;
  for (int y = 4; y + 4 < terrain.height(); ++y)
    for (int x = 4; x + 4 < terrain.width(); ++x) {
      if (std::abs(band(x, y)) < 0.5F) continue;
      const double share = (static_cast<double>(out(x, y)) - terrain(x, y)) / band(x, y);
      const bool changes = std::abs(share) > 1e-3;
      if ((profile_of(band, x, y) > 0.0) == concave) {
        ++raw_cells;
        shares.raw += changes ? 1.0 : 0.0;
      }
      if ((profile_of(even, x, y) > 0.0) != concave) continue;
      ++shares.cells;
      shares.changed += changes ? 1.0 : 0.0;
      shares.by_half += share > 0.5 ? 1.0 : 0.0;
    }
  shares.raw /= raw_cells;
  shares.changed /= shares.cells;
  shares.by_half /= shares.cells;
  return shares;
}

// At most 2 % of the cells are on the wrong side. Told by the band with its alternation 6 % more
// are, in which it alone decides the sign (docs/generalization.md).
TEST(RealGeneralize, TheSetWithoutWeightsLeavesItsSideOfTheGround) {
  for (const char* file : {"innsbruck/innsbruck_utm32_30m.tif", "lost_river/mackay.tif"}) {
    const auto whole = real_ground(file);
    if (!whole) GTEST_SKIP() << "needs " << file;
    const Grid<float> terrain =
        window(*whole, (whole->width() - side) / 2, (whole->height() - side) / 2, side);
    for (const bool concave : {true, false}) {
      SCOPED_TRACE(testing::Message() << file << (concave ? ", concave" : ", convex"));
      const SideShares wrong = wrong_sides(terrain, concave);
      EXPECT_GT(wrong.cells, 6000);
      EXPECT_LT(wrong.changed, 0.02);
      EXPECT_LT(wrong.by_half, 0.01);
      EXPECT_LT(wrong.raw, 0.10);
    }
  }
}

// On ground without fine detail the sides do not change from cell to cell: the fourth difference of
// what is added along ridges is that of smooth forms, not that of a checkerboard.
TEST(RealGeneralize, SidesDoNotAlternateOnSmoothGround) {
  const auto terrain = karwendel();
  if (!terrain) GTEST_SKIP() << "needs innsbruck/innsbruck_utm32_30m.tif";
  const Grid<float> smooth = gaussian_blur(*terrain, 4.0);
  GeneralizeParameters p;
  p.foreground = p.background = {1.F};
  p.foreground_ridges = p.background_ridges = {1.F};
  p.foreground_valleys = p.background_valleys = {0.F};
  p.exponent = 0.F;
  const Grid<float> out = run(smooth, p);
  double fourth = 0.0;
  double sum = 0.0;
  for (int y = 8; y + 8 < side; ++y)
    for (int x = 8; x + 8 < side; ++x) {
      const auto added = [&](int u) { return static_cast<double>(out(u, y)) - smooth(u, y); };
      const double d =
          added(x - 2) - 4.0 * added(x - 1) + 6.0 * added(x) - 4.0 * added(x + 1) + added(x + 2);
      fourth += d * d;
      sum += added(x) * added(x);
    }
  EXPECT_LT(std::sqrt(fourth / sum) / 16.0, 0.1);
}

}  // namespace
}  // namespace belvedere
