// `belvedere man` as users meet it; what stands in the page is tested in man_page_test.cpp.
#include <gtest/gtest.h>

#include "renderer/image/provenance.h"
#include "tests/tools/program.h"
#include "tools/cli/man_page.h"
#include "tools/cli/program.h"

namespace belvedere {
namespace {

TEST_F(Program, ManPrintsThePage) {
  EXPECT_EQ(run({"man"}).out,
            tools::man_page(tools::describe_program(), "belvedere " + program_version()));
}

}  // namespace
}  // namespace belvedere
