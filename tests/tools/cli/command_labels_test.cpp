// `belvedere labels` as users meet it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "renderer/image/image_io.h"
#include "terrain/io/raster_io.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// A cone of 2000 m with a lower one before it and one behind it that it hides, seen from the south.
class LabelsCommand : public Program {
 protected:
  void SetUp() override {
    Raster<float> raster{
        Grid<float>(120, 160), {680000.0, 5266000.0, 100.0, 100.0}, normalize_crs("EPSG:32632")};
    for (int y = 0; y < 160; ++y)
      for (int x = 0; x < 120; ++x) {
        const auto cone = [&](int cx, int cy, double top, double down) {
          return top - down * std::hypot(x - cx, y - cy);
        };
        raster.cells(x, y) =
            static_cast<float>(std::max({500.0, cone(60, 60, 2000.0, 40.0),
                                         cone(30, 100, 1200.0, 40.0), cone(60, 25, 1300.0, 60.0)}));
      }
    write_raster(path("cones.tif"), raster);
    write("scene.toml", R"(version = 1
[[terrain.sources]]
file = "cones.tif"
[camera]
position = [686000, 5244000]
height_m = 2500
azimuth_deg = 0
pitch_deg = -8
field_of_view_deg = 50
[deform]
exaggeration = 1
[deform.bend]
radius_m = 0
[output]
width = 1600
height = 800
sheet_width_mm = 400
)");
    write("points.csv",
          "name,kind,rank,ele,east,north\nMittelkogel,summit,1,2000,686150,5259900\nHinterkogel,"
          "summit,2,1300,686050,5263450\n");
  }
  Outcome name(const std::vector<std::string>& more,
               const std::vector<std::string>& environment = {}) const {
    std::vector<std::string> arguments = {"labels", path("scene.toml"), "--quiet", "--out",
                                          path("names")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments, environment);
  }
};

TEST_F(LabelsCommand, NamesWhatIsSeenAndSaysWhatHidesTheRest) {
  write("panorama.png", "");
  ASSERT_THAT(name({"--points", path("points.csv"), "--under", path("panorama.png")}),
              Prints(AllOf(HasSubstr("1 of 2 names placed"), HasSubstr("1 hidden behind ground"))));
  const std::string svg = read_bytes(path("names/labels.svg"));
  EXPECT_THAT(svg, AllOf(HasSubstr(">Mittelkogel"), Not(HasSubstr("Hinterkogel")),
                         HasSubstr("xlink:href=\"../panorama.png\"")));
  EXPECT_THAT(
      read_bytes(path("names/labels.csv")),
      AllOf(HasSubstr("Hinterkogel,summit,2,hidden behind ground"), HasSubstr(",Mittelkogel,")));
  EXPECT_THAT(read_bytes(path("names/labels.geojson")), HasSubstr("\"FeatureCollection\""));
}

TEST_F(LabelsCommand, TheDemsOwnSummitsGoWithoutNames) {
  ASSERT_THAT(name({"--json"}),
              Prints(AllOf(HasSubstr("\"points\": 2"), HasSubstr("\"placed\": 2"))))
      << "the third is hidden";
  EXPECT_THAT(read_bytes(path("names/labels.svg")),
              AllOf(HasSubstr(">2000"), HasSubstr(">1200"), Not(HasSubstr(">1300"))));
  EXPECT_THAT(name({"--points", path("points.csv"), "--summits", "5", "--json"}).out,
              HasSubstr("\"points\": 3"))
      << "those that the file does not name";
}

TEST_F(LabelsCommand, TheSameBytesForAnyThreads) {
  name({"--points", path("points.csv"), "--summits", "5", "--threads", "1"});
  const std::string svg = read_bytes(path("names/labels.svg"));
  const std::string csv = read_bytes(path("names/labels.csv"));
  name({"--points", path("points.csv"), "--summits", "5", "--threads", "2"}, without_cache());
  EXPECT_EQ(read_bytes(path("names/labels.svg")), svg);
  EXPECT_EQ(read_bytes(path("names/labels.csv")), csv);
}

TEST_F(LabelsCommand, WaysAreDrawnWithTheirProfiles) {
  // Over the foot of the cone and behind it.
  write(
      "way.geojson",
      R"({"type": "Feature", "properties": {"name": "Round"}, "geometry": {"type": "LineString", "coordinates": [[11.41, 47.44], [11.44, 47.50], [11.47, 47.53]]}})");
  ASSERT_THAT(name({"--tracks", path("way.geojson")}), Prints(HasSubstr("Round: ")));
  EXPECT_THAT(read_bytes(path("names/labels.svg")), HasSubstr("<g id=\"tracks\""));
  EXPECT_THAT(read_bytes(path("names/profile_1.svg")), HasSubstr("Round: "));
  const Grid<glm::vec3> profile = read_picture(path("names/profile_1.png"));
  EXPECT_EQ(profile.width(), 2126);
  EXPECT_EQ(profile.height(), 591);
  std::size_t inked = 0;
  for (const glm::vec3 pixel : profile) inked += pixel == glm::vec3(1.F) ? 0U : 1U;
  EXPECT_GT(inked, profile.size() / 20) << "there is a profile on the paper";
}

TEST_F(LabelsCommand, AWayElsewhereIsSaidWithBothExtents) {
  write(
      "zero.geojson",
      R"({"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [[0, 0], [0.1, 0]]}})");
  EXPECT_THAT(
      name({"--tracks", path("zero.geojson")}).err,
      AllOf(HasSubstr("none of 1 ways lies on the terrain"), HasSubstr("longitude 0.00 … 0.10")));
  EXPECT_FALSE(std::filesystem::exists(path("names/labels.svg")));
}

TEST_F(LabelsCommand, PointsElsewhereAreSaidWithBothExtents) {
  write("zero.csv", "name,lon,lat\nNull Island,0,0\n");
  EXPECT_THAT(name({"--points", path("zero.csv")}),
              Ends(2, AllOf(HasSubstr("none of 1 points lies on the terrain"),
                            HasSubstr("longitude 0.00 … 0.00, latitude 0.00 … 0.00"),
                            HasSubstr("E 680000 … 692000"), HasSubstr("latitude 47."))));
  EXPECT_FALSE(std::filesystem::exists(path("names/labels.svg")));
}

TEST_F(LabelsCommand, WrongInputIsAWordAndNoFile) {
  EXPECT_EQ(name({"--points", path("none.csv")}).status, 3);
  EXPECT_EQ(name({"--style", "baroque"}).status, 2);
  write("empty.csv", "name,east,north\n");
  EXPECT_THAT(name({"--points", path("empty.csv")}).err, HasSubstr("nothing to name"));
  EXPECT_FALSE(std::filesystem::exists(path("names/labels.svg")));
}

}  // namespace
}  // namespace belvedere
