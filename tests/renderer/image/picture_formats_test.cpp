#include "renderer/image/picture_formats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/image/image_io.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using test::Folder;

Grid<glm::vec3> random_picture(int width, int height) {
  Grid<glm::vec3> out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) out(x, y)[c] = static_cast<float>(random_uniform(5, x, y, static_cast<std::uint64_t>(c)));
  return out;
}

// A profile that is not sRGB: red and green have changed places in its table of tags.
std::vector<std::uint8_t> printer_profile() {
  std::vector<std::uint8_t> bytes = srgb_profile();
  std::string text(bytes.begin(), bytes.end());
  const std::size_t red = text.find("rXYZ");
  const std::size_t green = text.find("gXYZ");
  bytes[red] = 'g';
  bytes[green] = 'r';
  return bytes;
}

std::set<std::string> names_in(const std::string& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

TEST(PictureFormats, WhatIsWrittenReadsBackAsTheRowSays) {
  const Folder folder("formats");
  const Grid<glm::vec3> picture = random_picture(300, 139);  // several tiles or groups of each format, the last ones cut
  PictureFileOptions options;
  options.dots_per_inch = 301.5;
  options.icc_profile = srgb_profile();
  options.notes = {{"scene", "a = 1\nb = 'x\\y: z'\n"}, {"palette", "1"}};
  for (const PictureFormat& format : picture_formats()) {
    if (format.write == nullptr) continue;
    SCOPED_TRACE(format.title);
    const std::string path = folder / ("a." + std::string(format.ending));
    format.write(path, picture, options);
    EXPECT_EQ(&format_of_file(path), &format);
    const ImageInfo info = read_image_info(path);
    EXPECT_EQ(info.format, format.name);
    EXPECT_EQ(info.width, 300);
    EXPECT_EQ(info.height, 139);
    ASSERT_EQ(info.parts.size(), 1u);
    ASSERT_EQ(info.parts[0].channels.size(), 3u);
    const ChannelType type = format.linear ? ChannelType::half : format.bits == 16 ? ChannelType::uint16 : ChannelType::uint8;
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
    if (format.write == nullptr) continue;
    const std::string one = folder / ("one." + std::string(format.ending));
    const std::string all = folder / ("all." + std::string(format.ending));
    {
      const ThreadLimit single(1);
      format.write(one, picture, options);
    }
    format.write(all, picture, options);
    EXPECT_TRUE(test::read_bytes(one) == test::read_bytes(all)) << format.title;
  }
}

TEST(PictureFormats, OddPixelsAreCutAndCutOffFilesFound) {
  const Folder folder("formats");
  Grid<glm::vec3> picture = random_picture(40, 30);
  picture(0, 0) = glm::vec3(-1.0F, 2.0F, std::nanf(""));
  for (const PictureFormat& format : picture_formats()) {
    if (format.write == nullptr) continue;
    SCOPED_TRACE(format.title);
    const std::string path = folder / ("a." + std::string(format.ending));
    format.write(path, picture, {});
    if (!format.linear) {
      EXPECT_EQ(read_picture(path)(0, 0), glm::vec3(0.0F, 1.0F, 0.0F));
    }
    const std::string whole = test::read_bytes(path);
    for (const double share : {0.3, 0.7, 0.95}) {
      test::write_bytes(path, whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
      EXPECT_THROW(read_picture(path), Error) << share;
    }
  }
}

TEST(PictureFormats, EndingsAndNamesAreThereOnce) {
  std::set<std::string_view> endings;
  std::set<std::string_view> names;
  for (const PictureFormat& format : picture_formats()) {
    EXPECT_TRUE(endings.insert(format.ending).second) << format.ending;
    EXPECT_TRUE(names.insert(format.name).second) << format.name;
    EXPECT_EQ(format.write == nullptr, format.meaning.empty()) << format.title;
  }
}

TEST(PictureFormats, TheBytesDecideAndNotTheName) {
  const Folder folder("formats");
  write_png8(folder / "named.tif", random_picture(9, 9), {});
  EXPECT_EQ(format_of_file(folder / "named.tif").ending, "png");
  test::write_bytes(folder / "no.png", "nothing that is a picture");
  try {
    format_of_file(folder / "no.png");
    ADD_FAILURE() << "it was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    for (const PictureFormat& format : picture_formats()) EXPECT_THAT(error.allowed(), testing::HasSubstr(std::string(format.title)));
  }
}

TEST(PictureFormats, OnlyTheFormatsAskedForAreWritten) {
  const Folder folder("formats");
  const Image linear = random_picture(20, 10);
  write_pictures(folder / "p", {"png"}, linear, {}, 300.0, {});
  EXPECT_EQ(names_in(folder.path()), (std::set<std::string>{"p.png"}));
  try {
    write_pictures(folder / "q", {"exr", "gif"}, linear, {}, 300.0, {});
    ADD_FAILURE() << "gif was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_THAT(error.found(), testing::HasSubstr("gif"));
    for (const std::string& ending : picture_endings()) EXPECT_THAT(error.allowed(), testing::HasSubstr(ending));
  }
  EXPECT_EQ(names_in(folder.path()), (std::set<std::string>{"p.png"})) << "refused before anything is written";
}

TEST(PictureFormats, ThePrintersProfileIsForDeviceFormatsAlone) {
  const Folder folder("formats");
  const Image linear = random_picture(20, 10);
  const Grid<glm::vec3> display = to_display(linear, {});
  const std::vector<std::uint8_t> printer = printer_profile();
  write_pictures(folder / "p", picture_endings(), linear, {.display = {}, .device_profile = printer}, 300.0, {});
  const Grid<glm::vec3> printed = to_profile(display, printer);
  for (const PictureFormat& format : picture_formats()) {
    if (format.write == nullptr) continue;
    SCOPED_TRACE(format.title);
    const std::string path = folder / ("p." + std::string(format.ending));
    const Grid<glm::vec3> again = read_picture(path);
    const Grid<glm::vec3>& expected = format.linear ? linear : format.device ? printed : display;
    for (std::size_t i = 0; i < again.size(); ++i)
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(again[i][c], expected[i][c], 0.003);
    const std::vector<std::uint8_t> profile = format.device ? printer : format.profile ? srgb_profile() : std::vector<std::uint8_t>{};
    EXPECT_EQ(read_image_info(path).icc_profile, profile);
  }
}

}  // namespace
}  // namespace belvedere
