// The page with sliders: what it holds, and, where there is a browser, that it computes what the program does.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "terrain/raster_io.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* browser = "/usr/bin/chromium";

class Equalizer : public Program {
 protected:
  // Odd sides, so that no level of the pyramid is even; as large as asked for.
  void write_dem(int width, int height) const {
    Raster<float> dem;
    dem.cells = Grid<float>(width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        dem.cells(x, y) = static_cast<float>(1500.0 + 500.0 * std::sin(x / 17.0) * std::cos(y / 23.0) +
                                             90.0 * std::abs(std::sin((x + 2 * y) / 7.0)) + 6.0 * std::sin(x * 2.1) * std::sin(y * 1.7));
      }
    }
    dem.transform = {600000.0, 5200000.0, 30.0, 30.0};
    dem.crs = normalize_crs("EPSG:32632");
    write_raster(path("dem.tif"), dem);
  }
  // The page as the browser leaves it.
  std::string opened(const std::string& page) const {
    const std::string command = fmt::format(
        "timeout 60 {} --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking "
        "--disable-component-update --disable-sync --user-data-dir={} --virtual-time-budget=30000 --dump-dom 'file://{}#self-check' "
        "2>/dev/null",
        browser, path("profile"), page);
    std::string out;
    FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return out;
    std::array<char, 65536> buffer{};
    for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) out.append(buffer.data(), n);
    pclose(pipe);
    return out;
  }
};

TEST_F(Equalizer, PageHoldsTerrainWeightsAndPresets) {
  write_dem(121, 95);
  const Outcome outcome =
      run({"generalize", path("dem.tif"), "--global", "1,1,0.7,0.3", "--ridges", "0,0,0.5,1", "--equalizer", path("page.html")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string page = read_bytes(path("page.html"));
  EXPECT_THAT(page, AllOf(HasSubstr("\"width\": 121"), HasSubstr("\"height\": 95"), HasSubstr("\"bands\": 4"), HasSubstr("\"skipped\": 0"),
                          HasSubstr("\"name\": \"figure4\""), HasSubstr("input.type = \"range\""), HasSubstr("id=\"preview\"")));
  // Four bytes a cell, in groups of three bytes that take four letters.
  const std::string key = "\"altitude\": \"";
  const std::size_t from = page.find(key) + key.size();
  EXPECT_EQ(page.find('"', from) - from, (121U * 95U * 4U + 2U) / 3U * 4U);
  EXPECT_EQ(page.find("http"), std::string::npos) << "the page must need no network";
  EXPECT_FALSE(std::filesystem::exists(path("out.tif")));
}

TEST_F(Equalizer, LargeTerrainIsShownAtALevelOfItsPyramidAndCellByCell) {
  write_dem(700, 301);
  ASSERT_EQ(run({"generalize", path("dem.tif"), "--equalizer", path("page.html")}).status, 0);
  const std::string page = read_bytes(path("page.html"));
  EXPECT_THAT(page,
              AllOf(HasSubstr("\"width\": 350"), HasSubstr("\"height\": 151"), HasSubstr("\"skipped\": 1"), HasSubstr("\"close-up\"")));
}

TEST_F(Equalizer, NothingToWriteIsAUsageError) {
  write_dem(40, 40);
  const Outcome outcome = run({"generalize", path("dem.tif"), "--global", "1,0"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("OUT"));
  EXPECT_EQ(run({"generalize", path("dem.tif"), "--equalizer", path("page.html"), "--report", path("report")}).status, 2);
}

TEST_F(Equalizer, BrowserComputesWhatTheProgramDoes) {
  if (!std::filesystem::exists(browser)) GTEST_SKIP() << "no browser at " << browser;
  write_dem(521, 301);
  // All six arrays, each band another weight.
  ASSERT_EQ(run({"generalize", path("dem.tif"), "--equalizer", path("page.html"), "--global", "1.1,0.9,1.6,0.4,0.1", "--ridges",
                 "0,0.2,0.5,0.8,1", "--valleys", "0,-0.3,0.2,0.4,0.5", "--background-global", "1.2,1.3,0.5,0.2,0", "--background-ridges",
                 "0,0.4,0.7,0.9,1.3", "--background-valleys", "0.1,0,0.3,0.2,0.1"})
                .status,
            0);
  const std::string page = opened(path("page.html"));
  EXPECT_THAT(page, HasSubstr("<title>self-check passed: 0.00"));
  // A slider for each weight, and the command line that does the same.
  std::size_t sliders = 0;
  for (std::size_t at = page.find("type=\"range\""); at != std::string::npos; at = page.find("type=\"range\"", at + 1)) ++sliders;
  EXPECT_EQ(sliders, 30U);
  EXPECT_THAT(page, HasSubstr("generalize dem.tif out.tif --global=1.1,0.9,1.6,0.4,0.1 --ridges=0,0.2,0.5,0.8,1 "
                              "--valleys=0,-0.3,0.2,0.4,0.5 --background-global=1.2,1.3,0.5,0.2,0"));
}

}  // namespace
}  // namespace belvedere
