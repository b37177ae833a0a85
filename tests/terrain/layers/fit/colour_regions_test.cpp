#include "terrain/layers/fit/colour_regions.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/files.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

TEST(ColourRegions, BoundsPolygonsGreysAndAltitude) {
  const std::vector<ColourRegion> regions = parse_colour_regions(R"(
[[region]]
name = "ice"
class = "glacier"
hue_deg = [165, 215]
saturation = [0.3, 1.01]
lowest_m = 3600
[[region]]
name = "red"
hue_deg = [340, 20]
[[region]]
name = "meadow"
polygon = [[80, 0.2], [160, 0.2], [160, 1], [80, 1]]
[[region]]
name = "rock"
grey = true
)",
                                                                 "regions.toml");
  ASSERT_EQ(regions.size(), 4U);
  EXPECT_EQ(regions[0].of.painted_as, LandCoverClass::glacier);
  const HueSaturation cyan{190.0, 0.6, 0.8, false};
  EXPECT_TRUE(holds(regions[0], cyan, 4000.0));
  EXPECT_FALSE(holds(regions[0], cyan, 3000.0));  // clouds are not snow
  EXPECT_TRUE(holds(regions[1], {350.0, 0.5, 0.5, false}, 0.0));
  EXPECT_TRUE(holds(regions[1], {10.0, 0.5, 0.5, false}, 0.0));
  EXPECT_FALSE(holds(regions[1], {60.0, 0.5, 0.5, false}, 0.0));
  EXPECT_TRUE(holds(regions[2], {120.0, 0.4, 0.5, false}, 0.0));
  EXPECT_FALSE(holds(regions[2], {120.0, 0.02, 0.5, false}, 0.0));
  EXPECT_FALSE(holds(regions[2], {300.0, 0.4, 0.5, false}, 0.0));
  EXPECT_TRUE(holds(regions[3], {300.0, 0.04, 0.5, true}, 0.0));
  EXPECT_FALSE(holds(regions[3], {300.0, 0.4, 0.5, false}, 0.0));
}

TEST(ColourRegions, MayBeShownInAnotherColour) {
  const std::vector<ColourRegion> regions = parse_colour_regions(
      "[[region]]\nname = \"ice\"\nshown = \"#e0e8ff\"\n[[region]]\nname = \"rock\"\n", "x.toml");
  ASSERT_TRUE(regions[0].of.shown.has_value());
  EXPECT_NEAR(regions[0].of.shown->x, 224.0, 0.01);
  EXPECT_NEAR(regions[0].of.shown->z, 255.0, 0.01);
  EXPECT_FALSE(regions[1].of.shown.has_value());
}

// The right half of the plane is painted red, the upper left quarter green; a soft edge between,
// and paper.
TEST(ColourRegions, MayBePaintedOverAPictureOfThePlane) {
  Grid<glm::vec3> plane(100, 100, glm::vec3(1.F));
  for (const auto [x, y] : test::cells(100, 100)) {
    if (x >= 50) plane(x, y) = {0.97F, 0.02F, 0.F};  // a painter's red is not exact
    if (x < 49 && y < 50) plane(x, y) = {0.F, 1.F, 0.F};
  }
  std::string asked;
  const auto read = [&](const std::string& path) {
    asked = path;
    return plane;
  };
  const std::vector<ColourRegion> regions = parse_colour_regions(
      "image = \"plane.png\"\n[[region]]\nname = \"rock\"\ncolour = \"#ff0000\"\n[[region]]\nname "
      "= \"wood\"\ncolour = \"#00ff00\"\n"
      "lowest_m = 500\n",
      "some/folder/regions.toml", read);
  EXPECT_EQ(asked, "some/folder/plane.png");
  ASSERT_EQ(regions.size(), 2U);
  for (const double hue : {350.0, 0.0, 60.0, 85.0}) {
    EXPECT_TRUE(holds(regions[0], {hue, 0.6, 0.5, false}, 1000.0)) << hue;
    EXPECT_FALSE(holds(regions[1], {hue, 0.6, 0.5, false}, 1000.0)) << hue;
  }
  for (const double hue : {100.0, 135.0, 170.0}) {
    EXPECT_FALSE(holds(regions[0], {hue, 0.6, 0.5, false}, 1000.0)) << hue;
    EXPECT_TRUE(holds(regions[1], {hue, 0.6, 0.5, false}, 1000.0)) << hue;
    EXPECT_FALSE(holds(regions[1], {hue, 0.6, 0.5, false}, 400.0)) << "altitude counts as well";
  }
  for (const ColourRegion& region : regions)
    EXPECT_FALSE(holds(region, {220.0, 0.6, 0.5, false}, 1000.0)) << "paper";
  const auto refused = [&](const char* text) -> std::string {
    return std::string(test::error_of([&] { parse_colour_regions(text, "r.toml", read); }).what());
  };
  EXPECT_NE(
      refused("image = \"p.png\"\n[[region]]\nname = \"a\"\ncolour = \"#0000ff\"").find("r.toml:4"),
      std::string::npos);
  EXPECT_NE(refused("[[region]]\nname = \"a\"\ncolour = \"#0000ff\"").find("without a picture"),
            std::string::npos);
}

TEST(ColourRegions, FaultsNameTheirPlace) {
  const auto message = [](const char* text) {
    return std::string(test::error_of([&] { parse_colour_regions(text, "r.toml"); }).what());
  };
  EXPECT_NE(message("[[region]]\nname = \"a\"\nclass = \"glacer\"").find("r.toml:3"),
            std::string::npos);
  EXPECT_NE(message("[[region]]\nname = \"a\"\npolygon = [[1, 1], [2, 1]]").find("2 corners"),
            std::string::npos);
  EXPECT_NE(message("[[region]]\nhue_deg = [1, 2]").find("name"), std::string::npos);
  EXPECT_NE(message("[[region]]\nname = \"a\"\nhue_deg = [1, 400]").find("400"), std::string::npos);
  EXPECT_NE(message("").find("no region"), std::string::npos);
}

}  // namespace
}  // namespace belvedere
