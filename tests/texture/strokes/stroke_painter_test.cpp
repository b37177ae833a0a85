#include "texture/strokes/stroke_painter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "tests/grids.h"
#include "tests/texture/strokes/stroke_picture.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

// One class over the whole picture, depth increasing upwards from 20 to 60 km, fall line straight
// down, tone .6.
Picture one_class(LandCoverClass id, int width = 320, int height = 240) {
  Picture p = plain_picture(id, width, height);
  for (const auto [x, y] : test::cells(width, height)) {
    p.guidance.depth_m(x, y) =
        id == sky ? std::numeric_limits<float>::infinity()
                  : 60000.F - 40000.F * static_cast<float>(y) / static_cast<float>(height);
    p.guidance.position_m(x, y) =
        glm::vec3(20.F * static_cast<float>(x), p.guidance.depth_m(x, y), 900.F);
  }
  return p;
}

double mean_height(const std::vector<Stroke>& strokes, float y0, float y1) {
  double sum = 0.0;
  int count = 0;
  for (const Stroke& s : strokes) {
    if (s.gate != StrokeGate::upright || s.points[0].y < y0 || s.points[0].y >= y1) continue;
    sum += s.points[0].y - s.points[1].y;
    ++count;
  }
  return sum / count;
}

TEST(StrokePainter, TreesStandUprightWhateverTheSlope) {
  Picture p = one_class(forest);
  for (auto& d : p.guidance.fall_line)
    d = glm::vec2(0.8F, 0.6F);  // a slope that falls to the right
  const auto trees = wood_strokes(p.scene());
  int bodies = 0;
  for (const Stroke& s : trees) {
    if (s.gate != StrokeGate::upright) continue;
    const glm::vec2 axis = s.points[1] - s.points[0];
    EXPECT_LT(axis.y, 0.F);
    EXPECT_LT(std::abs(axis.x), std::tan(0.1745F) * std::abs(axis.y) + 0.2F);  // within 10°
    ++bodies;
  }
  EXPECT_GT(bodies, 500);
}

// Puts the picture's ground at an altitude: which trees grow depends on it.
void raise(Picture& picture, float altitude_m) {
  for (auto& position : picture.guidance.position_m) position.z = altitude_m;
}

TEST(StrokePainter, TreesAreAsTallFarAsNear) {
  Picture p = one_class(forest);
  raise(p, 1700.F);  // spruces only: the occurrence of leafy trees varies over the ground
  const auto trees = wood_strokes(p.scene());
  EXPECT_NEAR(mean_height(trees, 0.F, 80.F) / mean_height(trees, 160.F, 240.F), 1.0, 0.05);
}

TEST(StrokePainter, TrunksStandInRowsOnSteepSlopesAndHuddledElsewhere) {
  const glm::vec2 fall(0.8F, 0.6F);
  const auto along_share = [&](float slope_deg) {
    Picture p = one_class(forest);
    raise(p, 1500.F);
    for (auto& d : p.guidance.fall_line) d = fall;
    for (float& slope : p.guidance.slope_deg) slope = slope_deg;
    // Bodies are the wide upright strokes; the next in the list belongs to the same group if it is
    // a step away.
    std::vector<glm::vec2> feet;
    for (const Stroke& s : wood_strokes(p.scene()))
      if (s.gate == StrokeGate::upright && s.start_width > 2.5F) feet.push_back(s.points[0]);
    int steps = 0;
    int along = 0;
    for (std::size_t k = 1; k < feet.size(); ++k) {
      const glm::vec2 step = feet[k] - feet[k - 1];
      if (std::hypot(step.x, step.y) > 8.F) continue;
      ++steps;
      along += angle_deg(step, fall) < 20.0 ? 1 : 0;
    }
    EXPECT_GT(steps, 300);
    return static_cast<double>(along) / steps;
  };
  // For randomly spread trees this is two in nine by chance.
  EXPECT_NEAR(along_share(22.F), 2.0 / 9.0, 0.06) << "no slope is combed";
  EXPECT_GT(along_share(42.F), 0.38);
}

TEST(StrokePainter, LowForestIsLeafyAndWarmer) {
  Picture low = one_class(forest);
  raise(low, 500.F);
  Picture high = one_class(forest);
  raise(high, 1700.F);
  const auto warmest = [&](const Picture& p) {
    float max = -1.F;
    for (const Stroke& s : wood_strokes(p.scene())) max = std::max(max, s.colour.x - s.colour.z);
    return max;
  };
  EXPECT_GT(warmest(low), warmest(high) + 0.1F);  // yellow dots
}

TEST(StrokePainter, TreesOfTheValleyFloorStandInGroups) {
  Picture p = one_class(valley_floor, 600, 400);
  constexpr int cell = 25;
  Grid<int> counts(600 / cell, 400 / cell, 0);
  for (const Stroke& s : grow_strokes("scattered trees", p.scene()))
    if (s.gate == StrokeGate::upright && s.start_width > 1.5F)
      ++counts(std::min(599, static_cast<int>(s.points[0].x)) / cell,
               std::min(399, static_cast<int>(s.points[0].y)) / cell);
  double sum = 0.0;
  double squares = 0.0;
  for (const int n : counts) {
    sum += n;
    squares += static_cast<double>(n) * n;
  }
  const double mean = sum / static_cast<double>(counts.size());
  EXPECT_GT(mean, 0.1);
  // For evenly spread ones the variance would be as large as the mean.
  EXPECT_GT(squares / static_cast<double>(counts.size()) - mean * mean, 3.0 * mean);
}

// 10 … 30 % of the strokes are of the next darker tone, so that no area is flat.
TEST(StrokePainter, DarkerStrokesAreMixedIn) {
  const auto darker_share = [&](LandCoverClass id, std::string_view kind) {
    const auto strokes = grow_strokes(kind, one_class(id).scene());
    // Half a step down from the base at .5, the darker picture at .4.
    const auto dark = std::count_if(strokes.begin(), strokes.end(),
                                    [](const Stroke& s) { return s.colour.y < 0.455F; });
    return static_cast<double>(dark) / static_cast<double>(strokes.size());
  };
  for (const LandCoverClass id : {pasture, alpine_grass, valley_floor, snow, glacier, scree})
    EXPECT_THAT(darker_share(id, "wash"), testing::AllOf(testing::Gt(0.10), testing::Lt(0.30)))
        << class_name(id);
  for (const LandCoverClass id : {pasture, alpine_grass, valley_floor, shrub})
    EXPECT_THAT(darker_share(id, "meadow"), testing::AllOf(testing::Gt(0.10), testing::Lt(0.30)))
        << class_name(id);
  EXPECT_THAT(darker_share(scree, "scree"), testing::AllOf(testing::Gt(0.10), testing::Lt(0.30)));
  EXPECT_THAT(darker_share(snow, "snow"), testing::AllOf(testing::Gt(0.10), testing::Lt(0.30)));
}

// A round settlement of this radius on the valley floor, denser the larger it is and towards its
// centre.
Picture town(float radius) {
  Picture p = one_class(valley_floor, 320, 240);
  for (const auto [x, y] : test::cells(320, 240))
    if (const float r = std::hypot(static_cast<float>(x) - 160.F, static_cast<float>(y) - 120.F);
        r < radius) {
      p.guidance.land_cover(x, y) = settlement;
      p.guidance.built(x, y) = std::min(1.F, radius / 80.F) * (1.F - 0.7F * r / radius);
    }
  p.guidance.footprint_m = Grid<float>(320, 240, 15.F);
  return p;
}

TEST(StrokePainter, TownsDifferFromVillages) {
  const auto widest = [&](float radius) {
    const Picture p = town(radius);
    float max = 0.F;
    for (const Stroke& s : town_strokes(p.scene()))
      if (s.gate == StrokeGate::surface && s.point_count == 2)
        max = std::max(max, std::abs(s.points[1].x - s.points[0].x) +
                                (s.tip == StrokeTip::square ? 0.F : s.start_width));
    return max;
  };
  EXPECT_GT(widest(80.F), 4.5F);  // halls and factories
  EXPECT_LT(widest(9.F), 4.5F);
}

TEST(StrokePainter, TownsAreDenserInTheirMiddle) {
  Picture p = town(80.F);
  int inside = 0;
  int edge = 0;
  over_seeds(p, [&] {
    for (const Stroke& s : town_strokes(p.scene())) {
      if (s.alpha < 0.9F || s.gate != StrokeGate::surface) continue;  // walls and roofs
      const float r = std::hypot(s.points[0].x - 160.F, s.points[0].y - 120.F);
      inside += r < 55.F ? 1 : 0;
      edge += r > 70.F ? 1 : 0;
    }
  });
  EXPECT_GT(inside / (55.0 * 55.0), 1.15 * edge / (80.0 * 80.0 - 70.0 * 70.0));
}

TEST(StrokePainter, TheSkyIsDrawnOutLevel) {
  Picture p = one_class(sky);
  // A cloud in the right half: there the brush dabs, still level.
  for (const auto [x, y] : test::cells({200, 80, 280, 160}))
    p.ground.colour(x, y) = glm::vec3(0.9F);
  double clear = 0.0, dabbed = 0.0;
  int clear_count = 0, dab_count = 0;
  for (const Stroke& s : grow_strokes("sky", p.scene())) {
    const glm::vec2 axis = s.points[3] - s.points[0];
    EXPECT_LE(std::abs(std::atan2(axis.y, axis.x)) * 57.2958F, 3.F);
    const glm::vec2 centre = 0.5F * (s.points[0] + s.points[3]);
    if (centre.x < 150.F) clear += std::hypot(axis.x, axis.y), ++clear_count;
    if (centre.y > 85.F && centre.y < 155.F && std::abs(centre.x - 200.F) < 6.F)
      dabbed += std::hypot(axis.x, axis.y), ++dab_count;
  }
  ASSERT_GT(clear_count, 100);
  ASSERT_GT(dab_count, 5);
  EXPECT_GT(clear / clear_count, 3.0 * dabbed / dab_count);
}

TEST(StrokePainter, StrokesGrowWithTheSheet) {
  Picture small = one_class(forest, 200, 200);
  Picture large = one_class(forest, 400, 400);
  raise(small, 1700.F);  // spruces only
  raise(large, 1700.F);
  const StrokeParameters at_one;
  StrokeParameters at_two;
  at_two.pixels_per_unit = 2.0;
  for (float& metres : large.guidance.footprint_m) metres *= 0.5F;  // a unit covers as much ground
  const auto a = wood_strokes({small.guidance, small.ground, at_one});
  const auto b = wood_strokes({large.guidance, large.ground, at_two});
  EXPECT_NEAR(mean_height(b, 0.F, 400.F) / mean_height(a, 0.F, 200.F), 2.0, 0.05);
  EXPECT_NEAR(static_cast<double>(b.size()) / static_cast<double>(a.size()), 1.0, 0.1);
}

TEST(StrokePainter, LightSideFollowsTheSun) {
  const Picture p = one_class(forest);
  StrokeParameters from_left;
  from_left.sun_side = -1.0;
  const StrokeParameters from_right;
  const auto offset = [&](const StrokeParameters& parameters) {
    // The lit stroke comes directly after its dark body in the list.
    const auto trees = wood_strokes({p.guidance, p.ground, parameters});
    double sum = 0.0;
    for (std::size_t i = 1; i < trees.size(); ++i)
      if (trees[i].gate == StrokeGate::upright && trees[i - 1].gate == StrokeGate::upright &&
          trees[i].start_width < 0.6F * trees[i - 1].start_width)
        sum += trees[i].points[0].x - trees[i - 1].points[0].x;
    return sum;
  };
  StrokeParameters by_place;  // light from the left everywhere, given per position
  by_place.local_side = [](glm::dvec2) { return -1.0F; };
  EXPECT_EQ(offset(by_place), offset(from_left));
  EXPECT_GT(offset(from_right), 0.0);
  EXPECT_LT(offset(from_left), 0.0);
}

TEST(StrokePainter, EachClassGrowsItsOwnStrokesOnly) {
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    const Picture p = one_class(info.id);
    const StrokeScene scene = p.scene();
    EXPECT_EQ(wood_strokes(scene).empty(), info.id != forest) << info.name;
    EXPECT_EQ(grow_strokes("rock facets", scene).empty(), info.id != rock) << info.name;
    EXPECT_EQ(grow_strokes("water", scene).empty(), info.id != water) << info.name;
    EXPECT_EQ(town_strokes(scene).empty(), info.id != settlement) << info.name;
    EXPECT_EQ(grow_strokes("sky", scene).empty(), info.id != sky) << info.name;
    EXPECT_EQ(grow_strokes("snow", scene).empty(), info.id != snow && info.id != glacier)
        << info.name;
  }
}

TEST(StrokePainter, RockIsPaintedDownItsPlanes) {
  Picture p = one_class(rock);
  const glm::vec2 down = glm::vec2(0.6F, 0.8F);
  for (auto& d : p.guidance.fall_line) d = down;
  int along = 0;
  int all = 0;
  for (const Stroke& s : grow_strokes("rock dabs", p.scene())) {
    const glm::vec2 axis = s.points[3] - s.points[0];
    const float cosine = std::abs(axis.x * down.x + axis.y * down.y) / std::hypot(axis.x, axis.y);
    along += cosine > std::cos(0.6F) ? 1 : 0;
    ++all;
  }
  EXPECT_NEAR(static_cast<double>(along) / all, 0.7, 0.05);  // three in ten are perpendicular
}

TEST(StrokePainter, BrokenColourIsSmallAndLiesEveryWay) {
  const Picture p = one_class(scree);
  int steep = 0;
  int all = 0;
  for (const Stroke& s : grow_strokes("broken colour", p.scene())) {
    const glm::vec2 axis = s.points[3] - s.points[0];
    EXPECT_LT(std::hypot(axis.x, axis.y), 5.F);
    steep += angle_deg(axis, {0.F, 1.F}) < 45.0 ? 1 : 0;
    ++all;
  }
  ASSERT_GT(all, 1000);
  EXPECT_GT(steep, all * 2 / 5);
  EXPECT_LT(steep, all * 3 / 4);
}

TEST(StrokePainter, UprightLayerAloneLeavesBareGroundUntouched) {
  const Picture p = one_class(rock);
  const Grid<glm::vec3> canvas(320, 240, glm::vec3(0.3F));
  const StrokeLayers upright_only{
      .sky = false, .ground = false, .accents = false, .breaks = false, .upright = true};
  EXPECT_EQ(
      paint_strokes(canvas, p.guidance, p.ground, upright_only, {}, silent_progress()).picture,
      canvas);
}

TEST(StrokePainter, MeanColourStaysNearTheBase) {
  const Picture p = one_class(pasture);
  const auto picture = paint_strokes(p.ground.colour, p.guidance, p.ground, {.upright = false}, {},
                                     silent_progress())
                           .picture;
  double sum = 0.0;
  double squares = 0.0;
  for (const glm::vec3& c : picture) {
    sum += c.y;
    squares += c.y * c.y;
  }
  const double mean = sum / static_cast<double>(picture.size());
  EXPECT_NEAR(mean, 0.5, 0.02);
  EXPECT_GT(squares / static_cast<double>(picture.size()) - mean * mean,
            1e-4);  // and it is painted, not flat
}

// All kinds, by their layer; a kind that is not painted is a class without its brush.
TEST(StrokePainter, EveryKindOfStrokeIsPaintedInItsLayer) {
  using Names = std::vector<std::string_view>;
  const Names ground = {"wash",        "meadow",        "rock facets", "rock dabs", "rock chips",
                        "rock rubble", "rock turf",     "rock drifts", "scree",     "sand",
                        "snow",        "broken colour", "water"};
  const Names breaks = {"wind streaks",       "river foam",    "sea surf",
                        "glacier flow lines", "glacier edges", "glacier moraines",
                        "glacier crevasses"};
  const Names upright = {"forest trees", "forest edges", "glade grass",  "scattered trees",
                         "low bushes",   "rock trees",   "grass flecks", "stones",
                         "tufts",        "houses",       "churches",     "farms"};
  EXPECT_EQ(ground.size() + breaks.size() + upright.size() + 2, stroke_kinds().size())
      << "sky and accents are the other two";
  StrokeParameters winter;
  winter.winter = true;
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    Picture p = one_class(info.id, 160, 120);
    p.guidance.slope_deg = Grid<float>(160, 120, 30.F);
    p.guidance.footprint_m = Grid<float>(160, 120, 15.F);
    p.ground.accent = Grid<float>(160, 120, -0.8F);
    const StrokeScene scene{p.guidance, p.ground, winter};
    const auto count = [&](const StrokeLayers& layers) {
      return static_cast<std::size_t>(
          paint_strokes(p.ground.colour, p.guidance, p.ground, layers, winter, silent_progress())
              .stroke_count);
    };
    const auto sum = [&](const Names& names) {
      std::size_t all = 0;
      for (const std::string_view name : names) all += grow_strokes(name, scene).size();
      return all;
    };
    const auto only = [](StrokeLayers layers) {
      layers.accents = false;
      return layers;
    };
    EXPECT_EQ(count(only({.sky = true, .ground = false, .breaks = false, .upright = false})),
              grow_strokes("sky", scene).size())
        << info.name;
    EXPECT_EQ(count(only({.sky = false, .ground = true, .breaks = false, .upright = false})),
              sum(ground))
        << info.name;
    EXPECT_EQ(count(only({.sky = false, .ground = false, .breaks = true, .upright = false})),
              sum(breaks))
        << info.name;
    EXPECT_EQ(count(only({.sky = false, .ground = true, .breaks = true, .upright = false})),
              sum(ground) + sum(breaks))
        << info.name;
    EXPECT_EQ(count(only({.sky = false, .ground = false, .breaks = false, .upright = true})),
              sum(upright))
        << info.name;
    EXPECT_EQ(
        count({.sky = false, .ground = true, .accents = true, .breaks = false, .upright = false}),
        sum(ground) + grow_strokes("accents", scene).size())
        << info.name;
  }
}

TEST(StrokePainter, HousesInTheHazeTakeTheColourOfTheAir) {
  Picture p = one_class(settlement);
  p.guidance.footprint_m = Grid<float>(320, 240, 15.F);
  const auto farthest = [&](float haze) {
    p.ground.haze = Grid<float>(320, 240, haze);
    float max = 0.F;
    for (const Stroke& s : town_strokes(p.scene()))
      if (s.tip == StrokeTip::square) max = std::max(max, std::abs(s.colour.x - 0.5F));
    return max;
  };
  EXPECT_GT(farthest(0.F), 0.2F);
  EXPECT_NEAR(farthest(1.F), 0.F, 1e-5F);
}

TEST(StrokePainter, StrokesCurveSlightlyAndAreEdgedOnEitherSide) {
  const Picture p = one_class(pasture);
  double bend = 0.0;
  int right = 0;
  const auto strokes = grow_strokes("wash", p.scene());
  for (const Stroke& s : strokes) {
    const glm::vec2 chord = s.points[3] - s.points[0];
    const glm::vec2 centre = 0.5F * (s.points[1] + s.points[2]) - s.points[0];
    bend +=
        std::abs(chord.x * centre.y - chord.y * centre.x) / (chord.x * chord.x + chord.y * chord.y);
    right += s.edge > 0.F ? 1 : 0;
  }
  const auto count = static_cast<double>(strokes.size());
  EXPECT_THAT(bend / count,
              testing::AllOf(testing::Gt(0.008), testing::Lt(0.06)));  // of their length
  EXPECT_NEAR(right / count, 0.5, 0.05);
}

TEST(StrokePainter, AirEvensOutWhatLoadsOfPaintDifferBy) {
  Picture p = one_class(pasture);
  p.ground.darker = p.ground.lighter =
      p.ground.colour;  // no other differences than those of loads and jitter
  const auto variance = [&](float haze) {
    p.ground.haze = Grid<float>(320, 240, haze);
    const auto picture = paint_strokes(p.ground.colour, p.guidance, p.ground, {.upright = false},
                                       {}, silent_progress())
                             .picture;
    double squares = 0.0;
    for (const glm::vec3& c : picture) squares += (c.y - 0.5) * (c.y - 0.5);
    return squares / static_cast<double>(picture.size());
  };
  EXPECT_LT(variance(1.F), 0.8 * variance(0.F));
}

TEST(StrokePainter, ThreadsChangeNoBit) {
  Picture p = one_class(forest);
  for (const auto [x, y] :
       test::cells({p.guidance.width() / 2, 0, p.guidance.width(), p.guidance.height()}))
    p.guidance.land_cover(x, y) = rock;
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return paint_strokes(p.ground.colour, p.guidance, p.ground, {}, {}, silent_progress());
  };
  const Painting one = run(1);
  const Painting two = run(2);
  EXPECT_EQ(one.picture, two.picture);
  EXPECT_EQ(one.sources, two.sources);
  EXPECT_EQ(one.under, two.under);
  EXPECT_EQ(one.under_share, two.under_share);
  EXPECT_GT(std::count_if(one.under_share.begin(), one.under_share.end(),
                          [](int share) { return share > 60; }),
            50);
}

TEST(StrokePainter, RefusesGridsOfDifferentSize) {
  const Picture p = one_class(forest);
  const Grid<glm::vec3> canvas(10, 10);
  EXPECT_THROW(paint_strokes(canvas, p.guidance, p.ground, {}, {}, silent_progress()), Error);
}

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
  for (const auto [x, y] : test::cells(480, bands * band_px))
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
