// `belvedere generalize` as users meet it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include "terrain/generalize/generalize.h"
#include "terrain/io/dem.h"
#include "terrain/io/raster_io.h"
#include "tests/grids.h"
#include "tests/paths.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

RasterInfo info_of(const std::string& file) {
  RasterSource source;
  source.path = file;
  return read_raster_info(source);
}

class GeneralizeCommand : public Program {
 protected:
  static Raster<float> hills(const std::string& crs = "EPSG:32632", double cell = 100.0) {
    Raster<float> raster;
    raster.transform = crs == "EPSG:4326" ? GeoTransform{11.0, 47.5, cell, cell}
                                          : GeoTransform{680000.0, 5260000.0, cell, cell};
    raster.crs = normalize_crs(crs);
    raster.cells = Grid<float>(70, 53);
    for (const auto [x, y] : test::cells(70, 53))
      raster.cells(x, y) = static_cast<float>(1000.1 + 12.3 * x - 7.7 * y +
                                              40.0 * std::sin(x * 1.7) * std::cos(y * 1.1));
    return raster;
  }
  // With a void at (5, 5).
  std::string write_hills(const std::string& name, std::optional<double> nodata = {}) const {
    Raster<float> raster = hills();
    raster.cells(5, 5) = std::nanf("");
    write_raster(path(name), raster, nodata);
    return path(name);
  }
  Outcome generalize_file(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"generalize", "--quiet", "--change-lakes"});
    return run(arguments);
  }
};

TEST_F(GeneralizeCommand, UnitWeightsKeepEveryBitPlaceAndVoid) {
  for (const double nodata : {-9999.0, -32767.0, std::nan("")}) {
    SCOPED_TRACE(nodata);
    const std::string in = write_hills("in.tif", nodata);
    ASSERT_THAT(generalize_file({in, path("out.tif"), "--global", "1,1,1,1,1"}), Ends(0));
    const Raster<float> before = read_raster_file(in);
    const Raster<float> after = read_raster_file(path("out.tif"));
    EXPECT_EQ(after.transform, before.transform);
    EXPECT_EQ(after.crs, before.crs);
    ASSERT_TRUE(after.cells.same_size(before.cells));
    for (std::size_t i = 0; i < after.cells.size(); ++i)
      ASSERT_TRUE(after.cells[i] == before.cells[i] ||
                  (std::isnan(after.cells[i]) && std::isnan(before.cells[i])))
          << i;
    EXPECT_TRUE(std::isnan(after.cells(5, 5)));
    ASSERT_TRUE(info_of(path("out.tif")).nodata);
    const double written = *info_of(path("out.tif")).nodata;
    EXPECT_TRUE(written == nodata || (std::isnan(written) && std::isnan(nodata))) << written;
  }
  // ESRI ASCII says it as well, but for NaN, which it has no number for.
  ASSERT_EQ(
      generalize_file({write_hills("in.tif", -32767.0), path("out.asc"), "--global", "1,1"}).status,
      0);
  EXPECT_EQ(info_of(path("out.asc")).nodata, -32767.0);
  ASSERT_EQ(
      generalize_file({write_hills("in.tif", std::nan("")), path("out.asc"), "--global", "1,1"})
          .status,
      0);
  EXPECT_EQ(info_of(path("out.asc")).nodata, -9999.0);
}

// A void's number must not coincide with land: zero is an altitude as soon as a cell has it.
TEST_F(GeneralizeCommand, NoAltitudeBecomesAVoid) {
  Raster<float> raster = hills();
  raster.cells(5, 5) = std::nanf("");
  raster.cells(9, 9) = 0.F;
  write_raster(path("a.tif"), raster, 0.0);
  EXPECT_EQ(info_of(path("a.tif")).nodata, -9999.0);
  EXPECT_EQ(read_raster_file(path("a.tif")).cells(9, 9), 0.F);
  EXPECT_TRUE(std::isnan(read_raster_file(path("a.tif")).cells(5, 5)));
}

TEST_F(GeneralizeCommand, WeightsAndPresetsAreThoseOfTheLibrary) {
  write_raster(path("in.tif"), hills());
  ASSERT_EQ(generalize_file({path("in.tif"), path("preset.tif"), "--preset", "figure2"}).status, 0);
  ASSERT_EQ(
      generalize_file({path("in.tif"), path("weights.tif"), "--global", "1,1,2,0.25,0"}).status, 0);
  const Grid<float> preset = read_raster_file(path("preset.tif")).cells;
  EXPECT_EQ(read_raster_file(path("weights.tif")).cells, preset);
  GeneralizeParameters bands;
  bands.foreground = bands.background = {1.F, 1.F, 2.F, .25F, 0.F};
  EXPECT_EQ(preset, generalize(hills().cells, {100.0, 100.0}, {}, bands, silent_progress()));
  // Options beside a preset have precedence.
  ASSERT_EQ(generalize_file(
                {path("in.tif"), path("both.tif"), "--preset", "figure2", "--global", "1,1,1,1,1"})
                .status,
            0);
  EXPECT_EQ(read_raster_file(path("both.tif")).cells, hills().cells);
}

// How break lines are found, by every option of it, on real ground where there is some.
TEST_F(GeneralizeCommand, BreakLinesAreThoseOfTheLibrary) {
  Raster<float> ground = hills();
  const std::string file = test::data_folder() + "/lost_river/mackay.tif";
  if (std::filesystem::exists(file)) {
    const Raster<float> real = read_raster_file(file);
    ground.cells = Grid<float>(70, 53);
    for (int y = 0; y < 53; ++y)
      std::copy_n(real.cells.row(300 + y) + 300, 70, ground.cells.row(y));
  }
  write_raster(path("in.tif"), ground);
  GeneralizeParameters bands;
  bands.foreground = bands.background = {1.F, 0.5F};
  bands.foreground_ridges = bands.background_ridges = {0.5F, 1.F};
  bands.foreground_valleys = bands.background_valleys = {0.F, 0.25F};
  const std::vector<std::string> weights = {path("in.tif"), path("out.tif"), "--global",  "1,0.5",
                                            "--ridges",     "0.5,1",         "--valleys", "0,0.25"};
  const auto made = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = weights;
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(generalize_file(arguments).status, 0);
    return read_raster_file(path("out.tif")).cells;
  };
  const auto expected = [&](CurvatureForm form, float full, float blur, float exponent) {
    GeneralizeParameters p = bands;
    p.curvature = form;
    p.full_curvature = full;
    p.blur_cells = blur;
    p.exponent = exponent;
    return generalize(ground.cells, {100.0, 100.0}, {}, p, silent_progress());
  };
  const Grid<float> usual = made({});
  EXPECT_EQ(usual, expected(CurvatureForm::bounded, 0.F, 1.F, 1.F));
  const std::vector<std::pair<std::vector<std::string>, Grid<float>>> cases = {
      {{"--curvature", "plan"}, expected(CurvatureForm::plan, 0.F, 1.F, 1.F)},
      {{"--full-curvature", "0.4"}, expected(CurvatureForm::bounded, 0.4F, 1.F, 1.F)},
      {{"--blur", "2.5"}, expected(CurvatureForm::bounded, 0.F, 2.5F, 1.F)},
      {{"--exponent", "0.5"}, expected(CurvatureForm::bounded, 0.F, 1.F, 0.5F)}};
  for (const auto& [options, terrain] : cases) {
    EXPECT_EQ(made(options), terrain) << options[0];
    EXPECT_NE(terrain, usual) << options[0];
  }
}

TEST_F(GeneralizeCommand, AMaskKeepsWhatItCovers) {
  write_raster(path("in.tif"), hills());
  Raster<float> mask = hills();
  for (const auto [x, y] : test::cells(70, 53)) mask.cells(x, y) = x < 35 ? 0.F : 255.F;
  write_raster(path("mask.tif"), mask);
  ASSERT_EQ(generalize_file({path("in.tif"), path("masked.tif"), "--global", "1,1,0", "--mask",
                             path("mask.tif")})
                .status,
            0);
  ASSERT_EQ(generalize_file({path("in.tif"), path("whole.tif"), "--global", "1,1,0"}).status, 0);
  const Grid<float> masked = read_raster_file(path("masked.tif")).cells;
  const Grid<float> whole = read_raster_file(path("whole.tif")).cells;
  for (int y = 0; y < 53; ++y) {
    for (int x = 0; x < 20; ++x) ASSERT_EQ(masked(x, y), hills().cells(x, y));
    for (int x = 50; x < 70; ++x) ASSERT_EQ(masked(x, y), whole(x, y));
  }
  EXPECT_GT(std::abs(whole(10, 20) - hills().cells(10, 20)) +
                std::abs(whole(11, 20) - hills().cells(11, 20)),
            5.F);
}

TEST_F(GeneralizeCommand, WhatIsWrongIsSaidByTheExitStatus) {
  const std::string in = write_hills("in.tif");
  const std::string out = path("out.tif");
  const auto expect = [&](int status, const std::vector<std::string>& arguments,
                          const std::string& says) {
    EXPECT_THAT(generalize_file(arguments), Ends(status, HasSubstr(says)))
        << fmt::format("{}", fmt::join(arguments, " "));
    EXPECT_FALSE(std::filesystem::exists(out));
  };
  expect(2, {in, out}, "--preset NAME");
  expect(2, {in, out, "--preset", "figure9"}, "figure9");
  expect(2, {in, out, "--global", "1,6"}, "0 … 5");
  expect(2, {in, out, "--global", "1,x"}, "--global");
  expect(2, {in, out, "--global", "1,1", "--ridges", "0,0,1"}, "3 weights");
  expect(2, {in, out, "--global", "1,1", "--background-global", "1"}, "1 weights");
  expect(2, {in, out, "--preset", "figure4"}, "--viewer");
  expect(2, {in, path("out.jpg"), "--global", "1,1"}, ".tif or .asc");
  expect(3, {path("none.tif"), out, "--global", "1,1"}, "none.tif");
  expect(3, {in, out, "--global", "1,1", "--mask", path("none.tif")}, "none.tif");
  expect(4, {in, write("file", "x") + "/out.tif", "--global", "1,1"}, "file");
}

TEST_F(GeneralizeCommand, HasTheSameBytesForAnyNumberOfThreads) {
  const std::string in = write_hills("in.tif");
  for (const std::string threads : {"1", "2"}) {
    const Outcome outcome =
        generalize_file({in, path(threads + ".tif"), "--preset", "panorama", "--viewer",
                         "680000,5255000", "--distances", "1000,5000", "--threads", threads});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  EXPECT_EQ(read_bytes(path("1.tif")), read_bytes(path("2.tif")));
}

TEST_F(GeneralizeCommand, DegreesCountAsTheGroundTheyCover) {
  const Raster<float> geographic = hills("EPSG:4326", 0.001);
  write_raster(path("in.tif"), geographic);
  ASSERT_THAT(run({"generalize", path("in.tif"), path("out.tif"), "--change-lakes", "--preset",
                   "smooth_slopes"}),
              Ends(0, AllOf(HasSubstr("m on the ground"),
                            HasSubstr("75"))));  // 0.001° at 47.5° N: 75 × 111 m
  const Raster<float> after = read_raster_file(path("out.tif"));
  EXPECT_EQ(after.transform, geographic.transform);
  EXPECT_TRUE(info_of(path("out.tif")).geographic);
  EXPECT_NE(after.cells, geographic.cells);
  EXPECT_THAT(run({"generalize", path("in.tif"), path("no.tif"), "--preset", "smooth_slopes",
                   "--widen-valleys", "100"}),
              Ends(2, HasSubstr("gdalwarp")));
}

TEST_F(GeneralizeCommand, WhereTheMaskIsZeroNothingChangesWhateverActs) {
  Raster<float> dem;
  dem.transform = {680000.0, 5260000.0, 100.0, 100.0};
  dem.crs = normalize_crs("EPSG:32632");
  dem.cells = Grid<float>(120, 150);
  Raster<float> mask = dem;
  for (const auto [x, y] : test::cells(120, 150)) {
    dem.cells(x, y) = static_cast<float>(900.0 + 12.0 * std::abs(x - 60) + 2.0 * (150 - y) +
                                         20.0 * std::sin(x * 1.9) * std::cos(y * 1.3));
    mask.cells(x, y) = y < 70 ? 0.F : 255.F;
  }
  write_raster(path("in.tif"), dem);
  write_raster(path("mask.tif"), mask);
  for (const std::vector<std::string>& what :
       {std::vector<std::string>{"--global", "1,1", "--line-integral"},
        {"--global", "1,1", "--widen-valleys", "600"},
        {"--global", "1,1", "--base", "1.2"},
        {"--global", "1.5,2,0", "--line-integral", "--widen-valleys", "600"}}) {
    SCOPED_TRACE(testing::PrintToString(what));
    std::vector<std::string> arguments = {path("in.tif"), path("out.tif"), "--mask",
                                          path("mask.tif")};
    arguments.insert(arguments.end(), what.begin(), what.end());
    ASSERT_THAT(generalize_file(arguments), Ends(0));
    const Raster<float> out = read_raster_file(path("out.tif"));
    double changed = 0.0;
    for (const auto [x, y] : test::cells(120, 150)) {
      if (y < 70) {
        ASSERT_EQ(out.cells(x, y), dem.cells(x, y)) << x << ' ' << y;
      }
      changed = std::max(changed, static_cast<double>(std::abs(out.cells(x, y) - dem.cells(x, y))));
    }
    EXPECT_GT(changed, 20.0);
  }
}

}  // namespace
}  // namespace belvedere
