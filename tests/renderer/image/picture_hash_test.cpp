#include "renderer/image/picture_hash.h"

#include <gtest/gtest.h>

#include <bit>

#include "renderer/image/image_io.h"
#include "renderer/image/provenance.h"
#include "tests/files.h"

namespace belvedere {
namespace {

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
