#include "renderer/sheet/guidance_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/sheet/guidance_pack.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(GuidanceChoice, NamesChannelsOfASheet) {
  EXPECT_THAT(*read_guidance_choice("Z,landcover.id"), ElementsAre("Z", "landcover.id"));
  EXPECT_TRUE(read_guidance_choice("none")->empty());
  for (const char* wrong : {"", "Z,", "Z,,N.X", "depth", "landcover", "none,Z", "z"}) {
    const std::string message =
        test::message_of(ErrorKind::usage, [&] { read_guidance_choice(wrong); });
    EXPECT_THAT(message, HasSubstr("landcover.id")) << wrong;
    EXPECT_THAT(message, HasSubstr("none")) << wrong;
  }
}

TEST(GuidanceChoice, KeepsWholeVectorsAndNothingElse) {
  GuidanceBuffers guidance = sheet_guidance_like({});
  keep_chosen(guidance, std::nullopt);
  EXPECT_EQ(guidance.normal, sheet_guidance_like({}).normal);
  EXPECT_FALSE(guidance.depth_m.empty());
  keep_chosen(guidance, read_guidance_choice("N.Y,Z"));
  EXPECT_FALSE(guidance.depth_m.empty());
  EXPECT_FALSE(guidance.normal.empty());
  EXPECT_TRUE(guidance.land_cover.empty());
  EXPECT_TRUE(guidance.altitude_m.empty());
  keep_chosen(guidance, read_guidance_choice("none"));
  EXPECT_TRUE(guidance.depth_m.empty() && guidance.normal.empty());
}

}  // namespace
}  // namespace belvedere
