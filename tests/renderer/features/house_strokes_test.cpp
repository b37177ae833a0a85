#include "renderer/features/house_strokes.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/grids.h"
#include "tests/texture/strokes/stroke_picture.h"

namespace belvedere {
namespace {

DrawnFeatures one_house() {
  DrawnFeatures features;
  features.style = parse_feature_style(
      "version = 1\n[kinds.house]\ndraw = \"building\"\nfill = \"#ff0000\"\ncasing = \"#ffffff\"\n",
      "test.toml");
  features.sheet_px = {320, 240};
  features.net = {2, 1};
  features.houses_in = {{0}, {}};
  features.lines_in.resize(2);
  DrawnHouse house;
  house.foot = {100.F, 120.F};
  house.distance_m = 20000.F;
  house.reach_px = 10.F;
  house.shades = {{.from = house.foot, .to = house.foot + glm::vec2(-6.F, 1.F), .width = 4.F}};
  house.faces = {{.corners = {{{94.F, 122.F}, {106.F, 122.F}, {106.F, 116.F}, {94.F, 116.F}}},
                  .light = 0.2F,
                  .roof = false},
                 {.corners = {{{93.F, 116.F}, {107.F, 116.F}, {111.F, 110.F}, {97.F, 110.F}}},
                  .light = 0.9F,
                  .roof = true}};
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
  ASSERT_GT(strokes.size(), 6U);
  EXPECT_EQ(strokes[0].gate, StrokeGate::surface) << "the shadow lies on the ground";
  for (const Stroke& stroke : strokes) EXPECT_TRUE(stroke.standing);
  EXPECT_GT(strokes[1].order, strokes.back().order) << "the roof is painted last";
  Painting painting = begin_painting(p.ground.colour);
  paint_in_order(painting, p.guidance, strokes, 1.0, silent_progress());
  const glm::vec3 roof = painting.picture(100, 113);
  EXPECT_GT(roof.x, roof.y + 0.3F);
  const glm::vec3 wall = painting.picture(100, 119);
  EXPECT_LT(std::abs(wall.x - wall.y), 0.1F);
  EXPECT_LT(painting.picture(95, 121).y, 0.5F + 0.45F);
  EXPECT_EQ(painting.picture(130, 120), glm::vec3(0.5F));
  // The roof leans to the right as its corners do: its paint is complete, and ends where they do.
  for (int y = 110; y < 116; ++y) {
    const float left = 93.F + 4.F * (116.F - (static_cast<float>(y) + 0.5F)) / 6.F;
    for (int x = 85; x < 120; ++x) {
      const float inside =
          std::min(static_cast<float>(x) + 0.5F - left, left + 14.F - static_cast<float>(x) - 0.5F);
      const glm::vec3 here = painting.picture(x, y);
      if (inside > 1.5F && y > 110 && y < 115) {
        EXPECT_GT(here.x, here.y + 0.4F) << x << ' ' << y;
      }
      if (inside < -1.5F) {
        EXPECT_LT(std::abs(here.x - here.y), 0.15F) << x << ' ' << y;
      }
    }
  }
}

TEST(HouseStrokes, NearerGroundHidesThem) {
  Picture p = meadow();
  for (float& depth : p.guidance.depth_m) depth = 15000.F;
  Painting painting = begin_painting(p.ground.colour);
  paint_in_order(painting, p.guidance, house_strokes(one_house(), p.scene()), 1.0,
                 silent_progress());
  EXPECT_EQ(painting.picture(100, 113), glm::vec3(0.5F));
}

// Without standing objects all ground is visible; they take their share of it. Nothing grows on
// cleared ground.
TEST(HouseStrokes, StandingThingsKeepOffClearedGroundAndTellWhatTheyHide) {
  Picture p = plain_picture(LandCoverClass::forest, 320, 240);
  for (const auto [x, y] : test::cells(320, 240)) {
    p.guidance.depth_m(x, y) = 60000.F - 160.F * static_cast<float>(y);
    p.guidance.position_m(x, y) =
        glm::vec3(20.F * static_cast<float>(x), p.guidance.depth_m(x, y), 900.F);
  }
  const StrokeLayers trees{
      .sky = false, .ground = false, .accents = false, .breaks = false, .upright = true};
  MappedGround mapped;
  mapped.cleared = Grid<std::uint8_t>(320, 240, 0);
  SheetWindow window{.sheet_px = {320, 240}, .mapped = &mapped};
  const auto paint = [&](const SheetWindow& position) {
    return paint_strokes(p.ground.colour, p.guidance, p.ground, trees, p.parameters,
                         silent_progress(), position);
  };
  const Painting wood = paint(window);
  SheetWindow plain = window;
  plain.mapped = nullptr;
  const Painting before = paint(plain);
  EXPECT_TRUE(before.seen_ground.empty());
  std::size_t different = 0;
  for (std::size_t i = 0; i < wood.picture.size(); ++i)
    different += wood.picture[i] != before.picture[i] ? 1 : 0;
  EXPECT_EQ(different, 0U) << "a map without anything changes nothing";
  double seen = 0.0;
  for (const float share : wood.seen_ground) seen += share;
  EXPECT_LT(seen / static_cast<double>(wood.seen_ground.size()), 0.5)
      << "a forest hides its ground";
  EXPECT_TRUE(wood.seen_overhead.empty());

  // Overhead objects are hidden by nearer trees: by none in front of everything, by all behind
  // them.
  MappedGround overhead = mapped;
  overhead.overhead_m = Grid<float>(320, 240, std::numeric_limits<float>::infinity());
  for (const auto [x, y] : test::cells(160, 240)) overhead.overhead_m(x, y) = 20000.F;
  window.mapped = &overhead;
  const Painting ropes = paint(window);
  for (std::size_t i = 0; i < ropes.picture.size(); ++i)
    ASSERT_EQ(ropes.picture[i], wood.picture[i]) << "overhead objects are painted later";
  for (const auto [x, y] : test::cells(320, 240))
    ASSERT_EQ(ropes.seen_overhead(x, y), x < 160 ? 1.F : wood.seen_ground(x, y));
  // Inside the forest: trees of the rows in front hide it, those behind do not.
  for (float& distance_m : overhead.overhead_m) distance_m = 60000.F - 160.F * 120.F;
  const Painting amid = paint(window);
  double before_it = 0.0;
  for (int x = 0; x < 320; ++x) {
    EXPECT_EQ(amid.seen_overhead(x, 60), 1.F) << "all objects there are farther";
    before_it += amid.seen_overhead(x, 180);
    EXPECT_EQ(amid.seen_overhead(x, 180), wood.seen_ground(x, 180));
  }
  EXPECT_LT(before_it / 320.0, 0.6);
  window.mapped = &mapped;

  for (const auto [x, y] : test::cells({0, 100, 320, 160})) mapped.cleared(x, y) = 1;
  const Painting lane = paint(window);
  for (int x = 40; x < 280; ++x)
    EXPECT_EQ(lane.seen_ground(x, 130), 1.F) << "trees below reach up some pixels, and no farther";
  std::size_t elsewhere = 0;
  for (const auto [x, y] : test::cells(320, 60))
    elsewhere += lane.picture(x, y) != wood.picture(x, y) ? 1 : 0;
  EXPECT_EQ(elsewhere, 0U);
}

}  // namespace
}  // namespace belvedere
