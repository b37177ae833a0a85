#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/noise.h"
#include "base/random_streams.h"
#include "tests/texture/strokes/stroke_picture.h"
#include "texture/strokes/beds.h"
#include "texture/strokes/stroke_painter.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr int width = 240;
constexpr int height = 200;

// A slope that falls straight down the picture, 12 m a pixel and nearer by 10 m a row, all of one class.
Picture slope_of(LandCoverClass id) {
  Picture p = plain_picture(id, width, height);
  GuidanceBuffers& g = p.guidance;
  g.footprint_m = Grid<float>(width, height, 12.F);
  g.relief_s_m = Grid<float>(width, height, 0.F);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      g.depth_m(x, y) = 30000.F - 10.F * static_cast<float>(y);
      g.position_m(x, y) = glm::vec3(12.F * static_cast<float>(x), -10.F * static_cast<float>(y), 2600.F - 7.F * static_cast<float>(y));
    }
  return p;
}

// `upper` above row `border`, `lower` below it.
Picture two_bands(LandCoverClass upper, LandCoverClass lower, int border = height / 2) {
  Picture p = slope_of(lower);
  for (int y = 0; y < border; ++y)
    for (int x = 0; x < width; ++x) p.guidance.land_cover(x, y) = upper;
  return p;
}

TEST(StrokeRock, LedgesLieAlongBeds) {
  Picture p = slope_of(rock);
  const auto on_edge = [&](std::size_t i) {
    const glm::vec3 place = p.guidance.position_m[i];
    const std::uint64_t seed = stream_seed(p.parameters.seed, Stream::bed_wavering);
    const double n8 = gaussian_noise(seed, static_cast<double>(place.x), static_cast<double>(place.y), 210.0);
    return bed_edge(bed_phase(place.z, place.x, static_cast<float>(n8))) > 0.3F ? 1.0 : 0.0;
  };
  double edges = 0.0;  // share of the slopes
  over_seeds(p, [&] {
    for (std::size_t i = 0; i < p.guidance.depth_m.size(); ++i) edges += on_edge(i);
  });
  edges /= static_cast<double>(test_seeds * p.guidance.depth_m.size());
  // Share of ledges that lie there.
  const auto share = [&] {
    double sum = 0.0;
    std::size_t count = 0;
    over_seeds(p, [&] {
      const auto ledges = grow_strokes("rock ledges", p.scene());
      EXPECT_GT(ledges.size(), 80U);
      for (const Stroke& s : ledges) sum += on_edge(s.source);
      count += ledges.size();
    });
    return sum / static_cast<double>(count);
  };
  EXPECT_NEAR(edges, 0.15, 0.05);
  EXPECT_GT(share(), 2.0 * edges);
  // Where a bed is thinner than a few strokes, ledges lie anywhere.
  p.guidance.footprint_m = Grid<float>(width, height, 80.F);
  EXPECT_NEAR(share(), edges, 0.5 * edges);
}

TEST(StrokeRock, TurfHangsOverTheUpperRim) {
  const Picture p = two_bands(alpine_grass, rock);
  const StrokeParameters parameters;
  const auto turf = grow_strokes("rock turf", {p.guidance, p.ground, parameters});
  int hanging = 0;
  for (const Stroke& s : turf) {
    EXPECT_EQ(p.guidance.land_cover[s.source], alpine_grass);
    const auto [low, high] = std::minmax_element(s.points.begin(), s.points.end(), [](auto a, auto b) { return a.y < b.y; });
    EXPECT_LT(low->y, height / 2 + 30.F) << "never far from what grows";
    hanging += low->y < height / 2 + 1.F && high->y > height / 2 + 2.F ? 1 : 0;
  }
  EXPECT_GT(hanging, width / 12);
  // At the foot of a wall nothing hangs, and grass lies on its lowest ledges only.
  const Picture foot = two_bands(rock, alpine_grass);
  for (const Stroke& s : grow_strokes("rock turf", {foot.guidance, foot.ground, parameters}))
    EXPECT_NEAR(std::abs(s.points[3].x - s.points[0].x) / (std::abs(s.points[3].y - s.points[0].y) + 0.5F), 6.F, 6.01F);
  const Picture wall = slope_of(rock);
  EXPECT_TRUE(grow_strokes("rock turf", {wall.guidance, wall.ground, parameters}).empty());
}

TEST(StrokeRock, SnowReachesUpIntoTheWallAndThinsOutThere) {
  const Picture p = two_bands(rock, snow);
  const StrokeParameters parameters;
  const auto drifts = grow_strokes("rock drifts", {p.guidance, p.ground, parameters});
  EXPECT_GT(drifts.size(), 20U);
  for (const Stroke& s : drifts) {
    EXPECT_EQ(p.guidance.land_cover[s.source], snow);
    EXPECT_LT(s.points[3].y, s.points[0].y) << "drawn uphill";
    EXPECT_LT(s.end_width, 0.5F * s.start_width);
    EXPECT_LT(s.points[3].y, height / 2 + 1.F) << "it ends on the wall";
    EXPECT_GT(s.points[3].y, height / 2 - 14.F);
  }
  // A cornice over the rim runs down.
  const Picture rim = two_bands(snow, rock);
  const auto cornices = grow_strokes("rock drifts", {rim.guidance, rim.ground, parameters});
  EXPECT_GT(cornices.size(), 10U);
  for (const Stroke& s : cornices) EXPECT_GT(s.points[3].y, s.points[0].y);
  const Picture wood = two_bands(rock, forest);
  EXPECT_TRUE(grow_strokes("rock drifts", {wood.guidance, wood.ground, parameters}).empty());
}

TEST(StrokeRock, RubbleRunsFromTheFootIntoTheWood) {
  const Picture p = two_bands(rock, forest);
  const StrokeParameters parameters;
  const auto rubble = grow_strokes("rock rubble", {p.guidance, p.ground, parameters});
  EXPECT_GT(rubble.size(), 15U);
  float deepest = 0.F;
  for (const Stroke& s : rubble) {
    EXPECT_EQ(p.guidance.land_cover[s.source], rock);
    EXPECT_GT(s.points[3].y, s.points[0].y) << "downhill";
    deepest = std::max(deepest, s.points[3].y - height / 2);
  }
  EXPECT_GT(deepest, 6.F);
  const Picture above = two_bands(forest, rock);
  EXPECT_TRUE(grow_strokes("rock rubble", {above.guidance, above.ground, parameters}).empty());
}

// Trees, each counted by its body, on pixels of rock.
int trees_on_rock(const Picture& p) {
  int count = 0;
  for (const Stroke& s : grow_strokes("rock trees", {p.guidance, p.ground, {}})) {
    EXPECT_EQ(p.guidance.land_cover[s.source], forest) << "painted in the wood's colours";
    const int y = static_cast<int>(s.points[0].y);
    const int x = std::clamp(static_cast<int>(s.points[0].x), 0, width - 1);
    if (s.gate != StrokeGate::upright) continue;
    EXPECT_NEAR(s.depth_m, p.guidance.depth_m(x, std::clamp(y, 0, height - 1)), 40.F) << "it stands on the rock";
    count += s.alpha == 0.9F ? 1 : 0;
  }
  return count;
}

TEST(StrokeRock, SingleTreesStandOnRockNearTheWoodOnly) {
  EXPECT_EQ(trees_on_rock(slope_of(rock)), 0);
  const Picture p = two_bands(rock, forest);
  EXPECT_GT(trees_on_rock(p), 15);
  for (const Stroke& s : grow_strokes("rock trees", {p.guidance, p.ground, {}})) EXPECT_GT(s.points[0].y, height / 2 - 20.F);
  // In hollows more than on ribs.
  Picture gully = p;
  for (float& relief : gully.guidance.relief_s_m) relief = -20.F;
  Picture rib = p;
  for (float& relief : rib.guidance.relief_s_m) relief = 20.F;
  EXPECT_GT(trees_on_rock(gully), 3 * trees_on_rock(rib) / 2);
}

TEST(StrokeRock, PatchesTooSmallForAWallAreOvergrown) {
  // Patches of 12 by 16 pixels, and a wall of which just as many pixels lie within reach of the wood.
  Picture patches = slope_of(forest);
  int small = 0;
  for (int y = 20; y + 16 < height - 20; y += 60)
    for (int x = 20; x + 12 < width - 20; x += 50)
      for (int v = 0; v < 16; ++v)
        for (int u = 0; u < 12; ++u, ++small) patches.guidance.land_cover(x + u, y + v) = rock;
  const Picture wall = two_bands(rock, forest);
  const double by_patch = static_cast<double>(trees_on_rock(patches)) / small;
  const double by_wall = static_cast<double>(trees_on_rock(wall)) / (15.0 * width);
  EXPECT_GT(by_patch, 5.0 * by_wall);
}

TEST(StrokeRock, CopiedRockGetsItsCracksAndLedges) {
  const Picture p = slope_of(rock);
  const StrokeLayers over_copied{.sky = true, .ground = false, .accents = true, .upright = true};
  const Painting painted = paint_strokes(p.ground.colour, p.guidance, p.ground, over_copied, {}, silent_progress());
  double darker = 0.0;
  double lighter = 0.0;
  for (const glm::vec3& v : painted.picture) {
    darker += v.x < 0.44F ? 1.0 : 0.0;
    lighter += v.x > 0.54F ? 1.0 : 0.0;
  }
  const auto size = static_cast<double>(painted.picture.size());
  EXPECT_GT(darker / size, 0.04) << "dark lines";
  EXPECT_LT(darker / size, 0.30) << "in measure";
  EXPECT_GT(lighter / size, 0.005) << "and their lit edges";
}

TEST(StrokeRock, TreesBeforeAWallStayWhole) {
  // Accents on the wall lie under the trees that rise before it.
  Picture p = two_bands(rock, forest);
  for (std::size_t i = 0; i < p.ground.accent.size(); ++i) p.ground.accent[i] = p.guidance.land_cover[i] == rock ? -0.9F : 0.F;
  const auto paint = [&](bool accents) {
    return paint_strokes(p.ground.colour, p.guidance, p.ground, {.sky = false, .ground = false, .accents = accents, .upright = true}, {},
                         silent_progress());
  };
  const Painting plain = paint(false);
  const Painting accented = paint(true);
  int before_wall = 0;
  int whole = 0;
  for (int y = height / 2 - 8; y < height / 2; ++y)
    for (int x = 0; x < width; ++x) {
      if (p.guidance.land_cover[plain.sources(x, y)] != forest || plain.under_share(x, y) > 50) continue;
      ++before_wall;
      whole += p.guidance.land_cover[accented.sources(x, y)] == forest && accented.under_share(x, y) < 70 ? 1 : 0;
    }
  EXPECT_GT(before_wall, 100);
  EXPECT_GT(whole, before_wall * 4 / 5);
}

}  // namespace
}  // namespace belvedere
