#include "base/error.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace belvedere {
namespace {

TEST(Error, SaysWhereWhatAndWhatWouldDo) {
  const Error error(ErrorKind::usage, "alps.toml:3:7", "width = -5", "16 … 65535");
  EXPECT_STREQ(error.what(), "alps.toml:3:7: width = -5\n  allowed: 16 … 65535");
  EXPECT_EQ(error.where(), "alps.toml:3:7");
  EXPECT_EQ(error.found(), "width = -5");
  EXPECT_EQ(error.allowed(), "16 … 65535");
}

TEST(Error, LeavesOutWhatIsNotKnown) {
  EXPECT_STREQ(Error(ErrorKind::input, "dem.tif", "is damaged").what(), "dem.tif: is damaged");
  EXPECT_STREQ(Error(ErrorKind::limit, "", "out of memory").what(), "out of memory");
}

// Scripts depend on these numbers: they must not change.
TEST(Error, KindsAreExitStatuses) {
  const auto status = [](ErrorKind kind) { return Error(kind, "here", "this").exit_status(); };
  EXPECT_EQ(status(ErrorKind::usage), 2);
  EXPECT_EQ(status(ErrorKind::input), 3);
  EXPECT_EQ(status(ErrorKind::output), 4);
  EXPECT_EQ(status(ErrorKind::limit), 5);
  EXPECT_EQ(status(ErrorKind::bug), 70);
  EXPECT_EQ(status(ErrorKind::interrupted), 75);
}

TEST(Error, IsCaughtAsAnyOther) {
  try {
    throw Error(ErrorKind::output, "panorama.tif", "cannot be created");
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()), "panorama.tif: cannot be created");
  }
}

}  // namespace
}  // namespace belvedere
