#include "tools/cli/elevation_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/files.h"
#include "tests/tools/read_options.h"

namespace belvedere::tools {
namespace {

TEST(ElevationOptions, SayWhatASceneSaysOfItsSources) {
  const auto read = [](const std::string& line) {
    return elevation_source("a.nc",
                            test::read_options<ElevationOptions>(add_elevation_options, line));
  };
  const RasterSource source = read("--encoding mapbox --variable height");
  EXPECT_EQ(source.path, "a.nc");
  EXPECT_EQ(source.encoding, "mapbox");
  EXPECT_EQ(source.variable, "height");
  EXPECT_EQ(read("").encoding, "");
  EXPECT_THAT(test::message_of(ErrorKind::usage, [&] { read("--encoding png"); }),
              testing::HasSubstr("terrarium"));
}

}  // namespace
}  // namespace belvedere::tools
