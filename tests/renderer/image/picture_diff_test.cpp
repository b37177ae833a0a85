#include "renderer/image/picture_diff.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <limits>

#include "base/error.h"
#include "renderer/image/image_io.h"
#include "renderer/image/provenance.h"
#include "tests/files.h"

namespace belvedere {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

// 20 × 10 pixels of depth (float), tone (half) and class (ids), each by position.
std::string write_buffers(const test::Folder& folder, const std::string& name,
                          const std::function<float(int)>& depth,
                          const std::function<float(int)>& tone,
                          const std::function<std::uint32_t(int)>& id) {
  std::string path = folder / (name + ".exr");
  ExrWriter writer(path, 20, 10,
                   {{"depth", {{"Z", ChannelType::float32}, {"tone.V", ChannelType::half}}},
                    {"class", {{"landcover.id", ChannelType::uint32}}}},
                   {});
  std::vector<float> values;
  std::vector<float> ids;
  for (int i = 0; i < 200; ++i) {
    values.insert(values.end(), {depth(i), tone(i)});
    ids.push_back(std::bit_cast<float>(id(i)));
  }
  writer.write_rows(0, 0, 10, values);
  writer.write_rows(1, 0, 10, ids);
  writer.finish();
  return path;
}

const ChannelDifference& channel(const PictureDifference& difference, const std::string& name) {
  for (const ChannelDifference& c : difference.channels)
    if (c.name == name) return c;
  throw std::runtime_error("no channel " + name);
}

const auto ramp = [](int i) { return static_cast<float>(i); };
const auto sky_above = [](int i) { return i < 50 ? infinity : static_cast<float>(i); };
const auto half = [](int) { return 0.5F; };
const auto classes = [](int i) { return static_cast<std::uint32_t>(i % 7); };

TEST(PictureDiff, FiguresOfAKnownDifference) {
  const test::Folder folder;
  const std::string a = write_buffers(folder, "a", ramp, half, classes);
  // Depth differs by 3 and 4 at two of 200 pixels, the class at ten.
  const std::string b = write_buffers(
      folder, "b",
      [](int i) {
        return static_cast<float>(i) + (i == 20 ? 3.F : i == 120 ? -4.F : 0.F);
      },
      half, [](int i) { return static_cast<std::uint32_t>(i % 7 + (i % 20 == 0 ? 1 : 0)); });
  const PictureDifference difference = compare_pictures(a, b);
  EXPECT_TRUE(difference.mismatches.empty());
  EXPECT_EQ(difference.width, 20);
  const ChannelDifference& depth = channel(difference, "Z");
  EXPECT_DOUBLE_EQ(depth.mean, 7.0 / 200.0);
  EXPECT_DOUBLE_EQ(depth.max, 4.0);
  EXPECT_DOUBLE_EQ(depth.rms, std::sqrt(25.0 / 200.0));
  EXPECT_DOUBLE_EQ(depth.differing_share, 0.01);
  EXPECT_FALSE(depth.is_id);
  const ChannelDifference& id = channel(difference, "landcover.id");
  EXPECT_TRUE(id.is_id);
  EXPECT_DOUBLE_EQ(id.mean, 0.05);
  EXPECT_DOUBLE_EQ(id.max, 1.0);
  EXPECT_EQ(channel(difference, "tone.V").max, 0.0);

  EXPECT_FALSE(is_same(difference, {}));
  EXPECT_TRUE(is_same(difference, {.mean = 0.05, .max = 4.0}));  // max does not hold for ids
  EXPECT_FALSE(is_same(difference, {.mean = 0.049, .max = 4.0}));
  EXPECT_FALSE(is_same(difference, {.mean = 0.05, .max = 3.9}));
  EXPECT_FALSE(is_same(difference, {.mean = std::nan(""), .max = 4.0}));
  EXPECT_TRUE(is_same(compare_pictures(a, a), {}));
}

TEST(PictureDiff, SkyIsEqualToSkyAndInfinitelyFarFromLand) {
  const test::Folder folder;
  const std::string a = write_buffers(folder, "sky", sky_above, half, classes);
  EXPECT_TRUE(is_same(compare_pictures(a, a), {}));
  const PictureDifference difference =
      compare_pictures(a, write_buffers(folder, "land", ramp, half, classes));
  EXPECT_EQ(channel(difference, "Z").max, infinity);
  EXPECT_DOUBLE_EQ(channel(difference, "Z").differing_share, 0.25);
  EXPECT_FALSE(is_same(difference, {.mean = 1e300, .max = 1e300}));
}

TEST(PictureDiff, ChannelsThatOneLacksAreAMismatch) {
  const test::Folder folder;
  const std::string a = write_buffers(folder, "both", ramp, half, classes);
  const std::string b = folder / "one.exr";
  ExrWriter writer(b, 20, 10,
                   {{"depth", {{"Z", ChannelType::float32}, {"extra", ChannelType::half}}}}, {});
  std::vector<float> values;
  for (int i = 0; i < 200; ++i) values.insert(values.end(), {ramp(i), 0.F});
  writer.write_rows(0, 0, 10, values);
  writer.finish();
  const PictureDifference difference = compare_pictures(a, b);
  EXPECT_THAT(difference.mismatches, ::testing::SizeIs(3));  // extra, tone.V, landcover.id
  EXPECT_EQ(channel(difference, "Z").max, 0.0);
  EXPECT_FALSE(is_same(difference, {.mean = 1.0, .max = 1.0}));
}

TEST(PictureDiff, FormatsOfEqualValuesAreEqual) {
  const test::Folder folder;
  Grid<glm::vec3> picture(30, 20);
  for (std::size_t i = 0; i < picture.size(); ++i)
    picture[i] = glm::vec3(static_cast<float>(i % 256) / 255.F, 0.F, 1.F);
  const std::string png = folder / "picture.png";
  const std::string tiff = folder / "picture.tif";
  write_png8(png, picture, {});
  write_tiff16(tiff, picture, {});
  const PictureDifference difference = compare_pictures(png, tiff);
  ASSERT_THAT(difference.channels, ::testing::SizeIs(3));
  EXPECT_TRUE(is_same(difference, {.mean = 1e-6, .max = 1e-6}));
  picture(3, 4).g = 0.5F;
  write_tiff16(tiff, picture, {});
  EXPECT_NEAR(channel(compare_pictures(png, tiff), "G").max, 0.5, 1e-4);
  EXPECT_EQ(channel(compare_pictures(png, tiff), "R").max, 0.0 + channel(difference, "R").max);
}

TEST(PictureDiff, OtherSizesAndMissingFiles) {
  const test::Folder folder;
  const std::string a = folder / "s1.png";
  const std::string b = folder / "s2.png";
  write_png8(a, Grid<glm::vec3>(5, 5), {});
  write_png8(b, Grid<glm::vec3>(5, 6), {});
  EXPECT_THAT(compare_pictures(a, b).mismatches,
              ::testing::ElementsAre("5 × 5 pixels against 5 × 6"));
  EXPECT_THROW(compare_pictures(a, "/nowhere/x.png"), Error);
}

Grid<glm::vec3> picture() {
  Grid<glm::vec3> out(21, 13);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = {static_cast<float>(i % 256) / 255.F, 0.2F, static_cast<float>(i % 7) / 255.F};
  return out;
}

TEST(PictureHash, IsOfPixelsAndNotOfTheFile) {
  const test::Folder folder;
  write_png8(folder / "a.png", picture(), {});
  write_png8(folder / "b.png", picture(),
             {.dots_per_inch = 300.0, .icc_profile = {}, .notes = {{"made", "otherwise"}}});
  ASSERT_NE(test::read_bytes(folder / "a.png"), test::read_bytes(folder / "b.png"));
  const PictureHash a = hash_picture(folder / "a.png");
  EXPECT_EQ(a.whole, hash_picture(folder / "b.png").whole);
  ASSERT_EQ(a.channels.size(), 3U);
  EXPECT_EQ(a.channels[0].channel, "R");
  EXPECT_NE(a.channels[0].hash, a.channels[1].hash);
}

TEST(PictureHash, OnePixelAndTheSizeCount) {
  const test::Folder folder;
  Grid<glm::vec3> other = picture();
  other(20, 12).z += 1.F / 255.F;
  write_png8(folder / "a.png", picture(), {});
  write_png8(folder / "b.png", other, {});
  const PictureHash a = hash_picture(folder / "a.png");
  const PictureHash b = hash_picture(folder / "b.png");
  EXPECT_NE(a.whole, b.whole);
  EXPECT_EQ(a.channels[0].hash, b.channels[0].hash);
  EXPECT_NE(a.channels[2].hash, b.channels[2].hash);
  // The same values in other rows.
  const Grid<glm::vec3> flat(6, 4, glm::vec3(0.4F));
  const Grid<glm::vec3> high(4, 6, glm::vec3(0.4F));
  write_png8(folder / "c.png", flat, {});
  write_png8(folder / "d.png", high, {});
  EXPECT_NE(hash_picture(folder / "c.png").whole, hash_picture(folder / "d.png").whole);
}

// By hand: two pixels' values as the bytes in a file.
TEST(PictureHash, OfAnExrIsThatOfEachChannelsBits) {
  const test::Folder folder;
  ExrWriter writer(folder / "a.exr", 2, 1,
                   {{"part", {{"Z", ChannelType::float32}, {"landcover.id", ChannelType::uint32}}}},
                   {});
  writer.write_rows(0, 0, 1, {1.F, std::bit_cast<float>(7U), -2.F, std::bit_cast<float>(300U)});
  writer.finish();
  const PictureHash hash = hash_picture(folder / "a.exr");
  ASSERT_EQ(hash.channels.size(), 2U);
  EXPECT_EQ(hash.channels[0].channel, "Z");
  EXPECT_EQ(hash.channels[0].hash, hash_bytes(std::string("\0\0\x80\x3f\0\0\0\xc0", 8)));
  EXPECT_EQ(hash.channels[1].hash, hash_bytes(std::string("\x07\0\0\0\x2c\x01\0\0", 8)));
  EXPECT_EQ(hash.whole, hash_bytes("2 1\nZ " + hash.channels[0].hash + "\nlandcover.id " +
                                   hash.channels[1].hash + "\n"));
}

TEST(PictureHash, WhatIsNoPictureIsRefused) {
  const test::Folder folder;
  EXPECT_EQ(test::error_of([&] { hash_picture(folder.write("a.png", "text")); }).kind(),
            ErrorKind::input);
}

}  // namespace
}  // namespace belvedere
