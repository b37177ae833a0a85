#include "tools/options/run_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/files.h"
#include "tests/tools/read_options.h"

namespace belvedere::tools {
namespace {

RunOptions read_run_options(const std::string& line) {
  return test::read_options<RunOptions>(
      [](CommandOptions& command, RunOptions& options) { add_run_options(command, options); },
      line);
}

TEST(RunOptions, AreThreadsQuietAndJson) {
  const RunOptions none = read_run_options("");
  EXPECT_EQ(none.threads, 0);
  EXPECT_FALSE(none.quiet || none.json);
  const RunOptions all = read_run_options("--threads 3 -q --json");
  EXPECT_EQ(all.threads, 3);
  EXPECT_TRUE(all.quiet && all.json);
  EXPECT_TRUE(read_run_options("--quiet").quiet);
  EXPECT_THAT(test::message_of(ErrorKind::usage, [] { read_run_options("--threads -1"); }),
              testing::HasSubstr("--threads"));
}

}  // namespace
}  // namespace belvedere::tools
