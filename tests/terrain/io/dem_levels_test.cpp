#include "terrain/io/dem_levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"
#include "base/pyramid.h"
#include "terrain/io/raster_io.h"
#include "tests/grids.h"
#include "tests/terrain/io/raster_files.h"

namespace belvedere {
namespace {

// Values that smoothing does not make equal by chance.
float rough_value(int x, int y) {
  return static_cast<float>(900.0 + 37.0 * std::sin(0.7 * x) * std::cos(0.45 * y) +
                            3.0 * ((x * 7 + y * 13) % 11));
}

Grid<float> reduce_in_strips(const Grid<float>& grid, int rows) {
  DemRowReducer reducer(grid.width(), grid.height());
  Grid<float> out((grid.width() + 1) / 2, (grid.height() + 1) / 2);
  int made = 0;
  for (int y = 0; y < grid.height(); y += rows) {
    const Grid<float> part =
        reducer.push(part_of(grid, {0, y, grid.width(), std::min(y + rows, grid.height())}));
    for (int row = 0; row < part.height(); ++row, ++made)
      std::copy_n(part.row(row), part.width(), out.row(made));
  }
  EXPECT_EQ(made, out.height());
  return out;
}

TEST(DemRowReducer, EqualsReduceHoweverTheRowsCome) {
  for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(2, 2), glm::ivec2(3, 5),
                                glm::ivec2(6, 4), glm::ivec2(37, 52), glm::ivec2(40, 41)})
    for (const int rows : {1, 2, 3, 7, 100}) {
      const Grid<float> grid = test::grid_of(size.x, size.y, rough_value);
      EXPECT_EQ(reduce_in_strips(grid, rows), reduce(grid))
          << size.x << " × " << size.y << ", " << rows << " rows at once";
    }
}

TEST(DemRowReducer, VoidsTakeNoPart) {
  Grid<float> level(20, 20, 500.F);
  for (const auto [x, y] : test::cells({6, 6, 14, 14})) level(x, y) = NAN;
  const Grid<float> half = reduce_in_strips(level, 5);
  for (const auto [x, y] : test::cells(10, 10)) {
    const bool deep =
        x >= 4 && x <= 5 && y >= 4 && y <= 5;  // no known cell under the kernel, or few
    if (deep)
      EXPECT_TRUE(std::isnan(half(x, y))) << x << ' ' << y;
    else if (!std::isnan(half(x, y)))
      EXPECT_NEAR(half(x, y), 500.F, 1e-3F) << x << ' ' << y;
    else
      EXPECT_TRUE(x >= 3 && x <= 6 && y >= 3 && y <= 6) << x << ' ' << y;
  }
}

TEST(CoarsestLevel, LeavesThreeQuartersToWindows) {
  const RasterFrame frame{{0.0, 245760.0, 30.0, 30.0}, 8192, 8192, {}};
  EXPECT_EQ(coarsest_level(frame, 8192.0 * 8192.0), 0) << "it fits";
  EXPECT_EQ(coarsest_level(frame, 8192.0 * 8192.0 - 1.0), 2);
  EXPECT_EQ(coarsest_level(frame, 4.2e6), 3) << "1024² is a quarter of it";
}

class DemLevelsTest : public RasterFiles {
 protected:
  DemParameters rough_file(int width, int height) const {
    DemParameters parameters;
    parameters.sources.resize(1);
    parameters.sources[0].path =
        write_ascii("rough.asc", width, height, 600000, 5200000, 30,
                    [](int x, int y) { return std::to_string(rough_value(x, y)); });
    parameters.sources[0].crs = "EPSG:32632";
    return parameters;
  }
};

TEST_F(DemLevelsTest, WindowsAreThoseOfTheWholePyramid) {
  const DemParameters parameters = rough_file(150, 131);
  const RasterFrame frame = choose_frame(parameters.sources, "", 0.0, {});
  std::vector<Grid<float>> pyramid = {
      warp_rasters(parameters.sources, frame, silent_progress()).cells};
  for (int level = 1; level <= 3; ++level) pyramid.push_back(reduce(pyramid.back()));
  for (const double kept : {0.0, 1e9}) {
    DemLevels levels(parameters, frame, 3, kept, silent_progress());
    const Dem whole = levels.whole();
    EXPECT_EQ(whole.altitude_m, pyramid[3]);
    EXPECT_EQ(whole.halved, 3);
    for (int level = 0; level <= 3; ++level) {
      const Grid<float>& all = pyramid[static_cast<std::size_t>(level)];
      const PixelRect rects[] = {{0, 0, all.width(), all.height()},
                                 {5, 3, 17, 9},
                                 {all.width() - 7, all.height() - 6, all.width(), all.height()}};
      for (const PixelRect& rect : rects)
        EXPECT_EQ(levels.window(level, rect, whole).altitude_m, part_of(all, rect))
            << "level " << level << ", kept " << kept;
    }
  }
}

TEST_F(DemLevelsTest, CellsLieWhereTheirGroundIs) {
  // A ramp is its own mean: at every level the altitude is that of the cell's centre.
  DemParameters parameters;
  parameters.sources.resize(1);
  parameters.sources[0].crs = "EPSG:32632";
  parameters.sources[0].path = write_ascii(
      "ramp.asc", 90, 70, 600000, 5200000, 30,
      [](int x, int y) { return std::to_string(1000.0 + 4.0 * (x + 0.5) - 2.0 * (y + 0.5)); });
  const RasterFrame frame = choose_frame(parameters.sources, "", 0.0, {});
  DemLevels levels(parameters, frame, 2, 0.0, silent_progress());
  const Dem whole = levels.whole();
  for (int level = 0; level <= 2; ++level) {
    const Dem window = levels.window(level, {4, 6, 16, 15}, whole);
    for (const auto [x, y] : test::cells(window)) {
      const glm::dvec2 position = window.transform.to_crs(x, y);
      const double expected = 1000.0 + 4.0 * (position.x - 600000.0) / 30.0 -
                              2.0 * (5200000.0 + 70.0 * 30.0 - position.y) / 30.0;
      EXPECT_NEAR(window.altitude_m(x, y), expected, 2e-3) << "level " << level;
    }
  }
}

TEST_F(DemLevelsTest, VoidsOfAWindowAreFilledAsTheWholeIs) {
  DemParameters parameters;
  parameters.sources.resize(1);
  parameters.sources[0].crs = "EPSG:32632";
  parameters.sources[0].nodata = -9999;
  parameters.sources[0].path = write_ascii(
      "holes.asc", 120, 120, 600000, 5200000, 30,
      [](int x, int y) {
        return x >= 40 && x < 70 && y >= 50 && y < 80 ? std::string("-9999")
                                                      : std::to_string(1000.0 + 5.0 * x);
      },
      "-9999");
  const RasterFrame frame = choose_frame(parameters.sources, "", 0.0, {});
  DemLevels levels(parameters, frame, 2, 0.0, silent_progress());
  const Dem whole = levels.whole();
  // Entirely within the void, without a known border.
  const Dem inside = levels.window(0, {50, 60, 60, 70}, whole);
  for (const auto [x, y] : test::cells(10, 10)) {
    EXPECT_EQ(inside.filled(x, y), 1);
    EXPECT_NEAR(inside.altitude_m(x, y), 1000.0 + 5.0 * (50 + x), 30.0);
  }
  EXPECT_EQ(levels.window(0, {0, 0, 120, 120}, whole).filled(39, 60), 0);
  parameters.max_void_share = 0.01;
  EXPECT_THROW(DemLevels(parameters, frame, 2, 0.0, silent_progress()), Error);
}

TEST_F(DemLevelsTest, RasterWindowsHaveTheBitsOfTheWholeAlsoReprojected) {
  const DemParameters parameters = rough_file(160, 140);
  RasterFrame frame = choose_frame(parameters.sources, "EPSG:32633", 41.0, {});
  const Grid<float> whole = warp_rasters(parameters.sources, frame, silent_progress()).cells;
  RasterWindows windows(parameters.sources, frame);
  for (const PixelRect& rect : {PixelRect{0, 0, frame.width, frame.height},
                                PixelRect{13, 29, 70, 64}, PixelRect{50, 40, 51, 41}}) {
    const Grid<float> part = windows.read(rect);
    for (const auto [x, y] : test::cells(part)) {
      const float expected = whole(rect.x0 + x, rect.y0 + y);
      if (std::isnan(expected))
        EXPECT_TRUE(std::isnan(part(x, y)));
      else
        EXPECT_EQ(part(x, y), expected) << x << ' ' << y;
    }
  }
  EXPECT_THROW(windows.read({0, 0, frame.width + 1, 1}), Error);
}

}  // namespace
}  // namespace belvedere
