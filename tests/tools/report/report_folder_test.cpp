#include "tools/report/report_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text/markup.h"
#include "renderer/image/image_io.h"
#include "tests/files.h"

namespace belvedere::tools {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(ReportFolder, TextIsEscaped) {
  EXPECT_EQ(markup_text("a<b> & \"c\""), "a&lt;b&gt; &amp; &quot;c&quot;");
  EXPECT_EQ(html_row({"a", "<b>c</b>"}), "<tr><td>a</td><td><b>c</b></td></tr>\n");
  EXPECT_EQ(html_row({"a"}, "th"), "<tr><th>a</th></tr>\n");
}

TEST(ReportFolder, AddsPicturesToItsPageAndFolder) {
  const test::Folder folder;
  ReportFolder page(folder / "report");
  page.begin_figure("one", "Heading", "How to read it.");
  page.picture("dot", Grid<glm::vec3>(3, 2, glm::vec3(1.F, 0.F, 0.F)), "a dot");
  page.next_row();
  page.end_figure();
  page.write_page("a & b", "Of <b>", "Lead.", "belvedere x > y");
  const std::string html = test::read_bytes(folder / "report/index.html");
  EXPECT_THAT(html, AllOf(HasSubstr("<title>a &amp; b</title>"), HasSubstr("<h1>Of &lt;b&gt;</h1>"),
                          HasSubstr("<pre>belvedere x &gt; y</pre>"), HasSubstr("<section id=\"one\"><h2>Heading</h2>"),
                          HasSubstr("<img src=\"dot.png\" width=\"3\" height=\"2\""), Not(HasSubstr("http"))));
  EXPECT_EQ(read_picture(folder / "report/dot.png")(2, 1), glm::vec3(1.F, 0.F, 0.F));
}

TEST(ReportFolder, AFileInItsPlaceIsAnOutputError) {
  const test::Folder folder;
  folder.write("report", "in the way");
  EXPECT_EQ(test::error_of([&] { ReportFolder page(folder / "report"); }).kind(), ErrorKind::output);
}

TEST(ReportFolder, ReliefsAreAsLargeAsTheirPictureOrLess) {
  const test::Folder folder;
  ReportFolder page(folder.path());
  ReliefPainter paint(page, {30.0, 30.0});
  paint.whole("all", Grid<float>(1300, 10, 5.F), "all");
  paint.window("part", Grid<float>(50, 40, 5.F), {10, 5, 30, 15}, "part");
  EXPECT_EQ(read_image_info(folder / "all.png").width, 434);  // thirds: 600 are the most
  EXPECT_EQ(read_image_info(folder / "part.png").width, 20);
  EXPECT_EQ(read_image_info(folder / "part.png").height, 10);
}

}  // namespace
}  // namespace belvedere::tools
