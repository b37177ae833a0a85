// The page with sliders: its content, and, if there is a browser, that it computes the same as the
// program.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "terrain/io/raster_io.h"
#include "tests/tools/program.h"
#include "tests/tools/report/browser.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Equalizer : public Program {
 protected:
  // Odd sides, so that no level of the pyramid is even; as large as asked for. In the middle a
  // lake, and south of it a plain.
  void write_dem(int width, int height) const {
    Raster<float> dem = raster(width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double hills = 1500.0 + 500.0 * std::sin(x / 17.0) * std::cos(y / 23.0) +
                             90.0 * std::abs(std::sin((x + 2 * y) / 7.0)) +
                             6.0 * std::sin(x * 2.1) * std::sin(y * 1.7);
        const double shore = std::hypot(x - 0.5 * width, y - 0.3 * height) - 0.07 * height;
        const double plain = std::clamp(
            (std::hypot(x - 0.5 * width, y - 0.75 * height) - 0.1 * height) / 12.0, 0.0, 1.0);
        dem.cells(x, y) =
            static_cast<float>(shore <= 0.0 ? 1300.0
                                            : std::max(1200.0 + (hills - 1200.0) * plain,
                                                       1300.0 + shore - 130.0 * (1.0 - plain)));
      }
    }
    write_raster(path("dem.tif"), dem);
  }
  // Half of the eastern third may change.
  void write_mask(int width, int height) const {
    Raster<float> mask = raster(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        mask.cells(x, y) = static_cast<float>(std::clamp(1.5 - 1.5 * x / width, 0.25, 1.0));
    write_raster(path("drawn.tif"), mask);
  }
  static Raster<float> raster(int width, int height) {
    Raster<float> out;
    out.cells = Grid<float>(width, height);
    out.transform = {600000.0, 5200000.0, 30.0, 30.0};
    out.crs = normalize_crs("EPSG:32632");
    return out;
  }
};

TEST_F(Equalizer, PageHoldsTerrainWeightsAndPresets) {
  write_dem(121, 95);
  const Outcome outcome = run({"generalize", path("dem.tif"), "--global", "1,1,0.7,0.3", "--ridges",
                               "0,0,0.5,1", "--equalizer", path("page.html")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string page = read_bytes(path("page.html"));
  EXPECT_THAT(page, AllOf(HasSubstr("\"width\": 121"), HasSubstr("\"height\": 95"),
                          HasSubstr("\"bands\": 4"), HasSubstr("\"skipped\": 0"),
                          HasSubstr("\"name\": \"figure4\""), HasSubstr("input.type = \"range\""),
                          HasSubstr("id=\"preview\"")));
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
  EXPECT_THAT(page, AllOf(HasSubstr("\"width\": 350"), HasSubstr("\"height\": 151"),
                          HasSubstr("\"skipped\": 1"), HasSubstr("\"close-up\"")));
}

TEST_F(Equalizer, NothingToWriteIsAUsageError) {
  write_dem(40, 40);
  const Outcome outcome = run({"generalize", path("dem.tif"), "--global", "1,0"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("OUT"));
  EXPECT_EQ(run({"generalize", path("dem.tif"), "--equalizer", path("page.html"), "--report",
                 path("report")})
                .status,
            2);
}

TEST_F(Equalizer, BrowserComputesWhatTheProgramDoes) {
  if (!std::filesystem::exists(test::browser)) GTEST_SKIP() << "no browser at " << test::browser;
  write_dem(521, 301);
  write_mask(521, 301);
  // All six arrays, each band another weight, and all masks.
  const Outcome made = run({"generalize",
                            path("dem.tif"),
                            "--equalizer",
                            path("page.html"),
                            "--global",
                            "1.1,0.9,1.6,0.4,0.1",
                            "--ridges",
                            "0,0.2,0.5,0.8,1",
                            "--valleys",
                            "0,-0.3,0.2,0.4,0.5",
                            "--background-global",
                            "1.2,1.3,0.5,0.2,0",
                            "--background-ridges",
                            "0,0.4,0.7,0.9,1.3",
                            "--background-valleys",
                            "0.1,0,0.3,0.2,0.1",
                            "--mask",
                            path("drawn.tif"),
                            "--mask-slope",
                            "2,8",
                            "--automatic-mask"});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(read_bytes(path("page.html")), HasSubstr("\"lakes\": \"A"));
  const std::string page = test::opened_page(path("page.html") + "#self-check", path("profile"));
  EXPECT_THAT(page, HasSubstr("<title>self-check passed: 0.000"));
  // A slider for each weight, and the command line that does the same.
  std::size_t sliders = 0;
  for (std::size_t at = page.find("type=\"range\""); at != std::string::npos;
       at = page.find("type=\"range\"", at + 1))
    ++sliders;
  EXPECT_EQ(sliders, 30U);
  EXPECT_THAT(
      page,
      HasSubstr("generalize dem.tif out.tif --global=1.1,0.9,1.6,0.4,0.1 --ridges=0,0.2,0.5,0.8,1 "
                "--valleys=0,-0.3,0.2,0.4,0.5 --background-global=1.2,1.3,0.5,0.2,0"));
  EXPECT_THAT(page, HasSubstr(" --automatic-mask --mask-slope=2,8 --mask=drawn.tif --viewer "));
}

TEST_F(Equalizer, BrowserFindsBreakLinesAsAskedFor) {
  if (!std::filesystem::exists(test::browser)) GTEST_SKIP() << "no browser at " << test::browser;
  write_dem(321, 201);
  const std::string lines = " --curvature plan --full-curvature 0.4 --blur 1.5 --exponent 0.5";
  ASSERT_EQ(run({"generalize", path("dem.tif"), "--equalizer", path("page.html"), "--preset",
                 "smooth_slopes", "--curvature", "plan", "--full-curvature", "0.4", "--blur", "1.5",
                 "--exponent", "0.5"})
                .status,
            0);
  const std::string page = test::opened_page(path("page.html") + "#self-check", path("profile"));
  EXPECT_THAT(page, HasSubstr("<title>self-check passed: 0.000"));
  EXPECT_THAT(page, HasSubstr(lines + "</pre>"));
}

// Actions of a user on the page, and the resulting display. Pictures are compared in the browser; a
// line reports each step.
constexpr const char* equalizer_clicks = R"(<pre id="clicked"></pre><script>
(async () => {
  const lines = [];
  const say = (line) => { lines.push(line); document.getElementById("clicked").textContent = lines.join("\n"); };
  const drawn = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
  const canvas = document.getElementById("preview");
  const picture = () => canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.join();
  const click = async (text) => {
    [...document.querySelectorAll("button")].find((button) => button.textContent === text).click();
    await drawn();
    return picture();
  };
  const flip = async (name) => { document.getElementById(`switch-${name}`).click(); await drawn(); return picture(); };
  const command = () => document.getElementById("command").textContent;
  const switches = () => [...document.querySelectorAll("#switches input")].filter((box) => box.checked).map((box) => box.id).join();
  let copied = "";
  Object.defineProperty(navigator, "clipboard", { value: { writeText: (text) => { copied = text; return Promise.resolve(); } } });

  const plain = await click("unchanged");
  say(`begins with ${switches()}: ${command()}.`);
  say(`unchanged is the original: ${plain === await click("original / generalized")}`);
  await click("original / generalized");
  const free = await click("figure2");
  say(`figure2 with ${switches()}: ${command()}.`);
  say(`figure2 changes the picture: ${free !== plain}`);
  say(`and the original can be had: ${plain === await click("original / generalized")}`);
  await click("original / generalized");
  say(`lakes change the picture: ${free !== await flip("lakes")}, ${command()}.`);
  say(`and back: ${free === await flip("lakes")}`);
  say(`feet change the picture: ${free !== await flip("foot")}, ${command()}.`);
  await flip("foot");
  const sloped = await flip("slope");
  say(`slopes change the picture: ${free !== sloped}, ${command()}.`);
  await flip("slope");
  say(`figure5 is figure2 with slopes masked: ${sloped === await click("figure5")}, ${switches()}`);
  const slider = document.querySelector("#foreground input[type=range]");
  slider.value = 1.5;
  slider.dispatchEvent(new Event("input"));
  await drawn();
  say(`a slider changes the picture: ${sloped !== picture()}, ${command()}.`);
  await click("Copy");
  say(`copied: ${copied === command()}`);
  const size = () => `${canvas.width} x ${canvas.height}`;
  await click("close-up");
  say(`close-up ${size()}`);
  await click("whole terrain");
  say(`whole ${size()}`);
  say(`unchanged is so after all: ${plain === await click("unchanged")}, ${switches()}.`);
  say("done");
})().catch((error) => { document.getElementById("clicked").textContent += `\nfailed: ${error}`; });
</script></body>)";

TEST_F(Equalizer, ButtonsSwitchesAndSlidersDoWhatTheySay) {
  if (!std::filesystem::exists(test::browser)) GTEST_SKIP() << "no browser at " << test::browser;
  write_dem(521, 301);
  ASSERT_EQ(run({"generalize", path("dem.tif"), "--equalizer", path("page.html"), "--global",
                 "1,1,1,1,1"})
                .status,
            0);
  std::string text = read_bytes(path("page.html"));
  const std::size_t end = text.rfind("</body>");
  ASSERT_NE(end, std::string::npos);
  text.replace(end, 7, equalizer_clicks);
  // A browser without a window may stop drawing frames; timers go on.
  const std::size_t begin = text.find("<body>");
  ASSERT_NE(begin, std::string::npos);
  text.insert(begin + 6,
              "<script>window.requestAnimationFrame = (draw) => setTimeout(draw, 0);</script>");
  const std::string page = test::opened_page(write("clicked.html", text), path("profile"));
  const std::size_t from = page.find("<pre id=\"clicked\">");
  ASSERT_NE(from, std::string::npos);
  const std::string said = page.substr(from, page.find("</pre>", from) - from);
  const std::string figure2 = "belvedere generalize dem.tif out.tif --global=1,1,2,0.25,0";
  for (const std::string& line : {
           std::string("begins with switch-lakes: belvedere generalize dem.tif out.tif "
                       "--global=1,1,1,1,1."),
           std::string("unchanged is the original: true"),
           "figure2 with switch-lakes: " + figure2 + ".",
           std::string("figure2 changes the picture: true"),
           std::string("and the original can be had: true"),
           "lakes change the picture: true, " + figure2 + " --change-lakes.",
           std::string("and back: true"),
           "feet change the picture: true, " + figure2 + " --automatic-mask.",
           "slopes change the picture: true, " + figure2 + " --mask-slope=3,10.",
           std::string("figure5 is figure2 with slopes masked: true, switch-lakes,switch-slope"),
           std::string("a slider changes the picture: true, belvedere generalize dem.tif out.tif "
                       "--global=1.5,1,2,0.25,0 "),
           std::string("copied: true"),
           std::string("close-up 320 x 301"),
           std::string("whole 261 x 151"),
           std::string("unchanged is so after all: true, switch-lakes."),
           std::string("done"),
       }) {
    EXPECT_THAT(said, HasSubstr(line));
  }
}

}  // namespace
}  // namespace belvedere
