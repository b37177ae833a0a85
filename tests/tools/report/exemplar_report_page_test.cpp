#include "tools/report/exemplar_report_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/image/image_io.h"
#include "tests/files.h"

namespace belvedere::tools {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(ExemplarReportPage, ShowsThePaintingItsClassesAndCharts) {
  Exemplar painting{
      .name = "p.png", .picture = Grid<Rgb8>(64, 48, Rgb8{10, 200, 30}), .guides = {}};
  painting.guides.label = Grid<std::uint8_t>(64, 48, 7);
  painting.guides.guides.push_back({"altitude", Grid<std::uint8_t>(64, 48, 100)});
  ExemplarFindings findings;
  findings.name = [](std::uint8_t label) { return "class " + std::to_string(label); };
  findings.value = [](const std::string&, int value) { return std::to_string(value); };
  findings.paintings.push_back({painting.name, 64, 48, survey_exemplar(painting)});
  const test::Folder folder;
  write_exemplar_report(folder.path(), {painting}, {}, findings, "belvedere exemplar check");
  const std::string page = test::read_bytes(folder / "index.html");
  EXPECT_THAT(page, AllOf(HasSubstr("\"id\": \"verdict\""), HasSubstr("class 7"),
                          HasSubstr("belvedere exemplar check")));
  EXPECT_THAT(page, AllOf(HasSubstr("\"texels_inside\": 3072"), HasSubstr("\"coverage\": {")));
  // Every picture of the page is there.
  std::size_t shown = 0;
  for (std::size_t at = page.find("\"src\": \""); at != std::string::npos;
       at = page.find("\"src\": \"", at + 1), ++shown) {
    const std::size_t begin = at + 8;
    EXPECT_GT(read_image_info(folder / page.substr(begin, page.find('"', begin) - begin)).width, 0);
  }
  EXPECT_EQ(shown, 3U) << "painting, classes, a swatch";
}

}  // namespace
}  // namespace belvedere::tools
