// choose_frame of terrain/io/raster_io.h. The choice of coordinate systems for degrees, feet and
// Web Mercator is tested in raster_io_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <string>

#include "terrain/io/raster_io.h"
#include "tests/terrain/io/raster_files.h"

namespace belvedere {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Frame : public RasterFiles {
 protected:
  // A file of 40 × 30 cells whose corner is not at whole numbers.
  RasterSource file(const std::string& name, double east = 500007.0, double north = 5200003.0,
                    double cell_m = 100.0) const {
    write_raster(path(name), Raster<float>{Grid<float>(40, 30, 1.F),
                                           {east, north, cell_m, cell_m},
                                           normalize_crs("EPSG:32632")});
    RasterSource source;
    source.path = path(name);
    return source;
  }
  using Extent = std::optional<std::array<double, 4>>;
};

TEST_F(Frame, OfOneMetricFileIsTheFilesOwn) {
  const RasterFrame frame = choose_frame({file("a.tif")}, "", 0.0, {});
  EXPECT_EQ(frame.transform, (GeoTransform{500007.0, 5200003.0, 100.0, 100.0}));
  EXPECT_EQ(frame.width, 40);
  EXPECT_EQ(frame.height, 30);
  EXPECT_EQ(describe_crs(frame.crs), "EPSG:32632");
}

TEST_F(Frame, HoldsAllFilesOnTheLatticeOfTheFinest) {
  // 4 km of 100 m from E 500007, 2 km of 50 m from E 504007; the finest one's cells are used.
  const RasterFrame frame =
      choose_frame({file("a.tif"), file("b.tif", 504007.0, 5200003.0, 50.0)}, "", 0.0, {});
  EXPECT_EQ(frame.transform, (GeoTransform{500007.0, 5200003.0, 50.0, 50.0}));
  EXPECT_EQ(frame.width, 120);
  EXPECT_EQ(frame.height, 60);
}

TEST_F(Frame, OtherCellsLieOnRoundPlacesAndHoldAll) {
  const RasterFrame frame = choose_frame({file("a.tif")}, "", 250.0, {});
  EXPECT_EQ(frame.transform, (GeoTransform{500000.0, 5200250.0, 250.0, 250.0}));
  EXPECT_EQ(frame.width, 17);   // to E 504250, the file ends at 504007
  EXPECT_EQ(frame.height, 13);  // to N 5197000, the file ends at 5197003
}

TEST_F(Frame, AnExtentGrowsToWholeCells) {
  const RasterFrame frame =
      choose_frame({file("a.tif")}, "", 0.0, Extent{{500150.0, 5198000.0, 500207.0, 5199003.0}});
  EXPECT_EQ(frame.transform.origin_x, 500107.0);
  EXPECT_EQ(frame.transform.origin_y, 5199003.0);
  EXPECT_EQ(frame.width, 1);
  EXPECT_EQ(frame.height, 11);
}

TEST_F(Frame, RefusesExtentsOfNothing) {
  const RasterSource source = file("a.tif");
  EXPECT_THAT(test::usage_error([&] {
                choose_frame({source}, "", 0.0, Extent{{2.0, 1.0, 1.0, 2.0}});
              }),
              HasSubstr("has no area"));
  EXPECT_THAT(test::input_error([&] {
                choose_frame({source}, "", 0.0, Extent{{1.0, 1.0, 2.0, 2.0}});
              }),
              AllOf(HasSubstr("outside the data"), HasSubstr("E 500007…504007"),
                    HasSubstr("N 5197003…5200003")));
}

TEST_F(Frame, RefusesNoFilesMapsThatStretchAndTooManyCells) {
  EXPECT_THAT(test::usage_error([] { choose_frame({}, "", 0.0, {}); }), HasSubstr("at least one"));
  const RasterSource source = file("a.tif");
  EXPECT_THAT(test::usage_error([&] { choose_frame({source}, "EPSG:3857", 0.0, {}); }),
              AllOf(HasSubstr("distorts distances"), HasSubstr("EPSG:32632")));
  EXPECT_THAT(test::message_of(ErrorKind::limit, [&] { choose_frame({source}, "", 0.001, {}); }),
              AllOf(HasSubstr("a.tif"), HasSubstr("cell_m")));
}

}  // namespace
}  // namespace belvedere
