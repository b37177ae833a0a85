#include "base/guidance_buffers.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <type_traits>

#include "tests/files.h"
#include "tests/paths.h"

namespace belvedere {
namespace {

using B = GuidanceBuffers;
using testing::HasSubstr;

template <class T>
constexpr std::size_t parts_of = std::is_same_v<T, glm::vec3>   ? 3
                                 : std::is_same_v<T, glm::vec2> ? 2
                                                                : 1;

TEST(GuidanceChannels, EachHasANameForEveryComponentAndOneMember) {
  std::set<std::string_view> names;
  std::set<GuidanceMember> members;
  for (const GuidanceChannel& channel : guidance_channels()) {
    const std::size_t components = std::visit(
        [](auto member) {
          return parts_of<typename std::decay_t<decltype(B{}.*member)>::value_type>;
        },
        channel.member);
    EXPECT_EQ(channel.components(), components) << channel.names[0];
    for (std::size_t k = 0; k < components; ++k)
      EXPECT_TRUE(names.insert(channel.names[k]).second) << channel.names[k];
    EXPECT_FALSE(channel.meaning.empty()) << channel.names[0];
    EXPECT_EQ(&channel_of(channel.member), &channel) << channel.names[0];
  }
}

TEST(GuidanceChannels, IdsAreWholeNumbersInTheFileAndOnlyThey) {
  for (const GuidanceChannel& channel : guidance_channels()) {
    const bool id = std::holds_alternative<Grid<LandCoverClass> B::*>(channel.member) ||
                    std::holds_alternative<Grid<std::uint32_t> B::*>(channel.member);
    EXPECT_EQ(channel.type == ChannelStorage::uint32, id) << channel.names[0];
  }
}

TEST(GuidanceChannels, PartsOfTheFileHangTogether) {
  std::set<std::string_view> closed;
  std::string_view open;
  for (const GuidanceChannel& channel : guidance_channels()) {
    if (channel.part != open) {
      EXPECT_TRUE(closed.insert(channel.part).second) << channel.part << " stands in two places";
    }
    open = channel.part;
  }
}

// The file format is public: the meaning of a name must not change.
TEST(GuidanceChannels, KeepTheNamesThatFilesHaveHad) {
  std::string all;
  for (const GuidanceChannel& channel : guidance_channels())
    for (std::size_t k = 0; k < channel.components(); ++k)
      all += std::string(channel.part) + "/" + std::string(channel.names[k]) + " ";
  for (const char* name : {"depth/Z ",
                           "depth/coverage.A ",
                           "depth/front.A ",
                           "depth/silhouette.V ",
                           "depth/footprint.V ",
                           "position/P.X ",
                           "position/P.Z ",
                           "position/altitude.V ",
                           "normal/N.X ",
                           "normal/Nd.Y ",
                           "normal/Ns.Z ",
                           "class/landcover.id ",
                           "terrain/slope.V ",
                           "terrain/aspect.V ",
                           "terrain/fallline.Y ",
                           "terrain/ridge.V ",
                           "terrain/relief.S ",
                           "terrain/relief.M ",
                           "terrain/relief.L ",
                           "terrain/valley.V ",
                           "terrain/rim.V ",
                           "terrain/built.V ",
                           "terrain/grain.X ",
                           "light/shadow.V ",
                           "light/skyview.V ",
                           "light/tone.V ",
                           "base/base.R ",
                           "paint/painted.id ",
                           "paint/painted.from ",
                           "paint/stroke.id ",
                           "paint/ground.from "})
    EXPECT_THAT(all, HasSubstr(name));
}

// The table in Markdown, with a header and one row per grid.
std::string describe_guidance_channels() {
  std::string out = "| channel | unit | meaning |\n|---|---|---|\n";
  for (const GuidanceChannel& channel : guidance_channels()) {
    std::string names;
    for (std::size_t k = 0; k < channel.components(); ++k)
      names += fmt::format("{}{}", k == 0 ? "" : " ", channel.names[k]);
    const bool rare = channel.maker == ChannelMaker::strokes;
    out += fmt::format("| `{}` | {} | {}{} |\n", names, channel.unit, channel.meaning,
                       rare ? " (example paintings only)" : "");
  }
  return out;
}

TEST(GuidanceChannels, DocsHaveTheTable) {
  EXPECT_THAT(test::read_bytes(test::source_folder() + "/docs/guidance.md"),
              HasSubstr("\n\n" + describe_guidance_channels() + "\n"))
      << "put this table into docs/guidance.md";
}

TEST(GuidanceChannels, WhatIsMissingIsNamedWithItsStageAndItsMaker) {
  GuidanceBuffers g;
  g.depth_m = Grid<float>(4, 3, 1000.F);
  g.tone = Grid<float>(4, 3, 0.5F);
  EXPECT_NO_THROW(require_channels(g, {&B::depth_m, &B::tone}, "strokes"));
  const auto refused = [&](GuidanceMember member, ErrorKind kind) -> std::string {
    try {
      require_channels(g, {&B::depth_m, member}, "strokes", kind);
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), kind);
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(refused(&B::slope_deg, ErrorKind::bug),
              testing::AllOf(HasSubstr("strokes"), HasSubstr("no channel slope.V"),
                             HasSubstr("trace_guidance")));
  EXPECT_THAT(refused(&B::land_cover, ErrorKind::input), HasSubstr("landcover.id"));
  g.slope_deg = Grid<float>(3, 3);
  EXPECT_THAT(refused(&B::slope_deg, ErrorKind::bug),
              testing::AllOf(HasSubstr("3 × 3"), HasSubstr("4 × 3")));
  g = {};
  EXPECT_THAT(refused(&B::depth_m, ErrorKind::bug), HasSubstr("no channel Z"))
      << "an empty picture has nothing";
}

TEST(GuidanceChannels, AreFilledWithOneValue) {
  GuidanceBuffers g;
  for (const GuidanceChannel& channel : guidance_channels())
    fill_channel(g, channel, 2, 2, channel.sky);
  EXPECT_TRUE(g.is_sky(0));
  EXPECT_EQ(g.normal_detail[3], glm::vec3(0.F, 0.F, 1.F));
  EXPECT_EQ(g.land_cover[2], LandCoverClass::sky);
  EXPECT_EQ(g.sky_view[1], 1.F);
  EXPECT_EQ(g.grain[1], glm::vec2(0.F));
  for (const GuidanceChannel& channel : guidance_channels())
    EXPECT_TRUE(has_channel(g, channel.member)) << channel.names[0];
}

}  // namespace
}  // namespace belvedere
