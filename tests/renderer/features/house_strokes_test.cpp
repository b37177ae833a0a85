#include "renderer/features/house_strokes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/texture/strokes/stroke_picture.h"

namespace belvedere {
namespace {

DrawnFeatures one_house() {
  DrawnFeatures features;
  features.style =
      parse_feature_style("version = 1\n[kinds.house]\ndraw = \"building\"\nfill = \"#ff0000\"\ncasing = \"#ffffff\"\n", "test.toml");
  features.sheet_px = {320, 240};
  features.net = {2, 1};
  features.houses_in = {{0}, {}};
  features.lines_in.resize(2);
  DrawnHouse house;
  house.foot = {100.F, 120.F};
  house.distance_m = 20000.F;
  house.reach_px = 10.F;
  house.shade = {-6.F, 1.F};
  house.shade_px = 4.F;
  house.faces = {{.from = {100.F, 122.F}, .to = {100.F, 116.F}, .from_width = 12.F, .to_width = 12.F, .light = 0.2F, .roof = false},
                 {.from = {100.F, 116.F}, .to = {100.F, 110.F}, .from_width = 13.F, .to_width = 13.F, .light = 0.9F, .roof = true}};
  features.houses.push_back(house);
  return features;
}

Picture meadow() {
  Picture p = plain_picture(LandCoverClass::pasture, 320, 240);
  for (float& depth : p.guidance.depth_m) depth = 20000.F;
  return p;
}

TEST(HouseStrokes, PaintsRoofOverWallAndAShadowBeside) {
  const Picture p = meadow();
  const std::vector<Stroke> strokes = house_strokes(one_house(), p.scene());
  ASSERT_EQ(strokes.size(), 3U);
  EXPECT_EQ(strokes[0].gate, StrokeGate::surface) << "the shadow lies on the ground";
  for (const Stroke& stroke : strokes) EXPECT_TRUE(stroke.standing);
  EXPECT_GT(strokes[1].order, strokes[2].order) << "the roof is painted last";
  Painting painting = begin_painting(p.ground.colour);
  paint_in_order(painting, p.guidance, strokes, 1.0, silent_progress());
  const glm::vec3 roof = painting.picture(100, 113);
  EXPECT_GT(roof.x, roof.y + 0.3F);
  const glm::vec3 wall = painting.picture(100, 119);
  EXPECT_LT(std::abs(wall.x - wall.y), 0.1F);
  EXPECT_LT(painting.picture(95, 121).y, 0.5F + 0.45F);
  EXPECT_EQ(painting.picture(130, 120), glm::vec3(0.5F));
}

TEST(HouseStrokes, NearerGroundHidesThem) {
  Picture p = meadow();
  for (float& depth : p.guidance.depth_m) depth = 15000.F;
  Painting painting = begin_painting(p.ground.colour);
  paint_in_order(painting, p.guidance, house_strokes(one_house(), p.scene()), 1.0, silent_progress());
  EXPECT_EQ(painting.picture(100, 113), glm::vec3(0.5F));
}

// Before anything stands: all ground is seen; what stands takes its share of it. Nothing grows where it is cleared.
TEST(HouseStrokes, StandingThingsKeepOffClearedGroundAndTellWhatTheyHide) {
  Picture p = plain_picture(LandCoverClass::forest, 320, 240);
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x) {
      p.guidance.depth_m(x, y) = 60000.F - 160.F * static_cast<float>(y);
      p.guidance.position_m(x, y) = glm::vec3(20.F * static_cast<float>(x), p.guidance.depth_m(x, y), 900.F);
    }
  const StrokeLayers trees{.sky = false, .ground = false, .accents = false, .breaks = false, .upright = true};
  MappedGround mapped;
  mapped.cleared = Grid<std::uint8_t>(320, 240, 0);
  SheetWindow window;
  window.sheet_px = {320, 240};
  window.mapped = &mapped;
  const auto paint = [&](const SheetWindow& place) {
    return paint_strokes(p.ground.colour, p.guidance, p.ground, trees, p.parameters, silent_progress(), place);
  };
  const Painting wood = paint(window);
  SheetWindow plain = window;
  plain.mapped = nullptr;
  const Painting before = paint(plain);
  EXPECT_TRUE(before.seen_ground.empty());
  std::size_t different = 0;
  for (std::size_t i = 0; i < wood.picture.size(); ++i) different += wood.picture[i] != before.picture[i] ? 1 : 0;
  EXPECT_EQ(different, 0U) << "a map without anything changes nothing";
  double seen = 0.0;
  for (const float share : wood.seen_ground) seen += share;
  EXPECT_LT(seen / static_cast<double>(wood.seen_ground.size()), 0.5) << "a forest hides its ground";

  for (int y = 100; y < 160; ++y)
    for (int x = 0; x < 320; ++x) mapped.cleared(x, y) = 1;
  const Painting lane = paint(window);
  for (int x = 40; x < 280; ++x) EXPECT_EQ(lane.seen_ground(x, 130), 1.F) << "trees stand below and reach up some pixels, and no farther";
  std::size_t elsewhere = 0;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 320; ++x) elsewhere += lane.picture(x, y) != wood.picture(x, y) ? 1 : 0;
  EXPECT_EQ(elsewhere, 0U);
}

}  // namespace
}  // namespace belvedere
