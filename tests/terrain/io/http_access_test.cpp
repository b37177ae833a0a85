#include "terrain/io/http_access.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "base/error.h"
#include "terrain/io/crs.h"
#include "terrain/io/raster_file.h"
#include "terrain/io/raster_io.h"
#include "tests/http_server.h"
#include "tests/terrain/io/raster_files.h"

// Rasters on a server started by the test: tests/http_server.py.
// Rasters whose bytes come from a function.

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class Http : public RasterFiles {
 protected:
  void SetUp() override {
    if (!test::has_python()) GTEST_SKIP() << "there is no python3 to serve files";
  }
  // Noise, so that the file is larger than a single request.
  Raster<float> write_tiff(const std::string& name = "dem.tif") const {
    Raster<float> raster{
        Grid<float>(300, 200), {500000.0, 5200000.0, 30.0, 30.0}, normalize_crs("EPSG:32632")};
    std::uint32_t state = 1;
    for (float& z : raster.cells)
      z = static_cast<float>((state = state * 1664525U + 1013904223U) >> 8U) * 1e-4F;
    write_raster(path(name), raster);
    return raster;
  }
  static RasterSource source_of(const std::string& path) {
    RasterSource source;
    source.path = path;
    return source;
  }
  HttpParameters impatient(int retries = 3) {
    return {.silence_s = 1, .retries = retries, .tell = [this](const std::string& text) {
              told_.push_back(text);
            }};
  }
  std::vector<std::string> told_;
};

TEST(HttpAddress, IsKnownAndHasNoPassword) {
  EXPECT_TRUE(is_address("https://example.org/a.tif"));
  EXPECT_TRUE(is_address("http://example.org/a.tif"));
  for (const char* file :
       {"dem/a.tif", "/vsicurl/http://example.org/a.tif", "ftp://example.org/a.tif", "http:/a"})
    EXPECT_FALSE(is_address(file)) << file;
  EXPECT_NO_THROW(check_address("https://example.org/a@b.tif"));
  EXPECT_THAT(test::usage_error([] { check_address("http:///a.tif"); }), HasSubstr("no host"));
  const std::string secret =
      test::usage_error([] { check_address("https://me:secret@example.org/a.tif"); });
  EXPECT_THAT(secret, AllOf(HasSubstr("example.org"), HasSubstr("password"),
                            ::testing::Not(HasSubstr("secret"))));
}

TEST_F(Http, NoServerIsAskedWithoutLeave) {
  write_tiff();
  const test::HttpServer server(folder_.path());
  EXPECT_FALSE(http_allowed());
  EXPECT_THAT(test::input_error([&] { read_raster(source_of(server.address("dem.tif"))); }),
              HasSubstr("--allow-http"));
  {
    const HttpAccess access({});
    EXPECT_TRUE(http_allowed());
  }
  EXPECT_FALSE(http_allowed());
}

TEST_F(Http, RastersAreReadAsIfTheyLayHere) {
  const Raster<float> raster = write_tiff();
  const test::HttpServer server(folder_.path());
  const HttpAccess access(impatient());
  const Raster<float> read = read_raster(source_of(server.address("dem.tif")));
  EXPECT_EQ(read.cells, raster.cells);
  EXPECT_EQ(read.crs, raster.crs);
  EXPECT_THAT(told_, IsEmpty());
  std::string bytes;
  const std::uint64_t size =
      read_address(server.address("dem.tif"), [&](std::string_view piece) { bytes += piece; });
  EXPECT_EQ(size, bytes.size());
  EXPECT_TRUE(bytes == read_text("dem.tif"));
}

TEST_F(Http, AnswersThatFailTwiceAreAskedForAgainAndSaidSo) {
  const Raster<float> raster = write_tiff();
  // For the file's size, twice; for its head and its middle once, since GDAL waits seconds before
  // the second.
  for (const auto& [fail, after] : {std::pair{"fail=2", "after=0"}, std::pair{"fail=1", "after=1"},
                                    std::pair{"fail=1", "after=2"}}) {
    told_.clear();
    const test::HttpServer server(folder_.path(), {fail, after});
    const HttpAccess access(impatient());
    EXPECT_EQ(read_raster(source_of(server.address("dem.tif"))).cells, raster.cells) << after;
    ASSERT_THAT(told_, SizeIs(std::string(fail) == "fail=2" ? 2U : 1U)) << after;
    EXPECT_THAT(told_[0],
                AllOf(HasSubstr("503"), HasSubstr(server.address("dem.tif")), HasSubstr("again")));
  }
}

TEST_F(Http, AServerThatFailsForGoodIsAnInputError) {
  write_tiff();
  for (const char* after : {"after=0", "after=1", "after=2"}) {
    const test::HttpServer server(folder_.path(), {"fail=1000", after});
    const HttpAccess access(impatient(0));
    const std::string raster =
        test::input_error([&] { read_raster(source_of(server.address("dem.tif"))); });
    EXPECT_THAT(raster, AllOf(HasSubstr(server.address("dem.tif")), HasSubstr("server"))) << after;
    EXPECT_EQ(
        error_of([&] { read_address(server.address("dem.tif"), [](std::string_view) {}); }).kind(),
        ErrorKind::input)
        << after;
  }
  const test::HttpServer server(folder_.path());
  const HttpAccess access(impatient());
  EXPECT_EQ(error_of([&] { read_raster(source_of(server.address("none.tif"))); }).kind(),
            ErrorKind::input);
}

TEST_F(Http, ServersThatStallOrGiveNoPartsAreInputErrors) {
  write_tiff();
  const test::HttpServer stalls(folder_.path(), {"stall"});
  const HttpAccess access(impatient(0));
  EXPECT_THAT(test::input_error([&] { read_raster(source_of(stalls.address("dem.tif"))); }),
              HasSubstr(stalls.address("dem.tif")));
  EXPECT_EQ(
      error_of([&] { read_address(stalls.address("dem.tif"), [](std::string_view) {}); }).kind(),
      ErrorKind::input);
  const test::HttpServer whole(folder_.path(), {"no-ranges"});
  EXPECT_THAT(test::input_error([&] { read_raster(source_of(whole.address("dem.tif"))); }),
              HasSubstr("range requests"));
}

TEST_F(Http, VrtsMayNameRastersOnServersButNotLieThere) {
  const Raster<float> raster = write_tiff();
  const test::HttpServer server(folder_.path());
  const auto vrt = [](const std::string& file) {
    return "<VRTDataset rasterXSize=\"300\" "
           "rasterYSize=\"200\"><SRS>EPSG:32632</SRS><GeoTransform>500000,30,0,5200000,0,-30</"
           "GeoTransform>"
           "<VRTRasterBand dataType=\"Float32\" band=\"1\"><SimpleSource><SourceFilename "
           "relativeToVRT=\"0\">" +
           file +
           "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></"
           "VRTDataset>";
  };
  const std::string remote = write_text("remote.vrt", vrt("/vsicurl/" + server.address("dem.tif")));
  EXPECT_EQ(error_of([&] { read_raster(source_of(remote)); }).kind(), ErrorKind::input);
  const HttpAccess access(impatient());
  EXPECT_EQ(read_raster(source_of(remote)).cells, raster.cells);
  EXPECT_THAT(raster_parts(remote), ElementsAre(remote, server.address("dem.tif")));
  EXPECT_EQ(error_of([&] { read_raster(source_of(server.address("remote.vrt"))); }).kind(),
            ErrorKind::input);
}

TEST_F(RasterFiles, PartsOfARasterAreAllFilesItIsReadFrom) {
  write_ascii("a.asc", 2, 2, 0, 0, 30, [](int, int) { return "1"; });
  write_text("a.prj", "PROJCS[\"x\"]");
  write_text("all.vrt",
             "<VRTDataset rasterXSize=\"2\" "
             "rasterYSize=\"2\"><GeoTransform>0,30,0,60,0,-30</GeoTransform><VRTRasterBand "
             "dataType=\"Float32\" band=\"1\"><SimpleSource><SourceFilename "
             "relativeToVRT=\"1\">a.asc</SourceFilename>"
             "<SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>");
  EXPECT_THAT(raster_parts(path("a.asc")), ElementsAre(path("a.asc"), path("a.prj")));
  EXPECT_THAT(raster_parts(path("all.vrt")),
              ElementsAre(path("all.vrt"), path("a.asc"), path("a.prj")));
}

class Streams : public RasterFiles {
 protected:
  Raster<float> write_noise() const {
    Raster<float> raster{
        Grid<float>(600, 500), {500000.0, 5200000.0, 30.0, 30.0}, normalize_crs("EPSG:32632")};
    std::uint32_t state = 1;
    for (float& z : raster.cells)
      z = static_cast<float>((state = state * 1664525U + 1013904223U) >> 8U) * 1e-4F;
    write_raster(path("noise.tif"), raster);
    return raster;
  }
  static RasterSource source_of(const StreamFile& stream) {
    RasterSource source;
    source.path = stream.path();
    return source;
  }
};

TEST_F(Streams, AreReadAsFilesAre) {
  const Raster<float> raster = write_noise();
  const std::string bytes = read_text("noise.tif");
  // Several with the same name, one after the other and at the same time.
  for (int i = 0; i < 3; ++i) {
    std::uint64_t read = 0;
    const ByteSource source{bytes.size(), [&](std::uint64_t offset, std::size_t count, char* to) {
                              read += count;
                              bytes.copy(to, count, offset);
                            }};
    const StreamFile stream("noise.tif", source);
    const StreamFile other("noise.tif", source);
    EXPECT_TRUE(is_stream(stream.path()));
    EXPECT_EQ(read_raster(source_of(stream)).cells, raster.cells);
    EXPECT_EQ(read_raster_info(source_of(other)).width, 600);
    EXPECT_GT(read, bytes.size() / 2);
    stream.rethrow();
  }
  EXPECT_FALSE(is_stream(path("noise.tif")));
}

TEST_F(Streams, WhatTheirFunctionThrowsIsKept) {
  write_noise();
  const std::string bytes = read_text("noise.tif");
  for (const std::uint64_t good : {std::uint64_t{0}, bytes.size() / 2}) {
    const StreamFile stream("noise.tif",
                            {bytes.size(), [&](std::uint64_t offset, std::size_t count, char* to) {
                               if (offset + count > good)
                                 throw std::runtime_error("the line is dead");
                               bytes.copy(to, count, offset);
                             }});
    EXPECT_EQ(error_of([&] { read_raster(source_of(stream)); }).kind(), ErrorKind::input);
    EXPECT_THROW(stream.rethrow(), std::runtime_error);
  }
}

TEST_F(Streams, EndWithTheirObject) {
  std::string name;
  {
    const StreamFile stream("a.tif", {4, [](std::uint64_t, std::size_t, char*) {}});
    name = stream.path();
  }
  RasterSource source;
  source.path = name;
  EXPECT_EQ(error_of([&] { read_raster(source); }).kind(), ErrorKind::input);
}

}  // namespace
}  // namespace belvedere
