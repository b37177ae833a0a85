// `belvedere exemplar register` as users meet it.
#include <gmock/gmock.h>

#include <fmt/core.h>

#include <cmath>
#include <sstream>

#include "base/random.h"
#include "base/statistics.h"
#include "renderer/image/guidance_io.h"
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

// A painting of the program's own by a view that the registration is not told.
class ExemplarRegisterLong : public Program {
 protected:
  static double altitude_at(glm::dvec2 at) {
    const double x = at.x / 1000.0, y = at.y / 1000.0;
    return 1300.0 + 400.0 * std::sin(0.9 * x + 0.5 * y) + 350.0 * std::sin(0.7 * y - 0.8 * x) +
           150.0 * std::sin(1.9 * x);
  }
  void SetUp() override {
    const GeoTransform transform{671000.0, 5271000.0, 200.0, 200.0};
    write_raster(path("dem.tif"),
                 Raster<float>{test::grid_of(150, 150,
                                             [&](int x, int y) {
                                               return altitude_at(transform.to_crs(x, y));
                                             }),
                               transform, normalize_crs("EPSG:32632")});
    scene_ = write("scene.toml", R"(version = 1
[[terrain.sources]]
file = "dem.tif"
[camera]
position = [686000, 5228000]
height_m = 9000
azimuth_deg = 0
pitch_deg = -16
field_of_view_deg = 60
[deform]
exaggeration = 1.5
[deform.bend]
radius_m = 0
[synthesis]
enabled = false
[sampling]
pixel_samples = 1
shadow_rays = 1
sky_directions = 4
[output]
width = 400
height = 200
sheet_width_mm = 200
)");
  }
  // Places on a lattice that the scene shows, with their pixels.
  std::vector<ControlPair> seen_places() const {
    std::vector<std::string> words = {"deform", scene_, "--quiet"};
    for (int j = 0; j < 12; ++j)
      for (int i = 0; i < 12; ++i) {
        words.emplace_back("--locate");
        words.push_back(fmt::format("{},{}", 672500 + 2450 * i, 5242500 + 2450 * j));
      }
    std::vector<ControlPair> out;
    std::istringstream lines(run(words).out);
    for (std::string line; std::getline(lines, line);) {
      ControlPair place;
      if (line.ends_with(", seen") &&
          std::sscanf(line.c_str(), "E %lf N %lf: pixel %lf,%lf,", &place.position.x,
                      &place.position.y, &place.pixel.x, &place.pixel.y) == 4)
        out.push_back(place);
    }
    return out;
  }

  std::string scene_;
};

// From clicks to altitudes: of some forty places with clicks that are off by 0.7 px, the scene that
// is written shows the places in between at their altitudes: relief is 1700 m, a pixel shows ground
// of 75 m by 250 m. Prototypes gave 8 to 12 m at the median, 27 to 62 m at nine tenths.
TEST_F(ExemplarRegisterLong, GuidanceOfARegisteredPaintingHasTheAltitudes) {
  const std::vector<ControlPair> places = seen_places();
  ASSERT_GE(places.size(), 60U);
  std::string pairs = "x_px,y_px,lon,lat,name\n";
  for (std::size_t i = 0; i < places.size(); i += 2) {
    const auto n = static_cast<std::int64_t>(i);
    const glm::dvec2 at = transform_point("EPSG:32632", "EPSG:4326", places[i].position);
    pairs += fmt::format("{:.3f},{:.3f},{:.8f},{:.8f},place {}\n",
                         places[i].pixel.x + 0.7 * random_normal(8, n, 0),
                         places[i].pixel.y + 0.7 * random_normal(8, n, 1), at.x, at.y, i);
  }
  ASSERT_THAT(run({"render", scene_, "--quiet", "--out", path("painting")}), Ends(0));
  ASSERT_THAT(run({"exemplar", "register", path("painting/panorama.png"), path("dem.tif"),
                   "--quiet", "--pairs", write("pairs.csv", pairs), "--out", path("registered")}),
              Ends(0));
  ASSERT_THAT(run({"guidance", path("registered/registered.toml"), "--quiet", "--data", path(""),
                   "--out", path("registered")}),
              Ends(0));
  const GuidanceBuffers guidance = read_guidance(path("registered/guidance.exr"));
  ASSERT_EQ(guidance.width(), 400);
  std::vector<double> off_m;
  for (std::size_t i = 1; i < places.size(); i += 2) {
    const auto x = static_cast<int>(places[i].pixel.x), y = static_cast<int>(places[i].pixel.y);
    if (guidance.is_sky(guidance.depth_m.index(x, y))) continue;  // on the skyline
    off_m.push_back(
        std::abs(static_cast<double>(guidance.altitude_m(x, y)) - altitude_at(places[i].position)));
  }
  ASSERT_GE(off_m.size(), places.size() / 2 - 3);
  EXPECT_LT(percentile(off_m, 0.5), 25.0);
  EXPECT_LT(percentile(off_m, 0.8), 60.0);
}

}  // namespace
}  // namespace belvedere
