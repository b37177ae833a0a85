// `belvedere completion` as users meet it; what scripts do is tested in shell_completion_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/program.h"
#include "tools/cli/program.h"
#include "tools/cli/shell_completion.h"

namespace belvedere {
namespace {

using ::testing::HasSubstr;

TEST_F(Program, CompletionPrintsTheScript) {
  for (const std::string& shell : tools::completed_shells())
    EXPECT_EQ(run({"completion", shell}).out,
              tools::shell_completion(tools::describe_program(), shell));
  EXPECT_THAT(run({"completion", "csh"}), Ends(2, HasSubstr("bash,fish,zsh")));
}

}  // namespace
}  // namespace belvedere
