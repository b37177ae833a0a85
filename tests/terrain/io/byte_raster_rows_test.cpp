#include "terrain/io/byte_raster_rows.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "base/random.h"
#include "tests/files.h"

namespace belvedere {
namespace {

ByteRasterLayout layout(int bands) {
  ByteRasterLayout made{
      .frame = {{1000.0, 2000.0, 5.0, 4.0}, 300, 550, normalize_crs("EPSG:32632")}};
  for (int i = 0; i < bands; ++i) made.bands.push_back({"band " + std::to_string(i), 1.0});
  return made;
}
std::uint8_t value(int band, int x, int y) {
  return static_cast<std::uint8_t>(random_bits(static_cast<std::uint64_t>(band), x, y) % 200 + 1);
}

std::vector<Grid<std::uint8_t>> rows(int bands, int y0, int count) {
  std::vector<Grid<std::uint8_t>> out;
  for (int b = 0; b < bands; ++b) {
    Grid<std::uint8_t>& grid = out.emplace_back(300, count);
    for (int y = 0; y < count; ++y)
      for (int x = 0; x < 300; ++x) grid(x, y) = value(b, x, y0 + y);
  }
  return out;
}

TEST(ByteRasterRows, RowsComeBackAsTheyWere) {
  const test::Folder folder;
  ByteRasterRows file(folder / "a.tif", layout(3));
  for (int y0 = 0; y0 < 550; y0 += 200) file.write(y0, rows(3, y0, std::min(200, 550 - y0)));
  file.commit();
  EXPECT_EQ(folder.count(), 1U);
  for (int b = 0; b < 3; ++b) {
    RasterSource source;
    source.path = folder / "a.tif";
    source.band = b + 1;
    const Raster<std::int32_t> back = read_codes(source);
    EXPECT_EQ(back.transform, (GeoTransform{1000.0, 2000.0, 5.0, 4.0}));
    for (int y = 0; y < 550; ++y)
      for (int x = 0; x < 300; ++x) ASSERT_EQ(back.cells(x, y), value(b, x, y));
  }
}

TEST(ByteRasterRows, WithoutCommitTheOldFileStays) {
  const test::Folder folder;
  folder.write("a.tif", "old");
  {
    ByteRasterRows file(folder / "a.tif", layout(1));
    file.write(0, rows(1, 0, 550));
    file.prepare();
  }
  EXPECT_EQ(test::read_bytes(folder / "a.tif"), "old");
  EXPECT_EQ(folder.count(), 1U);
}

TEST(ByteRasterRows, RefusesGapsAndPlacesThatAreNone) {
  const test::Folder folder;
  ByteRasterRows file(folder / "a.tif", layout(1));
  EXPECT_THROW(file.write(10, rows(1, 10, 5)), Error);
  EXPECT_THROW(file.commit(), Error);
  EXPECT_THROW(ByteRasterRows(folder / "no/such/a.tif", layout(1)), Error);
  EXPECT_THROW(ByteRasterRows(folder / "a.png", layout(1)), Error);
}

}  // namespace
}  // namespace belvedere
