// The report of the generalize command, as users meet it.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

#include "renderer/image/image_io.h"
#include "terrain/io/raster_io.h"
#include "tests/grids.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

// A row of mountains with rough slopes beside a plain.
Raster<float> mountains() {
  Raster<float> dem;
  dem.cells = Grid<float>(260, 180);
  for (const auto [x, y] : test::cells(260, 180)) {
    const double ridge = 500.0 * std::abs(std::sin(x / 21.0)) * std::abs(std::sin((x + y) / 37.0)) +
                         14.0 * std::sin(x * 1.9) * std::cos(y * 2.3);
    dem.cells(x, y) =
        static_cast<float>(600.0 + (x > 60 ? ridge * std::min((x - 60) / 20.0, 1.0) : 0.0));
  }
  dem.transform = {600000.0, 5200000.0, 30.0, 30.0};
  dem.crs = normalize_crs("EPSG:32632");
  return dem;
}

class GeneralizeReport : public Program {
 protected:
  void SetUp() override { write_raster(path("dem.tif"), mountains()); }
};

TEST_F(GeneralizeReport, ShowsEveryFigureAndItsPicturesLieBesideThePage) {
  const Outcome outcome = run({"generalize", path("dem.tif"), path("out.tif"), "--global",
                               "1,1,2,0.25,0", "--report", path("report")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string page = read_bytes(path("report/index.html"));
  for (const char* id : {"overview", "closeup", "energy", "ridges", "pits", "change", "figure1",
                         "figure2", "figure3", "figure4", "figure5"})
    EXPECT_THAT(page, HasSubstr(fmt::format("\"id\": \"{}\"", id)));
  EXPECT_THAT(page, HasSubstr("belvedere generalize dem.tif out.tif --global 1,1,2,0.25,0"));
  EXPECT_EQ(page.find("http"), std::string::npos) << "the page must need no network";
  EXPECT_EQ(page.find("nan"), std::string::npos);
  const std::regex image("\"src\": \"([^\"]+)\",\\s+\"width\": ([0-9]+),\\s+\"height\": ([0-9]+)");
  std::set<std::string> shown;
  for (std::sregex_iterator i(page.begin(), page.end(), image); i != std::sregex_iterator(); ++i) {
    const ImageInfo info = read_image_info(path("report/" + (*i)[1].str()));
    EXPECT_EQ(info.width, std::stoi((*i)[2].str()));
    EXPECT_EQ(info.height, std::stoi((*i)[3].str()));
    EXPECT_LE(info.width, 900);
    shown.insert((*i)[1].str());
  }
  EXPECT_GE(shown.size(), 25U);
  std::set<std::string> written;
  for (const auto& entry : fs::directory_iterator(path("report")))
    if (entry.path().extension() == ".png") written.insert(entry.path().filename().string());
  EXPECT_EQ(written, shown);
}

TEST_F(GeneralizeReport, NumbersAreAboutTheResult) {
  // Unit weights change nothing, and the report must show it.
  ASSERT_EQ(run({"generalize", path("dem.tif"), path("same.tif"), "--global", "1,1,1", "--report",
                 path("same")})
                .status,
            0);
  const std::string same = read_bytes(path("same/report.json"));
  EXPECT_THAT(same, AllOf(HasSubstr("\"change_largest_m\": 0,"),
                          HasSubstr("\"ridge_curvature_kept\": 1,"), HasSubstr("\"bands\": 3")));
  EXPECT_THAT(same, HasSubstr("\"lowered_million_m3\": 0"));
  // Without its finest band the terrain is smoother.
  ASSERT_EQ(run({"generalize", path("dem.tif"), path("less.tif"), "--global", "1,1,0", "--report",
                 path("less")})
                .status,
            0);
  const std::string less = read_bytes(path("less/report.json"));
  std::smatch kept;
  ASSERT_TRUE(std::regex_search(less, kept, std::regex("\"ridge_curvature_kept\": ([0-9.]+)")));
  EXPECT_LT(std::stod(kept[1].str()), 0.95);
  EXPECT_EQ(less.find("\"change_largest_m\": 0,"), std::string::npos);
}

// The chart and the table below it agree: a group per range of distance, a bar per band.
TEST_F(GeneralizeReport, BarsAreTheTablesShares) {
  ASSERT_EQ(run({"generalize", path("dem.tif"), path("out.tif"), "--preset", "smooth_slopes",
                 "--report", path("report")})
                .status,
            0);
  const std::string json = read_bytes(path("report/report.json"));
  const std::size_t chart = json.find("\"bars\": {");
  const std::size_t table = json.find("\"table\": {", chart);
  const std::size_t end = json.find("\"small\":", table);
  const auto all = [&](std::size_t from, std::size_t to, const std::string& pattern) {
    const std::string part = json.substr(from, to - from);
    const std::regex wanted(pattern);
    std::vector<std::string> found;
    for (std::sregex_iterator i(part.begin(), part.end(), wanted); i != std::sregex_iterator(); ++i)
      found.push_back((*i)[1].str());
    return found;
  };
  EXPECT_EQ(all(chart, table, "\"name\": \"([^\"]+)\""),
            (std::vector<std::string>{"nearest", "2 of 5", "3 of 5", "4 of 5", "farthest"}));
  const std::vector<std::string> bars = all(chart, table, "\n +([0-9.e-]+),?(?=\n)");
  EXPECT_EQ(bars.size(), 30U);
  EXPECT_EQ(bars, all(table, end, "\"value\": ([0-9.e-]+)"));
}

// The command line in the report makes the same altitudes, for every option that affects them.
TEST_F(GeneralizeReport, ItsCommandMakesTheSameTerrain) {
  const std::vector<std::vector<std::string>> asked = {
      {"--preset", "smooth_slopes", "--curvature", "plan", "--full-curvature", "0.4", "--blur",
       "2.5", "--exponent", "0.35"},
      {"--preset", "panorama", "--viewer", "500000.5,4990000", "--change-lakes", "--exponent",
       "0.7"},
      {"--global", "1,1.7,2,0.3", "--valleys", "0,0.2,0.4,1.1", "--mask-slope", "2.5,9",
       "--automatic-mask", "--widen-valleys", "60"}};
  for (const std::vector<std::string>& options : asked) {
    std::vector<std::string> arguments = {"generalize", path("dem.tif"), path("out.tif"),
                                          "--report", path("report")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    ASSERT_EQ(run(arguments).status, 0);
    const std::string first = read_bytes(path("out.tif"));
    const std::string json = read_bytes(path("report/report.json"));
    std::smatch line;
    ASSERT_TRUE(std::regex_search(json, line, std::regex("\"command\": \"belvedere ([^\"]*)\"")));
    std::istringstream words(line[1].str());
    arguments.clear();
    for (std::string word; words >> word;)
      arguments.push_back(word == "dem.tif" || word == "out.tif" ? path(word) : word);
    fs::remove(path("out.tif"));
    ASSERT_THAT(run(arguments), Ends(0));
    EXPECT_TRUE(read_bytes(path("out.tif")) == first) << line[1].str();
  }
}

TEST_F(GeneralizeReport, HasTheSameBytesForAnyNumberOfThreads) {
  for (const char* threads : {"1", "2"})
    ASSERT_EQ(run({"generalize", path("dem.tif"), path("out.tif"), "--preset", "bold_ridges",
                   "--report", path(threads), "--threads", threads})
                  .status,
              0);
  for (const auto& entry : fs::directory_iterator(path("1")))
    EXPECT_EQ(read_bytes(entry.path().string()),
              read_bytes(path("2/" + entry.path().filename().string())))
        << entry.path();
}

TEST_F(GeneralizeReport, AFolderThatCannotBeMadeIsFoundBeforeTheWork) {
  const std::string file = write("file", "no folder");
  const Outcome outcome = run({"generalize", path("dem.tif"), path("out.tif"), "--global", "1,0",
                               "--report", file + "/report"});
  EXPECT_NE(outcome.status, 0);
  EXPECT_FALSE(fs::exists(path("out.tif")));
}

// The options that other stages take part by, into both formats.
TEST_F(GeneralizeReport, OperatorsAndProductsGoAlong) {
  for (const char* extension : {"tif", "asc"}) {
    const std::string out = path(fmt::format("result.{}", extension));
    ASSERT_THAT(run({"generalize", path("dem.tif"), out, "--global", "1,1,0.5,0", "--destripe",
                     "--line-integral", "--widen-valleys", "60", "--hillshade", path("relief.tif"),
                     "--contours", path("lines.geojson"), "--contour-interval", "50"}),
                Ends(0));
    RasterSource source;
    source.path = out;
    source.crs = "EPSG:32632";
    const Raster<float> result = read_raster(source);
    EXPECT_EQ(result.cells.width(), 260);
    EXPECT_EQ(result.transform, mountains().transform);
    RasterSource relief;
    relief.path = path("relief.tif");
    EXPECT_EQ(read_raster_info(relief).width, 260);
    EXPECT_THAT(read_bytes(path("lines.geojson")), HasSubstr("LineString"));
  }
}

}  // namespace
}  // namespace belvedere
