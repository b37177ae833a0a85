// `belvedere pdf` as users meet it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/renderer/image/icc/press_profile.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

class Pdf : public Program {
 protected:
  void picture() const {
    write_png8(path("a.png"), Grid<glm::vec3>(300, 200, glm::vec3(0.5F)),
               {.dots_per_inch = 254.0, .icc_profile = {}, .notes = {}});
  }
};

TEST_F(Pdf, WritesSheetsAndTiles) {
  picture();
  const Outcome sheet = run({"pdf", path("a.png"), "--profile", test::press_file, "--bleed", "1",
                             "--marks", "--quiet", "--out", path("a.pdf")});
  ASSERT_EQ(sheet.status, 0) << sheet.err;
  EXPECT_THAT(sheet.out, HasSubstr("1 page, picture 30 × 20 mm"));
  EXPECT_THAT(sheet.out, HasSubstr("% of ink"));
  EXPECT_THAT(read_bytes(path("a.pdf")), testing::StartsWith("%PDF-1.6"));
  const Outcome tiles = run({"pdf", path("a.png"), "--width-mm", "400", "--paper", "A4", "--quiet",
                             "--out", path("b.pdf")});
  ASSERT_EQ(tiles.status, 0) << tiles.err;
  EXPECT_THAT(tiles.out, HasSubstr("3 pages"));  // 400 × 267 on 190 × 277
  EXPECT_EQ(run({"pdf", path("a.png"), "--width-mm", "400", "--paper", "190x287", "--quiet",
                 "--out", path("b.pdf")})
                .status,
            0);
}

TEST_F(Pdf, FaultsHaveTheirStatusAndWord) {
  picture();
  const Outcome paper =
      run({"pdf", path("a.png"), "--paper", "A7", "--quiet", "--out", path("a.pdf")});
  EXPECT_EQ(paper.status, 2);
  EXPECT_THAT(paper.err, HasSubstr("A4, A3"));
  EXPECT_EQ(run({"pdf", path("a.png"), "--paper", "A4", "--bleed", "3", "--quiet", "--out",
                 path("a.pdf")})
                .status,
            2);
  EXPECT_EQ(run({"pdf", path("absent.png"), "--quiet", "--out", path("a.pdf")}).status, 3);
  EXPECT_EQ(run({"pdf", path("a.png"), "--quiet", "--out", "/dev/full/a.pdf"}).status, 4);
}

}  // namespace
}  // namespace belvedere
