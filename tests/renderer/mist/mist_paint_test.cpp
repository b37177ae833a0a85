#include "renderer/mist/mist_paint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/grid.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

constexpr int width = 220;
constexpr int height = 160;

// A bank whose share falls towards its edge, and a nearer one in front of a part of it.
MistSight bank() {
  MistSight sight{Grid<float>(width, height, 0.F),
                  Grid<float>(width, height, std::numeric_limits<float>::infinity()),
                  Grid<float>(width, height, 0.F), Grid<float>(width, height, 0.F)};
  for (const auto [x, y] : test::cells(width, height)) {
    const float away =
        std::hypot((static_cast<float>(x) - 110.F) / 90.F, (static_cast<float>(y) - 80.F) / 60.F);
    if (away >= 1.F) continue;
    sight.share(x, y) = std::min(1.F, 3.F * (1.F - away));
    sight.depth_m(x, y) = x < 60 ? 9000.F : 20000.F + 10.F * static_cast<float>(height - y);
    sight.light(x, y) = 0.5F + 0.4F * std::sin(static_cast<float>(x) * 0.1F) *
                                   std::cos(static_cast<float>(y) * 0.13F);
    sight.altitude_m(x, y) = 1500.F;
  }
  return sight;
}

StrokeParameters strokes() {
  StrokeParameters p;
  p.pixels_per_unit = 1.0;
  return p;
}

MistPaint paint(const MistSight& sight, const SheetWindow& window) {
  return paint_mist(sight, {}, read_palette("summer"), strokes(), window, silent_progress());
}

TEST(MistPaint, NoPaintLiesWhereThereIsNoMist) {
  const MistSight sight = bank();
  const MistPaint painted = paint(sight, {});
  for (std::size_t i = 0; i < sight.share.size(); ++i)
    if (sight.share[i] <= 0.F) {
      EXPECT_EQ(painted.share[i], 0.F);
    }
}

// The brush moves edges; it does not make mist thinner or denser.
TEST(MistPaint, AsMuchIsHiddenAsIsSeen) {
  const MistSight sight = bank();
  const MistPaint painted = paint(sight, {});
  double seen = 0.0, drawn = 0.0, moved = 0.0;
  for (std::size_t i = 0; i < sight.share.size(); ++i) {
    seen += static_cast<double>(sight.share[i]);
    drawn += static_cast<double>(painted.share[i]);
    moved += std::abs(static_cast<double>(painted.share[i] - sight.share[i]));
    EXPECT_GE(painted.share[i], 0.F);
    EXPECT_LE(painted.share[i], 1.F);
  }
  EXPECT_NEAR(drawn / seen, 1.0, 0.04);
  EXPECT_GT(moved / seen, 0.01) << "edges of the air, not of a brush";
}

TEST(MistPaint, AWindowIsPaintedAsTheWhole) {
  const MistSight sight = bank();
  const MistPaint whole = paint(sight, {});
  const int margin = mist_margin_px(strokes());
  const PixelRect sheet{0, 0, width, height};
  for (const PixelRect asked : {PixelRect{90, 70, 130, 100}, {0, 0, 30, 160}, {219, 80, 220, 81}}) {
    const PixelRect window = intersection(sheet, grown(asked, margin));
    const MistSight part{part_of(sight.share, window), part_of(sight.depth_m, window),
                         part_of(sight.light, window), part_of(sight.altitude_m, window)};
    const MistPaint painted = paint(part, {.origin_px = {window.x0, window.y0},
                                           .sheet_px = {width, height},
                                           .asked = {asked.x0 - window.x0, asked.y0 - window.y0,
                                                     asked.x1 - window.x0, asked.y1 - window.y0}});
    EXPECT_TRUE(painted.share == part_of(whole.share, asked));
    EXPECT_TRUE(painted.colour == part_of(whole.colour, asked));
  }
}

TEST(MistPaint, LightIsWarmAndShadeIsCool) {
  const Palette palette = read_palette("summer");
  const AirParameters clear{.haze = 0.0};
  const glm::vec3 light = mist_colour(clear, palette, 1.F, 1000.0, 1500.0);
  const glm::vec3 shade = mist_colour(clear, palette, 0.F, 1000.0, 1500.0);
  EXPECT_GT(light.r - light.b, shade.r - shade.b + 0.1F);
  EXPECT_GT(light.g, shade.g + 0.2F);
  float before = 0.F;
  for (float l = 0.F; l <= 1.F; l += 0.01F) {
    const float now = mist_colour(clear, palette, l, 1000.0, 1500.0).g;
    EXPECT_GE(now, before);
    before = now;
  }
}

TEST(MistPaint, FarMistStandsInTheAir) {
  const Palette palette = read_palette("summer");
  const glm::vec3 near = mist_colour({}, palette, 1.F, 1000.0, 1500.0);
  const glm::vec3 far = mist_colour({}, palette, 1.F, 120000.0, 1500.0);
  EXPECT_LT(far.r, near.r - 0.1F);
}

}  // namespace
}  // namespace belvedere
