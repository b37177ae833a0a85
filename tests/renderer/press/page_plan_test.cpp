#include "renderer/press/page_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

double right(MmBox box) { return box.left + box.width; }
double top(MmBox box) { return box.bottom + box.height; }

TEST(PagePlan, OnePageIsThePicture) {
  const std::vector<PrintPage> pages = plan_pages({300, 120}, {});
  ASSERT_EQ(pages.size(), 1U);
  EXPECT_EQ(pages[0].size_mm, glm::dvec2(300, 120));
  EXPECT_EQ(pages[0].trim.width, 300.0);
}

TEST(PagePlan, BleedIsOfThePicturesEdge) {
  const PrintPage page = plan_pages({300, 120}, {.bleed_mm = 3.0, .marks = true}).at(0);
  EXPECT_DOUBLE_EQ(page.trim.width, 294.0);
  EXPECT_DOUBLE_EQ(page.trim.height, 114.0);
  EXPECT_DOUBLE_EQ(page.trim.left - page.shown.left, 3.0);
  EXPECT_GE(page.shown.left, 7.0) << "room for marks";
  const std::vector<MarkLine> marks = crop_marks(page);
  EXPECT_EQ(marks.size(), 8U);
  for (const MarkLine& mark : marks) {
    const bool level = mark.from_mm.y == mark.to_mm.y;
    const double at = level ? mark.from_mm.y : mark.from_mm.x;
    EXPECT_TRUE(level ? at == page.trim.bottom || at == top(page.trim)
                      : at == page.trim.left || at == right(page.trim));
    for (const glm::dvec2 end : {mark.from_mm, mark.to_mm}) {
      const bool in_picture = end.x > page.shown.left && end.x < right(page.shown) &&
                              end.y > page.shown.bottom && end.y < top(page.shown);
      EXPECT_FALSE(in_picture) << "no mark is printed into the picture";
      EXPECT_GE(std::min(end.x, end.y), 0.0);
    }
  }
}

// Every millimetre of the picture is on a page, neighbours share the overlap, and no page exceeds
// its paper.
TEST(PagePlan, TilesCoverThePicture) {
  for (const glm::dvec2 picture :
       {glm::dvec2(1200, 550), glm::dvec2(277, 190), glm::dvec2(277.1, 100), glm::dvec2(50, 40)}) {
    const PageParameters parameters = {
        .paper_mm = glm::dvec2(297, 210), .margin_mm = 10.0, .overlap_mm = 12.0};
    const std::vector<PrintPage> pages = plan_pages(picture, parameters);
    for (double x = 0.5; x < picture.x; x += 7.0)
      for (double y = 0.5; y < picture.y; y += 7.0)
        EXPECT_TRUE(
            std::any_of(pages.begin(), pages.end(),
                        [&](const PrintPage& page) {
                          const glm::dvec2 at = {page.picture.left + x, page.picture.bottom + y};
                          return at.x >= page.shown.left && at.x <= right(page.shown) &&
                                 at.y >= page.shown.bottom && at.y <= top(page.shown);
                        }))
            << x << " " << y;
    for (const PrintPage& page : pages) {
      EXPECT_GE(page.shown.left, 10.0 - 1e-9);
      EXPECT_LE(right(page.shown), 287.0 + 1e-9);
      EXPECT_GE(page.shown.bottom, 10.0 - 1e-9);
      EXPECT_LE(top(page.shown), 200.0 + 1e-9);
    }
  }
  EXPECT_EQ(plan_pages({277, 190}, {.paper_mm = glm::dvec2(297, 210)}).size(), 1U)
      << "what fits is one page";
  EXPECT_EQ(plan_pages({277.1, 190}, {.paper_mm = glm::dvec2(297, 210)}).size(), 2U);
  const std::vector<PrintPage> two = plan_pages({400, 100}, {.paper_mm = glm::dvec2(297, 210)});
  ASSERT_EQ(two.size(), 2U);
  EXPECT_DOUBLE_EQ(
      right(two[0].shown) - two[0].picture.left - (two[1].shown.left - two[1].picture.left), 10.0)
      << "the overlap";
}

TEST(PagePlan, RefusesWhatCannotBe) {
  const auto refused = [](glm::dvec2 picture, const PageParameters& p) {
    return test::usage_error([&] { plan_pages(picture, p); });
  };
  EXPECT_THAT(refused({6000, 100}, {}), HasSubstr("5080"));
  EXPECT_THAT(refused({300, 100}, {.bleed_mm = 3.0, .paper_mm = glm::dvec2(210, 297)}),
              HasSubstr("glued"));
  EXPECT_THAT(refused({300, 100}, {.paper_mm = glm::dvec2(25, 25)}), HasSubstr("no room"));
  EXPECT_THAT(refused({300, 90}, {.bleed_mm = 45.0}), HasSubstr("half"));
}

using testing::StartsWith;

TEST(VectorPage, IsAPageOfTheSizeAsked) {
  const test::Folder folder;
  const std::string svg = folder.write(
      "a.svg",
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="10mm" height="5mm" viewBox="0 0 100 50">
    <rect x="0" y="0" width="100" height="50" fill="#ff0000"/></svg>)");
  const std::string pdf = svg_as_pdf(svg, {254.0, 127.0});
  EXPECT_THAT(pdf, StartsWith("%PDF"));
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [ 0 0 720 360 ]"));
}

TEST(VectorPage, SaysWhatIsNoSvg) {
  const test::Folder folder;
  const auto refused = [](const std::string& file) {
    return test::input_error([&] { svg_as_pdf(file, {100, 100}); });
  };
  EXPECT_THAT(refused(folder.write("a.svg", "no drawing")), HasSubstr("cannot be read as SVG"));
  EXPECT_THAT(refused(folder / "absent.svg"), HasSubstr("file not found"));
}

}  // namespace
}  // namespace belvedere
