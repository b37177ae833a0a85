#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "tests/grids.h"
#include "tests/texture/strokes/stroke_picture.h"
#include "texture/strokes/brush.h"
#include "texture/strokes/stroke_painter.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr int rock_width = 240;
constexpr int rock_height = 200;

// A slope straight down the picture, 12 m per pixel and nearer by 10 m per row, all of one class.
Picture falling_slope(LandCoverClass id) {
  Picture p = plain_picture(id, rock_width, rock_height);
  GuidanceBuffers& g = p.guidance;
  g.footprint_m = Grid<float>(rock_width, rock_height, 12.F);
  g.relief_s_m = Grid<float>(rock_width, rock_height, 0.F);
  for (const auto [x, y] : test::cells(rock_width, rock_height)) {
    g.depth_m(x, y) = 30000.F - 10.F * static_cast<float>(y);
    g.position_m(x, y) = glm::vec3(12.F * static_cast<float>(x), -10.F * static_cast<float>(y),
                                   2600.F - 7.F * static_cast<float>(y));
  }
  return p;
}

// `upper` above row `border`, `lower` below it.
Picture two_bands(LandCoverClass upper, LandCoverClass lower, int border = rock_height / 2) {
  Picture p = falling_slope(lower);
  for (const auto [x, y] : test::cells(rock_width, border)) p.guidance.land_cover(x, y) = upper;
  return p;
}

// Two planes of rock side by side, of one tone: one left of the centre, the other right of it.
Picture two_planes() {
  Picture p = falling_slope(rock);
  p.guidance.rock_facet = Grid<std::uint32_t>(rock_width, rock_height, 0x00010001U);
  for (const auto [x, y] : test::cells({rock_width / 2, 0, rock_width, rock_height}))
    p.guidance.rock_facet(x, y) = 0x00010002U;
  return p;
}

TEST(StrokeRock, PaintStaysOnItsPlane) {
  const Picture p = two_planes();
  StrokeParameters parameters;
  parameters.pixels_per_unit = 2.0;
  for (const char* kind : {"rock facets", "rock dabs", "rock chips"}) {
    const auto strokes = grow_strokes(kind, {p.guidance, p.ground, parameters});
    ASSERT_GT(strokes.size(), 50U) << kind;
    for (const Stroke& s : strokes) ASSERT_EQ(s.facet, p.guidance.rock_facet[s.source]) << kind;
  }
  // The same stroke across the border of two planes, and on one plane.
  Stroke stroke;
  stroke.points[0] = {80.F, 100.F};
  stroke.points[1] = {160.F, 100.F};
  stroke.point_count = 2;
  stroke.start_width = stroke.end_width = 10.F;
  stroke.colour = glm::vec3(1.F, 0.F, 0.F);
  stroke.depth_m = 29000.F;
  stroke.facet = 0x00010001U;
  Painting painting = begin_painting(Grid<glm::vec3>(rock_width, rock_height, glm::vec3(0.F)));
  paint_in_order(painting, p.guidance, {stroke}, 1.0, silent_progress());
  EXPECT_NEAR(painting.picture(100, 100).x, 1.F, 1e-3F);
  EXPECT_NEAR(painting.picture(140, 100).x, 0.2F, 1e-3F);
}

TEST(StrokeRock, TheHandRestsInPlaces) {
  Picture p = falling_slope(rock);
  const auto busy = [&](const Stroke& s) {
    return sheet_noise(p.scene(),
                       {static_cast<float>(s.source % rock_width),
                        static_cast<float>(s.source / rock_width)},
                       Stream::rock_calm, 13.0) > 0.F;
  };
  double in_busy = 0.0;
  double all = 0.0;
  over_seeds(p, [&] {
    for (const Stroke& s : grow_strokes("rock chips", p.scene())) {
      in_busy += busy(s) ? 1.0 : 0.0;
      all += 1.0;
    }
  });
  EXPECT_GT(in_busy / all, 0.57);
}

TEST(StrokeRock, TurfHangsOverTheUpperRim) {
  const Picture p = two_bands(alpine_grass, rock);
  const StrokeParameters parameters;
  const auto turf = grow_strokes("rock turf", {p.guidance, p.ground, parameters});
  int hanging = 0;
  for (const Stroke& s : turf) {
    EXPECT_EQ(p.guidance.land_cover[s.source], alpine_grass);
    const auto [low, high] = std::minmax_element(s.points.begin(), s.points.end(),
                                                 [](auto a, auto b) { return a.y < b.y; });
    EXPECT_LT(low->y, rock_height / 2 + 30.F) << "never far from what grows";
    hanging += low->y < rock_height / 2 + 1.F && high->y > rock_height / 2 + 2.F ? 1 : 0;
  }
  EXPECT_GT(hanging, rock_width / 12);
  // At the foot of a wall there is no overhanging turf, and grass lies on its lowest ledges only.
  const Picture foot = two_bands(rock, alpine_grass);
  for (const Stroke& s : grow_strokes("rock turf", {foot.guidance, foot.ground, parameters}))
    EXPECT_NEAR(
        std::abs(s.points[3].x - s.points[0].x) / (std::abs(s.points[3].y - s.points[0].y) + 0.5F),
        6.F, 6.01F);
  const Picture wall = falling_slope(rock);
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
    EXPECT_LT(s.points[3].y, rock_height / 2 + 1.F) << "it ends on the wall";
    EXPECT_GT(s.points[3].y, rock_height / 2 - 14.F);
  }
  // A cornice over the edge runs down.
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
    deepest = std::max(deepest, s.points[3].y - rock_height / 2);
  }
  EXPECT_GT(deepest, 6.F);
  const Picture above = two_bands(forest, rock);
  EXPECT_TRUE(grow_strokes("rock rubble", {above.guidance, above.ground, parameters}).empty());
}

// Trees, each counted by its body, on pixels of rock.
int trees_on_rock(const Picture& p) {
  int count = 0;
  for (const Stroke& s : grow_strokes("rock trees", {p.guidance, p.ground, {}})) {
    EXPECT_EQ(p.guidance.land_cover[s.source], forest) << "painted in the forest's colours";
    const int y = static_cast<int>(s.points[0].y);
    const int x = std::clamp(static_cast<int>(s.points[0].x), 0, rock_width - 1);
    if (s.gate != StrokeGate::upright) continue;
    EXPECT_NEAR(s.depth_m, p.guidance.depth_m(x, std::clamp(y, 0, rock_height - 1)), 40.F)
        << "it is on the rock";
    count += s.alpha == 0.9F ? 1 : 0;
  }
  return count;
}

TEST(StrokeRock, SingleTreesStandOnRockNearTheWoodOnly) {
  EXPECT_EQ(trees_on_rock(falling_slope(rock)), 0);
  const Picture p = two_bands(rock, forest);
  EXPECT_GT(trees_on_rock(p), 15);
  for (const Stroke& s : grow_strokes("rock trees", {p.guidance, p.ground, {}}))
    EXPECT_GT(s.points[0].y, rock_height / 2 - 20.F);
  // More in hollows than on ribs.
  Picture gully = p;
  for (float& relief : gully.guidance.relief_s_m) relief = -20.F;
  Picture rib = p;
  for (float& relief : rib.guidance.relief_s_m) relief = 20.F;
  EXPECT_GT(trees_on_rock(gully), 3 * trees_on_rock(rib) / 2);
}

TEST(StrokeRock, PatchesTooSmallForAWallAreOvergrown) {
  // Patches of 12 by 16 pixels, and a wall with the same number of pixels within reach of the
  // forest.
  Picture patches = falling_slope(forest);
  int small = 0;
  for (int y = 20; y + 16 < rock_height - 20; y += 60)
    for (int x = 20; x + 12 < rock_width - 20; x += 50)
      for (int v = 0; v < 16; ++v)
        for (int u = 0; u < 12; ++u, ++small) patches.guidance.land_cover(x + u, y + v) = rock;
  const Picture wall = two_bands(rock, forest);
  const double by_patch = static_cast<double>(trees_on_rock(patches)) / small;
  const double by_wall = static_cast<double>(trees_on_rock(wall)) / (15.0 * rock_width);
  EXPECT_GT(by_patch, 5.0 * by_wall);
}

TEST(StrokeRock, TreesBeforeASlopeStayWhole) {
  // Accents on the slope are below the trees in front of it.
  Picture p = two_bands(scree, forest);
  for (std::size_t i = 0; i < p.ground.accent.size(); ++i)
    p.ground.accent[i] = p.guidance.land_cover[i] == scree ? -0.9F : 0.F;
  const auto paint = [&](bool accents) {
    return paint_strokes(p.ground.colour, p.guidance, p.ground,
                         {.sky = false, .ground = false, .accents = accents, .upright = true}, {},
                         silent_progress());
  };
  const Painting plain = paint(false);
  const Painting accented = paint(true);
  int before_slope = 0;
  int whole = 0;
  for (const auto [x, y] : test::cells({0, rock_height / 2 - 8, rock_width, rock_height / 2})) {
    if (p.guidance.land_cover[plain.sources(x, y)] != forest || plain.under_share(x, y) > 50)
      continue;
    ++before_slope;
    whole +=
        p.guidance.land_cover[accented.sources(x, y)] == forest && accented.under_share(x, y) < 70
            ? 1
            : 0;
  }
  EXPECT_GT(before_slope, 40);
  EXPECT_GT(whole, before_slope * 4 / 5);
}

}  // namespace
}  // namespace belvedere
