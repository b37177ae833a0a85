#include "renderer/pipeline/output_colour.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/files.h"
#include "tests/renderer/image/icc/press_profile.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(OutputColour, IsSrgbWhereTheSceneSaysNothing) {
  const OutputColour colour = read_output_colour(test::small_scene());
  EXPECT_THAT(colour.profile, IsEmpty());
  EXPECT_EQ(colour.display.config, "");
}

TEST(OutputColour, BadFilesAreNamedBeforeTheWork) {
  const test::Folder folder;
  folder.write("printer.icc", "no profile");
  folder.write("show.ocio", "no config: [");
  const auto refused = [&](const std::string& setting) {
    return test::message_of(
        ErrorKind::input, [&] { read_output_colour(test::small_scene({setting}, folder.path())); });
  };
  EXPECT_THAT(refused("output.profile=printer.icc"), HasSubstr("printer.icc"));
  EXPECT_THAT(refused("output.ocio_config=show.ocio"), HasSubstr("show.ocio"));
}

TEST(OutputColour, TakesSpacesByNameAndPresses) {
  const OutputColour p3 = read_output_colour(test::small_scene({"output.colours=display-p3"}));
  EXPECT_EQ(p3.profile, colour_space_profile("display-p3"));
  const test::Folder folder;
  const std::vector<std::uint8_t> bytes = test::press_profile();
  folder.write("press.icc", std::string(bytes.begin(), bytes.end()));
  const OutputColour press =
      read_output_colour(test::small_scene({"output.profile=press.icc", "output.intent=relative",
                                            "output.black_point=false", "output.ink_limit=280"},
                                           folder.path()));
  EXPECT_EQ(press.profile, test::press_profile());
  EXPECT_EQ(press.device.intent, RenderingIntent::relative);
  EXPECT_FALSE(press.device.black_point);
  EXPECT_EQ(press.ink_limit_percent, 280.0);
  const auto both = [&] {
    read_output_colour(
        test::small_scene({"output.colours=adobe-rgb", "output.profile=press.icc"}, folder.path()));
  };
  EXPECT_THAT(test::message_of(ErrorKind::usage, both), HasSubstr("output.profile"));
}

}  // namespace
}  // namespace belvedere
