// `belvedere schema` as users meet it.
#include <gtest/gtest.h>

#include "renderer/scene/scene_file.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

TEST_F(Program, SchemaPrintsTheTwoReferences) {
  EXPECT_EQ(run({"schema"}).out, scene_json_schema());
  EXPECT_EQ(run({"schema", "--markdown"}).out, scene_reference());
}

}  // namespace
}  // namespace belvedere
