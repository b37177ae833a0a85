#include "tools/web/web_page.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text/text_encoding.h"
#include "renderer/image/guidance_io.h"
#include "renderer/image/image_io.h"
#include "renderer/image/oiio_file.h"
#include "renderer/image/srgb.h"
#include "terrain/io/crs.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/tools/report/browser.h"

// The page of a panorama: its content, and the effect of pointer, keys, GPX files and links in a
// browser that opens it from the disk.

namespace belvedere::tools {
namespace {

using testing::HasSubstr;

constexpr int width = 1200;
constexpr int height = 600;
const glm::dvec2 origin(680000.0, 5240000.0);

// Level ground seen from above: ten metres a pixel, north is up; row 400 to 450 hides what lies
// behind 300 to 350.
glm::dvec2 position_of(double x, double y) {
  const double up = y >= 400 && y < 450 ? 1000.0 : 0.0;
  return transform_point("EPSG:32632", "EPSG:4326",
                         origin + glm::dvec2(10.0 * x, 10.0 * (height - y) + 30.0 * up));
}

class WebPage : public testing::Test {
 protected:
  void make_render(const std::string& name, glm::vec3 colour, bool with_guidance = true) {
    const std::string out = folder_ / name;
    std::filesystem::create_directories(out);
    write_png8(out + "/panorama.png", Grid<glm::vec3>(width, height, colour), {});
    if (!with_guidance) return;
    GuidanceBuffers guidance;
    guidance.origin_m = glm::dvec3(origin, 0.0);
    guidance.depth_m = Grid<float>(width, height, std::numeric_limits<float>::infinity());
    guidance.altitude_m = Grid<float>(width, height, 1234.F);
    guidance.position_m = Grid<glm::vec3>(width, height, glm::vec3(0.F));
    guidance.land_cover = Grid<LandCoverClass>(width, height, LandCoverClass::sky);
    for (const auto [x, y] : test::cells({0, 100, width, height})) {
      const float up = y >= 400 && y < 450 ? 30000.F : 0.F;
      guidance.depth_m(x, y) = 20000.F;
      guidance.position_m(x, y) = {10.F * (static_cast<float>(x) + .5F),
                                   10.F * (static_cast<float>(height - y) - .5F) + up, 1234.F};
      guidance.land_cover(x, y) = LandCoverClass::rock;
    }
    write_guidance(out + "/guidance.exr", guidance, {{"belvedere:crs", "EPSG:32632"}});
    test::write_bytes(out + "/labels.geojson", R"({"type": "FeatureCollection", "features": [
      {"type": "Feature", "geometry": null, "properties": {"name": "Big </script> Peak", "kind": "summit", "rank": 1, "outcome": "placed", "altitude_file_m": 2749, "pixel": [600, 300]}},
      {"type": "Feature", "geometry": null, "properties": {"name": "Small Peak", "kind": "summit", "rank": 4, "outcome": "no room", "pixel": [606, 301]}},
      {"type": "Feature", "geometry": null, "properties": {"name": "Unseen", "kind": "summit", "rank": 1, "outcome": "hidden", "pixel": [100, 300]}}]})");
  }
  void make_page(const std::vector<WebPicture>& pictures) {
    Progress progress;
    write_web_page(pictures, folder_ / "page", {.tile_px = 256}, progress);
  }
  // Values of a script when the page has been opened.
  std::string said_by(const std::string& script) {
    std::string text = test::read_bytes(folder_ / "page/index.html");
    const std::size_t end = text.rfind("</body>");
    text.replace(end, 7, R"(<pre id="told" style="position: absolute"></pre><script>
const tell = (text) => { document.getElementById("told").textContent += `${text}.\n`; };
const key = (name) => document.getElementById("picture").dispatchEvent(new KeyboardEvent("keydown", {key: name, cancelable: true}));
const wait = (ms) => new Promise((done) => setTimeout(done, ms));
(async () => { try {
)" + script + R"(
tell("done"); } catch (error) { tell(`failed: ${error.stack}`); } })();
</script></body>)");
    test::write_bytes(folder_ / "page/test.html", text);
    const std::string page = test::opened_page(folder_ / "page/test.html", folder_ / "profile");
    const std::size_t from = page.find("<pre id=\"told\"");
    return from == std::string::npos ? page.substr(0, 3000)
                                     : page.substr(from, page.find("</pre>", from) - from);
  }
  test::Folder folder_;
};

TEST_F(WebPage, IsOneFolderOfFilesThatNameNoServer) {
  make_render("summer", {.2F, .5F, .2F});
  make_page({{folder_ / "summer", "Summer"}});
  for (const char* file : {"index.html", "panorama.js", "tiles/0/0/4_2.jpg", "tiles/0/3/0_0.jpg"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / (std::string("page/") + file))) << file;
  const std::string page = test::read_bytes(folder_ / "page/index.html") +
                           test::read_bytes(folder_ / "page/panorama.js");
  EXPECT_EQ(page.find("http"), std::string::npos);
  EXPECT_EQ(page.find("</script> Peak"), std::string::npos);
}

TEST_F(WebPage, FoldersThatDoNotFitAreRefused) {
  make_render("summer", {.2F, .5F, .2F});
  write_png8(folder_.write("small/x", "") + ".png", Grid<glm::vec3>(10, 10), {});
  std::filesystem::rename(folder_ / "small/x.png", folder_ / "small/panorama.png");
  EXPECT_THAT(test::usage_error([&] {
                make_page({{folder_ / "summer", "a"}, {folder_ / "small", "b"}});
              }),
              HasSubstr("1200 × 600"));
  std::filesystem::create_directories(folder_ / "empty");
  EXPECT_THAT(test::input_error([&] {
                make_page({{folder_ / "empty", "a"}});
              }),
              HasSubstr("belvedere render"));
}

TEST_F(WebPage, TellsShowsAndFindsInABrowser) {
  if (!std::filesystem::exists(test::browser)) GTEST_SKIP() << "no browser at " << test::browser;
  make_render("summer", {.2F, .5F, .2F});
  make_render("winter", {.9F, .9F, .9F}, false);
  make_page({{folder_ / "summer", "Summer"}, {folder_ / "winter", "Winter"}});
  const glm::dvec2 seen = position_of(700.3, 520.7);
  const glm::dvec2 hidden = position_of(700.0, 430.0) - glm::dvec2(0.0, 0.15);
  const std::string points =
      fmt::format("<trkpt lon=\"{:.7f}\" lat=\"{:.7f}\"/><trkpt lon=\"{:.7f}\" lat=\"{:.7f}\"/>",
                  seen.x, seen.y, position_of(760, 540).x, position_of(760, 540).y);
  const std::string said = said_by(fmt::format(R"(
const {{viewer, ground, marks, addWay, wordsAt, ways}} = window.panorama;
tell(`words: ${{wordsAt(600, 300)}}`);
tell(`sky: ${{wordsAt(600, 50)}}, outside: "${{wordsAt(-5, 50)}}"`);
const at = ground.locate({:.7f}, {:.7f});
tell(`located: ${{Math.abs(at[0] - 700.3) < 1.5 && Math.abs(at[1] - 520.7) < 1.5}} ${{at}}`);
tell(`far: ${{ground.locate({:.7f}, {:.7f})}}`);
tell(`names: ${{marks.map((m) => m.name + " " + m.button.hidden).join(", ")}}`);
marks[0].button.click();
tell(`said: ${{document.getElementById("says").textContent}}`);
tell(`went: ${{Math.round(viewer.x)}}, ${{Math.round(viewer.y)}}, ${{viewer.scale > viewer.leastScale() * 1.01}}`);
const before = viewer.x; key("ArrowRight"); tell(`arrow: ${{viewer.x > before}}`);
const size = viewer.scale; key("+"); tell(`plus: ${{viewer.scale > size}}`);
key("0"); tell(`whole: ${{viewer.scale === viewer.leastScale()}}`);
tell(`link: ${{window.panorama.hash()}}`);
location.hash = "#x=.25&y=.5&z=3"; await wait(200);
tell(`gone: ${{Math.round(viewer.x)}} ${{(viewer.scale / viewer.leastScale()).toFixed(1)}}`);
addWay("tour.gpx", `<gpx><trk><trkseg>{}</trkseg></trk></gpx>`);
tell(`way: ${{ways().length}} ${{ways()[0].pieces.map((p) => p.seen + " " + p.points.length).join()}}`);
for (const text of ["<kml/>", "<gpx/>"]) try {{ addWay("x", text); }} catch (error) {{ tell(`refused: ${{error.message}}`); }}
document.getElementById("show-names").click();
tell(`off: ${{marks.every((m) => m.button.hidden)}}`);
viewer.home();
for (let i = 0; i < 40 && ![...viewer.tiles.values()].some((t) => t.complete && t.naturalWidth); ++i) await wait(50);
document.getElementById("second").value = "1"; document.getElementById("second").dispatchEvent(new Event("change"));
viewer.setSwipe(.5); key("]");
tell(`swipe: ${{document.getElementById("second").options[1].text}} ${{viewer.swipe.toFixed(2)}}`);
viewer.draw(); await wait(300);  // a browser without a window paints no further frames of its own
tell(`tiles: ${{[...viewer.tiles].filter(([a, t]) => t.naturalWidth).map(([a]) => a.split("/")[1]).filter((v, i, all) => all.indexOf(v) === i)}}`);
)",
                                               seen.x, seen.y, hidden.x, hidden.y, points));
  for (const char* line : {"° N, 11.",
                           "1234 m · 20 km away · rock.",
                           "sky: sky, outside: \"\".",
                           "located: true",
                           "far: null.",
                           "Peak false, Small Peak true.",
                           "said: Big &lt;/script&gt; Peak: summit, 2749 m · ",
                           "went: 600, 300, true.",
                           "arrow: true.",
                           "plus: true.",
                           "whole: true.",
                           "link: #x=0.50000&amp;y=0.50000&amp;z=1.00.",
                           "gone: 300 3.0.",
                           "way: 1 true 2.",
                           "refused: is no GPX file.",
                           "refused: holds no track and no route.",
                           "off: true.",
                           "swipe: Summer | Winter 0.55.",
                           "tiles: 0,1.",
                           "done."})
    EXPECT_THAT(said, HasSubstr(line));
}

// Without guidance the page shows the picture and states what it lacks.
TEST_F(WebPage, WithoutGuidanceItStillShowsThePicture) {
  if (!std::filesystem::exists(test::browser)) GTEST_SKIP() << "no browser at " << test::browser;
  make_render("bare", {.2F, .5F, .2F}, false);
  make_page({{folder_ / "bare", "Bare"}});
  const std::string said = said_by(R"(
tell(document.getElementById("says").textContent);
tell(`gpx ${document.getElementById("gpx-switch").hidden} names ${document.getElementById("names-switch").hidden}`);
tell(window.panorama.viewer.width);
)");
  for (const char* line : {"without guidance.exr", "gpx true names true.", "1200.", "done."})
    EXPECT_THAT(said, HasSubstr(line));
}

constexpr int sheet_width = 90;
constexpr int sheet_height = 70;  // more than a row of tiles
const glm::dvec3 sheet_origin(680000.0, 5250000.0, 0.0);

// Sky above row 10, below it ground whose numbers are its pixel.
GuidanceBuffers guidance() {
  GuidanceBuffers out;
  out.origin_m = sheet_origin;
  out.depth_m = Grid<float>(sheet_width, sheet_height, std::numeric_limits<float>::infinity());
  out.altitude_m = Grid<float>(sheet_width, sheet_height);
  out.position_m = Grid<glm::vec3>(sheet_width, sheet_height);
  out.land_cover = Grid<LandCoverClass>(sheet_width, sheet_height, LandCoverClass::sky);
  for (const auto [x, y] : test::cells({0, 10, sheet_width, sheet_height})) {
    out.depth_m(x, y) = static_cast<float>(100 * y);
    out.altitude_m(x, y) = static_cast<float>(1000 + x);
    out.position_m(x, y) = {10.F * static_cast<float>(x),
                            10.F * static_cast<float>(sheet_height - y), 0.F};
    out.land_cover(x, y) = x < 40 ? LandCoverClass::forest : LandCoverClass::rock;
  }
  return out;
}

TEST(ReadOut, IsTheMiddleOfSquaresOfPixels) {
  const test::Folder folder;
  write_guidance(folder / "g.exr", guidance(), {{"belvedere:crs", "EPSG:32632"}});
  const ReadOut whole = sample_read_out(folder / "g.exr", sheet_width * sheet_height);
  EXPECT_EQ(whole.step_px, 1);
  EXPECT_EQ(whole.altitude_m(33, 60), 1033.F);
  const ReadOut out = sample_read_out(folder / "g.exr", 800);
  ASSERT_EQ(out.step_px, 3);
  ASSERT_EQ(out.distance_m.width(), 30);
  ASSERT_EQ(out.distance_m.height(), 24);
  for (const auto [column, row] : test::cells(30, 24)) {
    const int x = std::min(3 * column + 1, sheet_width - 1);
    const int y = std::min(3 * row + 1, sheet_height - 1);
    ASSERT_EQ(std::isinf(out.distance_m(column, row)), y < 10);
    if (y < 10) continue;
    ASSERT_EQ(out.distance_m(column, row), static_cast<float>(100 * y));
    ASSERT_EQ(out.altitude_m(column, row), static_cast<float>(1000 + x));
    ASSERT_EQ(out.class_id(column, row),
              static_cast<float>(x < 40 ? LandCoverClass::forest : LandCoverClass::rock));
    const glm::dvec2 position =
        transform_point("EPSG:32632", "EPSG:4326",
                        glm::dvec2(sheet_origin) + 10.0 * glm::dvec2(x, sheet_height - y));
    ASSERT_NEAR(out.longitude_deg(column, row), position.x, 1e-6);
    ASSERT_NEAR(out.latitude_deg(column, row), position.y, 1e-6);
  }
  EXPECT_THAT(read_out_script(out), HasSubstr("\"longitude\""));
}

// The value after a key of a script, from `from` on.
std::string_view behind(std::string_view script, std::string_view key, std::size_t from = 0) {
  const std::string quoted = "\"" + std::string(key) + "\": ";
  const std::size_t at = script.find(quoted, from);
  return at == std::string_view::npos ? std::string_view() : script.substr(at + quoted.size());
}
std::string bytes_behind(std::string_view script, std::string_view key, std::size_t from = 0) {
  const std::string_view text = behind(script, key, from);
  return text.empty() ? "" : base64_bytes(text.substr(1, text.find('"', 1) - 1)).value_or("");
}
int whole_of(const std::string& bytes, std::size_t i) {
  return static_cast<unsigned char>(bytes[2 * i]) +
         256 * static_cast<unsigned char>(bytes[2 * i + 1]);
}

// Data of the page: classes of a byte, the rest as steps of two bytes, low byte first.
TEST(ReadOut, TheScriptsNumbersAreThoseOfThePicture) {
  const test::Folder folder;
  write_guidance(folder / "g.exr", guidance(), {{"belvedere:crs", "EPSG:32632"}});
  const ReadOut out = sample_read_out(folder / "g.exr", 800);
  const std::string script = read_out_script(out);
  const std::string classes = bytes_behind(script, "classes");
  const std::string altitudes = bytes_behind(script, "altitudes");
  const std::string distances = bytes_behind(script, "distances");
  const std::size_t cells = out.distance_m.size();
  ASSERT_EQ(classes.size(), cells);
  ASSERT_EQ(altitudes.size(), 2 * cells);
  ASSERT_EQ(distances.size(), 2 * cells);
  const double altitude_from = std::strtod(behind(script, "altitudeFrom").data(), nullptr);
  const double distance_step = std::strtod(behind(script, "distanceStep").data(), nullptr);
  const std::size_t longitude = script.find("\"longitude\"");
  const std::string degrees = bytes_behind(script, "values", longitude);
  ASSERT_EQ(degrees.size(), 2 * cells);
  const double west = std::strtod(behind(script, "from", longitude).data(), nullptr);
  const double east = std::strtod(behind(script, "to", longitude).data(), nullptr);
  for (std::size_t i = 0; i < cells; ++i) {
    if (std::isinf(out.distance_m[i])) {
      ASSERT_EQ(static_cast<unsigned char>(classes[i]), 255);
      ASSERT_EQ(whole_of(distances, i), 65535);
      continue;
    }
    ASSERT_EQ(static_cast<unsigned char>(classes[i]), static_cast<int>(out.class_id[i]));
    ASSERT_NEAR(altitude_from + whole_of(altitudes, i), out.altitude_m[i], 0.5);
    ASSERT_NEAR(distance_step * whole_of(distances, i), out.distance_m[i], 0.5 * distance_step);
    ASSERT_NEAR(west + (east - west) * whole_of(degrees, i) / 65535.0, out.longitude_deg[i], 1e-6);
  }
}

// Sky takes the place of the origin, which is none of its own, and ground of the first pixel its
// own.
TEST(ReadOut, TheFirstPixelHasItsPlace) {
  const test::Folder folder;
  GuidanceBuffers ground = guidance();
  ground.depth_m(0, 0) = 700.F;
  ground.position_m(0, 0) = {300.F, 400.F, 0.F};
  ground.land_cover(0, 0) = LandCoverClass::rock;
  write_guidance(folder / "g.exr", ground, {{"belvedere:crs", "EPSG:32632"}});
  const ReadOut out = sample_read_out(folder / "g.exr", sheet_width * sheet_height);
  const glm::dvec2 first = transform_point("EPSG:32632", "EPSG:4326",
                                           glm::dvec2(sheet_origin) + glm::dvec2(300.0, 400.0));
  const glm::dvec2 origin = transform_point("EPSG:32632", "EPSG:4326", glm::dvec2(sheet_origin));
  EXPECT_NEAR(out.longitude_deg(0, 0), first.x, 1e-6);
  EXPECT_NEAR(out.latitude_deg(0, 0), first.y, 1e-6);
  EXPECT_NEAR(out.longitude_deg(1, 0), origin.x, 1e-6);
  EXPECT_NEAR(out.latitude_deg(1, 0), origin.y, 1e-6);
}

// The only ground is the last pixel: the script's scale is its longitude.
TEST(ReadOut, TheLastPixelCountsForTheExtent) {
  const test::Folder folder;
  GuidanceBuffers ground = guidance();
  for (float& depth : ground.depth_m) depth = std::numeric_limits<float>::infinity();
  ground.depth_m(sheet_width - 1, sheet_height - 1) = 700.F;
  write_guidance(folder / "g.exr", ground, {{"belvedere:crs", "EPSG:32632"}});
  const ReadOut out = sample_read_out(folder / "g.exr", sheet_width * sheet_height);
  const std::string script = read_out_script(out);
  const std::size_t longitude = script.find("\"longitude\"");
  EXPECT_NEAR(std::strtod(behind(script, "from", longitude).data(), nullptr),
              out.longitude_deg(sheet_width - 1, sheet_height - 1), 1e-6);
}

TEST(ReadOut, WithoutASystemThereAreNoPlaces) {
  const test::Folder folder;
  write_guidance(folder / "g.exr", guidance(), {{"belvedere:crs", "none"}});
  const ReadOut out = sample_read_out(folder / "g.exr", 800);
  EXPECT_FALSE(out.has_places);
  EXPECT_THAT(read_out_script(out), Not(HasSubstr("longitude")));
  GuidanceBuffers bare;
  bare.altitude_m = guidance().altitude_m;
  write_guidance(folder / "bare.exr", bare, {});
  EXPECT_THAT(test::input_error([&] { sample_read_out(folder / "bare.exr", 800); }),
              HasSubstr("no distances"));
}

namespace fs = std::filesystem;

// Smooth, so that JPEG keeps it.
Grid<glm::vec3> slope(int width, int height) {
  return test::grid_of<glm::vec3>(width, height, [&](int x, int y) {
    return glm::vec3{static_cast<float>(x) / static_cast<float>(width),
                     static_cast<float>(y) / static_cast<float>(height), 0.5F};
  });
}

TEST(TilePyramid, TilesOfEveryLevelShowThePicture) {
  const test::Folder folder;
  const Grid<glm::vec3> picture = slope(300, 170);
  write_png8(folder / "a.png", picture, {});
  Progress progress;
  const TilePyramid made =
      write_tile_pyramid(folder / "a.png", folder / "tiles", {64, 95}, progress);
  EXPECT_EQ(made.width, 300);
  EXPECT_EQ(made.height, 170);
  ASSERT_EQ(made.levels, 4) << "300, 150, 75, 38 pixels";
  for (int level = 0; level < made.levels; ++level) {
    const int width = (300 + (1 << level) - 1) >> level;
    const int height = (170 + (1 << level) - 1) >> level;
    int tiles = 0;
    for (int row = 0; row * 64 < height; ++row)
      for (int column = 0; column * 64 < width; ++column, ++tiles) {
        const Grid<glm::vec3> tile =
            read_picture(folder / ("tiles/" + std::to_string(level) + "/" + std::to_string(column) +
                                   "_" + std::to_string(row) + ".jpg"));
        ASSERT_EQ(tile.width(), std::min(64, width - 64 * column));
        ASSERT_EQ(tile.height(), std::min(64, height - 64 * row));
        for (int y = 0; y < tile.height() - 1; y += 9)
          for (int x = 0; x < tile.width() - 1; x += 7) {
            const double at = (64.0 * column + x + 0.5) * (1 << level);
            EXPECT_NEAR(tile(x, y).x, at / 300.0, 0.03) << level << ": " << column << ", " << row;
            EXPECT_NEAR(tile(x, y).z, 0.5, 0.03) << "colours are kept at half the size";
          }
      }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / ("tiles/" + std::to_string(level))),
                            fs::directory_iterator()),
              tiles);
  }
}

// Black and white stripes of a pixel become the grey of half the light, not of half the number.
TEST(TilePyramid, SmallerLevelsAreMeansOfLight) {
  const test::Folder folder;
  Grid<glm::vec3> stripes(128, 128);
  for (const auto [x, y] : test::cells(128, 128)) stripes(x, y) = glm::vec3(x % 2 == 0 ? 0.F : 1.F);
  write_png8(folder / "a.png", stripes, {});
  Progress progress;
  ASSERT_EQ(write_tile_pyramid(folder / "a.png", folder / "tiles", {64, 95}, progress).levels, 2);
  EXPECT_NEAR(read_picture(folder / "tiles/1/0_0.jpg")(30, 30).x, srgb_encoded(0.5), 0.01);
}

TEST(TilePyramid, ThreadsChangeNoByte) {
  const test::Folder folder;
  write_png8(folder / "a.png", slope(300, 170), {});
  Progress progress;
  write_tile_pyramid(folder / "a.png", folder / "two", {64, 88}, progress);
  const ThreadLimit one(1);
  write_tile_pyramid(folder / "a.png", folder / "one", {64, 88}, progress);
  for (const char* tile : {"/0/0_0.jpg", "/0/4_2.jpg", "/2/1_0.jpg"})
    EXPECT_EQ(test::read_bytes(folder / "two" + tile), test::read_bytes(folder / "one" + tile))
        << tile;
}

}  // namespace
}  // namespace belvedere::tools
