#include "renderer/paint/ribs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/random.h"
#include "renderer/paint/picture_filter.h"
#include "renderer/paint/picture_noise.h"
#include "tests/grids.h"
#include "tests/renderer/exemplar/painted_hills.h"

namespace belvedere {
namespace {

TEST(Ribs, LineIntegralHasDeviationOne) {
  const GuidanceBuffers g =
      test::make_slope(500, 300, LandCoverClass::rock, {0.0F, 0.3F, 1.0F}, 45.0F);
  const Grid<std::uint8_t> all(500, 300, 1);
  const std::array<Grid<float>, 3> fields = integrate_along_fall_line(g, {g}, all, 3, {0, 0}, 1.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const Grid<float>& field = fields[k];
    double squares = 0.0, along = 0.0, across = 0.0;
    int count = 0;
    for (int y = 60; y < 240; ++y)
      for (int x = 60; x < 440; ++x, ++count) {
        squares += field(x, y) * field(x, y);
        along += field(x, y) * field(x, y + 5);
        across += field(x, y) * field(x + 5, y);
      }
    EXPECT_NEAR(std::sqrt(squares / count), 1.0, 0.2) << "width " << k;
    EXPECT_GT(along, across) << "the field must run down the fall line";
  }
}

// One streamline after the other, over wide pixels of three: sums in the same order, so the same
// bits except for the scale.
TEST(Ribs, AreSumsAlongStreamlines) {
  constexpr int factor = 3;
  constexpr double ppu = 6.0;
  GuidanceBuffers g = test::make_hills(150, 100, ppu);
  for (const auto [x, y] : test::cells(60, 40)) g.fall_line(x, y) = {0.0F, 0.0F};
  const glm::ivec2 origin{300, 600};
  const GuidanceBuffers seen = thin_out({g, 1, origin}, factor);
  const WideView wide{seen, factor, origin / factor};
  const std::array<Grid<float>, 3> fields =
      integrate_along_fall_line(g, wide, Grid<std::uint8_t>(150, 100, 1), 3, origin, ppu);
  for (std::size_t k = 0; k < 3; ++k) {
    const double sigma = rib_widths[k].sigma_units;
    const Grid<float> noise =
        make_image_noise(stream_seed(3, Stream::rib_lines, k), wide.origin_px, seen.width(),
                         seen.height(), ppu / factor, sigma, sigma);
    const int steps = static_cast<int>(rib_widths[k].length_units / 4.0);
    const int count = 2 * steps + 1;
    double variance = count;
    for (int i = 1; i < count; ++i)
      variance += 2.0 * (count - i) * std::exp(-(i / sigma) * (i / sigma));
    const auto sum_of = [&](int x, int y, float sign) {
      glm::vec2 offset(0.0F), direction(0.0F), fall = g.fall_line(x, y);
      float depth_m = g.depth_m(x, y);
      bool bound = true;
      float sum = 0.0F;
      for (int i = 0; i < steps; ++i) {
        if (bound && (fall.x != 0.0F || fall.y != 0.0F)) direction = fall * sign;
        offset += direction * static_cast<float>(2.0 * ppu);
        const std::size_t at =
            wide.index(origin.x + x + static_cast<int>(std::floor(offset.x + 0.5F)),
                       origin.y + y + static_cast<int>(std::floor(offset.y + 0.5F)));
        bound = bound && same_surface(depth_m, seen.depth_m[at]);
        depth_m = seen.depth_m[at];
        fall = seen.fall_line[at];
        sum += noise[at];
      }
      return sum;
    };
    for (int y = 0; y < 100; y += 3)
      for (int x = 0; x < 150; ++x) {
        const float sum = noise[wide.index(origin.x + x, origin.y + y)] + sum_of(x, y, 1.0F) +
                          sum_of(x, y, -1.0F);
        ASSERT_NEAR(fields[k](x, y), sum / std::sqrt(variance), 1e-5) << k << ' ' << x << ' ' << y;
      }
  }
}

TEST(Ribs, DoNotCrossASilhouette) {
  GuidanceBuffers g = test::make_slope(60, 120, LandCoverClass::rock, {0.0F, 0.3F, 1.0F}, 45.0F);
  for (const auto [x, y] : test::cells(60, 60)) g.depth_m(x, y) = 50000.0F;
  const Grid<std::uint8_t> all(60, 120, 1);
  const Grid<float> before = integrate_along_fall_line(g, {g}, all, 3, {0, 0}, 1.0)[0];
  // Turning the far range's fall line must not change the near one.
  for (const auto [x, y] : test::cells(60, 60)) g.fall_line(x, y) = {0.8F, 0.6F};
  const Grid<float> after = integrate_along_fall_line(g, {g}, all, 3, {0, 0}, 1.0)[0];
  for (int x = 0; x < 60; ++x) EXPECT_EQ(after(x, 61), before(x, 61));
  EXPECT_NE(after(30, 50), before(30, 50));
}

TEST(Ribs, PartWithItsMarginEqualsWhole) {
  const GuidanceBuffers whole = test::make_hills(260, 200, 1.0);
  const Grid<std::uint8_t> all(260, 200, 1);
  const Grid<float> ribs = make_ribs(whole, {whole}, all, {}, {0, 0});
  const int margin = rib_margin_px(1.0);
  const PixelRect part{90, 70, 140, 120};
  const PixelRect wide = test::with_margin(part, margin, 260, 200);
  ASSERT_GT(wide.x0, 0) << "else nothing is cut off";
  const GuidanceBuffers held = test::cut(whole, wide);
  const Grid<float> cut =
      make_ribs(held, {held, 1, {wide.x0, wide.y0}}, test::cut(all, wide), {}, {wide.x0, wide.y0});
  EXPECT_EQ(
      test::cut(cut, {part.x0 - wide.x0, part.y0 - wide.y0, part.x1 - wide.x0, part.y1 - wide.y0}),
      test::cut(ribs, part));
}

// Flanks lit from one side are in shade from the other; only the deepest hollows, up to a quarter,
// are dark from both.
TEST(Ribs, TheOtherSunTurnsThemOver) {
  const GuidanceBuffers g =
      test::make_slope(160, 120, LandCoverClass::rock, {0.0F, 0.3F, 1.0F}, 45.0F);
  const Grid<std::uint8_t> all(160, 120, 1);
  const Grid<float> right = make_ribs(g, {g}, all, {.sun_side = 0.4}, {0, 0});
  const Grid<float> left = make_ribs(g, {g}, all, {.sun_side = -1.0}, {0, 0});
  float strongest = 0.F;
  for (std::size_t i = 0; i < right.size(); ++i) {
    ASSERT_LE(right[i] + left[i], 1e-5F);
    ASSERT_GE(right[i] + left[i], -0.5F - 1e-5F);
    strongest = std::max(strongest, std::abs(right[i]));
  }
  EXPECT_GT(strongest, 0.3F);
}

TEST(Ribs, StandOnlyWhereTheyAreWanted) {
  const GuidanceBuffers g =
      test::make_slope(80, 60, LandCoverClass::rock, {0.0F, 0.3F, 1.0F}, 45.0F);
  Grid<std::uint8_t> left_half(80, 60, 0);
  for (const auto [x, y] : test::cells(40, 60)) left_half(x, y) = 1;
  const Grid<float> some = make_ribs(g, {g}, left_half, {}, {0, 0});
  const Grid<float> everywhere = make_ribs(g, {g}, Grid<std::uint8_t>(80, 60, 1), {}, {0, 0});
  for (const auto [x, y] : test::cells(80, 60))
    ASSERT_EQ(some(x, y), x < 40 ? everywhere(x, y) : 0.F) << x << ' ' << y;
}

}  // namespace
}  // namespace belvedere
