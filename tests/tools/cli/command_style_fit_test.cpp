// `belvedere style fit` from the command line.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "base/random.h"
#include "renderer/style/style_file.h"
#include "tests/renderer/image/picture_bytes.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class StyleFit : public Program {
 protected:
  // Sky, forest and meadow.
  std::string write_painting() const {
    return write_picture("painting.png", 120, 90, [](int x, int y) {
      const glm::vec3 colour =
          y < 30 ? glm::vec3(.55F, .7F, .9F)
                 : (x < 60 ? glm::vec3(.12F, .25F, .1F) : glm::vec3(.6F, .75F, .35F));
      return colour + glm::vec3(static_cast<float>(random_index(20, 5, x / 2, y / 2)) / 400.F);
    });
  }
  // The same as class numbers.
  std::string write_mask(int pasture = 10) const {
    return write_labels("mask.png", 120, 90, [&](int x, int y) {
      return y < 30 ? 0 : x < 60 ? 4 : pasture;
    });
  }
};

TEST_F(StyleFit, WritesAStyleAndItsPage) {
  const Outcome outcome = run({"style", "fit", write_painting(), "--classes", write_mask(), "--out",
                               path("bands.toml"), "--report", path("report"), "--origin",
                               "Nobody, Bands", "--licence", "CC0", "-q", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("\"notes\""), HasSubstr("no water")));
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
  const Outcome outcome =
      run({"style", "fit", write_painting(), "--out", path("bands.toml"), "--name", "inferred"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("no mask was given"));
  const Style style = read_style(path("bands.toml"));
  EXPECT_EQ(style.name, "inferred");
  EXPECT_GT(style.brushwork[4].length_px, 0.0);
}

TEST_F(StyleFit, MistakesAreToldBeforeAnythingIsWritten) {
  const std::string painting = write_painting();
  EXPECT_EQ(run({"style", "fit", painting, "--out", path("style.png")}).status, 2);
  const Outcome number = run(
      {"style", "fit", painting, "--classes", write_mask(77), "--out", path("style.toml"), "-q"});
  EXPECT_EQ(number.status, 3);
  EXPECT_THAT(number.err, HasSubstr("77 (3600 pixels"));
  EXPECT_FALSE(std::filesystem::exists(path("style.toml")));
}

// Cut-out pictures that differ by the colour under their transparency alone.
TEST_F(StyleFit, HiddenColoursAreNotSeen) {
  const Grid<glm::vec3> picture = read_picture(write_painting());
  std::vector<std::string> results;
  for (const std::string& hidden : {std::string("\xff\0\xff\0", 4), std::string("\0\xff\0\0", 4)}) {
    std::string rows;
    for (int y = 0; y < picture.height(); ++y)
      for (int x = 0; x < picture.width(); ++x) {
        for (int c = 0; x < 80 && c < 3; ++c)
          rows += static_cast<char>(std::lround(picture(x, y)[c] * 255.F));
        rows += x < 80 ? "\xff" : hidden;
      }
    write("cut.png", test::make_png(picture.width(), picture.height(), 8, 6, rows));
    for (const bool masked : {true, false}) {
      std::vector<std::string> fit = {"style", "fit",          path("cut.png"),
                                      "--out", path("c.toml"), "-q"};
      if (masked) fit.insert(fit.end(), {"--classes", write_mask()});
      const Outcome outcome = run(fit);
      ASSERT_EQ(outcome.status, 0) << outcome.err;
      if (masked) results.emplace_back();
      results.back() += read_bytes(path("c.toml"));
    }
  }
  EXPECT_EQ(results[0], results[1]);
}

}  // namespace
}  // namespace belvedere
