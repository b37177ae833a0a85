#include "renderer/image/exif.h"

#include <gtest/gtest.h>

#include <string_view>

namespace belvedere {
namespace {

std::vector<std::uint8_t> bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

TEST(Exif, ReadsWhatItWrites) {
  const ExifTags tags{.description = "first line\nsecond: \\ line",
                      .software = "Belvedere",
                      .dots_per_inch = 301.5};
  EXPECT_EQ(read_exif(write_exif(tags)), tags);
  EXPECT_EQ(read_exif(write_exif({})), ExifTags{});
  const ExifTags short_words{.description = "abc",
                             .software = "x",
                             .dots_per_inch = 0.0};  // short enough to stand in their entries
  EXPECT_EQ(read_exif(write_exif(short_words)), short_words);
}

TEST(Exif, BytesAreThoseOfTheStandard) {
  // TIFF 6.0, section 2: head, number of entries, (tag, type, count, value or its offset) …, 0,
  // then the values.
  const std::string_view expected(
      "II*\0\x08\0\0\0"
      "\x03\0"
      "\x1a\x01\x05\0\x01\0\0\0\x32\0\0\0"
      "\x1b\x01\x05\0\x01\0\0\0\x3a\0\0\0"
      "\x28\x01\x03\0\x01\0\0\0\x02\0\0\0"
      "\0\0\0\0"
      "\xc0\xc6\x2d\0\x10\x27\0\0"
      "\xc0\xc6\x2d\0\x10\x27\0\0",
      66);
  EXPECT_EQ(write_exif({.description = {}, .software = {}, .dots_per_inch = 300.0}),
            bytes_of(expected));
}

TEST(Exif, ReadsBigEndianAndCentimetres) {
  const std::string_view file(
      "MM\0*\0\0\0\x08"
      "\0\x03"
      "\x01\x0e\0\x02\0\0\0\x04hut\0"
      "\x01\x1a\0\x05\0\0\0\x01\0\0\0\x32"
      "\x01\x28\0\x03\0\0\0\x01\0\x03\0\0"
      "\0\0\0\0"
      "\0\0\0\xec\0\0\0\x02",
      58);
  const ExifTags tags = read_exif(bytes_of(file));
  EXPECT_EQ(tags.description, "hut");
  EXPECT_NEAR(tags.dots_per_inch, 118.0 * 2.54, 1e-9);
}

TEST(Exif, DamagedBytesSayNothingOrLess) {
  const std::vector<std::uint8_t> whole =
      write_exif({.description = "some words", .software = "a program", .dots_per_inch = 72.0});
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const ExifTags tags =
        read_exif({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)});
    EXPECT_TRUE(tags.description.empty() || tags.description == "some words") << size;
  }
  for (std::size_t at = 4; at < whole.size(); ++at) {
    std::vector<std::uint8_t> bytes = whole;
    bytes[at] = 0xff;
    read_exif(bytes);  // offsets and counts beyond the end: the sanitizers would report an access
                       // out of bounds
  }
}

}  // namespace
}  // namespace belvedere
