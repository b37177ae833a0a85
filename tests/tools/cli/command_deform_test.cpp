// `belvedere deform` as users meet it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "renderer/image/image_io.h"
#include "terrain/io/raster_io.h"
#include "tests/grids.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class DeformCommand : public Program {
 protected:
  // 80 × 60 cells of 100 m in UTM 32 with a hole: a cone.
  std::string write_cone() const {
    Raster<float> raster;
    raster.transform = {680000.0, 5260000.0, 100.0, 100.0};
    raster.crs = normalize_crs("EPSG:32632");
    raster.cells = Grid<float>(80, 60);
    for (const auto [x, y] : test::cells(80, 60))
      raster.cells(x, y) = static_cast<float>(1000.0 - 10.0 * std::hypot(x - 40, 2.0 * (y - 30)));
    raster.cells(5, 5) = std::nanf("");
    write_raster(path("cone.tif"), raster);
    return path("cone.tif");
  }
};

TEST_F(DeformCommand, ADemBecomesADeformedDemInTheSameFrame) {
  const std::string cone = write_cone();
  const std::string out = path("out.tif");
  ASSERT_THAT(run({"deform", cone, out, "--quiet", "--viewer", "684000,5250000", "--exaggeration",
                   "2", "--bend", "2000:10,9000:0", "--handle",
                   "684050,5256950 radius=2900 core=900 rotate=90 raise=50"}),
              Prints(AllOf(HasSubstr("no folds"), HasSubstr("80 × 60 cells of 100 m"),
                           HasSubstr("EPSG:32632"))));
  const Raster<float> before = read_raster_file(cone);
  const Raster<float> after = read_raster_file(out);
  EXPECT_EQ(after.transform, before.transform);
  EXPECT_TRUE(std::isnan(after.cells(5, 5)));
  // In the core a quarter turn clockwise: what lay 8 cells north of the summit lies 8 cells east of
  // it, raised and exaggerated, and bent by how far away it is now. Outside the handle's reach only
  // the bend is left, which goes by distance from the viewer at column 39.5, row 99.5.
  const auto bend = [&](int x, int y) { return 2.F * before.cells(x, y) - after.cells(x, y); };
  EXPECT_NEAR(bend(10, 5), bend(69, 5), 0.01);
  EXPECT_GT(bend(5, 58), bend(5, 1) + 50.F);
  // A cell outside the reach that is as far away as (48, 30).
  const double distance = std::hypot(8.5, 69.5);
  const auto far =
      static_cast<int>(std::lround(99.5 - std::sqrt(distance * distance - 32.5 * 32.5)));
  EXPECT_NEAR(after.cells(48, 30), 2.F * (before.cells(40, 22) + 50.F) - bend(72, far), 3.0);
  EXPECT_THAT(run({"deform", cone, out, "--quiet", "--json", "--exaggeration", "1"}).out,
              HasSubstr("\"highest_m\": 1000"));
  const Raster<float> same = read_raster_file(out);
  for (std::size_t i = 0; i < same.cells.size(); ++i)
    if (!std::isnan(same.cells[i])) {
      ASSERT_EQ(same.cells[i], before.cells[i]);
    }
}

TEST_F(DeformCommand, FoldsAreReportedWithTheirPlace) {
  EXPECT_THAT(
      run({"deform", write_cone(), path("out.tif"), "--quiet", "--handle",
           "684050,5256950 radius=2000 core=800 move=1900,0"}),
      Prints(HasSubstr("fold: deform.handles.0 folds the ground over itself around E 685")));
}

TEST_F(DeformCommand, SaysWherePlacesLieInThePicture) {
  const std::string scene = write_scene_file();
  const Outcome shown = run({"deform", scene, "--quiet", "--at", "48,40", "--at", "48,1"});
  ASSERT_EQ(shown.status, 0) << shown.err;
  EXPECT_THAT(shown.out, HasSubstr("pixel 48.00,1.00: sky"));
  double east = 0.0;
  double north = 0.0;
  ASSERT_EQ(std::sscanf(shown.out.c_str() + shown.out.find("E "), "E %lf N %lf", &east, &north), 2)
      << shown.out;
  const Outcome back = run({"deform", scene, "--quiet", "--locate",
                            fmt::format("{},{}", east, north), "--locate", "1e7,0"});
  EXPECT_THAT(back.out, AllOf(HasSubstr("seen"), HasSubstr("outside the terrain")));
  double x = 0.0;
  double y = 0.0;
  ASSERT_EQ(std::sscanf(back.out.c_str() + back.out.find("pixel "), "pixel %lf,%lf", &x, &y), 2)
      << back.out;
  EXPECT_NEAR(x, 48.0, 0.05);
  EXPECT_NEAR(y, 40.0, 0.05);
}

// A file's points are written as a table, on stdout alone so that it can be redirected, or to
// --out; each row equals the output for that position alone.
TEST_F(DeformCommand, LocatesAllPointsOfAFile) {
  const std::string scene = write_scene_file();
  const Outcome shown = run({"deform", scene, "--quiet", "--at", "48,40"});
  double east = 0.0;
  double north = 0.0;
  ASSERT_EQ(std::sscanf(shown.out.c_str() + shown.out.find("E "), "E %lf N %lf", &east, &north), 2)
      << shown.out;
  const std::string points = write(
      "points.csv",
      fmt::format("name,ele,east,north\nAlm,1234,{0},{1}\n,,{0},{1}\nFar,,1e7,0\n", east, north));
  const Outcome table = run({"deform", scene, "--quiet", "--locate", points});
  ASSERT_EQ(table.status, 0) << table.err;
  EXPECT_TRUE(table.out.starts_with("name,kind,rank,outcome,x_px,y_px,")) << table.out;
  EXPECT_EQ(std::count(table.out.begin(), table.out.end(), '\n'), 4)
      << "nothing but the table: " << table.out;
  const Outcome one =
      run({"deform", scene, "--quiet", "--locate", fmt::format("{},{}", east, north)});
  double x = 0.0, y = 0.0;
  ASSERT_EQ(std::sscanf(one.out.c_str() + one.out.find("pixel "), "pixel %lf,%lf", &x, &y), 2)
      << one.out;
  EXPECT_THAT(table.out, AllOf(HasSubstr(fmt::format("Alm,summit,5,seen,{:.2f},{:.2f},", x, y)),
                               HasSubstr(",1234.0,"),
                               HasSubstr(fmt::format("\n,summit,5,seen,{:.2f},{:.2f},", x, y)),
                               HasSubstr("Far,summit,5,outside the terrain")));
  const Outcome written = run({"deform", scene, "--quiet", "--locate", points, "--at", "48,40",
                               "--out", path("table.csv")});
  EXPECT_EQ(written.status, 0) << written.err;
  EXPECT_EQ(read_bytes(path("table.csv")), table.out);
  EXPECT_THAT(written.out, AllOf(HasSubstr("table.csv"), HasSubstr("pixel 48.00,40.00: E ")));
  EXPECT_THAT(run({"deform", scene, "--quiet", "--json", "--locate", points}).out,
              AllOf(HasSubstr("\"points\""), HasSubstr("\"altitude_file_m\": 1234"),
                    HasSubstr("\"outside the terrain\"")));
}

TEST_F(DeformCommand, ASearchedBendCanBePastedAndShowsWhatItPromises) {
  const std::string scene = write_scene_file();
  const Outcome found = run(
      {"deform", scene, "--quiet", "--search-bend", "--points", "3", "--out", path("bend.png")});
  ASSERT_EQ(found.status, 0) << found.err;
  EXPECT_EQ(read_image_info(path("bend.png")).height, 2 * 64 + 6);
  const std::size_t keys = found.out.find("# Shows ");
  ASSERT_NE(keys, std::string::npos);
  double promised = 0.0;
  ASSERT_EQ(std::sscanf(found.out.c_str() + keys, "# Shows %lf", &promised), 1);
  ASSERT_THAT(
      run({"deform", write("pasted.toml", read_bytes(scene) + "\n" + found.out.substr(keys)),
           "--quiet"}),
      Prints(HasSubstr(fmt::format("of which {:.1f} % is visible", promised))));
}

TEST_F(DeformCommand, MistakesAreUsageErrors) {
  const std::string cone = write_cone();
  const std::string out = path("out.tif");
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
           {cone},
           {cone, out, "--bend", "2000:10,9000:0"},
           {cone, out, "--bend", "x:3,4:5", "--viewer", "0,0"},
           {cone, out, "--handle", "1,2 radius=10 spin=3"},
           {cone, out, "--at", "3,4"},
           {write_scene_file(), "--search-bend", "--max-distortion", "90"},
           {write_scene_file(), "--locate", "here"},
           {write_scene_file(), "--locate", "1,2", "--out", out},
           {write_scene_file(), "--locate", write("zero.csv", "name,east,north\nNowhere,0,9e7\n")},
       }) {
    std::vector<std::string> arguments = {"deform", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2) << fmt::format("{}", fmt::join(more, " ")) << outcome.err;
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_FALSE(std::filesystem::exists(out));
  }
  EXPECT_EQ(run({"deform", path("none.tif"), out}).status, 3);
}

TEST_F(DeformCommand, AFoldInThePictureStopsTheRender) {
  const std::string handle =
      "[deform]\nallow_folds = false\n[[deform.handles]]\nposition = [9000, 8000]\nradius_m = "
      "5000\nmove_m = [0, 4800]\n";
  const std::string scene = write_scene_file(handle);
  {
    EXPECT_THAT(run({"check", scene, "--quiet"}),
                Ends(2, AllOf(HasSubstr("deform.handles.0"), HasSubstr("folds the ground"),
                              HasSubstr("larger radius_m"))));
  }
  EXPECT_EQ(run({"check", scene, "--set", "deform.allow_folds=true"}).status, 0);
}

}  // namespace
}  // namespace belvedere
