// `belvedere new` as users meet it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "terrain/io/raster_io.h"
#include "tests/renderer/compose/synthetic_region.h"
#include "tests/tools/cli/new/two_bands.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class New : public Program {
 protected:
  std::string write_dem(const std::string& name = "my_dem.tif", double side_km = 60.0) const {
    write_raster(path(name), test::synthetic_raster(side_km, [&](double e, double n) {
                   return test::chain(e * 60.0 / side_km, n * 60.0 / side_km);
                 }));
    return path(name);
  }
};

TEST_F(New, WritesASceneThatIsInOrderAndRenders) {
  ASSERT_THAT(run({"new", write_dem(), "--out", path("scene.toml")}),
              Prints(AllOf(HasSubstr("* 1. "), HasSubstr("  2. "), HasSubstr("merit"),
                           HasSubstr("next: belvedere render"))));
  const std::string text = read_bytes(path("scene.toml"));
  EXPECT_THAT(text, AllOf(HasSubstr("file = \"my_dem.tif\""), HasSubstr("title = \"my dem\""),
                          HasSubstr("crs = \"EPSG:32632\"")));
  ASSERT_THAT(run({"check", path("scene.toml"), "--set", "synthesis.enabled=false"}),
              Prints(AllOf(HasSubstr("composition: merit"), HasSubstr("valley floor seen"),
                           Not(HasSubstr("much sky")))));
  const Outcome render = run({"render", path("scene.toml"), "--draft", "--out", path("out"),
                              "--set", "output.width=192", "--set", "output.height=96"});
  EXPECT_EQ(render.status, 0) << render.err;
}

TEST_F(New, IsTheSameForAnyThreadsAndChoosesByNumber) {
  const std::string dem = write_dem();
  ASSERT_EQ(run({"new", dem, "--out", path("one.toml"), "--threads", "1"}, without_cache()).status,
            0);
  ASSERT_EQ(run({"new", dem, "--out", path("two.toml"), "--threads", "3"}).status, 0);
  EXPECT_EQ(read_bytes(path("one.toml")), read_bytes(path("two.toml")));
  ASSERT_EQ(run({"new", dem, "--out", path("other.toml"), "--choose", "2"}).status, 0);
  EXPECT_NE(read_bytes(path("one.toml")), read_bytes(path("other.toml")));
  EXPECT_THAT(run({"new", dem, "--out", path("none.toml"), "--choose", "9"}),
              Ends(2, HasSubstr("--choose")));
}

TEST_F(New, KeepsAFileThatIsThere) {
  const std::string dem = write_dem();
  write("mine.toml", "precious");
  EXPECT_THAT(run({"new", dem, "--out", path("mine.toml")}),
              Ends(4, AllOf(HasSubstr("mine.toml"), HasSubstr("--force"))));
  EXPECT_EQ(read_bytes(path("mine.toml")), "precious");
  EXPECT_EQ(run({"new", dem, "--out", path("mine.toml"), "--force", "--quiet"}).status, 0);
  EXPECT_THAT(read_bytes(path("mine.toml")), HasSubstr("version = 1"));
}

// Coordinates of one system labelled as another: the scene is written, and its climate is that of a
// place far away.
TEST_F(New, APlaceFarFromWhereItsSystemIsUsedIsDoubted) {
  Raster<float> raster =
      test::synthetic_raster(60.0, [](double e, double n) { return test::chain(e, n); });
  EXPECT_THAT(run({"new", write_dem(), "--out", path("right.toml")}).err,
              Not(HasSubstr("coordinate system")));
  raster.transform.origin_x = -1620000.0;
  raster.transform.origin_y = 438000.0;
  write_raster(path("wrong.tif"), raster);
  EXPECT_THAT(run({"new", path("wrong.tif"), "--out", path("wrong.toml")}),
              Ends(0, AllOf(HasSubstr("wrong.tif: lies at 3° N 9° W"), HasSubstr("EPSG:32632"))));
}

TEST_F(New, WishesAreHeldOrRefused) {
  const std::string dem = write_dem();
  // Peaks of the chain lie at N 5230 km: 47.2° N, 10.7° E.
  const Outcome requested = run({"new", dem, "--out", path("a.toml"), "--towards", "north",
                                 "--format", "3:1", "--include", "the peak|10.71,47.2"});
  ASSERT_EQ(requested.status, 0) << requested.err;
  EXPECT_THAT(read_bytes(path("a.toml")), HasSubstr("height = 800"));
  EXPECT_THAT(run({"new", dem, "--out", path("b.toml"), "--include", "Rome|12.5,41.9"}),
              Ends(2, AllOf(HasSubstr("--include"), HasSubstr("outside the data"))));
  EXPECT_EQ(run({"new", dem, "--out", path("c.toml"), "--towards", "up"}).status, 2);
  EXPECT_FALSE(std::filesystem::exists(path("c.toml")));
}

TEST_F(New, RegionsThatCannotDoAreRefusedInWords) {
  const Outcome small = run({"new", write_dem("small.tif", 5.0), "--out", path("a.toml")});
  EXPECT_EQ(small.status, 3);
  EXPECT_THAT(small.err, AllOf(HasSubstr("small.tif"), HasSubstr("8 km")));
  Raster<float> nowhere = test::synthetic_raster(60.0, test::chain);
  nowhere.crs.clear();
  write_raster(path("nowhere.asc"), nowhere);
  EXPECT_THAT(run({"new", path("nowhere.asc"), "--out", path("a.toml")}),
              Ends(3, HasSubstr("--crs")));
  EXPECT_THAT(run({"new", path("nowhere.asc"), "--out", path("a.toml"), "--crs", "EPSG:32632"}),
              Ends(0));
  EXPECT_THAT(read_bytes(path("a.toml")), HasSubstr("# the file does not state it"));
  const Outcome missing = run({"new", path("missing.tif"), "--out", path("b.toml")});
  EXPECT_EQ(missing.status, 3);
  EXPECT_THAT(missing.err, HasSubstr("missing.tif"));
}

// Codes of FBFM40 in the second band of a file, and the same codes in a file without coordinates.
TEST_F(New, LandCoverMayBeABandOfAFileThatSaysLittle) {
  const Raster<float> dem = test::synthetic_raster(60.0, test::chain);
  Raster<float> codes = dem;
  for (float& code : codes.cells) code = code > 1500.F ? 99.F : 161.F;  // bare ground, timber
  write_raster(path("dem.tif"), dem);
  test::write_two_bands(path("bands.tif"), codes);
  codes.crs.clear();
  write_raster(path("codes.asc"), codes);
  const auto propose = [&](std::vector<std::string> cover) {
    std::vector<std::string> arguments = {"new",     path("dem.tif"), "--out", path("a.toml"),
                                          "--force", "--legend",      "fbfm40"};
    arguments.insert(arguments.end(), cover.begin(), cover.end());
    return run(arguments);
  };
  const auto check = [&] {
    return run({"check", path("a.toml"), "--set", "synthesis.enabled=false"});
  };
  ASSERT_EQ(propose({"--land-cover", path("bands.tif"), "--land-cover-band", "2"}).status, 0);
  EXPECT_THAT(read_bytes(path("a.toml")),
              AllOf(HasSubstr("file = \"bands.tif\"\nband = 2"), HasSubstr("legend = \"fbfm40\"")));
  EXPECT_EQ(check().status, 0) << "the codes are those of the legend";
  EXPECT_THAT(propose({"--land-cover", path("bands.tif"), "--land-cover-band", "3"}),
              Ends(3, HasSubstr("has no band 3")));

  EXPECT_THAT(propose({"--land-cover", path("codes.asc")}),
              Ends(3, AllOf(HasSubstr("codes.asc"), HasSubstr("--land-cover-crs"))));
  EXPECT_THAT(propose({"--land-cover", path("codes.asc"), "--land-cover-crs", "EPSG:32611"}),
              Ends(3, HasSubstr("does not overlap")));
  ASSERT_EQ(propose({"--land-cover", path("codes.asc"), "--land-cover-crs", "EPSG:32632",
                     "--land-cover-unknown", "shrub"})
                .status,
            0);
  EXPECT_THAT(read_bytes(path("a.toml")),
              AllOf(HasSubstr("crs = \"EPSG:32632\""), HasSubstr("unknown = \"shrub\"")));
  EXPECT_EQ(check().status, 0);
  EXPECT_EQ(run({"new", path("dem.tif"), "--out", path("b.toml"), "--land-cover-band", "2"}).status,
            2)
      << "of which file?";
}

TEST_F(New, PicturesAreOneNumberedSheet) {
  ASSERT_THAT(run({"new", write_dem(), "--out", path("a.toml"), "--pictures", path("views"),
                   "--proposals", "2", "--json"}),
              Prints(AllOf(HasSubstr("\"proposals\": ["), HasSubstr("proposals.png"),
                           HasSubstr("\"merit\": "))));
  EXPECT_EQ(read_picture(path("views/proposals.png")).width(), 2 * 520 + 3 * 12);
}

TEST_F(New, FilesElsewhereAreNamedByTheirDataFolder) {
  std::filesystem::create_directories(path("data"));
  std::filesystem::create_directories(path("scenes"));
  write_dem("data/far.tif");
  ASSERT_THAT(run({"new", "far.tif", "--data", path("data"), "--out", path("scenes/a.toml")}),
              Prints(HasSubstr("--data " + path("data"))));
  EXPECT_EQ(run({"check", path("scenes/a.toml"), "--data", path("data"), "--set",
                 "synthesis.enabled=false"})
                .status,
            0);
}

}  // namespace
}  // namespace belvedere
