#include "renderer/close/ice_streams.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/grids.h"
#include "tests/renderer/close/close_ground.h"
#include "tests/renderer/paint/hills_print.h"

namespace belvedere {
namespace {

constexpr int side = 220;

// A slope of ice that falls straight down the picture.
GuidanceBuffers glacier(LandCoverClass id) {
  return test::make_slope(side, side, id, glm::normalize(glm::vec3(0.0F, -0.12F, 1.0F)), 7.0F);
}

Grid<float> streams_of(const GuidanceBuffers& g, glm::ivec2 origin, PixelRect wanted) {
  const WideView wide{g, 1, origin};
  const Grid<glm::vec2> fall = smooth_fall_lines(wide, 1.0, {0, 0, g.width(), g.height()});
  return ice_streams({wide, fall, 1.0, 3}, wanted);
}

double mean_step(const Grid<float>& bands, int dx, int dy) {
  double sum = 0.0;
  int count = 0;
  for (int y = 90; y < 130; ++y)
    for (int x = 90; x < 130; ++x, ++count)
      sum += std::abs(static_cast<double>(bands(x + dx, y + dy) - bands(x, y)));
  return sum / count;
}

TEST(IceStreams, RunAlongTheFlow) {
  const GuidanceBuffers g = glacier(LandCoverClass::glacier);
  const Grid<float> bands = streams_of(g, {0, 0}, {0, 0, side, side});
  const double across = mean_step(bands, 8, 0);
  EXPECT_GT(across, 0.1) << "there are bands";
  EXPECT_LT(mean_step(bands, 0, 8), 0.6 * across);
  for (const float band : bands) EXPECT_LE(std::abs(band), 1.0F);
}

TEST(IceStreams, LieOnIceAndSnowAlone) {
  const GuidanceBuffers g = glacier(LandCoverClass::scree);
  for (const float band : streams_of(g, {0, 0}, {60, 60, 160, 160})) EXPECT_EQ(band, 0.0F);
}

TEST(IceStreams, AreTheSameInAnyWindow) {
  const GuidanceBuffers g = glacier(LandCoverClass::snow);
  const PixelRect wanted{150, 150, 190, 180};
  const int reach = ice_streams_reach(1.0, 1);
  ASSERT_LT(reach, 150);
  const Grid<float> whole = streams_of(g, {0, 0}, {0, 0, side, side});
  const test::Window part = test::window_of(g, grown(wanted, reach));
  const glm::ivec2 corner(part.rect.x0, part.rect.y0);
  const Grid<float> piece = streams_of(part.held, corner, moved(wanted, -corner.x, -corner.y));
  for (const auto [x, y] : test::cells(wanted))
    ASSERT_EQ(piece(x - corner.x, y - corner.y), whole(x, y)) << x << ' ' << y;
}

}  // namespace
}  // namespace belvedere
