#include "tools/cli/print_result.h"

#include <gtest/gtest.h>

#include "tests/files.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

TEST(RunOptions, AreReadFromTheLine) {
  CommandLine line("program", "tests");
  RunOptions options;
  add_run_options(line.options(), options);
  line.read({"--threads", "2", "-q", "--json"});
  EXPECT_EQ(options.threads, 2);
  EXPECT_TRUE(options.quiet);
  EXPECT_TRUE(options.json);
  EXPECT_EQ(test::error_of([&] { line.read({"--threads", "5000"}); }).kind(), ErrorKind::usage);
}

}  // namespace
}  // namespace belvedere::tools
