// `belvedere layers picture` as users meet it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "terrain/io/raster_io.h"
#include "tests/grids.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::HasSubstr;

class LayersPicture : public Program {
 protected:
  void SetUp() override {
    Raster<float> raster{
        Grid<float>(60, 40), {680000.0, 5260000.0, 100.0, 100.0}, normalize_crs("EPSG:32632")};
    for (const auto [x, y] : test::cells(60, 40))
      raster.cells(x, y) = 100.F + 20.F * static_cast<float>(x);
    write_raster(path("dem.tif"), raster);
    test::write_bytes(
        path("one.layers.toml"),
        "version = 1\nname = \"one\"\nground = { class = \"rock\", colour = \"#804020\" }\n"
        "[[inputs]]\nname = \"altitude\"\nlow = 0\nhigh = 1200\n"
        "[[layers]]\nname = \"snow\"\nclass = \"snow\"\ncolour = "
        "\"#ffffff\"\n[layers.functions]\naltitude = { low = 2000 }\n");
  }
  Outcome draw(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"layers",       "picture",       path("one.layers.toml"),
                                          "--dem",        path("dem.tif"), "--out",
                                          path("map.tif")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
};

TEST_F(LayersPicture, LiesOnTheGroundOfTheDem) {
  ASSERT_THAT(draw({"--finer", "3", "--light-from", "90"}),
              Prints(HasSubstr("180×120 pixels of 33.3333 m")));
  RasterSource source;
  source.path = path("map.tif");
  const RasterInfo info = read_raster_info(source);
  EXPECT_EQ(info.width, 180);
  EXPECT_EQ(info.height, 120);
  EXPECT_NEAR(info.transform.cell_x, 100.0 / 3.0, 1e-9);
  EXPECT_EQ(info.transform.origin_x, 680000.0);
}

TEST_F(LayersPicture, WrongNumbersAreRefusedBeforeAnythingIsWritten) {
  EXPECT_THAT(draw({"--finer", "99"}), Ends(2, HasSubstr("1 to 16")));
  EXPECT_FALSE(std::filesystem::exists(path("map.tif")));
}

}  // namespace
}  // namespace belvedere
