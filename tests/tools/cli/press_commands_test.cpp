#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/image/display_conversion.h"
#include "tests/renderer/image/icc/press_profile.h"
#include "tests/tools/program.h"

// `belvedere proof` and `belvedere palette check` as users meet them.
// `belvedere pdf` as users meet it.

namespace belvedere {
namespace {

using testing::HasSubstr;

class PressCommands : public Program {
 protected:
  void picture() const {
    write_png8(path("a.png"), Grid<glm::vec3>(30, 20, glm::vec3(0.5F)),
               {.dots_per_inch = 300.0, .icc_profile = {}, .notes = {}});
  }
};

TEST_F(PressCommands, ProofsAPicture) {
  picture();
  ASSERT_THAT(
      run({"proof", path("a.png"), "--profile", test::press_file, "--out", path("out"), "--quiet"}),
      Prints(HasSubstr("unprintable colours: 0.00 % of the pixels")));
  EXPECT_EQ(read_picture(path("out/a_proof.png")).width(), 30);
  EXPECT_EQ(read_picture(path("out/a_outside.png")).height(), 20);
  const Outcome json = run({"proof", path("a.png"), "--profile", test::press_file, "--out",
                            path("out"), "--quiet", "--json"});
  EXPECT_THAT(json.out, HasSubstr("\"outside_share\": 0"));
}

TEST_F(PressCommands, FaultsHaveTheirStatusAndWord) {
  picture();
  write("text.icc", "no profile");
  const auto run_with = [&](const std::string& file, const std::string& profile) {
    return run({"proof", path(file), "--profile", profile, "--out", path("out"), "--quiet"});
  };
  EXPECT_THAT(run_with("a.png", path("text.icc")), Ends(3, HasSubstr("is not an ICC profile")));
  const Outcome absent = run_with("absent.png", test::press_file);
  EXPECT_EQ(absent.status, 3);
  EXPECT_THAT(absent.err, HasSubstr("absent.png"));
  const std::vector<std::uint8_t> rgb = srgb_profile();
  write("rgb.icc", std::string(rgb.begin(), rgb.end()));
  EXPECT_THAT(run_with("a.png", path("rgb.icc")).err, HasSubstr("colours in RGB"));
  EXPECT_EQ(run({"proof", path("a.png"), "--profile", test::press_file, "--intent", "nice", "--out",
                 path("out")})
                .status,
            2);
}

TEST_F(PressCommands, PalettesAreChecked) {
  EXPECT_THAT(run({"palette", "check", "summer", "winter", "--profile", test::press_file,
                   "--outside", "50"}),
              Prints(HasSubstr("winter: 0 of ")));
  const Outcome few = run(
      {"palette", "check", "summer", "--profile", test::press_file, "--outside", "0.1", "--json"});
  EXPECT_EQ(few.status, 1);
  EXPECT_THAT(few.out, HasSubstr("\"delta_e\""));
  EXPECT_EQ(run({"palette", "check", "spring?", "--profile", test::press_file}).status, 2);
}

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
  ASSERT_THAT(run({"pdf", path("a.png"), "--width-mm", "400", "--paper", "A4", "--quiet", "--out",
                   path("b.pdf")}),
              Prints(HasSubstr("3 pages")));  // 400 × 267 on 190 × 277
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
