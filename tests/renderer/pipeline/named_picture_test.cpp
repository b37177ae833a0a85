#include "renderer/pipeline/named_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/grid_part.h"
#include "renderer/image/image_io.h"
#include "renderer/pipeline/pipeline.h"
#include "tests/files.h"
#include "tests/renderer/world/small_world.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

const std::vector<std::string> named = {
    "output.width=320", "output.height=200",      "output.formats=[\"png\"]",    "synthesis.enabled=false",
    "labels.summits=6", "labels.in_picture=true", "labels.least_prominence_m=40"};

void render_to(const std::string& folder, std::vector<std::string> more, const SheetRequest& request = {}) {
  std::vector<std::string> settings = named;
  settings.insert(settings.end(), more.begin(), more.end());
  SheetRequest own = request;
  own.channels = GuidanceChoice{std::vector<std::string>{}};
  render(test::small_scene(settings), folder, {0, 0, 32, silent_progress(), no_cache()}, own);
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

// The paper around changes no pixel of the picture, and the classes of the legend are those of the palette.
TEST(NamedPicture, TheMarginLiesAroundThePicture) {
  const test::Folder folder;
  render_to(folder / "bare", {});
  render_to(folder / "framed", {"margin={ title = \"Test\", frame_mm = 2 }"});
  const Grid<glm::vec3> bare = read_picture(folder / "bare/panorama_names.png");
  const Grid<glm::vec3> framed = read_picture(folder / "framed/panorama_names.png");
  EXPECT_TRUE(read_picture(folder / "bare/panorama.png") == read_picture(folder / "framed/panorama.png"));
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

TEST(NamedPicture, TheLegendSurvivesTheWorkFolder) {
  const std::vector<LegendEntry> legend = {{"alpine grass", "#aabbcc"}, {"rock", "#010203"}};
  const std::vector<LegendEntry> again = legend_from_text(legend_to_text(legend));
  ASSERT_EQ(again.size(), 2U);
  EXPECT_EQ(again[0].name, "alpine grass");
  EXPECT_EQ(again[1].colour, "#010203");
}

}  // namespace
}  // namespace belvedere
