// `belvedere layers apply` as users meet it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/land_cover_class.h"
#include "terrain/io/dem.h"
#include "terrain/io/raster_io.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr char two_layers[] = R"(version = 1
name = "two"
ground = { class = "rock", colour = "#804020" }
[[inputs]]
name = "altitude"
low = 0
high = 1200
[[layers]]
name = "grass"
class = "pasture"
colour = "#40c040"
[layers.functions]
altitude = { high = 1500 }
[[layers]]
name = "snow"
class = "snow"
colour = "#ffffff"
[layers.functions]
altitude = { low = 2000 }
)";

class LayersApply : public Program {
 protected:
  // Rises to the east from 100 m, 20 m a column of 100 m; a void at (5, 5).
  std::string write_ramp() const {
    Raster<float> raster{Grid<float>(120, 90), {680000.0, 5260000.0, 100.0, 100.0}, normalize_crs("EPSG:32632")};
    for (int y = 0; y < 90; ++y)
      for (int x = 0; x < 120; ++x) raster.cells(x, y) = 100.F + 20.F * static_cast<float>(x);
    raster.cells(5, 5) = std::nanf("");
    write_raster(path("dem.tif"), raster);
    return path("dem.tif");
  }
  std::string write_layers(const std::string& text = two_layers) const {
    test::write_bytes(path("two.layers.toml"), text);
    return path("two.layers.toml");
  }
  Raster<std::int32_t> codes(const std::string& name, int band = 1) const {
    RasterSource source;
    source.path = path(name);
    source.band = band;
    return read_codes(source);
  }
};

TEST_F(LayersApply, WritesClassesColoursAndShares) {
  const Outcome outcome = run({"layers", "apply", write_layers(), "--dem", write_ramp(), "--out", path("c.tif"), "--colour",
                               path("rgb.tif"), "--shares", path("s.tif")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("pasture"), HasSubstr("rock"), HasSubstr("snow"), HasSubstr("altitude")));
  const Raster<std::int32_t> classes = codes("c.tif");
  ASSERT_EQ(classes.cells.width(), 120);
  EXPECT_EQ(classes.transform, (GeoTransform{680000.0, 5260000.0, 100.0, 100.0}));
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 120; ++x) {
      const auto expected = x <= 70 ? LandCoverClass::pasture : x < 95 ? LandCoverClass::rock : LandCoverClass::snow;
      ASSERT_EQ(classes.cells(x, y), x == 5 && y == 5 ? -1 : static_cast<int>(expected)) << x << ", " << y;
    }
  EXPECT_EQ(codes("rgb.tif", 2).cells(10, 10), 0xc0);
  EXPECT_EQ(codes("rgb.tif", 1).cells(80, 10), 0x80);
  EXPECT_EQ(codes("s.tif", 1).cells(10, 10), 255);
  EXPECT_EQ(codes("s.tif", 2).cells(10, 10), 0);
  EXPECT_EQ(codes("s.tif", 2).cells(110, 10), 255);
  // A legend that a scene can read.
  EXPECT_THAT(read_bytes(path("c.legend.toml")), HasSubstr("10 = { label = "));
}

// More than a tenth of the ground lies above 1200 m, which is all that the layers know.
TEST_F(LayersApply, WarnsWhereTheGroundLiesOutside) {
  const Outcome outcome = run({"layers", "apply", write_layers(), "--dem", write_ramp(), "--out", path("c.tif"), "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("warning: 53 % of the ground has altitude outside 0…1200"));
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("\"outside\""), HasSubstr("\"pasture\""), HasSubstr("they guess there")));
}

TEST_F(LayersApply, NothingIsWrittenWhereSomethingIsWrong) {
  const std::string dem = write_ramp();
  const auto refused = [&](const std::string& text, const std::string& words) {
    const Outcome outcome = run({"layers", "apply", write_layers(text), "--dem", dem, "--out", path("c.tif"), "--shares", path("s.tif")});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, HasSubstr(words));
    for (const char* name : {"c.tif", "s.tif", "c.tmp.tif", "s.tmp.tif", "c.legend.toml"})
      EXPECT_FALSE(std::filesystem::exists(path(name))) << name;
  };
  refused("version = 1\n[[layers]]\nname = \"a\"\nparent = \"a\"\n", "two.layers.toml:4:10: a layer that is its own ancestor: a → a");
  refused("version = 1\n[[inputs]]\nname = \"rain\"\nlow = 0\nhigh = 1\n[[layers]]\nname = \"a\"\n", "input rain");
  refused("version = 1\nlayers = []\n", "no layers");
  const Outcome twice = run({"layers", "apply", write_layers(), "--dem", dem, "--out", path("c.tif"), "--colour", path("c.tif")});
  EXPECT_EQ(twice.status, 2);
  EXPECT_THAT(twice.err, HasSubstr("the same file twice"));
}

TEST_F(LayersApply, ThreadsChangeNoCell) {
  const std::string dem = write_ramp();
  std::string text = two_layers;
  text += "noise = { amplitude = 0.8, bias = 0.5 }\n";
  text.replace(text.find("altitude = { low = 2000 }\n"), 26,
               "altitude = { low = 1500, width = 900 }\n[[layers]]\nname = \"third\"\nclass = \"scree\"\n");
  const std::string layers = write_layers(text);
  ASSERT_EQ(run({"layers", "apply", layers, "--dem", dem, "--out", path("a.tif"), "--threads", "1"}).status, 0);
  ASSERT_EQ(run({"layers", "apply", layers, "--dem", dem, "--out", path("b.tif"), "--threads", "3"}).status, 0);
  EXPECT_EQ(codes("a.tif").cells, codes("b.tif").cells);
  ASSERT_EQ(run({"layers", "apply", layers, "--dem", dem, "--out", path("c.tif"), "--seed", "2"}).status, 0);
  EXPECT_NE(codes("a.tif").cells, codes("c.tif").cells);
}

}  // namespace
}  // namespace belvedere
