#include "renderer/sheet/guidance_pack.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/guidance_buffers.h"
#include "renderer/image/guidance_io.h"
#include "renderer/stages/lit_picture.h"
#include "tests/files.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

// A file written from packed guidance is the file of the guidance itself.
TEST(GuidancePack, KeepsAllThatTheFileKeeps) {
  const World world = make_world(test::small_scene(), silent_progress());
  const GuidanceBuffers guidance =
      make_lit_picture(world, read_palette("summer"), {0, 0, 96, 80}, {}).guidance;
  const GuidanceBuffers back = unpack_guidance(pack_guidance(guidance), guidance);
  const test::Folder folder;
  write_guidance(folder / "a.exr", guidance, {});
  write_guidance(folder / "b.exr", back, {});
  EXPECT_TRUE(test::read_bytes(folder / "a.exr") == test::read_bytes(folder / "b.exr"));
  EXPECT_EQ(back.origin_m, guidance.origin_m);
}

TEST(GuidancePack, ASheetsGuidanceHasTheChannelsOfTracingAndLight) {
  const World world = make_world(test::small_scene(), silent_progress());
  const GuidanceBuffers guidance =
      make_lit_picture(world, read_palette("summer"), {0, 0, 96, 80}, {}).guidance;
  const GuidanceBuffers like = sheet_guidance_like(guidance.origin_m);
  for (const GuidanceChannel& channel : guidance_channels())
    std::visit(
        [&](auto member) {
          EXPECT_EQ((like.*member).empty(), (guidance.*member).empty()) << channel.names[0];
        },
        channel.member);
  EXPECT_EQ(blank_packed(like, 5, 4).planes.size(), pack_guidance(guidance).planes.size());
}

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
