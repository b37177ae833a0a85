// `belvedere fetch` as users meet it, against a server of the test's own.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "terrain/io/crs.h"
#include "terrain/io/raster_io.h"
#include "tests/grids.h"
#include "tests/http_server.h"
#include "tests/tools/cli/new/two_bands.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class FetchProgram : public Program {
 protected:
  void SetUp() override {
    if (!test::has_python()) GTEST_SKIP() << "there is no python3 to serve files";
    constexpr int side = 200;
    constexpr double cell = 1.0 / side;
    Raster<float> dem{
        Grid<float>(side, side), {11.0, 48.0, cell, cell}, normalize_crs("EPSG:4326")};
    Raster<std::uint8_t> cover{Grid<std::uint8_t>(side, side), dem.transform, dem.crs};
    for (const auto [x, y] : test::cells(side, side)) {
      dem.cells(x, y) = static_cast<float>(1200.0 + 600.0 * std::sin(0.1 * x) * std::cos(0.08 * y));
      cover.cells(x, y) = dem.cells(x, y) > 1300.0F ? 60 : 10;
    }
    std::filesystem::create_directories(path("served"));
    write_raster(path("served/N47E011.tif"), dem);
    write_raster(path("served/cover_N47E011.tif"), cover);
    const std::string common =
        "cell_m = 500\nmissing = \"error\"\nlicence = \"free with credit\"\n"
        "[grid]\ncrs = \"EPSG:4326\"\ntile_deg = [1, 1]\nrows = 200\ncolumns = [[0, 200]]\ncells = "
        "\"between the lines\"\n";
    heights_ = write("heights.toml",
                     "name = \"Heights\"\nkind = \"elevation\"\nurl = "
                     "\"https://example.org/{lat}{lon}.tif\"\ncredit = \"© Surveyors\"\n" +
                         common);
    cover_ = write("cover.toml",
                   "name = \"Cover\"\nkind = \"land_cover\"\nlegend = \"esa_worldcover\"\nurl = "
                   "\"https://example.org/cover_{lat}{lon}.tif\"\n"
                   "credit = \"© Lookers\"\n" +
                       common);
  }
  Outcome fetch(const std::vector<std::string>& more, const std::string& mirror) const {
    std::vector<std::string> arguments = {"fetch", "--at",           "11.5,47.5", "--size",
                                          "30",    "--source",       heights_,    "--source",
                                          cover_,  "--http-retries", "0"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments, {"BELVEDERE_CACHE=" + path("cache"), "BELVEDERE_MIRROR=" + mirror});
  }
  std::string heights_, cover_;
};

// A position alone is enough for a first picture.
TEST_F(FetchProgram, NewFetchesThePlaceItIsGiven) {
  const test::HttpServer server(path("served"));
  const auto propose = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {
        "new",      "--at", "11.5,47.5",      "--size", "60",    "--source",        heights_,
        "--source", cover_, "--http-retries", "0",      "--out", path("place.toml")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments,
               {"BELVEDERE_CACHE=" + path("cache"), "BELVEDERE_MIRROR=" + server.address("")});
  };
  ASSERT_THAT(propose({}), Ends(0));
  const std::string scene = read_bytes(path("place.toml"));
  EXPECT_THAT(scene,
              AllOf(HasSubstr("file = \"place_data/elevation.tif\""), HasSubstr("© Surveyors"),
                    HasSubstr("© Lookers"), HasSubstr("legend = \"esa_worldcover\""),
                    HasSubstr("title = \"place\"")));
  EXPECT_EQ(run({"check", path("place.toml"), "--set", "synthesis.enabled=false"}).status, 0);
  // The user's own land cover has precedence over fetched data: in a second band, of codes that the
  // fetched one would not have.
  RasterSource served;
  served.path = path("served/N47E011.tif");
  Raster<float> own = read_raster(served);
  for (float& code : own.cells) code = 161.F;
  test::write_two_bands(path("own.tif"), own);
  std::filesystem::remove_all(path("place_data"));
  const Outcome with_own = propose(
      {"--land-cover", path("own.tif"), "--legend", "fbfm40", "--land-cover-band", "2", "--force"});
  ASSERT_EQ(with_own.status, 0) << with_own.err;
  EXPECT_THAT(read_bytes(path("place.toml")),
              AllOf(HasSubstr("file = \"own.tif\"\nband = 2"), HasSubstr("legend = \"fbfm40\""),
                    Not(HasSubstr("© Lookers"))));
  EXPECT_FALSE(std::filesystem::exists(path("place_data/land_cover.tif")));
  EXPECT_EQ(run({"check", path("place.toml"), "--set", "synthesis.enabled=false"}).status, 0);
  // With local files there is nothing to fetch, and without either no data.
  EXPECT_THAT(propose({path("served/N47E011.tif")}), Ends(2, HasSubstr("--at LON,LAT")));
  EXPECT_EQ(run({"new", "--out", path("none.toml")}).status, 2);
}

TEST_F(FetchProgram, WhatItWritesIsReadyForAScene) {
  const test::HttpServer server(path("served"));
  ASSERT_THAT(fetch({"--out", path("out")}, server.address("")),
              Prints(AllOf(HasSubstr("elevation.tif: 61 × 61 cells of 500 m, EPSG:32632"),
                           HasSubstr("© Surveyors"), HasSubstr("© Lookers"))));
  // The tables down to [request], and a view.
  const std::string record = read_bytes(path("out/fetched.toml"));
  const std::string scene =
      write("out/scene.toml",
            "version = 1\n" + record.substr(0, record.find("[request]")) +
                "[camera]\nposition_lonlat = [11.5, 47.3]\nheight_m = 4000\npitch_deg = -20\n"
                "[synthesis]\nenabled = false\n[output]\nwidth = 96\nheight = 64\nsheet_width_mm = "
                "96\nformats = [\"png\"]\n");
  EXPECT_THAT(run({"check", scene}), Ends(0));
  ASSERT_THAT(run({"render", scene, "--out", path("picture")}), Ends(0));
  // Pictures name the source of the data they show.
  EXPECT_THAT(run({"info", path("picture/panorama.png")}).out,
              AllOf(HasSubstr("© Surveyors"), HasSubstr("© Lookers"), HasSubstr("fetched 20")));
  const Outcome again = fetch({"--out", path("again"), "--json"}, server.address(""));
  EXPECT_THAT(again.out,
              AllOf(HasSubstr("\"questions\": 0"), HasSubstr("\"legend\": \"esa_worldcover\""),
                    HasSubstr("\"N47E011\"")));
  EXPECT_EQ(read_bytes(path("again/land_cover.tif")), read_bytes(path("out/land_cover.tif")));
  EXPECT_THAT(run({"cache", "list"}, {"BELVEDERE_CACHE=" + path("cache")}).out,
              AllOf(HasSubstr("fetched file"), HasSubstr("N47E011.tif")));
}

TEST_F(FetchProgram, WithoutLandCoverOnlyHeightsAreAskedFor) {
  const test::HttpServer server(path("served"));
  ASSERT_EQ(fetch({"--out", path("out"), "--no-land-cover"}, server.address("")).status, 0);
  EXPECT_FALSE(std::filesystem::exists(path("out/land_cover.tif")));
  EXPECT_TRUE(std::filesystem::exists(path("out/elevation.tif")));
}

TEST_F(FetchProgram, FailuresHaveTheirStatus) {
  const std::string nobody = "http://127.0.0.1:9/";  // a port without a service
  EXPECT_THAT(
      fetch({"--out", path("out")}, nobody),
      Ends(3, AllOf(HasSubstr("127.0.0.1:9"), HasSubstr("network"), HasSubstr("--mirror"))));
  EXPECT_EQ(fetch({"--out", path("out"), "--size", "much"}, nobody).status, 2);
  EXPECT_EQ(fetch({"--out", path("out"), "--size", "4000"}, nobody).status, 2);
  EXPECT_EQ(fetch({"--out", path("out"), "--source", "none"}, nobody).status, 2);
  EXPECT_EQ(fetch({"--out", path("out")}, "not an address").status, 2);
  EXPECT_EQ(fetch({}, nobody).status, 2);
  write("file", "");
  const test::HttpServer server(path("served"));
  EXPECT_EQ(fetch({"--out", path("file/out")}, server.address("")).status, 4);
}

}  // namespace
}  // namespace belvedere
