#include "renderer/pipeline/named_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "base/cache/cache.h"
#include "base/grid.h"
#include "renderer/image/image_io.h"
#include "renderer/pipeline/picture_legend.h"
#include "renderer/pipeline/pipeline.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/scenes.h"
#include "tests/shared_cache.h"

// Layers of a whole picture: those over its strokes are roads, lifts, names. Unpacked by Python.

namespace belvedere {
namespace {

using testing::HasSubstr;

const std::vector<std::string> named = {"output.width=320",          "output.height=200",
                                        "output.formats=[\"png\"]",  "synthesis.enabled=false",
                                        "labels.summits=6",          "labels.in_picture=true",
                                        "labels.min_prominence_m=40"};

void render_to(const std::string& folder, std::vector<std::string> more,
               const SheetRequest& request = {}) {
  std::vector<std::string> settings = named;
  settings.insert(settings.end(), more.begin(), more.end());
  SheetRequest own = request;
  own.channels = GuidanceChoice{std::vector<std::string>{}};
  render(test::small_scene(settings), folder, {.cache = test::shared_cache()}, own);
}

TEST(NamedPicture, HasThePanoramaUnderItsNamesAndAPartHasThePixelsOfTheWhole) {
  const test::Folder folder;
  render_to(folder / "whole", {});
  const Grid<glm::vec3> clean = read_picture(folder / "whole/panorama.png");
  const Grid<glm::vec3> names = read_picture(folder / "whole/panorama_names.png");
  ASSERT_EQ(names.width(), 320);
  std::size_t changed = 0;
  for (std::size_t i = 0; i < clean.size(); ++i) changed += clean[i] == names[i] ? 0U : 1U;
  EXPECT_GT(changed, 200U);
  EXPECT_LT(changed, clean.size() / 2);
  const PixelRect part{60, 20, 260, 140};
  SheetRequest request;
  request.part = part;
  render_to(folder / "part", {}, request);
  EXPECT_TRUE(read_picture(folder / "part/panorama_names.png") == part_of(names, part));
}

// The paper around changes no pixel of the picture, and the colours of the legend are those of the
// palette.
TEST(NamedPicture, TheMarginLiesAroundThePicture) {
  const test::Folder folder;
  render_to(folder / "bare", {});
  render_to(folder / "framed", {"margin={ title = \"Test\", frame_mm = 2 }"});
  const Grid<glm::vec3> bare = read_picture(folder / "bare/panorama_names.png");
  const Grid<glm::vec3> framed = read_picture(folder / "framed/panorama_names.png");
  EXPECT_TRUE(read_picture(folder / "bare/panorama.png") ==
              read_picture(folder / "framed/panorama.png"));
  const int frame = (framed.width() - bare.width()) / 2;
  ASSERT_GT(frame, 2);
  EXPECT_GT(framed.height(), bare.height() + 2 * frame);
  // One pixel at each side may have a share of the line around it.
  const PixelRect inner{frame + 1, frame + 1, frame + 319, frame + 199};
  EXPECT_TRUE(part_of(framed, inner) == part_of(bare, {1, 1, 319, 199}));
  EXPECT_EQ(framed(0, 0), framed(1, 0));
  EXPECT_THAT(test::read_bytes(folder / "framed/margin.svg"), HasSubstr(">Test</text>"));
  EXPECT_THAT(test::read_bytes(folder / "framed/margin.svg"), HasSubstr(">forest</text>"));
}

// A margin without names: the picture in it has another name, and does not exist if the scene only
// lists names.
TEST(NamedPicture, AMarginWithoutNamesInThePictureIsPanoramaMargin) {
  const test::Folder folder;
  const auto has = [&](const std::string& file) { return std::filesystem::exists(folder / file); };
  render_to(folder / "alone", {"labels.in_picture=false", "labels.summits=0",
                               "margin={ title = \"Test\", frame_mm = 2 }"});
  EXPECT_TRUE(has("alone/panorama_margin.png") && has("alone/margin.svg"));
  EXPECT_FALSE(has("alone/panorama_names.png") || has("alone/labels.svg"));
  render_to(folder / "listed",
            {"labels.in_picture=false", "margin={ title = \"Test\", frame_mm = 2 }"});
  EXPECT_TRUE(has("listed/panorama_margin.png") && has("listed/labels.svg"));
  EXPECT_FALSE(has("listed/panorama_names.png"));
  EXPECT_TRUE(read_picture(folder / "listed/panorama_margin.png") ==
              read_picture(folder / "alone/panorama_margin.png"))
      << "names that are not asked into the picture";
  SheetRequest request;
  request.part = PixelRect{60, 20, 260, 140};
  render_to(folder / "part",
            {"labels.in_picture=false", "labels.summits=0", "margin={ title = \"Test\" }"},
            request);
  EXPECT_FALSE(has("part/panorama_margin.png"))
      << "a part has no margin: it would be the panorama once more";
}

TEST(NamedPicture, AskingForNamesWithoutAnyIsRefused) {
  EXPECT_THAT(test::usage_error([] { test::small_scene({"labels.in_picture=true"}); }),
              HasSubstr("labels.in_picture is set, but there are no labels"));
}

// Before the picture is made, not after it.
TEST(NamedPicture, WrongNamesAreSaidBeforeAnythingIsPainted) {
  const test::Folder folder;
  folder.write("far.csv", "name,east,north\nA,900000,900000\n");
  const LoadedScene scene = test::small_scene({"labels.points.0.file=\"far.csv\""}, folder.path());
  EXPECT_THAT(test::usage_error(
                  [&] { render(scene, folder / "out", {.cache = test::shared_cache()}, {}); }),
              HasSubstr("none of 1 points lies on the terrain"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out/panorama.png"));
}

// A sheet for print: a part of it shows the names where the whole shows them, at the size of
// letters on that sheet.
TEST(NamedPicture, APartOfALargeSheetHasTheNamesOfTheWhole) {
  const test::Folder folder;
  const std::vector<std::string> large = {"output.width=800", "output.height=500",
                                          "output.sheet_width_mm=80"};
  render_to(folder / "whole", large);
  const Grid<glm::vec3> names = read_picture(folder / "whole/panorama_names.png");
  const Grid<glm::vec3> clean = read_picture(folder / "whole/panorama.png");
  // Around a pixel of a name, so that the part cuts letters.
  std::size_t first = 0;
  while (first < clean.size() && clean[first] == names[first]) ++first;
  ASSERT_LT(first, clean.size());
  const glm::ivec2 at(static_cast<int>(first) % 800, static_cast<int>(first) / 800);
  const PixelRect part =
      intersection({0, 0, 800, 500}, {at.x - 117, at.y - 3, at.x + 201, at.y + 129});
  SheetRequest request;
  request.part = part;
  render_to(folder / "part", large, request);
  const Grid<glm::vec3> cut = read_picture(folder / "part/panorama_names.png");
  EXPECT_TRUE(cut == part_of(names, part));
  EXPECT_FALSE(cut == read_picture(folder / "part/panorama.png")) << "there are names in it";
}

// Drawn roads are in the legend, other kinds of the style are not.
TEST(NamedPicture, TheLegendShowsFeaturesThatAreDrawn) {
  DrawnFeatures drawn;
  drawn.style = load_feature_style("classic");
  drawn.counts = {std::vector<DrawnCount>(drawn.style.kinds.size()),
                  std::vector<DrawnCount>(drawn.style.kinds.size())};
  const auto at = [&](const char* word) {
    return static_cast<std::size_t>(drawn.style.find(word));
  };
  drawn.counts[1][at("main_road")].drawn = 3;
  drawn.counts[0][at("lift")].drawn = 1;
  drawn.counts[0][at("railway")].hidden = 4;
  drawn.counts[0][at("river")].drawn = 4;
  const std::vector<FeatureSwatch> swatches = find_feature_legend(drawn, read_palette("summer"));
  ASSERT_EQ(swatches.size(), 2U) << "railways are hidden, rivers are water";
  EXPECT_EQ(swatches[0].name, "main road");
  EXPECT_EQ(swatches[0].fill, "#fbf2d6");
  EXPECT_EQ(swatches[1].form, SwatchForm::cable);
  drawn.winter = true;
  EXPECT_EQ(find_feature_legend(drawn, read_palette("winter"))[0].fill, "#efe3bf");
  const std::vector<FeatureSwatch> again = swatches_from_text(swatches_to_text(swatches));
  ASSERT_EQ(again.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(again[i].name, swatches[i].name);
    EXPECT_EQ(again[i].form, swatches[i].form);
    EXPECT_EQ(again[i].casing, swatches[i].casing);
    EXPECT_EQ(again[i].width_mm, swatches[i].width_mm);
    EXPECT_EQ(again[i].dash_mm, swatches[i].dash_mm);
    EXPECT_EQ(again[i].has_pylons, swatches[i].has_pylons);
  }
}

TEST(NamedPicture, TheLegendSurvivesTheWorkFolder) {
  const std::vector<LegendEntry> legend = {{"alpine grass", "#aabbcc", {3, 4, 25, 16}},
                                           {"rock", "#010203"}};
  const std::vector<LegendEntry> again = legend_from_text(legend_to_text(legend));
  ASSERT_EQ(again.size(), 2U);
  EXPECT_EQ(again[0].name, "alpine grass");
  EXPECT_EQ(again[0].at, (PixelRect{3, 4, 25, 16}));
  EXPECT_EQ(again[1].colour, "#010203");
}

// A sheet of two classes, whose light differs: the piece lies in its class, where that is as light
// as usual, and the class that is too narrow is shown by half a piece.
TEST(NamedPicture, SwatchesAreTypicalPiecesOfThePicture) {
  PictureOverview overview{.sheet_px = {800, 400},
                           .factor = 4,
                           .classes = Grid<LandCoverClass>(200, 100, LandCoverClass::forest),
                           .colours = Grid<glm::vec3>(200, 100, glm::vec3(.2F, .4F, .2F))};
  for (const auto [x, y] : test::cells(200, 100)) {
    if (x < 40) overview.colours(x, y) = glm::vec3(.8F);
    if (x >= 100 && y >= 50 && y < 54) {
      overview.classes(x, y) = LandCoverClass::rock;
      overview.colours(x, y) = glm::vec3(.6F, .6F, .65F);
    }
  }
  const std::vector<LegendEntry> legend = find_legend(overview, {48.0, 28.0});
  ASSERT_EQ(legend.size(), 2U);
  EXPECT_EQ(legend[0].name, "forest");
  EXPECT_EQ(legend[0].at.width(), 48);
  EXPECT_GE(legend[0].at.x0, 160) << "not in the light";
  EXPECT_TRUE(legend[0].at.y0 >= 216 || legend[0].at.y1 <= 200 || legend[0].at.x1 <= 400)
      << "no rock in it";
  EXPECT_EQ(legend[1].name, "rock");
  EXPECT_EQ(legend[1].at.width(), 24);
  EXPECT_GE(legend[1].at.x0, 400);
  EXPECT_NEAR(.5 * (legend[1].at.y0 + legend[1].at.y1), 208.0, 5.0);
}

TEST(NamedPicture, TheGroundsLuminanceSurvivesTheWorkFolder) {
  const PictureOverview overview{
      .sheet_px = {30, 20}, .classes = {}, .colours = Grid<glm::vec3>(3, 2, glm::vec3(.5F))};
  const Grid<float> again = luminance_from_bytes(luminance_to_bytes(overview));
  ASSERT_EQ(again.width(), 3);
  EXPECT_NEAR(again(2, 1), .2140, .003) << "sRGB's half";
}

namespace fs = std::filesystem;

struct Layer {
  Grid<glm::vec3> colour;
  Grid<float> opacity;
};

class LayerFiles : public testing::Test {
 protected:
  // Every layer's own picture is in an archive at OUT/layers.
  std::string make(const std::string& name, const std::vector<std::string>& more,
                   const SheetRequest& request = {}) const {
    std::vector<std::string> settings = {"output.width=320", "output.height=200",
                                         "output.formats=[\"tif\"]", "synthesis.enabled=false"};
    settings.insert(settings.end(), more.begin(), more.end());
    SheetRequest own = request;
    own.layers = {"ora"};
    own.channels = GuidanceChoice{std::vector<std::string>{}};
    const std::string out = folder_ / name;
    render(test::small_scene(settings, folder_.path()), out, {.cache = test::shared_cache()}, own);
    EXPECT_EQ(std::system(("cd " + out + " && python3 -m zipfile -e panorama.ora layers").c_str()),
              0);
    return out;
  }
  static Layer layer(const std::string& out, const std::string& name) {
    Layer one;
    one.colour = read_picture(out + "/layers/data/" + name + ".png", &one.opacity);
    return one;
  }
  static double max_off(const Grid<glm::vec3>& a, const Grid<glm::vec3>& b) {
    double off = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
      for (int c = 0; c < 3; ++c)
        off = std::max(off, static_cast<double>(std::abs(a[i][c] - b[i][c])));
    return off;
  }
  test::Folder folder_;
};

TEST_F(LayerFiles, NamesAreAHiddenLayerThatMakesThePictureWithNames) {
  const std::vector<std::string> named = {"labels.summits=6", "labels.in_picture=true",
                                          "labels.min_prominence_m=40"};
  const std::string out = make("whole", named);
  EXPECT_NE(
      test::read_bytes(out + "/layers/stack.xml")
          .find("src=\"data/names.png\" x=\"0\" y=\"0\" opacity=\"1.0\" visibility=\"hidden\""),
      std::string::npos);
  const Layer names = layer(out, "names");
  Grid<glm::vec3> picture = read_picture(out + "/panorama.tif");
  const Grid<glm::vec3> clean = picture;
  for (std::size_t i = 0; i < picture.size(); ++i)
    picture[i] += names.opacity[i] * (names.colour[i] - picture[i]);
  EXPECT_GT(max_off(picture, clean), 0.3);
  EXPECT_LT(max_off(picture, read_picture(out + "/panorama_names.tif")), 1e-3);
  const PixelRect part{60, 20, 260, 140};
  SheetRequest request;
  request.part = part;
  const Layer cut = layer(make("part", named, request), "names");
  EXPECT_TRUE(cut.opacity == part_of(names.opacity, part));
  EXPECT_TRUE(cut.colour == part_of(names.colour, part));
}

TEST_F(LayerFiles, ASceneWithoutRoadsAndNamesHasNoLayersOfThem) {
  const std::string out = make("bare", {});
  EXPECT_TRUE(fs::exists(out + "/layers/data/ground.png"));
  EXPECT_FALSE(fs::exists(out + "/layers/data/features.png"));
  EXPECT_FALSE(fs::exists(out + "/layers/data/names.png"));
  const std::string lost =
      make("lost", {"labels.points.0={ file = \"none.csv\", optional = true }"});
  EXPECT_FALSE(fs::exists(lost + "/layers/data/names.png")) << "nothing is there to name";
}

}  // namespace
}  // namespace belvedere
