#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

#include "base/progress.h"
#include "tests/grids.h"
#include "tests/texture/strokes/stroke_picture.h"
#include "texture/strokes/stroke_painter.h"
#include "texture/strokes/stroke_parts.h"
#include "texture/strokes/stroke_trees.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr int wood_width = 320;
constexpr int wood_height = 240;

// One class on one plane at 1700 m, 20 km away, 20 m per unit, tone .6, sun from the right.
Picture level_ground(LandCoverClass id, float altitude_m = 1700.F) {
  Picture p = plain_picture(id, wood_width, wood_height);
  p.guidance.depth_m = Grid<float>(wood_width, wood_height, 20000.F);
  p.guidance.relief_s_m = Grid<float>(wood_width, wood_height, 0.F);
  for (const auto [x, y] : test::cells(wood_width, wood_height))
    p.guidance.position_m(x, y) =
        glm::vec3(20.F * static_cast<float>(x), -20.F * static_cast<float>(y), altitude_m);
  return p;
}

template <class T>
void fill(Grid<T>& grid, int x0, int y0, int x1, int y1, T value) {
  for (const auto [x, y] : test::cells({x0, y0, x1, y1})) grid(x, y) = value;
}

bool is_body(const Stroke& s) {
  return s.gate == StrokeGate::upright && s.start_width > 2.4F && s.alpha > 0.85F;
}

std::vector<Stroke> one_tree(const Picture& p, bool leafy, const TreeTone& tone = {}) {
  std::vector<Stroke> all;
  for (int k = 0; k < 200; ++k) {
    StrokeSeed seed(7, k, 0);
    const Tree tree{{160.F, 120.F}, 3.7F, 7.8F};
    if (leafy)
      plant_leafy(p.scene(), tree, p.guidance.depth_m.index(160, 120), tone, seed, all);
    else
      plant_spruce(p.scene(), tree, p.guidance.depth_m.index(160, 120), tone, seed, all);
  }
  return all;
}

double mean_luma(const std::vector<Stroke>& strokes, bool (*which)(const Stroke&)) {
  double sum = 0.0;
  int count = 0;
  for (const Stroke& s : strokes)
    if (which(s)) sum += luma(s.colour), ++count;
  EXPECT_GT(count, 20);
  return sum / count;
}

bool is_lit_side(const Stroke& s) { return s.gate == StrokeGate::upright && s.start_width < 2.4F; }

// What makes a single tree readable: its dark body is far darker than its ground and its light side
// lighter.
TEST(Trees, HaveADarkBodyAndALightSide) {
  const Picture p = level_ground(forest);
  const auto trees = one_tree(p, false);
  EXPECT_LT(mean_luma(trees, is_body), 0.5 - 0.12);
  EXPECT_GT(mean_luma(trees, is_lit_side), 0.5 + 0.04);
  Picture shade = level_ground(forest);
  for (float& tone : shade.guidance.tone) tone = 0.1F;
  const auto dark = one_tree(shade, false);
  const double contrast = mean_luma(dark, is_lit_side) - mean_luma(dark, is_body);
  EXPECT_LT(contrast, 0.6 * (mean_luma(trees, is_lit_side) - mean_luma(trees, is_body)))
      << "a shaded forest is one mass";
}

TEST(Trees, SpruceIsPointedLeafyCrownIsRound) {
  const Picture p = level_ground(forest);
  for (const Stroke& s : one_tree(p, false))
    if (is_body(s)) {
      EXPECT_LT(s.end_width, 0.2F * s.start_width);
    }
  for (const Stroke& s : one_tree(p, true))
    if (is_body(s)) {
      EXPECT_GE(s.end_width, s.start_width);
    }
}

TEST(Trees, OfTheEdgeShineTowardsTheSunAndCastShadowsOnOpenGround) {
  const Picture p = level_ground(forest);
  const auto inside = one_tree(p, false);
  const auto edge = one_tree(p, false, {0.F, 1.F, 1.F});
  EXPECT_GT(mean_luma(edge, is_lit_side), mean_luma(inside, is_lit_side) + 0.03);
  EXPECT_LT(mean_luma(edge, is_body), mean_luma(inside, is_body) - 0.02);
  int shadows = 0;
  for (const Stroke& s : edge) {
    if (s.gate != StrokeGate::surface) continue;
    ++shadows;
    EXPECT_LT(axis_of(s).x, -3.7F) << "the sun is on the right";
  }
  EXPECT_EQ(shadows, 200);
}

// In the forest the ground around a tree is dark and is painted before every tree.
TEST(Trees, StandInTheDarkInsideTheWood) {
  const Picture p = level_ground(forest);
  int shades = 0;
  for (const Stroke& s : one_tree(p, false)) {
    if (s.gate != StrokeGate::surface) continue;
    ++shades;
    EXPECT_GT(s.order, 20000.F);
    EXPECT_GT(s.start_width, 3.7F);
    EXPECT_LT(luma(s.colour), 0.47F);
  }
  EXPECT_EQ(shades, 200);
}

TEST(Trees, TakeThePalettesLeaves) {
  Picture p = level_ground(forest, 500.F);
  p.parameters.leaves = {glm::vec3(0.9F, 0.2F, 0.1F)};
  p.parameters.leaf_share = 0.6;
  const auto redness = [](const std::vector<Stroke>& strokes) {
    double sum = 0.0;
    for (const Stroke& s : strokes) sum += s.colour.x - s.colour.y;
    return sum / static_cast<double>(strokes.size());
  };
  Picture plain = level_ground(forest, 500.F);
  EXPECT_GT(redness(one_tree(p, true)), redness(one_tree(plain, true)) + 0.08);
  EXPECT_NEAR(redness(one_tree(p, false)), redness(one_tree(plain, false)), 1e-6)
      << "spruces stay as they are";
  for (float& h : p.ground.haze) h = 1.F;
  for (float& h : plain.ground.haze) h = 1.F;
  EXPECT_NEAR(redness(one_tree(p, true)), redness(one_tree(plain, true)), 0.02)
      << "air hides leaves";
}

TEST(Trees, HoldSnowInWinterWhereTheyKeepTheirNeedles) {
  Picture p = level_ground(forest);
  const std::size_t summer = one_tree(p, false).size();
  p.parameters.winter = true;
  EXPECT_GT(one_tree(p, false).size(), summer + 60);
  const auto dots = [](const std::vector<Stroke>& s) { return s.size(); };
  const std::size_t bare = dots(one_tree(p, true));
  p.parameters.winter = false;
  EXPECT_LT(bare, dots(one_tree(p, true))) << "no yellow dots on bare twigs";
}

// Glades: where the density is below glade_density there are no trees, and grass is painted.
TEST(Wood, GladesAreGrassWithoutTrees) {
  Picture p = level_ground(forest);
  fill(p.ground.tree_density, 100, 60, 220, 180, 0.02F);
  int inside = 0;
  int grass = 0;
  for (const Stroke& s : wood_strokes(p.scene())) {
    const glm::vec2 at = s.point_count == 2 ? s.points[0] : 0.5F * (s.points[0] + s.points[3]);
    const bool in_glade = at.x > 104.F && at.x < 216.F && at.y > 64.F && at.y < 176.F;
    if (s.point_count == 2) inside += in_glade && is_body(s);
    if (s.point_count == 4) {
      ++grass;
      EXPECT_TRUE(at.x > 94.F && at.x < 226.F && at.y > 54.F && at.y < 186.F);
    }
  }
  EXPECT_EQ(inside, 0);
  EXPECT_GT(grass, 500);
}

// Where forest ends at a meadow its lower edge is closed, however thin the forest behind it.
TEST(Wood, StandsLikeAWallBeforeMeadowButNotAtTheTreeline) {
  const auto near_edge = [](LandCoverClass beyond) {
    Picture p = level_ground(forest);
    for (float& d : p.ground.tree_density) d = 0.3F;
    fill(p.guidance.land_cover, 0, 120, wood_width, wood_height, beyond);
    int count = 0;
    for (const Stroke& s : wood_strokes(p.scene())) count += is_body(s) && s.points[0].y > 114.F;
    return count;
  };
  EXPECT_GT(near_edge(pasture), 2 * near_edge(alpine_grass));
  EXPECT_GT(near_edge(pasture), wood_width / 8);
}

// The border of the forest towards the sun shines, the one away from it does not.
TEST(Wood, LightsItsRimTowardsTheSun) {
  Picture p = level_ground(forest);
  fill(p.guidance.land_cover, 0, 0, 100, wood_height, pasture);
  fill(p.guidance.land_cover, 220, 0, wood_width, wood_height, pasture);
  std::vector<Stroke> trees;
  over_seeds(p, [&] {
    const std::vector<Stroke> more = wood_strokes(p.scene());
    trees.insert(trees.end(), more.begin(), more.end());
  });
  const auto lit_between = [&](float x0, float x1) {
    double sum = 0.0;
    int count = 0;
    for (const Stroke& s : trees)
      if (is_lit_side(s) && s.points[0].x >= x0 && s.points[0].x < x1)
        sum += luma(s.colour), ++count;
    EXPECT_GT(count, 50);
    return sum / count;
  };
  EXPECT_GT(lit_between(215.F, 222.F), lit_between(150.F, 170.F) + 0.025);
  EXPECT_LT(lit_between(99.F, 106.F), lit_between(150.F, 170.F) + 0.015);
}

TEST(Wood, LeafyTreesStandInGroupsOfTheirOwn) {
  Picture p = level_ground(forest, 900.F);
  constexpr int cell = 16;
  int pure = 0;
  int cells = 0;
  double total = 0.0;
  double trees = 0.0;
  over_seeds(p, [&] {
    Grid<int> leafy(wood_width / cell, wood_height / cell, 0);
    Grid<int> all(wood_width / cell, wood_height / cell, 0);
    for (const Stroke& s : wood_strokes(p.scene())) {
      if (!is_body(s)) continue;
      const int x = std::clamp(static_cast<int>(s.points[0].x), 0, wood_width - 1) / cell;
      const int y = std::clamp(static_cast<int>(s.points[0].y), 0, wood_height - 1) / cell;
      leafy(x, y) += s.end_width >= s.start_width;
      ++all(x, y);
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
      total += leafy[i];
      trees += all[i];
      if (all[i] < 6) continue;
      ++cells;
      pure += leafy[i] * 10 <= all[i] || leafy[i] * 10 >= 9 * all[i];
    }
  });
  EXPECT_GT(total / trees, 0.15);
  EXPECT_LT(total / trees, 0.60);
  // With an even spread, hardly one in ten cells of about fifteen trees would be nearly pure.
  EXPECT_GT(pure, cells * 2 / 5);
}

// Broadleaf below, spruce, then larch and stone pine below the treeline; without larches all high
// forest is spruce.
TEST(Wood, StandsInBeltsByHeight) {
  const glm::vec3 gold(0.95F, 0.75F, 0.25F);
  const auto shares = [&](float altitude_m, double larch_share, double treeline_m) {
    Picture p = level_ground(forest, altitude_m);
    p.parameters.larch = gold;
    p.parameters.larch_share = larch_share;
    p.parameters.treeline_m = treeline_m;
    glm::dvec3 counts(0.0);  // leafy, golden in the light, blunt
    double bodies = 0.0;
    double lit = 0.0;
    for (const Stroke& s : wood_strokes(p.scene()))
      if (is_body(s)) {
        bodies += 1.0;
        counts.x += s.end_width >= s.start_width;
        counts.z += s.end_width > 0.3F * s.start_width && s.end_width < s.start_width;
      } else if (is_lit_side(s)) {
        lit += 1.0;
        counts.y += s.colour.x - s.colour.z > 0.2F;
      }
    return counts / glm::dvec3(bodies, lit, bodies);
  };
  const glm::dvec3 low = shares(700.F, 0.8, 1820.0);
  const glm::dvec3 centre = shares(1280.F, 0.8, 1820.0);
  const glm::dvec3 high = shares(1750.F, 0.8, 1820.0);
  EXPECT_GT(low.x, 0.3);
  EXPECT_LT(centre.x, 0.25);
  EXPECT_EQ(high.x, 0.0);
  EXPECT_LT(low.y, 0.05) << "sunny leaves at most";
  EXPECT_GT(high.y, 0.35);
  EXPECT_LT(centre.y, 0.5 * high.y);
  EXPECT_GT(high.z, 0.1);
  EXPECT_LT(shares(1750.F, 0.0, 1820.0).y, 0.05);
  EXPECT_LT(shares(1750.F, 0.8, 3200.0).y, 0.05) << "belts depend on the treeline";
}

// The side of a group that faces the sun is lighter: with the sun on the other side, so is the
// light.
TEST(Wood, GroupsHaveALightSideAndADarkOne) {
  const auto tone_by_side = [](double sun_side) {
    Picture p = level_ground(forest, 1500.F);
    p.parameters.sun_side = sun_side;
    const StrokeScene scene = p.scene();
    double right = 0.0;
    int count = 0;
    for (const Stroke& s : wood_strokes(scene)) {
      if (!is_body(s)) continue;
      const glm::vec2 position = s.points[0];
      const glm::vec2 left_of = position - glm::vec2(5.F, 0.F);
      const glm::vec2 right_of = position + glm::vec2(5.F, 0.F);
      if (!scene.on_canvas(left_of) || !scene.on_canvas(right_of) || !scene.on_canvas(position))
        continue;
      const float left_crowns =
          patch_noise(scene, scene.pixel(left_of), Stream::forest_groups, 5.0);
      const float right_crowns =
          patch_noise(scene, scene.pixel(right_of), Stream::forest_groups, 5.0);
      if (std::abs(left_crowns - right_crowns) < 0.8F) continue;
      right += (left_crowns > right_crowns ? 1.0 : -1.0) * static_cast<double>(luma(s.colour));
      ++count;
    }
    EXPECT_GT(count, 200);
    return right / count;
  };
  EXPECT_GT(tone_by_side(1.0), tone_by_side(-1.0) + 0.008);
}

TEST(Wood, ValleyTreesFollowTheBrook) {
  Picture p = level_ground(valley_floor, 600.F);
  for (float& metres : p.guidance.footprint_m) metres = 20.F;
  fill(p.guidance.land_cover, 0, 118, wood_width, 122, water);
  int banks = 0;
  int open = 0;
  over_seeds(p, [&] {
    for (const Stroke& s : grow_strokes("scattered trees", p.scene())) {
      if (s.gate != StrokeGate::upright) continue;
      const float y = s.points[0].y;
      banks += std::abs(y - 120.F) < 8.F;
      open += y < 100.F || y > 140.F;
    }
  });
  EXPECT_GT(banks, 50 * static_cast<int>(test_seeds));
  // Per area: 16 rows of bank, 200 rows of open land.
  EXPECT_GT(banks / 16.0, 4.0 * open / 200.0);
}

TEST(Meadow, StrokesFollowTheSlopeDownOrAcrossAndLieLevelOnTheFloor) {
  const glm::vec2 fall(0.6F, 0.8F);
  for (const LandCoverClass id : {pasture, alpine_grass, shrub, valley_floor}) {
    Picture p = level_ground(id);
    for (auto& d : p.guidance.fall_line) d = fall;
    int along = 0;
    int across = 0;
    int level = 0;
    int all = 0;
    for (const Stroke& s : grow_strokes("meadow", p.scene())) {
      along += angle_deg(axis_of(s), fall) < 25.0;
      across += angle_deg(axis_of(s), fall) > 65.0;
      level += angle_deg(axis_of(s), {1.F, 0.F}) < 20.0;
      ++all;
    }
    ASSERT_GT(all, 1000) << class_name(id);
    if (id == valley_floor) {
      EXPECT_GT(level, all * 9 / 10);
    } else {
      EXPECT_GT(along, all * 3 / 10) << class_name(id);
      EXPECT_GT(across, all * 3 / 10) << class_name(id);
    }
  }
}

TEST(Meadow, TussocksLieInHollowsAndAcrossTheSlope) {
  const auto dark_flecks = [](float relief_m) {
    Picture p = level_ground(alpine_grass);
    for (float& r : p.guidance.relief_s_m) r = relief_m;
    int dark = 0;
    for (const Stroke& s : grow_strokes("grass flecks", p.scene())) {
      EXPECT_GT(angle_deg(axis_of(s), {0.F, 1.F}), 10.0);
      dark += luma(s.colour) < 0.45F;
    }
    return dark;
  };
  EXPECT_GT(dark_flecks(-6.F), dark_flecks(6.F) * 3 / 2);
  EXPECT_GT(dark_flecks(0.F), 100);
  EXPECT_TRUE(grow_strokes("grass flecks", level_ground(forest).scene()).empty());
  EXPECT_TRUE(grow_strokes("grass flecks", level_ground(valley_floor).scene()).empty());
}

TEST(Shrub, BushesAreLowDarkAndAsManyAsTheirDensity) {
  Picture p = level_ground(shrub);
  const auto bushes = grow_strokes("low bushes", p.scene());
  ASSERT_GT(bushes.size(), 1000U);
  for (const Stroke& s : bushes) {
    EXPECT_LT(luma(s.colour), 0.5F);
    EXPECT_LT(std::abs(axis_of(s).y), 0.5F * s.start_width) << "wider than tall";
  }
  for (float& d : p.ground.tree_density) d = 0.19F;
  EXPECT_NEAR(static_cast<double>(grow_strokes("low bushes", p.scene()).size()),
              0.2 * static_cast<double>(bushes.size()), 0.06 * static_cast<double>(bushes.size()));
  EXPECT_TRUE(grow_strokes("low bushes", level_ground(pasture).scene()).empty());
}

// Lone dots of twigs all over the snow would look like pepper.
TEST(Shrub, StandsInThicketsInWinter) {
  Picture p = level_ground(shrub);
  for (float& d : p.ground.tree_density) d = 1.F;
  p.parameters.winter = true;
  const auto twigs = grow_strokes("low bushes", p.scene());
  ASSERT_GT(twigs.size(), 20U);
  constexpr float cell = 12.F;
  std::set<std::pair<int, int>> cells;
  for (const Stroke& s : twigs)
    cells.emplace(static_cast<int>(s.points[0].x / cell), static_cast<int>(s.points[0].y / cell));
  const double all = wood_width * wood_height / static_cast<double>(cell * cell);
  EXPECT_LT(static_cast<double>(cells.size()), 0.5 * all) << "most snow is empty";
  EXPECT_GT(static_cast<double>(twigs.size()), 4.0 * static_cast<double>(cells.size()));
}

// Near stone is dabbed in all directions, within its own class: lines would be fur.
TEST(Scree, IsDabbedWhereItIsNear) {
  Picture p = level_ground(scree);
  const glm::vec2 fall(0.6F, 0.8F);
  for (auto& d : p.guidance.fall_line) d = fall;
  for (float& metres : p.guidance.footprint_m) metres = 6.F;
  int all = 0;
  int across = 0;
  for (const Stroke& s : grow_strokes("scree", p.scene())) {
    EXPECT_LT(glm::length(axis_of(s)), 6.F);
    EXPECT_EQ(s.gate, StrokeGate::same_class);
    across += angle_deg(axis_of(s), fall) > 45.0 ? 1 : 0;
    ++all;
  }
  EXPECT_NEAR(across, 0.4 * all, 0.06 * all);
}

TEST(Scree, IsSmallStonesDownTheSlope) {
  Picture p = level_ground(scree);
  const glm::vec2 fall(0.6F, 0.8F);
  for (auto& d : p.guidance.fall_line) d = fall;
  int all = 0;
  for (const Stroke& s : grow_strokes("scree", p.scene())) {
    EXPECT_LT(glm::length(axis_of(s)), 6.F);
    EXPECT_LT(s.start_width, 2.5F);
    EXPECT_LT(angle_deg(axis_of(s), fall), 45.0);
    ++all;
  }
  EXPECT_GT(all, 3000);
}

// No area is flat: of windows of 4 mm on every class of ground hardly any has a single colour.
TEST(Ground, NoWindowIsFlat) {
  for (const LandCoverClass id :
       {valley_floor, forest, pasture, alpine_grass, shrub, scree, sand, rock, snow, glacier}) {
    Picture p = level_ground(id);
    const auto picture =
        paint_strokes(p.ground.colour, p.guidance, p.ground, {}, p.parameters, silent_progress())
            .picture;
    int flat = 0;
    int windows = 0;
    for (int y0 = 8; y0 + 8 <= wood_height - 8; y0 += 8)
      for (int x0 = 8; x0 + 8 <= wood_width - 8; x0 += 8, ++windows) {
        double sum = 0.0;
        double squares = 0.0;
        for (const auto [x, y] : test::cells({x0, y0, x0 + 8, y0 + 8})) {
          const double l = luma(picture(x, y));
          sum += l;
          squares += l * l;
        }
        flat += squares / 64.0 - sum * sum / 4096.0 < 0.006 * 0.006;
      }
    EXPECT_LT(flat, windows / 50) << class_name(id);
  }
}

}  // namespace
}  // namespace belvedere
