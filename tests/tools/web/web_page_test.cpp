// The page of a panorama: its content, and the effect of pointer, keys, GPX files and links in a
// browser that opens it from the disk.
#include "tools/web/web_page.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "base/error.h"
#include "renderer/image/guidance_io.h"
#include "renderer/image/oiio_file.h"
#include "terrain/io/crs.h"
#include "tests/files.h"
#include "tests/tools/report/browser.h"

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
    for (int y = 100; y < height; ++y)
      for (int x = 0; x < width; ++x) {
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
  EXPECT_THAT(test::message_of(ErrorKind::usage,
                               [&] {
                                 make_page({{folder_ / "summer", "a"}, {folder_ / "small", "b"}});
                               }),
              HasSubstr("1200 × 600"));
  std::filesystem::create_directories(folder_ / "empty");
  EXPECT_THAT(test::message_of(ErrorKind::input,
                               [&] {
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

}  // namespace
}  // namespace belvedere::tools
