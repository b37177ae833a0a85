#include "renderer/world/ground_texture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "base/cache/cache.h"
#include "base/error.h"
#include "base/parallel.h"
#include "renderer/world/scene_land_cover.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/texture/composite/composite_crops.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

// Green paints pasture, grey stripes rock; quickly, without polish.
const CompositeModel& pasture_and_rock() {
  static const CompositeModel model = [] {
    CompositeModel made = test::two_textures_model();
    made.labels[0].name = std::to_string(static_cast<int>(pasture));
    made.labels[1].name = std::to_string(static_cast<int>(rock));
    for (CompositeLabel& label : made.labels) label.model.polish = false;
    return made;
  }();
  return model;
}

// Cells of 100 m that cross a line between tiles (of 5120 m): pasture, a square of rock, and water
// in the south.
constexpr double east = 99 * 5120.0 - 1000.0;
constexpr double north = 1015 * 5120.0 - 500.0;
LandCover ground() {
  LandCover cover{{Grid<LandCoverClass>(20, 16, pasture), {east, north, 100.0, 100.0}, "crs"}};
  for (const auto [x, y] : test::cells({3, 4, 9, 10})) cover.classes.cells(x, y) = rock;
  for (const auto [x, y] : test::cells({0, 13, 20, 16})) cover.classes.cells(x, y) = water;
  return cover;
}
Raster<GroundColour> paint(const RasterFrame& frame) {
  const CompositeModel& model = pasture_and_rock();
  GroundTextureParameters quick;
  quick.make.rounds = 2;
  return paint_ground_texture(model, classes_of_labels(model, "x"), ground(), frame, quick);
}

TEST(GroundTexture, AnyRectangleHasTheTexelsOfTheWhole) {
  const Raster<GroundColour> whole = paint({{east, north, 100.0, 100.0}, 20, 16, "crs"});
  ASSERT_EQ(whole.cells.width(), 200);
  ASSERT_EQ(whole.cells.height(), 160);
  EXPECT_EQ(whole.transform, (GeoTransform{east, north, 10.0, 10.0}));
  EXPECT_EQ(whole.crs, "crs");
  // Each class in its texture, away from borders; what no label paints stays unknown.
  int strangers = 0;
  int greys = 0;
  const LandCover cover = ground();
  for (const auto [x, y] : test::cells(whole.cells)) {
    const GroundColour& c = whole.cells(x, y);
    const glm::dvec2 position = whole.transform.to_crs(x, y);
    const LandCoverClass id = cover.cell_at(position.x, position.y);
    ASSERT_EQ(c.a, id == water ? 0 : 255) << x << ", " << y;
    if (id == water) continue;
    bool border = false;
    for (const double d : {-60.0, 60.0})
      border = border || cover.cell_at(position.x + d, position.y) != id ||
               cover.cell_at(position.x, position.y + d) != id;
    if (border) continue;
    greys += id == rock ? 1 : 0;
    strangers += test::is_green({c.r, c.g, c.b}) != (id == pasture) ? 1 : 0;
  }
  EXPECT_GT(greys, 1500);
  EXPECT_LT(strangers, 600);
  // A part on cells of its own, one thread.
  const ThreadLimit one(1);
  const Raster<GroundColour> part =
      paint({{east + 300.0, north - 440.0, 30.0, 30.0}, 20, 20, "crs"});
  ASSERT_EQ(part.cells.width(), 60);
  EXPECT_EQ(part.cells, part_of(whole.cells, {30, 44, 90, 104}));
}

TEST(GroundTexture, OtherLabelsAndTooManyTexelsAreRefused) {
  const Error label =
      test::error_of([] { classes_of_labels(test::two_textures_model(), "two.composite"); });
  EXPECT_EQ(label.kind(), ErrorKind::usage);
  EXPECT_THAT(label.what(), ::testing::AllOf(::testing::HasSubstr("two.composite"),
                                             ::testing::HasSubstr("#008000")));
  EXPECT_EQ(test::error_of([] {
              paint({{east, north, 1e4, 1e4}, 60, 60, "crs"});
            }).kind(),
            ErrorKind::limit);
}

// As the colours of a scene's ground, also from the cache; a pixel is a cell unless it says more.
TEST(GroundTexture, IsTheColourOfAScenesGround) {
  const test::Folder folder;
  folder.write("rules.toml",
               "version = 1\nname = \"one\"\n[parameters]\nspeck_cells = 0\n[[layers]]\nclass = "
               "\"pasture\"\nwhen = \"1\"\n");
  folder.write("two.composite", composite_text(pasture_and_rock()));
  const Dem dem = make_dem({Grid<float>(20, 12, 1000.F),
                            {500000.0, 5200000.0, 100.0, 100.0},
                            normalize_crs("EPSG:32632")});
  const LoadedScene scene = parse_scene(
      "version = 1\n[land_cover]\nrules = \"rules.toml\"\ncolours = \"texture\"\ntexture = "
      "\"two.composite\"\n",
      "s.toml", folder.path(), {});
  const Cache cache({.folder = folder / "cache", .limit_bytes = 0});
  const Raster<GroundColour> made =
      make_scene_land_cover(scene, dem, silent_progress(), cache).colours;
  ASSERT_EQ(made.cells.width(), 20);
  ASSERT_EQ(made.cells.height(), 12);
  EXPECT_EQ(made.transform, dem.transform);
  EXPECT_EQ(made.crs, dem.crs);
  int green = 0;
  for (const GroundColour& c : made.cells) {
    ASSERT_EQ(c.a, 255);
    green += test::is_green({c.r, c.g, c.b}) ? 1 : 0;
  }
  EXPECT_GT(green, 230);
  const Raster<GroundColour> again =
      make_scene_land_cover(scene, dem, silent_progress(), cache).colours;
  EXPECT_EQ(again.cells, made.cells);
  EXPECT_EQ(again.transform, made.transform);
}

}  // namespace
}  // namespace belvedere
