#include "renderer/pipeline/output_color.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/files.h"
#include "tests/renderer/world/small_world.h"

namespace belvedere {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(OutputColor, IsSrgbWhereTheSceneSaysNothing) {
  const OutputColor color = read_output_color(test::small_scene());
  EXPECT_THAT(color.profile, IsEmpty());
  EXPECT_EQ(color.display.config, "");
}

TEST(OutputColor, BadFilesAreNamedBeforeTheWork) {
  const test::Folder folder;
  folder.write("printer.icc", "no profile");
  folder.write("show.ocio", "no config: [");
  const auto refused = [&](const std::string& setting) {
    return test::message_of(ErrorKind::input, [&] { read_output_color(test::small_scene({setting}, folder.path())); });
  };
  EXPECT_THAT(refused("output.profile=printer.icc"), HasSubstr("printer.icc"));
  EXPECT_THAT(refused("output.ocio_config=show.ocio"), HasSubstr("show.ocio"));
}

}  // namespace
}  // namespace belvedere
