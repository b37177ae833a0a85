#include "renderer/image/guidance_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <type_traits>
#include <variant>

#include "base/error.h"
#include "base/guidance_buffers.h"
#include "base/random.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/paths.h"
#include "tests/renderer/image/picture_bytes.h"

namespace belvedere {
namespace {

using test::Folder;

float uniform(int x, int y, std::uint64_t draw, double low, double high) {
  return static_cast<float>(low + (high - low) * random_uniform(3, x, y, draw));
}

// Every channel of the table, with values of its kind all over the range of its type.
template <class T>
T some_value(const GuidanceChannel& channel, int x, int y, std::uint64_t draw) {
  const glm::vec3 v(uniform(x, y, draw, -1e4, 1e4), uniform(x, y, draw + 1, -1e4, 1e4),
                    uniform(x, y, draw + 2, -1e4, 1e4));
  if (channel.kind == ChannelKind::class_id)
    return value_of<T>(glm::vec3(static_cast<float>((x + y) % land_cover_class_count), 0.F, 0.F));
  if (channel.type == ChannelStorage::uint32)
    return value_of<T>(glm::vec3(std::abs(v.x), 0.F, 0.F));
  if constexpr (std::is_same_v<T, glm::vec2> || std::is_same_v<T, glm::vec3>) {
    if (channel.kind == ChannelKind::direction)
      return x == 1 ? T(0.F) : glm::normalize(value_of<T>(v));
  }
  return value_of<T>(v);
}

GuidanceBuffers make_guidance(int width, int height) {
  GuidanceBuffers g;
  std::uint64_t draw = 0;
  for (const GuidanceChannel& channel : guidance_channels()) {
    draw += 3;
    fill_channel(g, channel, width, height, channel.sky);
    std::visit(
        [&](auto member) {
          auto& grid = g.*member;
          for (const auto [x, y] : test::cells(width, height))
            grid(x, y) =
                some_value<typename std::decay_t<decltype(grid)>::value_type>(channel, x, y, draw);
        },
        channel.member);
  }
  for (int x = 0; x < width; ++x) g.depth_m(x, 0) = std::numeric_limits<float>::infinity();
  return g;
}

// Half keeps 11 bits: a relative error of 2^-11 at most, half of that when rounded; float and ids
// come back as they were.
template <class T>
bool same_in_file(const T& a, const T& b, ChannelStorage type) {
  if constexpr (std::is_same_v<T, float>) {
    return a == b || (type == ChannelStorage::half && std::abs(a - b) <= 0x1p-11F * std::abs(a));
  } else if constexpr (std::is_same_v<T, glm::vec2> || std::is_same_v<T, glm::vec3>) {
    for (int c = 0; c < T::length(); ++c)
      if (std::abs(a[c] - b[c]) > (type == ChannelStorage::half ? 0x1p-10F * glm::length(a) : 0.F))
        return false;
    return true;
  } else {
    return a == b;
  }
}

TEST(GuidanceIo, EveryChannelComesBack) {
  const Folder folder("guidance");
  const GuidanceBuffers g = make_guidance(100, 150);
  write_guidance(folder / "g.exr", g, {{"camera", "perspective"}});
  const GuidanceBuffers r = read_guidance(folder / "g.exr");
  for (const GuidanceChannel& channel : guidance_channels())
    std::visit(
        [&](auto member) {
          ASSERT_TRUE((r.*member).same_size(g.*member)) << channel.names[0];
          for (std::size_t i = 0; i < (g.*member).size(); ++i)
            ASSERT_TRUE(same_in_file((g.*member)[i], (r.*member)[i], channel.type))
                << channel.names[0] << " " << i;
        },
        channel.member);
  for (const auto [x, y] : test::cells({2, 0, 100, 150})) {
    ASSERT_NEAR(glm::length(r.normal(x, y)), 1.0, 1e-6) << "made unit again";
    ASSERT_NEAR(glm::length(r.fall_line(x, y)), 1.0, 1e-6);
  }
  EXPECT_EQ(r.fall_line(1, 5), glm::vec2(0.0f)) << "flat ground has no direction";
}

TEST(GuidanceIo, HeaderNamesChannelsTypesAndClasses) {
  const Folder folder("guidance");
  write_guidance(folder / "g.exr", make_guidance(10, 10), {{"camera", "perspective"}});
  const ImageInfo info = read_image_info(folder / "g.exr");
  std::map<std::string, ChannelType> found;
  for (const PartSpec& part : info.parts)
    for (const ChannelSpec& c : part.channels) found[part.name + "/" + c.name] = c.type;
  std::size_t expected = 0;
  for (const GuidanceChannel& channel : guidance_channels()) expected += channel.components();
  EXPECT_EQ(found.size(), expected);
  EXPECT_EQ(found.at("depth/Z"), ChannelType::float32);
  EXPECT_EQ(found.at("position/P.Y"), ChannelType::float32);
  EXPECT_EQ(found.at("normal/Nd.Z"), ChannelType::half);
  EXPECT_EQ(found.at("terrain/relief.M"), ChannelType::half);
  EXPECT_EQ(found.at("class/landcover.id"), ChannelType::uint32);
  EXPECT_EQ(found.at("paint/stroke.id"), ChannelType::uint32);
  EXPECT_EQ(info.notes.at("camera"), "perspective");
  EXPECT_THAT(info.notes.at("legend"), testing::HasSubstr("\n4 forest 1e5a28\n"));
}

TEST(GuidanceIo, RefusesAVectorWithoutOneOfItsComponents) {
  const Folder folder("guidance");
  ExrWriter writer(folder / "half.exr", 2, 1,
                   {{"normal", {{"N.X", ChannelType::half}, {"N.Z", ChannelType::half}}}}, {});
  writer.write_rows(0, 0, 1, {0.F, 1.F, 0.F, 1.F});
  writer.finish();
  EXPECT_THAT(test::input_error([&] { read_guidance(folder / "half.exr"); }),
              testing::HasSubstr("N.X N.Y N.Z"));
}

TEST(GuidanceIo, StreamedIsTheSameFile) {
  const Folder folder("guidance");
  const GuidanceBuffers g = make_guidance(70, 200);
  write_guidance(folder / "whole.exr", g, {});
  GuidanceWriter writer(folder / "streamed.exr", 70, 200, {});
  writer.write_rows(g, 0, 128, 0);
  // The rest is taken from buffers with a margin.
  GuidanceBuffers lower = make_guidance(70, 200);
  writer.write_rows(lower, 128, 72, 128);
  writer.finish();
  EXPECT_EQ(test::read_bytes(folder / "whole.exr"), test::read_bytes(folder / "streamed.exr"));
}

TEST(GuidanceIo, AbsentChannelsStayEmpty) {
  const Folder folder("guidance");
  GuidanceBuffers g;
  g.depth_m = Grid<float>(5, 4, 2.0f);
  g.tone = Grid<float>(5, 4, 0.5f);
  write_guidance(folder / "g.exr", g, {});
  const GuidanceBuffers r = read_guidance(folder / "g.exr");
  EXPECT_EQ(r.depth_m, g.depth_m);
  EXPECT_EQ(r.tone, g.tone);
  EXPECT_TRUE(r.land_cover.empty());
  EXPECT_TRUE(r.base.empty());
  EXPECT_TRUE(r.normal.empty());
}

TEST(GuidanceIo, RefusesWhatIsNone) {
  const Folder folder("guidance");
  const auto kind = [&](const std::string& name) {
    try {
      read_guidance(folder / name);
    } catch (const Error& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr(name));
      return e.kind();
    }
    return ErrorKind::bug;
  };
  write_exr(folder / "picture.exr", Image(3, 3), {});
  EXPECT_EQ(kind("picture.exr"), ErrorKind::input);
  EXPECT_EQ(kind("absent.exr"), ErrorKind::input);
  ExrWriter writer(folder / "id.exr", 2, 1, {{"class", {{"landcover.id", ChannelType::uint32}}}},
                   {});
  writer.write_rows(0, 0, 1,
                    {std::bit_cast<float>(3u),
                     std::bit_cast<float>(static_cast<std::uint32_t>(land_cover_class_count))});
  writer.finish();
  EXPECT_EQ(kind("id.exr"), ErrorKind::input);
}

// A header may claim a text of 2 GiB in a file of some kB: no memory is taken for it.
TEST(GuidanceIo, TextsLongerThanTheFileAreRefused) {
  const Folder folder;
  const std::string good =
      test::read_bytes(std::string(test::source_folder()) + "/tests/fuzz/guidance/small.exr");
  const std::string path = folder.write("a.exr", good);
  EXPECT_NO_THROW(read_guidance(path));
  const std::string type("\0string\0", 8);
  int texts = 0;
  for (std::size_t at = good.find(type); at != std::string::npos; at = good.find(type, at + 1)) {
    std::string bad = good;
    bad.replace(at + type.size(), 4, "\xff\xff\xff\x7f");
    test::write_bytes(path, bad);
    EXPECT_THAT(test::input_error([&] { read_guidance(path); }),
                testing::HasSubstr("longer than the file"));
    ++texts;
  }
  EXPECT_GT(texts, 3);
}

TEST(GuidanceIo, ChannelsMustNotComeAndGo) {
  const Folder folder("guidance");
  GuidanceBuffers g = make_guidance(10, 128);
  GuidanceWriter writer(folder / "g.exr", 10, 128, {});
  writer.write_rows(g, 0, 64, 0);
  g.tone = {};
  EXPECT_THROW(writer.write_rows(g, 64, 64, 64), Error);
}

}  // namespace
}  // namespace belvedere
