#include "renderer/image/picture_formats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/image/display_conversion.h"
#include "renderer/image/image_io.h"
#include "tests/files.h"
#include "tests/renderer/image/random_picture.h"

namespace belvedere {
namespace {

using test::Folder;
using test::random_picture;

void write_as(const PictureFormat& format, const std::string& path, const Grid<glm::vec3>& picture,
              const PictureFileOptions& options) {
  write_whole(*format.open(path, picture.width(), picture.height(), options), picture);
}

TEST(PictureFormats, WhatIsWrittenReadsBackAsTheRowSays) {
  const Folder folder("formats");
  const Grid<glm::vec3> picture =
      random_picture(300, 139);  // several tiles or groups of each format, the last ones cut
  PictureFileOptions options;
  options.dots_per_inch = 301.5;
  options.icc_profile = srgb_profile();
  options.notes = {{"scene", "a = 1\nb = 'x\\y: z'\n"}, {"palette", "1"}};
  for (const PictureFormat& format : picture_formats()) {
    if (format.open == nullptr) continue;
    SCOPED_TRACE(format.title);
    const std::string path = folder / ("a." + std::string(format.extension));
    write_as(format, path, picture, options);
    EXPECT_EQ(&format_of_file(path), &format);
    const ImageInfo info = read_image_info(path);
    EXPECT_EQ(info.format, format.name);
    EXPECT_EQ(info.width, 300);
    EXPECT_EQ(info.height, 139);
    ASSERT_EQ(info.parts.size(), 1u);
    ASSERT_EQ(info.parts[0].channels.size(), 3u);
    const ChannelType type = format.linear       ? ChannelType::half
                             : format.bits == 16 ? ChannelType::uint16
                                                 : ChannelType::uint8;
    EXPECT_EQ(info.parts[0].channels[0].type, type);
    EXPECT_EQ(info.icc_profile, format.profile ? options.icc_profile : std::vector<std::uint8_t>{});
    EXPECT_NEAR(info.dots_per_inch, format.resolution ? 301.5 : 0.0, 0.02);
    if (format.notes) {
      EXPECT_EQ(info.notes.at("scene"), options.notes.at("scene"));
      EXPECT_EQ(info.notes.at("palette"), "1");
    }
    const Grid<glm::vec3> again = read_picture(path);
    ASSERT_TRUE(again.same_size(picture));
    const double highest = (1 << format.bits) - 1;
    for (std::size_t i = 0; i < picture.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        const double value = picture[i][c];
        if (format.linear)
          ASSERT_NEAR(again[i][c], value, value / 2048.0 + 1e-7);
        else
          ASSERT_EQ(std::lround(again[i][c] * highest), std::lround(value * highest)) << i;
      }
  }
}

TEST(PictureFormats, SameBytesForAnyThreads) {
  const Folder folder("formats");
  const Grid<glm::vec3> picture = random_picture(700, 300);
  PictureFileOptions options;
  options.icc_profile = srgb_profile();
  for (const PictureFormat& format : picture_formats()) {
    if (format.open == nullptr) continue;
    const std::string one = folder / ("one." + std::string(format.extension));
    const std::string all = folder / ("all." + std::string(format.extension));
    {
      const ThreadLimit single(1);
      write_as(format, one, picture, options);
    }
    write_as(format, all, picture, options);
    EXPECT_TRUE(test::read_bytes(one) == test::read_bytes(all)) << format.title;
  }
}

TEST(PictureFormats, OddPixelsAreCutAndCutOffFilesFound) {
  const Folder folder("formats");
  Grid<glm::vec3> picture = random_picture(40, 30);
  picture(0, 0) = glm::vec3(-1.0F, 2.0F, std::nanf(""));
  for (const PictureFormat& format : picture_formats()) {
    if (format.open == nullptr) continue;
    SCOPED_TRACE(format.title);
    const std::string path = folder / ("a." + std::string(format.extension));
    write_as(format, path, picture, {});
    if (!format.linear) {
      EXPECT_EQ(read_picture(path)(0, 0), glm::vec3(0.0F, 1.0F, 0.0F));
    }
    const std::string whole = test::read_bytes(path);
    for (const double share : {0.3, 0.7, 0.95}) {
      test::write_bytes(
          path,
          whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
      EXPECT_THROW(read_picture(path), Error) << share;
    }
  }
}

TEST(PictureFormats, EndingsAndNamesAreThereOnce) {
  std::set<std::string_view> extensions;
  std::set<std::string_view> names;
  for (const PictureFormat& format : picture_formats()) {
    EXPECT_TRUE(extensions.insert(format.extension).second) << format.extension;
    EXPECT_TRUE(names.insert(format.name).second) << format.name;
    EXPECT_EQ(format.open == nullptr, format.meaning.empty()) << format.title;
  }
}

TEST(PictureFormats, TheBytesDecideAndNotTheName) {
  const Folder folder("formats");
  write_png8(folder / "named.tif", random_picture(9, 9), {});
  EXPECT_EQ(format_of_file(folder / "named.tif").extension, "png");
  test::write_bytes(folder / "no.png", "nothing that is a picture");
  const Error error = test::error_of([&] { format_of_file(folder / "no.png"); });
  EXPECT_EQ(error.kind(), ErrorKind::input);
  for (const PictureFormat& format : picture_formats())
    EXPECT_THAT(error.allowed(), testing::HasSubstr(std::string(format.title)));
}

// Memory that a writer promises before anything is written, so that a print can be planned with it.
TEST(PictureFormats, OnlyThoseThatPackPicturesWholeGrowWithTheHeight) {
  for (const PictureFormat& format : picture_formats()) {
    if (format.open == nullptr) continue;
    const double high = format.writer_bytes(40000, 16000);
    if (format.extension == "jxl") {
      EXPECT_EQ(high, 90.0 * 40000 * 16000);
    } else {
      EXPECT_EQ(high, format.writer_bytes(40000, 100)) << format.title;
      EXPECT_LT(high, 100e6) << format.title << ": some tens of megabytes for the largest print";
    }
  }
}

}  // namespace
}  // namespace belvedere
