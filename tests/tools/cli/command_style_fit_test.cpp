// `belvedere style fit` from the command line.
#include <gmock/gmock.h>

#include <filesystem>

#include "renderer/style/style_file.h"
#include "tests/grids.h"
#include "tests/renderer/image/picture_bytes.h"
#include "tests/tools/cli/bands.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class StyleFit : public Program {
 protected:
  // Sky, forest and meadow.
  std::string write_painting() const {
    return write_picture("painting.png", 120, 90, test::band_colour);
  }
  // The same as class numbers.
  std::string write_mask(int pasture = 10) const {
    return write_labels("mask.png", 120, 90, [&](int x, int y) {
      return y < 30 ? 0 : x < 60 ? 4 : pasture;
    });
  }
};

TEST_F(StyleFit, WritesAStyleAndItsPage) {
  ASSERT_THAT(run({"style", "fit", write_painting(), "--classes", write_mask(), "--out",
                   path("bands.toml"), "--report", path("report"), "--origin", "Nobody, Bands",
                   "--licence", "CC0", "-q", "--json"}),
              Prints(AllOf(HasSubstr("\"notes\""), HasSubstr("no water"))));
  const Style style = read_style(path("bands.toml"));
  EXPECT_EQ(style.name, "bands");
  EXPECT_EQ(style.origin, "Nobody, Bands");
  EXPECT_EQ(style.licence, "CC0");
  EXPECT_GT(style.brushwork[4].length_px, 0.0);
  const std::string page = read_bytes(path("report/index.html"));
  EXPECT_THAT(page, AllOf(HasSubstr("no water"), HasSubstr("strokes_forest.png")));
  EXPECT_TRUE(std::filesystem::exists(path("report/ramp_rock.png")));
}

TEST_F(StyleFit, TakesFarAirFromTheMask) {
  const Outcome outcome = run({"style", "fit", write_painting(), "--classes", write_mask(200),
                               "--out", path("bands.toml"), "-q"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const std::string& note : read_style(path("bands.toml")).notes)
    EXPECT_THAT(note, testing::Not(HasSubstr("no far air")));
}

TEST_F(StyleFit, InfersClassesWithoutAMask) {
  ASSERT_THAT(
      run({"style", "fit", write_painting(), "--out", path("bands.toml"), "--name", "inferred"}),
      Prints(HasSubstr("no mask was given")));
  const Style style = read_style(path("bands.toml"));
  EXPECT_EQ(style.name, "inferred");
  EXPECT_GT(style.brushwork[4].length_px, 0.0);
}

TEST_F(StyleFit, MistakesAreToldBeforeAnythingIsWritten) {
  const std::string painting = write_painting();
  EXPECT_EQ(run({"style", "fit", painting, "--out", path("style.png")}).status, 2);
  EXPECT_THAT(run({"style", "fit", painting, "--classes", write_mask(77), "--out",
                   path("style.toml"), "-q"}),
              Ends(3, HasSubstr("77 (3600 pixels")));
  EXPECT_FALSE(std::filesystem::exists(path("style.toml")));
}

// Cut-out pictures that differ by the colour under their transparency alone.
TEST_F(StyleFit, HiddenColoursAreNotSeen) {
  const Grid<glm::vec3> picture = read_picture(write_painting());
  std::vector<std::string> results;
  for (const std::string& hidden : test::hidden_colours) {
    write("cut.png", test::cut_out(picture, hidden));
    for (const bool masked : {true, false}) {
      std::vector<std::string> fit = {"style", "fit",          path("cut.png"),
                                      "--out", path("c.toml"), "-q"};
      if (masked) fit.insert(fit.end(), {"--classes", write_mask()});
      ASSERT_THAT(run(fit), Ends(0));
      if (masked) results.emplace_back();
      results.back() += read_bytes(path("c.toml"));
    }
  }
  EXPECT_EQ(results[0], results[1]);
}

}  // namespace
}  // namespace belvedere
