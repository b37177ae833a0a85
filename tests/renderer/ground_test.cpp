#include "renderer/ground.h"

#include <gtest/gtest.h>

#include "terrain/raster_io.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

// The rules see glacier east of 501 km, snow north of 5199 km, which wins, and forest elsewhere. The raster tells three columns of classes
// apart, on cells of its own.
class RefinedLandCover : public testing::Test {
 protected:
  static constexpr double east = 500000.0;
  static constexpr double north = 5200000.0;

  static Dem level() { return make_dem({Grid<float>(20, 20, 1000.F), {east, north, 100.0, 100.0}, normalize_crs("EPSG:32632")}); }
  LandCover refined(const std::string& refine) const {
    folder_.write("rules.toml",
                  "version = 1\nname = \"two\"\n[parameters]\nspeck_cells = 0\n[[layers]]\nclass = \"forest\"\nwhen = \"1\"\n"
                  "[[layers]]\nclass = \"glacier\"\nwhen = \"east > 501000\"\n[[layers]]\nclass = \"snow\"\nwhen = \"north > 5199000\"\n");
    Raster<float> codes{Grid<float>(50, 50), {east, north, 40.0, 40.0}, normalize_crs("EPSG:32632")};
    for (int y = 0; y < 50; ++y)
      for (int x = 0; x < 50; ++x) codes.cells(x, y) = code(x);
    write_raster(folder_ / "cover.tif", codes);
    const LoadedScene scene = parse_scene("version = 1\n[land_cover]\nlegend = \"esa_worldcover\"\nrules = \"rules.toml\"\n" + refine +
                                              "[[land_cover.sources]]\nfile = \"cover.tif\"\n",
                                          "s.toml", folder_.path(), {});
    return make_scene_land_cover(scene, level(), silent_progress());
  }
  // ESA WorldCover: grassland, bare ground, trees, in stripes one cell wide.
  static float code(int x) { return x % 3 == 0 ? 30.F : x % 3 == 1 ? 60.F : 10.F; }
  static LandCoverClass as_read(int x) { return x % 3 == 0 ? pasture : x % 3 == 1 ? rock : forest; }

  test::Folder folder_;
};

TEST_F(RefinedLandCover, ChangesTheNamedClassWhereTheRulesSeeTheOther) {
  const LandCover cover = refined("refine = { glacier = \"rock\", snow = \"pasture\" }\n");
  ASSERT_EQ(cover.classes.cells.width(), 50);
  int glaciers = 0;
  int snows = 0;
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 50; ++x) {
      // The rules stand on the DEM's cells of 100 m: the border lies between columns 9 and 10, and rows 9 and 10; cells of 40 m have
      // their centres at (n + 0.5) · 0.4 of those.
      const bool east_of = (x + 0.5) * 0.4 > 10.0;
      const bool north_of = (y + 0.5) * 0.4 < 10.0;
      const LandCoverClass read = as_read(x);
      const LandCoverClass wanted = read == rock && east_of && !north_of ? glacier : read == pasture && north_of ? snow : read;
      ASSERT_EQ(cover.classes.cells(x, y), wanted) << x << ", " << y;
      glaciers += wanted == glacier ? 1 : 0;
      snows += wanted == snow ? 1 : 0;
    }
  EXPECT_GT(glaciers, 100);
  EXPECT_GT(snows, 200);
}

TEST_F(RefinedLandCover, WithoutTheKeyTheRasterHoldsAlone) {
  const LandCover cover = refined("");
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 50; ++x) ASSERT_EQ(cover.classes.cells(x, y), as_read(x));
}

}  // namespace
}  // namespace belvedere
