#include "texture/strokes/far_strokes.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/texture/strokes/stroke_picture.h"

namespace belvedere {
namespace {

double width_sum(const std::vector<Stroke>& strokes) {
  double sum = 0.0;
  for (const Stroke& s : strokes) sum += static_cast<double>(s.start_width);
  return sum;
}

TEST(FarStrokes, AreFewerAndBroader) {
  Picture p = plain_picture(LandCoverClass::pasture, 320, 240);
  const std::vector<Stroke> near = grow_strokes("meadow", p.scene());
  std::size_t count = near.size();
  double width = width_sum(near) / static_cast<double>(count);
  for (const float haze : {0.45F, 0.8F}) {
    p.ground.haze = Grid<float>(320, 240, haze);
    const std::vector<Stroke> far = broaden_far(near, p.ground);
    EXPECT_LT(far.size(), 0.9 * static_cast<double>(count)) << haze;
    const double mean = width_sum(far) / static_cast<double>(far.size());
    EXPECT_GT(mean, 1.15 * width) << haze;
    count = far.size();
    width = mean;
  }
  EXPECT_GT(static_cast<double>(count), 0.4 * static_cast<double>(near.size()));
}

TEST(FarStrokes, NearOnesStayAsTheyAre) {
  Picture p = plain_picture(LandCoverClass::pasture, 320, 240);
  p.ground.haze = Grid<float>(320, 240, 0.25F);
  const std::vector<Stroke> near = grow_strokes("meadow", p.scene());
  const std::vector<Stroke> far = broaden_far(near, p.ground);
  ASSERT_EQ(far.size(), near.size());
  for (std::size_t k = 0; k < near.size(); ++k) EXPECT_EQ(far[k].start_width, near[k].start_width);
}

TEST(FarStrokes, TreesStandOrAreMissingAsAWhole) {
  Picture p = plain_picture(LandCoverClass::forest, 320, 240);
  p.guidance.depth_m = Grid<float>(320, 240, 8000.F);
  p.ground.haze = Grid<float>(320, 240, 0.8F);
  const std::vector<Stroke> near = grow_strokes("forest trees", p.scene());
  std::map<std::uint32_t, int> before, after;
  for (const Stroke& s : near) ++before[s.seed];
  for (const Stroke& s : broaden_far(near, p.ground)) ++after[s.seed];
  EXPECT_LT(after.size(), before.size());
  EXPECT_FALSE(after.empty());
  for (const auto& [seed, parts] : after) EXPECT_EQ(parts, before[seed]);
}

}  // namespace
}  // namespace belvedere
