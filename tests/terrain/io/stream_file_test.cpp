// Rasters whose bytes come from a function.
#include "terrain/io/stream_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "terrain/io/crs.h"
#include "terrain/io/raster_io.h"
#include "tests/terrain/io/raster_files.h"

namespace belvedere {
namespace {

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
