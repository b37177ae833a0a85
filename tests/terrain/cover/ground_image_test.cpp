#include "terrain/cover/land_cover.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "terrain/io/raster_file.h"
#include "tests/files.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

using test::input_error;
using testing::HasSubstr;

constexpr double east = 500000.0;
constexpr double north = 5200000.0;

RasterFrame frame_of(int width, int height, double cell_m, double moved_m = 0.0) {
  return {{east + moved_m, north, cell_m, cell_m}, width, height, normalize_crs("EPSG:32632")};
}

// Red grows to the east, green to the south, blue is 77.
class GroundImage : public testing::Test {
 protected:
  std::string write(int bands, const RasterFrame& frame) const {
    const std::string path = folder_ / "image.tif";
    std::vector<Grid<std::uint8_t>> cells(static_cast<std::size_t>(bands),
                                          Grid<std::uint8_t>(frame.width, frame.height, 77));
    for (const auto [x, y] : test::cells(frame.width, frame.height)) {
      cells[0](x, y) = static_cast<std::uint8_t>(10 * x);
      if (bands > 1) cells[1](x, y) = static_cast<std::uint8_t>(8 * y);
    }
    ByteRasterRows rows(path, {.frame = frame,
                               .bands = std::vector<ByteRasterLayout::Band>(cells.size()),
                               .is_colour = bands == 3});
    rows.write(0, cells);
    rows.prepare();
    rows.commit();
    return path;
  }
  test::Folder folder_;
};

TEST_F(GroundImage, IsTheBytesOfCellsThatCoincideAndUnknownBeyond) {
  const std::string path = write(3, frame_of(20, 16, 30.0));
  const Raster<GroundColour> read =
      read_ground_image(path, frame_of(30, 16, 30.0, -150.0), true, silent_progress());
  ASSERT_EQ(read.cells.width(), 30);
  for (const auto [x, y] : test::cells(30, 16)) {
    const bool known = x >= 5 && x < 25;
    const GroundColour expected =
        known ? GroundColour(10 * (x - 5), 8 * y, 77, 255) : GroundColour(0);
    ASSERT_EQ(read.cells(x, y), expected) << x << ", " << y;
  }
}

TEST_F(GroundImage, FinerPicturesAreAveraged) {
  const Raster<GroundColour> read = read_ground_image(
      write(3, frame_of(20, 16, 30.0)), frame_of(10, 8, 60.0), true, silent_progress());
  for (const auto [x, y] : test::cells({1, 1, 9, 7})) {
    EXPECT_NEAR(read.cells(x, y).r, 20 * x + 5, 2);
    EXPECT_NEAR(read.cells(x, y).g, 16 * y + 4, 2);
  }
}

TEST_F(GroundImage, RefusesWhatIsNoPictureOfTheGround) {
  const auto refused = [](const std::string& path, double moved_m) {
    return input_error(
        [&] { read_ground_image(path, frame_of(20, 16, 30.0, moved_m), true, silent_progress()); });
  };
  const std::string colour = write(3, frame_of(20, 16, 30.0));
  EXPECT_THAT(refused(colour, 90000.0), HasSubstr("does not cover the terrain"));
  EXPECT_NO_THROW(
      read_ground_image(colour, frame_of(20, 16, 30.0, 90000.0), false, silent_progress()))
      << "a window may lie beside it";
  EXPECT_THAT(refused(write(1, frame_of(20, 16, 30.0)), 0.0), HasSubstr("red, green and blue"));
  Raster<float> high{
      Grid<float>(20, 16, 300.F), {east, north, 30.0, 30.0}, normalize_crs("EPSG:32632")};
  write_raster(folder_ / "high.tif", high);
  EXPECT_THAT(refused(folder_ / "high.tif", 0.0), HasSubstr("red, green and blue"));
}

}  // namespace
}  // namespace belvedere
