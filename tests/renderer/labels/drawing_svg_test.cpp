#include "renderer/labels/drawing_svg.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <glm/geometric.hpp>

#include "renderer/labels/sheet_painter.h"
#include "tests/files.h"
#include "tests/renderer/labels/bent_text.h"

namespace belvedere {
namespace {

using test::bent;
using test::sans;
using testing::HasSubstr;
using testing::Not;

std::string svg_of(const DrawnText& text) { return shapes_svg({text}); }

TEST(DrawingSvg, SaysTextAsTextAndTurnsItsLetters) {
  Drawing drawing{.size_px = {200, 100}, .shapes = {}};
  drawing.shapes.push_back(DrawnText{
      .text = "Inn & Co", .type = {}, .at = {10, 20}, .anchor = 1.0, .colour = "#102030"});
  drawing.shapes.push_back(DrawnText{.text = "Tal",
                                     .type = {},
                                     .colour = "#102030",
                                     .halo = "#ffffff",
                                     .halo_px = 2.0,
                                     .along = {{0, 50}, {100, 40}}});
  drawing.shapes.push_back(DrawnPath{
      .points = {{0, 0}, {1, 0}, {1, 1}}, .closed = true, .fill = "#ff0000", .stroke = {}});
  const std::string svg = drawing_svg(drawing, 400.0);
  EXPECT_THAT(svg, HasSubstr("width=\"400.000mm\" height=\"200.000mm\""));
  EXPECT_THAT(svg, HasSubstr("text-anchor=\"end\">Inn &amp; Co</text>"));
  EXPECT_THAT(svg, HasSubstr("<title>Tal</title>"));
  // cos and sin of a line that falls by 10 in 100.
  EXPECT_THAT(svg, HasSubstr("matrix(0.99504 -0.09950 0.09950 0.99504 "));
  EXPECT_THAT(svg, HasSubstr("stroke-width=\"4.00px\""));
  EXPECT_THAT(svg, HasSubstr("d=\"M0.00 0.00L1.00 0.00L1.00 1.00Z\" fill=\"#ff0000\""));
}

TEST(DrawingSvg, StandsLetterByLetterUnderOneTitle) {
  if (!TextMeasure::has_family(sans)) GTEST_SKIP() << "DejaVu is not installed";
  const std::string svg = svg_of(bent("Inn & Tal"));
  EXPECT_THAT(svg, HasSubstr("<title>Inn &amp; Tal</title>"));
  EXPECT_THAT(svg, HasSubstr(">I</text>"));
  EXPECT_THAT(svg, HasSubstr(">&amp;</text>"));
  EXPECT_THAT(svg, Not(HasSubstr("textPath")));
  EXPECT_THAT(svg, Not(HasSubstr("> </text>"))) << "a space";
}

// Arabic letters join their neighbours.
TEST(DrawingSvg, LettersThatHangTogetherAreOneOutline) {
  if (!TextMeasure::has_family(sans)) GTEST_SKIP() << "DejaVu is not installed";
  const std::string arabic = svg_of(bent("جبل الشيخ"));
  EXPECT_THAT(arabic, HasSubstr("<title>جبل الشيخ</title>"));
  EXPECT_THAT(arabic, HasSubstr("<path d=\"M"));
  EXPECT_THAT(arabic, Not(HasSubstr("<text")));
}

Grid<glm::vec3> drawn_by_librsvg(const test::Folder& folder, const Drawing& drawing) {
  folder.write("a.svg", drawing_svg(drawing, drawing.size_px.x * 25.4 / 96.0));
  const std::string command = "rsvg-convert --background-color=white -o '" + (folder / "a.png") +
                              "' '" + (folder / "a.svg") + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
  const auto file = OIIO::ImageInput::open(folder / "a.png");
  if (!file) return {};
  Grid<glm::vec3> pixels(file->spec().width, file->spec().height);
  std::vector<float> values(pixels.size() * static_cast<std::size_t>(file->spec().nchannels));
  EXPECT_TRUE(file->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, values.data()));
  for (std::size_t i = 0; i < pixels.size(); ++i)
    for (int c = 0; c < 3; ++c)
      pixels[i][c] = values[i * static_cast<std::size_t>(file->spec().nchannels) +
                            static_cast<std::size_t>(c)];
  return pixels;
}

// An independent program shows the same as the picture: straight and curved, spaced, with halos, in
// several scripts.
TEST(DrawingSvg, LibrsvgDrawsWhatThePictureHas) {
  if (!TextMeasure::has_family(sans)) GTEST_SKIP() << "DejaVu is not installed";
  if (std::system("command -v rsvg-convert > /dev/null") != 0)
    GTEST_SKIP() << "needs librsvg's program rsvg-convert (librsvg2-bin)";
  const test::Folder folder;
  for (const DrawnText& text : {bent("Karwendeltal"), bent("INNTAL", 0.6), bent("הר חרמון"),
                                bent("جبل الشيخ"), bent("Ćićarija")}) {
    const Drawing drawing{.size_px = {600, 220}, .shapes = {text}};
    const Grid<glm::vec3> theirs = drawn_by_librsvg(folder, drawing);
    ASSERT_EQ(theirs.width(), 600) << text.text;
    ASSERT_EQ(theirs.height(), 220) << text.text;
    Grid<glm::vec3> ours(600, 220, glm::vec3(1.F));
    SheetPainter(drawing).paint(ours, {0, 0});
    double inked = 0.0;
    double apart = 0.0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
      inked += ours[i] != glm::vec3(1.F) ? 1.0 : 0.0;
      apart += glm::length(ours[i] - theirs[i]) > 0.5F ? 1.0 : 0.0;
    }
    EXPECT_GT(inked, 3000.0) << text.text;
    EXPECT_LT(apart, 0.02 * inked) << text.text;
  }
}

// The first of Hebrew letters stands at the right.
TEST(PlacedText, KnowsWhichLettersStandWhere) {
  const TextMeasure measure;
  if (!TextMeasure::has_family(sans)) GTEST_SKIP() << "DejaVu is not installed";
  const std::vector<PlacedLetter> hebrew = place_letters(bent("הר חרמון"), measure);
  ASSERT_EQ(hebrew.size(), 8U);
  EXPECT_EQ(hebrew.back().letter.text, "ה");
  EXPECT_EQ(hebrew.front().letter.text, "ן");
  EXPECT_GT(hebrew.back().at.x, hebrew.front().at.x + 100.0);
}

TEST(PlacedText, NothingStandsOnALineThatIsTooShort) {
  EXPECT_TRUE(
      place_letters(bent("Ein viel zu langer Name für diese kurze Linie"), TextMeasure()).empty());
}

}  // namespace
}  // namespace belvedere
