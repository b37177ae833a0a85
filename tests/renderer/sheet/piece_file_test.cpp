#include "renderer/sheet/piece_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "base/guidance_buffers.h"
#include "renderer/image/exr/compositing_file.h"
#include "renderer/image/guidance_io.h"
#include "renderer/stages/lit_picture.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

const PieceKey key{"0123", "panorama", {10, 20, 17, 25}};

struct Values {
  Grid<float> light = Grid<float>(7, 5);
  Grid<std::uint8_t> id = Grid<std::uint8_t>(7, 5);
  Values() {
    for (std::size_t i = 0; i < light.size(); ++i) {
      light[i] = 0.5F * static_cast<float>(i);
      id[i] = static_cast<std::uint8_t>(i);
    }
  }
  Planes planes() { return {plane_of(light), plane_of(id)}; }
};

class PieceFile : public testing::Test {
 protected:
  PieceFile() { write_piece(path_, key, values_.planes()); }
  test::Folder folder_;
  std::string path_ = folder_ / "a.piece";
  Values values_;
};

TEST_F(PieceFile, RowsComeBackWhereTheyBelong) {
  EXPECT_TRUE(is_whole_piece(path_, key));
  Grid<float> light(12, 2, -1.F);
  Grid<std::uint8_t> id(12, 2, 99);
  read_piece_rows(path_, key, 22, 24, 7, {plane_of(light), plane_of(id)});
  for (const auto [x, y] : test::cells(12, 2)) {
    const bool inside = x >= 3 && x < 10;
    EXPECT_EQ(light(x, y), inside ? values_.light(x - 3, y + 2) : -1.F);
    EXPECT_EQ(id(x, y), inside ? values_.id(x - 3, y + 2) : 99);
  }
}

TEST_F(PieceFile, OnlyTheRightPieceIsWhole) {
  EXPECT_FALSE(is_whole_piece(path_, {"other", key.product, key.rect}));
  EXPECT_FALSE(is_whole_piece(path_, {key.job, "guidance", key.rect}));
  EXPECT_FALSE(is_whole_piece(path_, {key.job, key.product, {10, 20, 17, 26}}));
  EXPECT_FALSE(is_whole_piece(folder_ / "none", key));
}

// Another program may change or cut a piece after it was found to be whole.
TEST_F(PieceFile, APieceThatChangesWhileItIsReadIsNotTaken) {
  Grid<float> light(7, 5);
  Grid<std::uint8_t> id(7, 5);
  const auto read = [&] {
    return test::input_error([&] {
      read_piece_rows(path_, key, 20, 25, 10, {plane_of(light), plane_of(id)});
    });
  };
  const std::string whole = test::read_bytes(path_);
  for (std::size_t size = 0; size < whole.size(); size += 5) {
    test::write_bytes(path_, whole.substr(0, size));
    read();
  }
  for (const char* planes : {"planes 1 4", "planes 4", "planes 4 1 1", "planes 4 9999999999999"}) {
    std::string other = whole;
    other.replace(other.find("planes 4 1"), 10, planes);
    test::write_bytes(path_, other);
    EXPECT_THAT(read(), testing::HasSubstr("changed by another program")) << planes;
  }
  std::filesystem::remove(path_);
  read();
}

// Whatever byte is lost or turned, and wherever the file ends.
TEST_F(PieceFile, ADamagedPieceIsFound) {
  const std::string whole = test::read_bytes(path_);
  for (std::size_t i = 0; i < whole.size(); i += 7) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    test::write_bytes(path_, damaged);
    EXPECT_FALSE(is_whole_piece(path_, key)) << "byte " << i;
    test::write_bytes(path_, whole.substr(0, i));
    EXPECT_FALSE(is_whole_piece(path_, key)) << "cut at " << i;
  }
  test::write_bytes(path_, whole);
  EXPECT_TRUE(is_whole_piece(path_, key));
}

TEST_F(PieceFile, NothingElseIsLeft) { EXPECT_EQ(folder_.count(), 1U); }

TEST_F(PieceFile, AFolderThatIsNotThereIsAnErrorOfTheOutput) {
  test::message_of(ErrorKind::output,
                   [&] { write_piece(folder_ / "none/a.piece", key, values_.planes()); });
}

TEST_F(PieceFile, BytesComeBack) {
  Grid<std::uint8_t> bytes(1000, 1, 7);
  write_piece(path_, key, {plane_of(bytes)});
  EXPECT_EQ(read_piece_bytes(path_), std::string(1000, '\7'));
}

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
  for (const char* wrong : {"", "Z,", "Z,,N.X", "depth", "landcover", "none,Z", "blender,Z", "z"}) {
    const std::string message = test::usage_error([&] { read_guidance_choice(wrong); });
    EXPECT_THAT(message, HasSubstr("landcover.id")) << wrong;
    EXPECT_THAT(message, HasSubstr("none, or blender")) << wrong;
  }
}

TEST(GuidanceChoice, ForBlenderKeepsWhatItsPassesAreMadeOf) {
  const GuidanceChoice choice = read_guidance_choice("blender");
  EXPECT_TRUE(is_for_blender(choice));
  EXPECT_FALSE(is_for_blender(std::nullopt) || is_for_blender(read_guidance_choice("none")) ||
               is_for_blender(read_guidance_choice("Z")));
  GuidanceBuffers guidance = sheet_guidance_like({});
  keep_chosen(guidance, choice);
  for (const GuidanceChannel& channel : guidance_channels())
    std::visit(
        [&](auto member) {
          const std::vector<std::string>& made_of = compositing_channels();
          EXPECT_EQ(!(guidance.*member).empty(),
                    std::count(made_of.begin(), made_of.end(), channel.names[0]) == 1)
              << channel.names[0];
        },
        channel.member);
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
