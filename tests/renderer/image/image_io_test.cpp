#include "renderer/image/image_io.h"
#include "renderer/image/png_palette.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <glm/vec2.hpp>

#include "base/error.h"
#include "base/files/file_guard.h"
#include "base/parallel.h"
#include "base/random.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/renderer/image/exr/mixed_channels.h"
#include "tests/renderer/image/picture_bytes.h"
#include "tests/renderer/image/random_picture.h"
#include "tests/small_disk.h"

namespace belvedere {
namespace {

using test::kind_of;
using test::random_picture;
using namespace std::string_literals;
using test::Folder;
using test::SmallDisk;
using test::write_mixed;

class MemoryVariable {
 public:
  explicit MemoryVariable(const char* mib) { ::setenv("BELVEDERE_MEMORY_MIB", mib, 1); }
  ~MemoryVariable() { ::unsetenv("BELVEDERE_MEMORY_MIB"); }
  MemoryVariable(const MemoryVariable&) = delete;
  MemoryVariable& operator=(const MemoryVariable&) = delete;
};

// --- pictures
// ------------------------------------------------------------------------------------------------------------------------

TEST(Tiff, RoundsToTheNearestStepAndReadsBack) {
  const Folder folder("tiff");
  Grid<glm::vec3> picture = random_picture(300, 270);
  picture(0, 0) = glm::vec3(-1.0f, 2.0f, std::nanf(""));
  picture(1, 0) = glm::vec3(0.49f / 65535.0f, 0.51f / 65535.0f, 1.0f);
  write_tiff16(folder / "a.tif", picture, {});
  const Grid<glm::vec3> again = read_picture(folder / "a.tif");
  ASSERT_TRUE(again.same_size(picture));
  EXPECT_EQ(again(0, 0), glm::vec3(0.0f, 1.0f, 0.0f));
  EXPECT_EQ(again(1, 0), glm::vec3(0.0f, 1.0f / 65535.0f, 1.0f));
  for (std::size_t i = 2; i < picture.size(); ++i)
    for (int c = 0; c < 3; ++c)
      ASSERT_EQ(std::lround(again[i][c] * 65535.0),
                std::lround(static_cast<double>(picture[i][c]) * 65535.0))
          << i;
}

TEST(Tiff, CarriesResolutionProfileAndNotes) {
  const Folder folder("tiff");
  PictureFileOptions options;
  options.dots_per_inch = 301.5;
  options.icc_profile.assign(1000, 7);
  options.notes = {{"scene", "a = 1\nb = 'x\\y: z'\n"}, {"version", "1"}};
  for (const bool png : {false, true}) {
    const std::string path = folder / (png ? "a.png" : "a.tif");
    if (png) options.icc_profile.clear();  // libpng checks profiles; icc_test embeds a true one
    png ? write_png8(path, random_picture(20, 10), options)
        : write_tiff16(path, random_picture(20, 10), options);
    const ImageInfo info = read_image_info(path);
    EXPECT_EQ(info.format, png ? "png" : "tiff");
    EXPECT_EQ(info.width, 20);
    EXPECT_EQ(info.height, 10);
    EXPECT_NEAR(info.dots_per_inch, 301.5, 0.02);
    EXPECT_EQ(info.icc_profile, options.icc_profile);
    EXPECT_EQ(info.notes.at("scene"), options.notes.at("scene"));
    EXPECT_EQ(info.notes.at("version"), "1");
    ASSERT_EQ(info.parts.size(), 1u);
    EXPECT_EQ(info.parts[0].channels.at(2).type, png ? ChannelType::uint8 : ChannelType::uint16);
  }
}

TEST(Tiff, SameBytesForAnyThreads) {
  const Folder folder("tiff");
  const Grid<glm::vec3> picture = random_picture(600, 300);
  {
    const ThreadLimit one(1);
    write_tiff16(folder / "one.tif", picture, {});
  }
  ::sleep(1);  // the time must not show either
  write_tiff16(folder / "two.tif", picture, {});
  EXPECT_EQ(test::read_bytes(folder / "one.tif"), test::read_bytes(folder / "two.tif"));
}

TEST(Tiff, BecomesBigTiffFromTheSizeOn) {
  const Folder folder("tiff");
  const Grid<glm::vec3> picture = random_picture(10, 10);
  PictureFileOptions options;
  EXPECT_EQ(options.big_tiff_from_bytes, std::uint64_t{1} << 31);
  for (const std::uint64_t from : {600u, 601u}) {
    options.big_tiff_from_bytes = from;
    write_tiff16(folder / "a.tif", picture, options);
    EXPECT_EQ(test::read_bytes(folder / "a.tif").substr(0, 4), from == 600u ? "II+\0"s : "II*\0"s);
    EXPECT_EQ(read_picture(folder / "a.tif").width(), 10);
  }
}

TEST(Png, RoundsToTheNearestStepAndReadsBack) {
  const Folder folder("png");
  Grid<glm::vec3> picture = random_picture(70, 130);
  picture(0, 0) = glm::vec3(-1.0f, 2.0f, 0.51f / 255.0f);
  write_png8(folder / "a.png", picture, {});
  const Grid<glm::vec3> again = read_picture(folder / "a.png");
  EXPECT_EQ(again(0, 0), glm::vec3(0.0f, 1.0f, 1.0f / 255.0f));
  for (std::size_t i = 1; i < picture.size(); ++i)
    for (int c = 0; c < 3; ++c)
      ASSERT_EQ(std::lround(again[i][c] * 255.0),
                std::lround(static_cast<double>(picture[i][c]) * 255.0));
}

TEST(Exr, PictureReadsBackAsHalf) {
  const Folder folder("exr");
  const Grid<glm::vec3> picture = random_picture(70, 130);
  write_exr(folder / "a.exr", picture, {{"program", "1"}});
  const Grid<glm::vec3> again = read_picture(folder / "a.exr");
  for (std::size_t i = 0; i < picture.size(); ++i)
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(again[i][c], picture[i][c], 0x1p-12);
  EXPECT_EQ(read_image_info(folder / "a.exr").notes, (FileNotes{{"program", "1"}}));
}

TEST(ReadPicture, AlphaDoesNotTouchColours) {
  const Folder folder("png");
  test::write_bytes(folder / "rgba.png",
                    test::make_png(2, 1, 8, 6, "\x64\xc8\x32\x00\x64\xc8\x32\x80"s));
  Grid<float> alpha;
  Grid<glm::vec3> picture = read_picture(folder / "rgba.png", &alpha);
  EXPECT_EQ(picture(0, 0), glm::vec3(0.F)) << "what is not seen has no colour";
  EXPECT_NEAR(picture(1, 0).x, 100.0 / 255.0, 1e-7);
  EXPECT_NEAR(picture(1, 0).y, 200.0 / 255.0, 1e-7);
  EXPECT_NEAR(picture(1, 0).z, 50.0 / 255.0, 1e-7);
  EXPECT_EQ(read_picture(folder / "rgba.png"), picture) << "without alpha as well";
  read_picture_rows(folder / "rgba.png",
                    [&](int, const Grid<glm::vec3>& rows) { EXPECT_EQ(rows, picture); });
  EXPECT_EQ(alpha(0, 0), 0.0f);
  EXPECT_NEAR(alpha(1, 0), 128.0 / 255.0, 1e-6);
  test::write_bytes(folder / "ga.png", test::make_png(1, 1, 8, 4, "\x64\x80"s));
  picture = read_picture(folder / "ga.png", &alpha);
  EXPECT_NEAR(picture(0, 0).x, 100.0 / 255.0, 1e-7);
  EXPECT_NEAR(alpha(0, 0), 128.0 / 255.0, 1e-6);
  test::write_bytes(folder / "grey.png", test::make_png(1, 1, 16, 0, "\x80\x00"s));
  EXPECT_NEAR(read_picture(folder / "grey.png", &alpha)(0, 0).y, 32768.0 / 65535.0, 1e-6);
  EXPECT_EQ(alpha(0, 0), 1.0f);
}

TEST(ReadPicture, TheLargestPageOfATiffIsRead) {
  const Folder folder("pages");
  using Pages = std::vector<test::TiffPageBytes>;
  const auto info = [&](const Pages& pages) {
    test::write_bytes(folder / "a.tif", test::make_tiff_pages(pages));
    return read_image_info(folder / "a.tif");
  };
  const auto first = [&] { return std::lround(255.F * read_picture(folder / "a.tif")(0, 0).x); };
  EXPECT_EQ(info({{.width = 6, .height = 4, .value = 10}}).notes.count("Page"), 0U);
  EXPECT_EQ(info({{.width = 6, .height = 4, .value = 10}, {.width = 3, .height = 2, .value = 20}})
                .notes.count("Page"),
            0U)
      << "the first is the largest";
  EXPECT_EQ(first(), 10);
  const ImageInfo second = info(
      {{.width = 3, .height = 2, .value = 10, .kind = 1}, {.width = 6, .height = 4, .value = 20}});
  EXPECT_EQ(second.width, 6);
  EXPECT_EQ(second.notes.at("Page"), "2 of 2, the largest");
  EXPECT_EQ(first(), 20);
  EXPECT_EQ(read_grey(folder / "a.tif")(0, 0), 20);
  read_picture_rows(folder / "a.tif",
                    [](int, const Grid<glm::vec3>& rows) { EXPECT_EQ(rows.width(), 6); });
  EXPECT_EQ(info({{.width = 6, .height = 4, .value = 10}, {.width = 6, .height = 4, .value = 20}})
                .notes.at("Page"),
            "1 of 2; pages 1, 2 have the same size");
  EXPECT_EQ(first(), 10);
  info({{.width = 3, .height = 2, .value = 10}, {.width = 9, .height = 9, .value = 20, .kind = 4}});
  EXPECT_EQ(first(), 10) << "the second is a mask";
}

// NEF and DNG have a preview as their page, and the sensor's numbers in a SubIFD; CR2 a mark.
TEST(ReadPicture, APreviewOfARawFileIsRefused) {
  const Folder folder("raw");
  const test::TiffPageBytes preview{.width = 3, .height = 2, .value = 10, .kind = 1};
  const test::TiffPageBytes sensor{.width = 6, .height = 4, .value = 20, .photometric = 32803};
  std::string canon = test::make_tiff_pages({{.width = 3, .height = 2, .value = 10}}, {}, 8);
  canon.replace(8, 2, "CR");
  for (const std::string& bytes :
       {test::make_tiff_pages({preview}, sensor), canon, test::make_tiff_pages({preview}),
        test::make_tiff_pages({{.width = 3, .height = 2, .value = 1, .photometric = 34892}})}) {
    test::write_bytes(folder / "a.tif", bytes);
    for (const auto& read : std::vector<std::function<void()>>{
             [&] { read_picture(folder / "a.tif"); }, [&] { read_image_info(folder / "a.tif"); }}) {
      const Error error = test::error_of(read);
      EXPECT_EQ(error.kind(), ErrorKind::input);
      EXPECT_NE(error.found().find("preview of 3 × 2 pixels"), std::string::npos);
      EXPECT_NE(error.allowed().find("raw converter"), std::string::npos);
    }
  }
  // A reduced copy in a SubIFD, as pyramids have it, is none.
  test::write_bytes(folder / "b.tif",
                    test::make_tiff_pages({{.width = 6, .height = 4, .value = 7}}, preview));
  EXPECT_NEAR(read_picture(folder / "b.tif")(5, 3).x, 7.0 / 255.0, 1e-6);
}

TEST(ReadGrey, GivesTheNumbersOfTheFile) {
  const Folder folder("grey");
  test::write_bytes(folder / "16.png", test::make_png(3, 1, 16, 0, "\x00\x05\x01\x00\xff\xff"s));
  EXPECT_THAT(read_grey(folder / "16.png"), testing::ElementsAre(5, 256, 65535));
  test::write_bytes(folder / "8.png", test::make_png(3, 1, 8, 0, "\x00\x07\xff"s));
  EXPECT_THAT(read_grey(folder / "8.png"), testing::ElementsAre(0, 7, 255));
  test::write_bytes(folder / "4.png", test::make_png(4, 1, 4, 0, "\x03\x9f"s));
  EXPECT_THAT(read_grey(folder / "4.png"), testing::ElementsAre(0, 3, 9, 15));
  test::write_bytes(folder / "1.png", test::make_png(8, 1, 1, 0, "\x25"s));
  EXPECT_THAT(read_grey(folder / "1.png"), testing::ElementsAre(0, 0, 1, 0, 0, 1, 0, 1));
  test::write_bytes(folder / "ga.png", test::make_png(2, 1, 8, 4, "\x09\x10\x03\x00"s));
  EXPECT_THAT(read_grey(folder / "ga.png"), testing::ElementsAre(9, 3));
  test::write_bytes(folder / "8.tif", test::make_tiff(3, 2, "\x00\x01\x02\x0a\x0b\xff"s));
  EXPECT_THAT(read_grey(folder / "8.tif"), testing::ElementsAre(0, 1, 2, 10, 11, 255));
}

TEST(ReadGrey, PaletteGivesIndicesWhateverTheColours) {
  const Folder folder("grey");
  // Two entries of one colour: looking colours up would mix them.
  const std::string palette = "\x10\x20\x30\xff\x00\x00\x10\x20\x30\x00\xff\x00"s;
  test::write_bytes(folder / "8.png", test::make_png(4, 1, 8, 3, "\x03\x00\x02\x01"s, palette));
  EXPECT_THAT(read_grey(folder / "8.png"), testing::ElementsAre(3, 0, 2, 1));
  test::write_bytes(folder / "2.png", test::make_png(4, 2, 2, 3, "\xc9\x1b"s, palette));
  EXPECT_THAT(read_grey(folder / "2.png"), testing::ElementsAre(3, 0, 2, 1, 0, 1, 2, 3));
  EXPECT_EQ(read_picture(folder / "8.png")(3, 0), glm::vec3(1.0f, 0.0f, 0.0f));
}

TEST(ReadGrey, PaletteThatWasWrittenGivesItsNumbersAndColours) {
  const Folder folder("grey");
  Grid<std::uint8_t> numbers(16, 16);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<std::uint8_t>(255 - i);
  std::vector<std::array<std::uint8_t, 3>> colours(256, {7, 7, 7});
  colours[255] = {255, 0, 51};
  image_io::write_palette_png(folder / "256.png", numbers, colours);
  EXPECT_THAT(read_grey(folder / "256.png"), testing::ElementsAreArray(numbers));
  EXPECT_EQ(read_picture(folder / "256.png")(0, 0).x, 1.F);
  EXPECT_NEAR(read_picture(folder / "256.png")(0, 0).z, .2F, 1e-6F);
  const Grid<std::uint8_t> two(5, 3, 1);  // of two colours a file packs eight pixels into a byte
  image_io::write_palette_png(folder / "2.png", two, {{0, 0, 0}, {9, 9, 9}});
  EXPECT_THAT(read_grey(folder / "2.png"), testing::Each(1));
  EXPECT_EQ(kind_of([&] {
              image_io::write_palette_png(folder / "gone/x.png", two, {{0, 0, 0}, {9, 9, 9}});
            }),
            ErrorKind::output);
}

TEST(ReadGrey, RefusesColour) {
  const Folder folder("grey");
  test::write_bytes(folder / "rgb.png", test::make_png(1, 1, 8, 2, "\x01\x01\x01"s));
  EXPECT_EQ(kind_of([&] { read_grey(folder / "rgb.png"); }), ErrorKind::input);
}

// --- damaged, hostile, foreign
// ---------------------------------------------------------------------------------------------------

// 32 × 32 grey, quality 60, by the Independent JPEG Group's encoder.
const std::string jpeg_bytes(
    "\xff\xd8\xff\xe0\x00\x10\x4a\x46\x49\x46\x00\x01\x01\x00\x00\x01\x00\x01\x00\x00\xff\xdb\x00"
    "\x43\x00\x0d\x09\x0a\x0b\x0a\x08\x0d"
    "\x0b\x0a\x0b\x0e\x0e\x0d\x0f\x13\x20\x15\x13\x12\x12\x13\x27\x1c\x1e\x17\x20\x2e\x29\x31\x30"
    "\x2e\x29\x2d\x2c\x33\x3a\x4a\x3e\x33"
    "\x36\x46\x37\x2c\x2d\x40\x57\x41\x46\x4c\x4e\x52\x53\x52\x32\x3e\x5a\x61\x5a\x50\x60\x4a\x51"
    "\x52\x4f\xff\xc0\x00\x0b\x08\x00\x20"
    "\x00\x20\x01\x01\x11\x00\xff\xc4\x00\x16\x00\x01\x01\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00"
    "\x00\x00\x00\x00\x04\x05\x07\xff\xc4"
    "\x00\x16\x10\x01\x01\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x03\x00\x61\xff"
    "\xda\x00\x08\x01\x01\x00\x00\x3f\x00"
    "\xcf\xc4\x32\x78\x86\x4f\x10\xc9\xe2\x19\x46\x10\xc9\xe2\x19\x3c\x43\x27\x08\x65\x1c\x43\x27"
    "\x08\x64\xf1\x0c\x9e\x21\x94\x61\x0c"
    "\x9e\x21\x93\xc4\x32\x78\x86\x5f\xff\xd9",
    202);
TEST(ReadPicture, TruncatedFilesAreFound) {
  const Folder folder("cut");
  std::string rows;
  for (int i = 0; i < 40 * 40; ++i) rows += static_cast<char>(i * 7);
  const Grid<glm::vec3> picture = random_picture(300, 300);
  write_tiff16(folder / "own.tif", picture, {});
  write_png8(folder / "own.png", picture, {});
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.tif", test::make_tiff(40, 40, rows)},
      {"b.tif", test::read_bytes(folder / "own.tif")},
      {"c.png", test::make_png(40, 40, 8, 0, rows)},
      {"d.png", test::read_bytes(folder / "own.png")},
      {"e.png", test::make_png(40, 40, 8, 3, rows, std::string(768, 'x'))},
      {"f.jpg", jpeg_bytes}};
  for (const auto& [name, whole] : files) {
    test::write_bytes(folder / name, whole);
    EXPECT_NO_THROW(read_picture(folder / name)) << name;
    for (const double part : {0.0, 0.02, 0.1, 0.5, 0.9, 0.995}) {
      test::write_bytes(folder / name,
                        std::string_view(whole).substr(
                            0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))));
      EXPECT_EQ(kind_of([path = folder / name] { read_picture(path); }), ErrorKind::input)
          << name << " cut to " << part;
      if (!name.ends_with("jpg")) {
        EXPECT_EQ(kind_of([path = folder / name] { read_grey(path); }), ErrorKind::input)
            << name << " cut to " << part;
      }
    }
  }
}

TEST(ReadPicture, JpegIsReadWhole) {
  const Folder folder("jpeg");
  test::write_bytes(folder / "a.jpg", jpeg_bytes);
  const Grid<glm::vec3> picture = read_picture(folder / "a.jpg");
  ASSERT_EQ(picture.height(), 32);
  for (const auto [x, y] : test::cells(32, 32))
    ASSERT_NEAR(picture(x, y).x * 255.0, (4 * y + 3 * x) % 256, 8.0) << x << " " << y;
}

// Exif 2.32, 4.6.4 A: where the stored first row and column belong.
TEST(ReadPicture, ExifOrientationIsApplied) {
  const Folder folder("exif");
  std::string bytes(std::begin(jpeg_bytes), std::end(jpeg_bytes));
  const auto turned = [&](int orientation) {
    std::string exif =
        "\xff\xe1\0\x22"
        "Exif\0\0"
        "II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0"s;
    exif += static_cast<char>(orientation);
    exif += std::string(7, '\0');
    const std::string path = folder / (std::to_string(orientation) + ".jpg");
    test::write_bytes(path, bytes.substr(0, 2) + exif + bytes.substr(2));
    return path;
  };
  test::write_bytes(folder / "0.jpg", bytes);
  const Grid<glm::vec3> stored = read_picture(folder / "0.jpg");
  const int last = stored.width() - 1;
  const std::array<glm::ivec2, 8> first = {glm::ivec2{0, 0}, {last, 0}, {last, last}, {0, last},
                                           {0, 0},           {0, last}, {last, last}, {last, 0}};
  for (int o = 1; o <= 8; ++o) {
    const std::string path = turned(o);
    EXPECT_EQ(read_image_info(path).notes.contains("Orientation"), o != 1);
    const Grid<glm::vec3> picture = read_picture(path);
    const glm::ivec2 at = first[static_cast<std::size_t>(o - 1)];
    EXPECT_EQ(picture(0, 0), stored(at.x, at.y)) << o;
    // One pixel to the right is one along the row, or along the column where sides are exchanged.
    const glm::ivec2 step =
        o < 5 ? glm::ivec2(at.x == 0 ? 1 : -1, 0) : glm::ivec2(0, at.y == 0 ? 1 : -1);
    EXPECT_EQ(picture(3, 0), stored(at.x + 3 * step.x, at.y + 3 * step.y)) << o;
    Grid<glm::vec3> rows;
    read_picture_rows(path, [&](int y0, const Grid<glm::vec3>& band) {
      if (y0 == 0) rows = band;
    });
    EXPECT_EQ(rows(3, 0), picture(3, 0)) << o;
  }
}

TEST(ReadPicture, HugeClaimsAreRefusedBeforeAllocating) {
  const Folder folder("huge");
  // 95,000² pixels: 27 GB of grey bytes and far more as floats, in a file of some hundred bytes.
  test::write_bytes(folder / "a.png", test::make_png(95000, 95000, 8, 2, ""));
  EXPECT_LT(test::read_bytes(folder / "a.png").size(), 100u);
  test::write_bytes(folder / "a.exr", test::make_exr_header(95000, 95000));
  test::write_bytes(folder / "max.exr", test::make_exr_header(0x7fffffffu, 0x7fffffffu));
  EXPECT_EQ(kind_of([&] { read_picture(folder / "a.png"); }), ErrorKind::limit);
  test::write_bytes(folder / "grey.png", test::make_png(95000, 950000, 16, 0, ""));
  EXPECT_EQ(kind_of([&] { read_grey(folder / "grey.png"); }), ErrorKind::limit);
  test::write_bytes(folder / "p.png", test::make_png(95000, 950000, 8, 3, "", "abc"));
  EXPECT_EQ(kind_of([&] { read_grey(folder / "p.png"); }), ErrorKind::limit);
  EXPECT_EQ(kind_of([&] { read_channel(folder / "a.exr", "Z"); }), ErrorKind::limit);
  EXPECT_EQ(kind_of([&] { read_channel(folder / "max.exr", "Z"); }), ErrorKind::limit);
  EXPECT_EQ(read_image_info(folder / "a.exr").width, 95000)
      << "looking at the header costs nothing";
}

TEST(ReadPicture, KeepsToTheMemoryGiven) {
  const Folder folder("limit");
  write_exr(folder / "a.exr", random_picture(300, 400), {});
  write_tiff16(folder / "a.tif", random_picture(300, 400), {});
  EXPECT_NO_THROW(read_picture(folder / "a.tif"));
  const MemoryVariable limit("1");
  EXPECT_EQ(kind_of([&] { read_picture(folder / "a.tif"); }), ErrorKind::limit);
  EXPECT_EQ(kind_of([&] { read_picture(folder / "a.exr"); }), ErrorKind::limit);
  EXPECT_NO_THROW(read_channel(folder / "a.exr", "R")) << "half a megabyte";
}

TEST(ReadPicture, NamesWhatIsNoPicture) {
  const Folder folder("none");
  EXPECT_EQ(kind_of([&] { read_picture(folder / "absent.png"); }), ErrorKind::input);
  EXPECT_EQ(kind_of([&] { read_picture(folder.path()); }), ErrorKind::input);
  test::write_bytes(folder / "text.png", "not a picture at all");
  EXPECT_EQ(kind_of([&] { read_picture(folder / "text.png"); }), ErrorKind::input);
  test::write_bytes(folder / "cmyk.jpg", test::cmyk_jpeg);
  EXPECT_EQ(kind_of([&] { read_picture(folder / "cmyk.jpg"); }), ErrorKind::input);
  // The content counts, not the name.
  test::write_bytes(folder / "png.tif", test::make_png(1, 1, 8, 0, "\x01"s));
  EXPECT_EQ(read_image_info(folder / "png.tif").format, "png");
}

// --- output that fails
// -----------------------------------------------------------------------------------------------------------

TEST(Output, FullDiskLeavesTheOldFileWhole) {
  const Folder folder("full");
  const Grid<glm::vec3> picture = random_picture(200, 200);
  const std::vector<std::pair<std::string, std::function<void(const std::string&)>>> writers = {
      {"a.tif", [&](const std::string& path) { write_tiff16(path, picture, {}); }},
      {"a.png", [&](const std::string& path) { write_png8(path, picture, {}); }},
      {"a.exr", [&](const std::string& path) { write_exr(path, picture, {}); }},
      {"b.exr", [&](const std::string& path) { write_mixed(path, 200, 200); }},
  };
  std::size_t files = 0;
  for (const auto& [name, write] : writers) {
    test::write_bytes(folder / name, "old");
    ++files;
    write(folder / ("whole" + name));
    ++files;
    const auto size = static_cast<rlim_t>(test::read_bytes(folder / ("whole" + name)).size());
    // In the first byte, in the middle, and in the last byte.
    for (const rlim_t limit : {rlim_t{0}, size / 2, size - 1}) {
      const SmallDisk disk(limit);
      EXPECT_EQ(kind_of([&, w = &write, n = &name] { (*w)(folder / *n); }), ErrorKind::output)
          << name << " " << limit;
      EXPECT_EQ(test::read_bytes(folder / name), "old") << name << " " << limit;
      EXPECT_EQ(folder.count(), files) << "the temporary file is removed";
    }
    const SmallDisk disk(size);
    EXPECT_NO_THROW(write(folder / name)) << "just large enough";
  }
}

TEST(Output, PlacesWhereNothingCanBeWritten) {
  const Folder folder("place");
  test::write_bytes(folder / "file", "x");
  const Grid<glm::vec3> picture(2, 2);
  for (const std::string& path : {folder / "file/a", folder / "absent/a", "/proc/a"s}) {
    EXPECT_EQ(kind_of([&] { write_tiff16(path + ".tif", picture, {}); }), ErrorKind::output)
        << path;
    EXPECT_EQ(kind_of([&] { write_png8(path + ".png", picture, {}); }), ErrorKind::output) << path;
    EXPECT_EQ(kind_of([&] { write_exr(path + ".exr", picture, {}); }), ErrorKind::output) << path;
  }
  EXPECT_EQ(kind_of([&] { check_output_folder(folder / "file/below"); }), ErrorKind::output);
  EXPECT_EQ(kind_of([&] { check_output_folder("/proc/self"); }), ErrorKind::output);
  EXPECT_NO_THROW(check_output_folder(folder / "new/below"));
  EXPECT_TRUE(std::filesystem::is_directory(folder / "new/below"));
  EXPECT_TRUE(std::filesystem::is_empty(folder / "new/below"));
  // A folder of the output's name: the rename fails, and nothing stays.
  std::filesystem::create_directories(folder / "taken.png");
  EXPECT_EQ(kind_of([&] { write_png8(folder / "taken.png", picture, {}); }), ErrorKind::output);
  EXPECT_FALSE(std::filesystem::exists(folder / "taken.tmp.png"));
}

TEST(GreyPng, NumbersComeBackAsTheyWere) {
  const Folder folder("grey_png");
  Grid<std::uint8_t> grey(256, 3);
  for (std::size_t i = 0; i < grey.size(); ++i) grey[i] = static_cast<std::uint8_t>(i * 7);
  image_io::write_grey_png(folder / "g.png", grey);
  const Grid<std::uint16_t> read = read_grey(folder / "g.png");
  ASSERT_EQ(read.width(), 256);
  ASSERT_EQ(read.height(), 3);
  for (std::size_t i = 0; i < grey.size(); ++i) EXPECT_EQ(read[i], grey[i]);
  test::message_of(ErrorKind::output,
                   [&] { image_io::write_grey_png(folder / "gone/g.png", grey); });
}

}  // namespace
}  // namespace belvedere
