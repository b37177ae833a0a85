// Rasters that are damaged, missing or replaced, and disks that are full.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <thread>

#include "terrain/io/raster_file.h"
#include "terrain/io/raster_io.h"
#include "tests/small_disk.h"
#include "tests/terrain/io/raster_files.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

class RasterFaults : public RasterFiles {};

TEST_F(RasterFaults, WritingLeavesNothingHalfDone) {
  const Raster<float> raster = make_hills(20, 10, {0.0, 0.0, 30.0, 20.0}, "EPSG:32632");
  write_text("old.asc", "the old file");
  EXPECT_EQ(error_of([&] { write_raster(path("old.asc"), raster); }).kind(),
            ErrorKind::output);  // cells are not square
  EXPECT_EQ(read_text("old.asc"), "the old file");
  EXPECT_EQ(error_of([&] { write_raster(path("no/folder/a.tif"), raster); }).kind(),
            ErrorKind::output);
  EXPECT_EQ(error_of([&] { write_raster(path("a.jpg"), raster); }).kind(), ErrorKind::output);
  EXPECT_EQ(folder_.count(), 1U);
  // Written, but cannot be renamed onto a folder: the temporary file is removed.
  std::filesystem::create_directories(path("folder.tif/full"));
  EXPECT_EQ(error_of([&] { write_raster(path("folder.tif"), raster); }).kind(), ErrorKind::output);
  std::filesystem::remove_all(path("folder.tif"));
  EXPECT_EQ(folder_.count(), 1U);
  write_raster(path("old.tif"), raster);
  EXPECT_EQ(folder_.count(), 2U);
}

TEST_F(RasterFaults, AFullDiskKeepsTheOldFile) {
  const Raster<float> raster = make_hills(60, 50, {0.0, 0.0, 30.0, 30.0}, "EPSG:32632");
  for (const char* name : {"a.tif", "a.asc"}) {
    const std::string whole = path(std::string("whole-") + name);
    write_raster(whole, raster);
    write_text(name, "the old file");
    const std::size_t files = folder_.count();
    const auto size = static_cast<rlim_t>(std::filesystem::file_size(whole));
    for (const rlim_t room : {rlim_t{0}, rlim_t{100}, size / 2, size - 1}) {
      const test::SmallDisk disk(room);
      EXPECT_EQ(error_of([&] { write_raster(path(name), raster); }).kind(), ErrorKind::output)
          << name << " " << room;
      EXPECT_EQ(read_text(name), "the old file") << name << " " << room;
      EXPECT_EQ(folder_.count(), files) << name << " " << room;
    }
  }
}

// GDAL's own words belong into the Error, or nowhere.
TEST_F(RasterFaults, DamagedTagsAreNotPrintedAbout) {
  write_raster(path("a.tif"), make_hills(20, 10, {652000.0, 5320000.0, 30.0, 30.0}, "EPSG:32632"));
  std::string bytes = read_text("a.tif");
  const std::size_t name = bytes.find("UTM zone");
  ASSERT_NE(name, std::string::npos);
  for (const std::size_t from : {name, name - 9}) {
    bytes.replace(from, 5, 5, '\0');
    write_text("a.tif", bytes);
    testing::internal::CaptureStderr();
    try {
      read_raster(source_of(path("a.tif")));
    } catch (const Error&) {
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  }
}

// Another program writes the file while it is read: every outcome but an error or one of both files
// would be wrong.
TEST_F(RasterFaults, AFileThatIsReplacedWhileItIsReadIsOneOfTheTwo) {
  const Raster<float> first = make_hills(200, 150, {0.0, 0.0, 30.0, 30.0}, "EPSG:32632");
  Raster<float> second = first;
  for (float& v : second.cells) v += 500.0F;
  write_raster(path("a.tif"), first);
  std::atomic<bool> done = false;
  std::thread writer([&] {
    for (int i = 0; i < 12; ++i) write_raster(path("a.tif"), i % 2 == 0 ? second : first);
    done = true;
  });
  int read = 0;
  while (!done) {
    const Raster<float> back = read_raster(source_of(path("a.tif")));
    EXPECT_TRUE(back.cells == first.cells || back.cells == second.cells);
    ++read;
  }
  writer.join();
  EXPECT_GT(read, 0);
}

TEST_F(RasterFaults, MissingFilesAndFoldersAreErrors) {
  EXPECT_EQ(error_of([&] { read_raster(source_of(path("none.tif"))); }).kind(), ErrorKind::input);
  EXPECT_EQ(error_of([&] { read_raster(source_of(folder_.path())); }).kind(), ErrorKind::input);
  EXPECT_EQ(error_of([&] { read_raster(source_of("/vsimem/none.tif")); }).kind(), ErrorKind::input);
  write_text("text.tif", "this is no raster");
  EXPECT_EQ(error_of([&] { read_raster(source_of(path("text.tif"))); }).kind(), ErrorKind::input);
}

TEST_F(RasterFaults, TruncatedGeoTiffIsAnErrorInItsOwnWords) {
  write_raster(path("whole.tif"), make_hills(600, 600, {0.0, 0.0, 30.0, 30.0}, "EPSG:32632"));
  const std::string whole = read_text("whole.tif");
  for (const double part : {0.001, 0.1, 0.5, 0.95}) {
    write_text("cut.tif",
               whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))));
    testing::internal::CaptureStderr();
    const Error error = error_of([&] { read_raster(source_of(path("cut.tif"))); });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");  // the library prints nothing
    EXPECT_EQ(error.kind(), ErrorKind::input) << part;
    EXPECT_THAT(error.what(), HasSubstr("cut.tif"));
  }
}

TEST_F(RasterFaults, TruncatedAsciiIsAnError) {
  write_ascii("whole.asc", 40, 40, 0, 0, 30, [](int x, int y) { return std::to_string(x + y); });
  const std::string whole = read_text("whole.asc");
  write_text("cut.asc", whole.substr(0, whole.size() / 2));
  EXPECT_EQ(error_of([&] { read_raster(source_of(path("cut.asc"))); }).kind(), ErrorKind::input);
}

TEST_F(RasterFaults, HugeSizesAreRefusedBeforeAllocating) {
  // A VRT without sources of 2^20 × 2^20 cells: 4 TiB.
  write_text(
      "huge.vrt",
      R"(<VRTDataset rasterXSize="1048576" rasterYSize="1048576"><GeoTransform>0,30,0,0,0,-30</GeoTransform>
             <VRTRasterBand dataType="Float32" band="1"/></VRTDataset>)");
  EXPECT_EQ(error_of([&] { read_raster(source_of(path("huge.vrt"))); }).kind(), ErrorKind::limit);
  write_raster(path("a.tif"), make_hills(600, 600, {0.0, 0.0, 30.0, 30.0}, "EPSG:32632"));
  EXPECT_NO_THROW(read_raster(source_of(path("a.tif"))));
  setenv("BELVEDERE_MEMORY_MIB", "1", 1);
  EXPECT_EQ(error_of([&] { read_raster(source_of(path("a.tif"))); }).kind(), ErrorKind::limit);
}

std::string vrt_of(const std::string& file) {
  return R"(<VRTDataset rasterXSize="20" rasterYSize="10"><SRS>EPSG:32632</SRS><GeoTransform>0,30,0,0,0,-30</GeoTransform>
    <VRTRasterBand dataType="Float32" band="1"><SimpleSource><SourceFilename relativeToVRT="1">)" +
         file +
         R"(</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>)";
}

TEST_F(RasterFaults, VrtOnlyWhereItIsNamedSoAndItsSourcesOpen) {
  const Raster<float> raster = make_hills(20, 10, {0.0, 0.0, 30.0, 30.0}, "EPSG:32632");
  write_raster(path("a.tif"), raster);
  write_text("good.vrt", vrt_of("a.tif"));
  EXPECT_EQ(read_raster(source_of(path("good.vrt"))).cells, raster.cells);

  write_text("hidden.tif", vrt_of("a.tif"));
  const Error hidden = error_of([&] { read_raster(source_of(path("hidden.tif"))); });
  EXPECT_EQ(hidden.kind(), ErrorKind::input);
  EXPECT_THAT(hidden.what(), HasSubstr("VRT"));

  write_text("missing.vrt", vrt_of("none.tif"));
  const Error missing = error_of([&] { read_raster(source_of(path("missing.vrt"))); });
  EXPECT_EQ(missing.kind(), ErrorKind::input);
  EXPECT_THAT(missing.what(), HasSubstr("none.tif"));

  write_text("nested.vrt", vrt_of("missing.vrt"));
  EXPECT_EQ(error_of([&] { read_raster(source_of(path("nested.vrt"))); }).kind(), ErrorKind::input);
  write_text("circle.vrt", vrt_of("circle.vrt"));
  EXPECT_EQ(error_of([&] { read_raster(source_of(path("circle.vrt"))); }).kind(), ErrorKind::input);
  write_text("in_hidden.vrt", vrt_of("hidden.tif"));
  EXPECT_EQ(error_of([&] { read_raster(source_of(path("in_hidden.vrt"))); }).kind(),
            ErrorKind::input);
  write_text("remote.vrt", vrt_of("/vsicurl/http://127.0.0.1:9/a.tif"));
  EXPECT_EQ(error_of([&] { read_raster(source_of(path("remote.vrt"))); }).kind(), ErrorKind::input);

  const std::string whole = read_text("a.tif");
  write_text("cut.tif", whole.substr(0, whole.size() - 100));
  write_text("cut.vrt", vrt_of("cut.tif"));
  EXPECT_EQ(error_of([&] { read_raster(source_of(path("cut.vrt"))); }).kind(), ErrorKind::input);
}

}  // namespace
}  // namespace belvedere
