// `belvedere exemplar register` as users meet it.
#include <gmock/gmock.h>

#include <fmt/core.h>

#include <algorithm>

#include "renderer/image/label_image.h"
#include "terrain/io/crs.h"
#include "tests/grids.h"
#include "tests/terrain/register/synthetic_view.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class ExemplarRegister : public Program {
 protected:
  void SetUp() override {
    // Ground that rises to the north, 50 km square.
    const Raster<float> dem{test::grid_of(125, 125, [](int, int y) { return 1500.0 - 8.0 * y; }),
                            {660000.0, 5280000.0, 400.0, 400.0},
                            normalize_crs("EPSG:32632")};
    write_raster(path("dem.tif"), dem);
    write_picture("painting.png", 300, 138, [](int, int) { return glm::vec3(0.5F); });
    pairs_ = test::synthetic_places(60);
    for (ControlPair& pair : pairs_)
      pair.altitude_m = 1500.0 - 8.0 * dem.transform.to_cell(0.0, pair.position.y).y;
    test::paint(test::synthetic_view(ViewKind::plane, pairs_), pairs_);
    std::erase_if(pairs_, [](const ControlPair& p) {
      return p.pixel.x < 0.0 || p.pixel.x > 1200.0 || p.pixel.y < 0.0 || p.pixel.y > 550.0;
    });
    pairs_.at(5).pixel.x += pairs_[5].pixel.x > 600.0 ? -120.0 : 120.0;
  }

  // The painting is a quarter of the synthetic view.
  std::string write_pairs() const {
    std::string text = "x_px,y_px,lon,lat,name\n";
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const glm::dvec2 at = transform_point("EPSG:32632", "EPSG:4326", pairs_[i].position);
      text += fmt::format("{:.3f},{:.3f},{:.8f},{:.8f},place {}\n", pairs_[i].pixel.x / 4.0,
                          pairs_[i].pixel.y / 4.0, at.x, at.y, i);
    }
    return write("pairs.csv", text);
  }

  std::vector<ControlPair> pairs_;
};

TEST_F(ExemplarRegister, WritesASceneAReportAndTrust) {
  ASSERT_THAT(run({"exemplar", "register", path("painting.png"), path("dem.tif"), "--pairs",
                   write_pairs(), "--out", path("registered")}),
              Prints(AllOf(HasSubstr("pairs.csv:7 place 5"), HasSubstr("px off"),
                           HasSubstr("next: belvedere guidance"))));
  EXPECT_THAT(read_bytes(path("registered/registered.toml")),
              AllOf(HasSubstr("projection = \"perspective\""), HasSubstr("file = \"dem.tif\""),
                    HasSubstr("[[deform.field.places]]"), HasSubstr("width = 300")));
  EXPECT_THAT(read_bytes(path("registered/index.html")), HasSubstr("place 5"));
  const Grid<std::uint16_t> trust = read_grey(path("registered/trust.png"));
  EXPECT_EQ(trust.width(), 300);
  EXPECT_GT(trust(150, 120), 60);
  EXPECT_EQ(read_class_mask(path("registered/classes.png")).height(), trust.height());
  EXPECT_THAT(read_bytes(path("registered/index.html")), HasSubstr("Land cover"));
  // The scene is one that the program takes.
  EXPECT_THAT(run({"check", path("registered/registered.toml"), "--data", path("")}), Ends(0));
}

TEST_F(ExemplarRegister, TellsItsFindingsToPrograms) {
  ASSERT_THAT(
      run({"exemplar", "register", path("painting.png"), path("dem.tif"), "--pairs", write_pairs(),
           "--out", path("r"), "--projection", "perspective", "--sigma", "1", "--json", "-q"}),
      Prints(AllOf(HasSubstr("\"sigma_px\": 1"), HasSubstr("\"wrong\": true"),
                   HasSubstr("\"projection\": \"perspective\""),
                   Not(HasSubstr("\"projection\": \"panini\"")))));
}

TEST_F(ExemplarRegister, FaultsNameTheirPlace) {
  const auto refused = [&](const std::string& pairs) {
    const Outcome outcome = run({"exemplar", "register", path("painting.png"), path("dem.tif"),
                                 "--pairs", pairs, "--out", path("r")});
    EXPECT_EQ(outcome.status, 2);
    return outcome.err;
  };
  EXPECT_THAT(refused(write("short.csv", "x_px,y_px,lon,lat,name\n1,2,11.3,47.3,a\n")),
              HasSubstr("1 pairs"));
  EXPECT_THAT(refused(write("bad.csv", "x_px,y_px,lon,lat,name\n301,2,11.3,47.3,a\n")),
              HasSubstr("bad.csv:2: x_px is \"301\""));
}

}  // namespace
}  // namespace belvedere
