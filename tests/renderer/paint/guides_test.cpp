#include "renderer/paint/guides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/error.h"
#include "base/random.h"
#include "renderer/scene/scene.h"
#include "renderer/scene/scene_schema.h"
#include "tests/grids.h"
#include "tests/renderer/exemplar/painted_hills.h"
#include "texture/synthesis/synthesize.h"

namespace belvedere {
namespace {

using test::make_slope;

TEST(Guides, AreNamedOnceAndSayWhatTheyMean) {
  std::set<std::string_view> names;
  for (const GuideKind& kind : guide_kinds()) {
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
    EXPECT_FALSE(kind.meaning.empty()) << kind.name;
    EXPECT_TRUE(kind.share != nullptr) << kind.name;
    EXPECT_GE(kind.weight, 0.0) << kind.name;
    EXPECT_LE(kind.weight, 100.0) << kind.name;
  }
}

TEST(Guides, OfAPictureWithEveryChannelAreTheWholeTable) {
  GuidanceBuffers g;
  for (const GuidanceChannel& channel : guidance_channels())
    fill_channel(g, channel, 4, 3, channel.sky);
  std::vector<std::string> names;
  for (const Guide& guide : make_guide_stack(g, g.land_cover).guides) names.push_back(guide.name);
  EXPECT_EQ(names, guide_names());
}

TEST(Guides, OfScenesHaveTheWeightsOfTheTable) {
  EXPECT_EQ(SceneSynthesis{}.weights, default_guide_weights());
  EXPECT_EQ(default_guide_weights().size(), guide_kinds().size());
}

TEST(Guides, NeedDepthsAndClassesOfOneSize) {
  GuidanceBuffers g = make_slope(4, 3, LandCoverClass::scree, {0.0F, 0.0F, 1.0F}, 45.0F);
  EXPECT_THROW(make_guide_stack(g, Grid<LandCoverClass>(3, 3)), Error);
  g.depth_m = {};
  EXPECT_THROW(make_guide_stack(g, g.land_cover), Error);
}

TEST(Guides, AreQuantizedAsDocumented) {
  GuidanceBuffers g = make_slope(4, 1, LandCoverClass::scree, {0.0F, 0.0F, 1.0F}, 45.0F);
  g.depth_m[0] = 500.0F;
  g.depth_m[1] = 500000.0F;
  g.depth_m[2] = 500.0F * std::sqrt(1000.0F);
  g.depth_m[3] = std::numeric_limits<float>::infinity();
  g.altitude_m[1] = -20.0F;
  g.altitude_m[2] = 9000.0F;
  g.fall_line[1] = {-1.0F, 0.0F};
  g.valley_height_m[1] = 300.0F;
  g.valley_height_m[2] = 900.0F;
  const GuideStack stack = make_guide_stack(g, g.land_cover);
  const auto guide = [&](const std::string& name) {
    for (const Guide& each : stack.guides)
      if (each.name == name) return each.values;
    ADD_FAILURE() << name;
    return Grid<std::uint8_t>(4, 1, 0);
  };
  EXPECT_EQ(guide("valley")[0], 0);
  EXPECT_EQ(guide("valley")[1], 128);
  EXPECT_EQ(guide("valley")[2], 255);
  EXPECT_EQ(stack.label[0], 6);
  EXPECT_EQ(stack.label[3], 255);
  EXPECT_EQ(stack.depth_m, g.depth_m);
  EXPECT_EQ(guide("altitude")[0], 60);
  EXPECT_EQ(guide("altitude")[1], 0);
  EXPECT_EQ(guide("altitude")[2], 255);
  EXPECT_EQ(guide("tone")[0], 153);
  EXPECT_EQ(guide("distance")[0], 0);
  EXPECT_EQ(guide("distance")[1], 255);
  EXPECT_EQ(guide("distance")[2], 128);
  EXPECT_EQ(guide("shadow")[0], 255);
  EXPECT_EQ(guide("slope")[0], 128);
  EXPECT_EQ(guide("fall_line_x")[0], 128);
  EXPECT_EQ(guide("fall_line_y")[0], 255);
  EXPECT_EQ(guide("fall_line_x")[1], 0);
  g.shadow = {};
  EXPECT_EQ(make_guide_stack(g, g.land_cover).guides.size(), stack.guides.size() - 1);
  EXPECT_EQ(make_guide_stack(g, g.land_cover).find("shadow"), nullptr)
      << "left out, as its channel is absent";
}

// A meadow whose left half drains little ground and whose right half much, of one grey grain; a
// target with `flow` everywhere. Returns the share copied from the right half when that guide has
// `weight`.
double copied_from_the_brook(float flow, double weight) {
  GuidanceBuffers g = make_slope(96, 64, LandCoverClass::pasture, {0.0F, 0.0F, 1.0F}, 10.0F);
  g.flow = Grid<float>(96, 64, 3.0F);
  for (const auto [x, y] : test::cells({48, 0, 96, 64})) g.flow(x, y) = 8.0F;
  Exemplar exemplar{"meadow", Grid<Rgb8>(96, 64), make_guide_stack(g, g.land_cover)};
  for (const auto [x, y] : test::cells(96, 64)) {
    const auto grey = static_cast<std::uint8_t>(100.0 + 50.0 * random_uniform(9, x, y));
    exemplar.picture(x, y) = {grey, grey, grey};
  }
  GuidanceBuffers target = make_slope(48, 48, LandCoverClass::pasture, {0.0F, 0.0F, 1.0F}, 10.0F);
  target.flow = Grid<float>(48, 48, flow);
  SynthesisParameters parameters;
  parameters.weights = default_guide_weights();
  for (auto& [name, value] : parameters.weights)
    if (name == "flow") value = weight;
  const MatchField matches = synthesize({exemplar}, make_guide_stack(target, target.land_cover),
                                        parameters, silent_progress());
  double right = 0.0;
  for (const Match& m : matches) right += m.x >= 48 ? 1.0 : 0.0;
  return right / static_cast<double>(matches.size());
}

TEST(Guides, FlowChoosesAmongTexelsByTheWaterTheySee) {
  EXPECT_LT(copied_from_the_brook(3.0F, 1.0), 0.02);
  EXPECT_GT(copied_from_the_brook(8.0F, 1.0), 0.98);
  const double unasked = copied_from_the_brook(8.0F, 0.0);
  EXPECT_GT(unasked, 0.2);
  EXPECT_LT(unasked, 0.8);
  EXPECT_EQ(unasked, copied_from_the_brook(3.0F, 0.0)) << "off by default";
}

// The same for two halves whose slopes fall to the left and to the right.
TEST(Guides, FallLinesChooseStrokesOfTheirDirection) {
  const auto copied_from_the_right = [](glm::vec2 falls, double weight) {
    GuidanceBuffers g = make_slope(96, 64, LandCoverClass::rock, {0.0F, 0.0F, 1.0F}, 40.0F);
    for (const auto [x, y] : test::cells(96, 64))
      g.fall_line(x, y) = glm::vec2(x < 48 ? -1.0F : 1.0F, 0.0F);
    Exemplar exemplar{"face", Grid<Rgb8>(96, 64), make_guide_stack(g, g.land_cover)};
    for (const auto [x, y] : test::cells(96, 64)) {
      const auto grey = static_cast<std::uint8_t>(100.0 + 50.0 * random_uniform(9, x, y));
      exemplar.picture(x, y) = {grey, grey, grey};
    }
    GuidanceBuffers target = make_slope(48, 48, LandCoverClass::rock, {0.0F, 0.0F, 1.0F}, 40.0F);
    target.fall_line = Grid<glm::vec2>(48, 48, falls);
    SynthesisParameters parameters;
    for (const std::string& name : guide_names())
      parameters.weights.emplace_back(name, name.starts_with("fall_line") ? weight : 0.0);
    const MatchField matches = synthesize({exemplar}, make_guide_stack(target, target.land_cover),
                                          parameters, silent_progress());
    const auto right =
        std::count_if(matches.begin(), matches.end(), [](const Match& m) { return m.x >= 48; });
    return static_cast<double>(right) / static_cast<double>(matches.size());
  };
  EXPECT_GT(copied_from_the_right({1.0F, 0.0F}, 1.0), 0.98);
  EXPECT_LT(copied_from_the_right({-1.0F, 0.0F}, 1.0), 0.02);
  EXPECT_EQ(copied_from_the_right({1.0F, 0.0F}, 0.0), copied_from_the_right({-1.0F, 0.0F}, 0.0));
}

// Rock painted from a neighbour of the same class whose base differs by .05, .10 and nothing: a
// small difference is the variety of strokes, a larger one a border that they crossed.
TEST(PaintedClasses, WithinAClassTakeOnlyWhatStrokesDoNotCarry) {
  const GuidanceBuffers g = make_slope(4, 1, LandCoverClass::rock, {0.0F, 0.0F, 1.0F}, 10.0F);
  Grid<glm::vec3> base(4, 1);
  base[0] = {0.50F, 0.40F, 0.30F};
  base[1] = {0.45F, 0.42F, 0.30F};
  base[2] = {0.40F, 0.45F, 0.30F};
  base[3] = base[0];
  Grid<std::uint32_t> sources(4, 1, 0);
  const PaintedClasses painted = find_painted_classes(sources, g, base);
  EXPECT_EQ(painted.base[1], base[1]);
  EXPECT_EQ(painted.base[3], base[3]);
  // .06 of the .10 in red stay, and as much of the .05 in green in proportion.
  EXPECT_NEAR(painted.base[2].x, 0.44F, 1e-6F);
  EXPECT_NEAR(painted.base[2].y, 0.43F, 1e-6F);
  EXPECT_EQ(painted.base[2].z, 0.30F);
}

TEST(PaintedClasses, TakeClassAndBaseFromWhereThePaintCameFrom) {
  GuidanceBuffers g = make_slope(3, 1, LandCoverClass::rock, {0.0F, 0.0F, 1.0F}, 10.0F);
  g.land_cover[2] = LandCoverClass::snow;
  Grid<glm::vec3> base(3, 1);
  for (int i = 0; i < 3; ++i) base(i, 0) = glm::vec3(0.1F * static_cast<float>(i));
  Grid<std::uint32_t> sources(3, 1);
  sources(0, 0) = 1;  // rock on rock
  sources(1, 0) = 1;
  sources(2, 0) = 0;  // rock on snow
  const PaintedClasses painted = find_painted_classes(sources, g, base);
  EXPECT_EQ(painted.land_cover(2, 0), LandCoverClass::rock);
  EXPECT_EQ(painted.base(2, 0), base(0, 0));
  EXPECT_NEAR(painted.base(0, 0).x, base(1, 0).x - 0.06F, 1e-6F) << "of its own class";
  EXPECT_EQ(painted.base(1, 0), base(1, 0));
}

}  // namespace
}  // namespace belvedere
