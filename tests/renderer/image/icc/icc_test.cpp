#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/image/display_conversion.h"
#include "renderer/image/icc/press_colour.h"
#include "renderer/image/image_io.h"
#include "tests/files.h"
#include "tests/renderer/image/picture_bytes.h"
#include "tests/renderer/image/random_picture.h"

namespace belvedere {
namespace {

using test::Folder;
using test::random_picture;

std::string as_text(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

// The profile with red and green taking each other's place: the names in the table of tags are
// exchanged.
std::vector<std::uint8_t> swapped_profile() {
  std::string text = as_text(srgb_profile());
  const std::size_t red = text.find("rXYZ");
  const std::size_t green = text.find("gXYZ");
  EXPECT_LT(std::max(red, green), 400u) << "both in the table of tags";
  text[red] = 'g';
  text[green] = 'r';
  return {text.begin(), text.end()};
}

TEST(Icc, SrgbProfileHasTheSameBytesEveryTime) {
  const std::vector<std::uint8_t> first = srgb_profile();
  ::sleep(1);
  EXPECT_EQ(first, srgb_profile());
  ASSERT_GT(first.size(), 128u);
  const std::string text = as_text(first);
  EXPECT_EQ(text.substr(16, 4), "RGB ");
  EXPECT_EQ(text.substr(36, 4), "acsp");
  EXPECT_EQ(text.substr(24, 6), std::string("\x07\xcf\0\x0a\0\x12", 6));
  EXPECT_NE(text.substr(84, 16), std::string(16, '\0')) << "the profile's own checksum";
}

TEST(Icc, ToSrgbIsTheIdentity) {
  const Grid<glm::vec3> picture = random_picture(200, 50);
  const Grid<glm::vec3> out = ProfileConversion(srgb_profile()).convert(picture);
  for (std::size_t i = 0; i < picture.size(); ++i)
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(out[i][c], picture[i][c], 1.0 / 65535.0);
}

TEST(Icc, ConvertsToTheDeviceNumbers) {
  const Grid<glm::vec3> picture = random_picture(50, 50);
  const Grid<glm::vec3> out = ProfileConversion(swapped_profile()).convert(picture);
  for (std::size_t i = 0; i < picture.size(); ++i) {
    ASSERT_NEAR(out[i].x, picture[i].y, 1e-4);
    ASSERT_NEAR(out[i].y, picture[i].x, 1e-4);
    ASSERT_NEAR(out[i].z, picture[i].z, 1e-4);
  }
}

TEST(Icc, SameBitsForAnyThreads) {
  const Grid<glm::vec3> picture = random_picture(211, 97);
  const Grid<glm::vec3> many = ProfileConversion(swapped_profile()).convert(picture);
  const ThreadLimit one(1);
  EXPECT_EQ(ProfileConversion(swapped_profile()).convert(picture), many);
}

TEST(Icc, EmbeddedAndReadAgain) {
  const Folder folder("icc");
  PictureFileOptions options;
  options.icc_profile = srgb_profile();
  write_png8(folder / "a.png", random_picture(5, 5), options);
  write_tiff16(folder / "a.tif", random_picture(5, 5), options);
  EXPECT_EQ(read_image_info(folder / "a.png").icc_profile, options.icc_profile);
  EXPECT_EQ(read_image_info(folder / "a.tif").icc_profile, options.icc_profile);
  test::write_bytes(folder / "a.icc", as_text(options.icc_profile));
  EXPECT_EQ(read_device_profile(folder / "a.icc"), options.icc_profile);
}

TEST(Icc, FaultsAreNamed) {
  const Folder folder("icc");
  const std::string good = as_text(srgb_profile());
  const auto changed = [&](std::size_t at, const std::string& with) {
    return std::string(good).replace(at, with.size(), with);
  };
  const std::vector<std::pair<std::string, std::string>> files = {
      {"text.icc", "this is no profile"},
      {"empty.icc", ""},
      {"cut.icc", good.substr(0, 200)},
      {"grey.icc", changed(16, "GRAY")},
      {"link.icc", changed(12, "link")}};
  for (const auto& [name, bytes] : files) {
    test::write_bytes(folder / name, bytes);
    const std::string path = folder / name;
    EXPECT_THAT(test::input_error([&] { read_device_profile(path); }), testing::HasSubstr(name));
    EXPECT_THROW(ProfileConversion({bytes.begin(), bytes.end()}), Error) << name;
  }
  const std::string cmyk = changed(16, "CMYK");
  EXPECT_THROW(ProfileConversion({cmyk.begin(), cmyk.end()}), Error);
  EXPECT_THROW(read_device_profile(folder / "absent.icc"), Error);
  EXPECT_THROW(read_device_profile(folder.path()), Error);
}

}  // namespace
}  // namespace belvedere
