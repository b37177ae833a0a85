#include "tools/cli/contact/scene_sweep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/files.h"

namespace belvedere::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(SceneSweep, CommasSeparateValuesOutsideOfBracketsAndQuotes) {
  const SceneSweep sweep = split_sweep({"output.width=600", "generalize.foreground=[1,1],[1.5,0.5]",
                                        "title='a, b'", "palette=\"summer\",'winter'"});
  EXPECT_THAT(sweep.settings, ElementsAre("output.width=600", "title='a, b'"));
  ASSERT_EQ(sweep.axes.size(), 2U);
  EXPECT_EQ(sweep.axes[0].key, "generalize.foreground");
  EXPECT_THAT(sweep.axes[0].values, ElementsAre("[1,1]", "[1.5,0.5]"));
  EXPECT_THAT(sweep.axes[1].values, ElementsAre("\"summer\"", "'winter'"));
  EXPECT_THAT(split_sweep({"a={ x = 1, y = 2 },{ x = 2 }"}).axes[0].values,
              ElementsAre("{ x = 1, y = 2 }", "{ x = 2 }"));
}

TEST(SceneSweep, WhatIsNoSweepIsRefused) {
  const auto refusal = [](const std::vector<std::string>& settings) {
    return test::message_of(ErrorKind::usage, [&] { split_sweep(settings); });
  };
  EXPECT_THAT(refusal({}), HasSubstr("several values"));
  EXPECT_THAT(refusal({"a=1", "b=[1,2]"}), HasSubstr("several values"));
  EXPECT_THAT(refusal({"a=1,2", "b=1,2", "c=1,2"}), HasSubstr("one or two"));
  EXPECT_THAT(refusal({"a=1,2,1"}), HasSubstr("1 twice"));
  EXPECT_THAT(refusal({"a=1,"}), HasSubstr("empty"));
}

}  // namespace
}  // namespace belvedere::tools
