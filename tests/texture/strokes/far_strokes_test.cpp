#include "texture/strokes/far_strokes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

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
    const std::vector<Stroke> far = broaden_far(near, p.ground, {0, 0}, 1.0);
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
  p.ground.haze = Grid<float>(320, 240, 0.30F);
  const std::vector<Stroke> near = grow_strokes("meadow", p.scene());
  const std::vector<Stroke> far = broaden_far(near, p.ground, {0, 0}, 1.0);
  ASSERT_EQ(far.size(), near.size());
  for (std::size_t k = 0; k < near.size(); ++k) EXPECT_EQ(far[k].start_width, near[k].start_width);
}

// A window leaves out the same as the whole, and so does a print of three times the pixels.
TEST(FarStrokes, PlacesOnTheSheetSayWhichAreMissing) {
  BasePicture whole, window, print;
  whole.haze = Grid<float>(90, 60, 0.8F);
  window.haze = Grid<float>(40, 30, 0.8F);
  print.haze = Grid<float>(270, 180, 0.8F);
  int missing = 0;
  for (int y = 20; y < 50; ++y)
    for (int x = 30; x < 70; ++x) {
      const auto stays = [](const BasePicture& base, glm::ivec2 at, glm::ivec2 origin,
                            double pixels_per_unit) {
        Stroke stroke;
        stroke.source = static_cast<std::uint32_t>(base.haze.index(at.x, at.y));
        return broaden_far({stroke}, base, origin, pixels_per_unit).size();
      };
      const std::size_t here = stays(whole, {x, y}, {0, 0}, 1.0);
      EXPECT_EQ(stays(window, {x - 30, y - 20}, {30, 20}, 1.0), here);
      EXPECT_EQ(stays(print, {3 * x + 1, 3 * y + 1}, {0, 0}, 3.0), here);
      missing += here == 0 ? 1 : 0;
    }
  EXPECT_GT(missing, 300);
  EXPECT_LT(missing, 900);
}

TEST(FarStrokes, TreesStandOrAreMissingAsAWhole) {
  Picture p = plain_picture(LandCoverClass::forest, 320, 240);
  p.guidance.depth_m = Grid<float>(320, 240, 8000.F);
  p.ground.haze = Grid<float>(320, 240, 0.8F);
  const std::vector<Stroke> near = grow_strokes("forest trees", p.scene());
  std::map<std::uint32_t, int> before, after;
  for (const Stroke& s : near) ++before[s.seed];
  for (const Stroke& s : broaden_far(near, p.ground, {0, 0}, 1.0)) ++after[s.seed];
  EXPECT_LT(after.size(), before.size());
  EXPECT_FALSE(after.empty());
  for (const auto& [seed, parts] : after) EXPECT_EQ(parts, before[seed]);
}

// Air thickens with distance, up the picture; far trees are as tall on the sheet as near ones, and
// fewer.
TEST(FarStrokes, TreesAreFewerTheFartherAndAsTall) {
  constexpr int bands = 4;
  constexpr int band_px = 120;
  Picture p = plain_picture(LandCoverClass::forest, 480, bands * band_px);
  p.guidance.depth_m = Grid<float>(480, bands * band_px, 8000.F);
  const std::vector<Stroke> grown = grow_strokes("forest trees", p.scene());
  for (int y = 0; y < bands * band_px; ++y)
    for (int x = 0; x < 480; ++x)
      p.ground.haze(x, y) = 0.28F + 0.14F * static_cast<float>(bands - 1 - y / band_px);
  struct Extent {
    float top = 1e9F;
    float bottom = -1e9F;
  };
  std::map<std::uint32_t, Extent> trees[bands];
  for (const Stroke& s : broaden_far(grown, p.ground, {0, 0}, 1.0)) {
    if (s.gate != StrokeGate::upright) continue;
    Extent& tree = trees[s.source / 480 / band_px][s.source];
    for (int k = 0; k < s.point_count; ++k) {
      tree.top = std::min(tree.top, s.points[static_cast<std::size_t>(k)].y);
      tree.bottom = std::max(tree.bottom, s.points[static_cast<std::size_t>(k)].y);
    }
  }
  const auto height = [](const std::map<std::uint32_t, Extent>& of) {
    double sum = 0.0;
    for (const auto& [source, tree] : of) sum += static_cast<double>(tree.bottom - tree.top);
    return sum / static_cast<double>(of.size());
  };
  const std::size_t near = trees[bands - 1].size();
  ASSERT_GT(near, 100U);
  for (int b = bands - 2; b >= 0; --b) {
    RecordProperty("trees_" + std::to_string(b), static_cast<int>(trees[b].size()));
    EXPECT_LT(trees[b].size(), trees[b + 1].size()) << "band " << b;
    EXPECT_NEAR(height(trees[b]), height(trees[bands - 1]), 0.06 * height(trees[bands - 1]))
        << "band " << b;
  }
  EXPECT_LT(trees[0].size(), near * 7 / 10);
}

}  // namespace
}  // namespace belvedere
