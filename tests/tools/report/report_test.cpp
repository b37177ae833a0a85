#include "tools/report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include "renderer/image/image_io.h"
#include "tests/files.h"
#include "tests/tools/report/browser.h"

namespace belvedere::tools {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double not_finite = std::numeric_limits<double>::infinity();

TEST(Report, TablesKeepAllDigitsAndWhatIsNotKnownIsNull) {
  const Json table = ReportTable({{"name", "class"}, {"share", "share of all", ".1%", "of pixels"}})
                         .row("a<b>", 1.0 / 3.0)
                         .row(std::string("rest"), not_finite)
                         .row("good?", evaluated(2.5, false))
                         .json("Classes");
  const std::string text = table.str();
  EXPECT_THAT(text, AllOf(HasSubstr("\"title\": \"Classes\""),
                          HasSubstr("\"meaning\": \"of pixels\""), HasSubstr("\"format\": \".1%\""),
                          HasSubstr("\"name\": \"a<b>\",\n      \"share\": 0.3333333333333333\n"),
                          HasSubstr("\"name\": \"rest\",\n      \"share\": null\n"),
                          HasSubstr("\"value\": 2.5,\n        \"good\": false")));
}

TEST(Report, CellsOfEachKind) {
  EXPECT_EQ(swatch({1.F, .5F, 0.F}).str(), "{\n  \"colour\": \"#ff8000\"\n}");
  EXPECT_EQ(range(0.0, not_finite).str(), "{\n  \"min\": 0,\n  \"max\": null\n}");
  EXPECT_EQ(linked("one", "1.png").str(), "{\n  \"value\": \"one\",\n  \"href\": \"1.png\"\n}");
}

// A report with one element of each kind, with texts that would be markup.
std::string make_report(const std::string& folder) {
  Report report(folder);
  report.section("one", "Heading & more", "How to read </script><b>it</b>.", "bad");
  report.picture("dot", Grid<glm::vec3>(3, 2, glm::vec3(1.F, 0.F, 0.F)), "a <dot>");
  report.next_row();
  report.picture("other", Grid<glm::vec3>(4, 4), "another");
  report.text("said {css} & <done>");
  report.list({"first", "second"});
  report.listing("a\n  b");
  report.table(ReportTable({{"key", "", "hidden"},
                            {"name", "of"},
                            {"value", "value", ".2f"},
                            {"wanted", "wanted"},
                            {"seen", "seen"}})
                   .row("k", linked("<one>", "dot.png"), evaluated(0.125, false), range(0.0, 12.0),
                        swatch({0.F, 0.F, 1.F}))
                   .row("k", "two", not_finite, range(0.95, 1.05), "–"));
  report.table(ReportTable({{"share", "share", ".1%"},
                            {"signed", "signed", "+.1f"},
                            {"three", "three", ".3g"},
                            {"all", "all"}})
                   .row(0.3333, 2.25, 0.0123456, 1234.5678));
  report.section("two", "Charts");
  report.compare("left", Grid<glm::vec3>(6, 5), "right", Grid<glm::vec3>(6, 5));
  report.add("bars",
             Json::object()
                 .add("title", Json::text("bars"))
                 .add("groups",
                      Json::array({Json::object()
                                       .add("name", Json::text("near"))
                                       .add("values", Json::numbers(std::vector{2.0, 0.5, 1.0})),
                                   Json::object()
                                       .add("name", Json::text("far"))
                                       .add("values", Json::numbers(std::vector{1.0, 1.0, 3.0}))}))
                 .add("line", Json::number(1.0))
                 .add("max", Json::number(2.0)));
  std::vector<int> counts(256, 0);
  counts[5] = 7;
  std::vector<int> asked(256, 0);
  asked[6] = asked[7] = 1;
  report.add("coverage",
             Json::object()
                 .add("rows", Json::array({Json::object()
                                               .add("name", Json::text("rock"))
                                               .add("counts", Json::numbers(counts))
                                               .add("asked", Json::numbers(asked))}))
                 .add("scale", Json::array({Json::array({Json::number(0), Json::text("0 m")})})));
  report.write({.title = "Of <b> & \"c\"",
                .lead = "Lead.",
                .command = "belvedere x > y",
                .data = Json::object().add("bands", Json::number(3))});
  return test::read_bytes(folder + "/index.html");
}

TEST(Report, PageAndJsonTellTheSameAndPicturesLieBeside) {
  const test::Folder folder;
  const std::string page = make_report(folder / "report");
  EXPECT_THAT(page, AllOf(HasSubstr("<title>Of &lt;b&gt; &amp; &quot;c&quot;</title>"),
                          Not(HasSubstr("http")), Not(HasSubstr("</script><b>"))));
  const std::string json = test::read_bytes(folder / "report/report.json");
  EXPECT_THAT(json, AllOf(HasSubstr("\"command\": \"belvedere x > y\""),
                          HasSubstr("\"src\": \"dot.png\""), HasSubstr("\"width\": 3"),
                          HasSubstr("\"id\": \"two\""), HasSubstr("\"bands\": 3")));
  EXPECT_EQ(read_picture(folder / "report/dot.png")(2, 1), glm::vec3(1.F, 0.F, 0.F));
  EXPECT_LT(json.find("dot.png"), json.find("other.png"));
}

TEST(Report, PicturesInsideNeedNoFile) {
  const test::Folder folder;
  Report report(folder / "scratch", Report::Pictures::inside);
  report.section("one", "One");
  report.picture("dot", Grid<glm::vec3>(3, 2), "a dot");
  EXPECT_THAT(report.page({.title = "t", .lead = "l", .command = ""}),
              HasSubstr("\"src\": \"data:image/png;base64,"));
  EXPECT_TRUE(std::filesystem::is_empty(folder / "scratch"));
}

TEST(Report, AFileInItsPlaceIsAnOutputError) {
  const test::Folder folder;
  folder.write("report", "in the way");
  EXPECT_EQ(test::error_of([&] { Report page(folder / "report"); }).kind(), ErrorKind::output);
}

// Its display in a browser: every text unescaped, numbers in their columns' format, bars on one
// line.
TEST(Report, IsDrawnInABrowser) {
  if (!std::filesystem::exists(test::browser)) GTEST_SKIP() << "no browser at " << test::browser;
  const test::Folder folder;
  make_report(folder / "report");
  const std::string page = test::opened_page(folder / "report/index.html", folder / "profile");
  const std::string drawn = page.substr(std::min(page.size(), page.find("<h1>")));
  for (const char* part :
       {"<h1>Of &lt;b&gt; &amp; \"c\"</h1>", "<pre>belvedere x &gt; y</pre>",
        "<h2 class=\"bad\">Heading &amp; more</h2>",
        "<p>How to read &lt;/script&gt;&lt;b&gt;it&lt;/b&gt;.</p>",
        "<p>said {css} &amp; &lt;done&gt;</p>", "<li>second</li>", "<pre>a\n  b</pre>",
        "<img src=\"dot.png\" width=\"3\" height=\"2\" alt=\"a &lt;dot&gt;\"><figcaption>a "
        "&lt;dot&gt;</figcaption>",
        "<td><a href=\"dot.png\">&lt;one&gt;</a></td>", "<td><b>0.13</b></td><td>≤ 12</td>",
        "<td>–</td><td>0.95 – 1.05</td>", "#0000ff</td>",
        "<td>33.3 %</td><td>+2.3</td><td>0.0123</td><td>1234.5678</td>", "<input type=\"range\"",
        ">0 m</text>"})
    EXPECT_THAT(drawn, HasSubstr(part));
  EXPECT_THAT(drawn, Not(HasSubstr(">k</td>"))) << "hidden columns are for machines";
  // Bars are cut at the top, all end where the axis is, groups are named below their middle.
  for (const char* bar : {"<rect x=\"26\" y=\"8.0\" width=\"14\" height=\"160.0\"",
                          "<rect x=\"42\" y=\"128.0\" width=\"14\" height=\"40.0\"",
                          "<rect x=\"132\" y=\"8.0\" width=\"14\" height=\"160.0\"",
                          "<text x=\"50\" y=\"186\" text-anchor=\"middle\">near</text>",
                          "<line x1=\"13\" x2=\"161\" y1=\"88\" y2=\"88\""})
    EXPECT_THAT(drawn, HasSubstr(bar));
  EXPECT_THAT(
      drawn,
      HasSubstr("<rect x=\"145\" y=\"0\" width=\"3\" height=\"16\" fill=\"rgb(255,255,255)\""))
      << "texels at 5";
  EXPECT_THAT(drawn,
              HasSubstr("<rect x=\"148\" y=\"17\" width=\"3\" height=\"3\" fill=\"#1a4de6\""))
      << "asked for at 6";
}

}  // namespace
}  // namespace belvedere::tools
