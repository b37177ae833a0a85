#include "renderer/image/icc/painting_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/image/icc/device_colour.h"
#include "renderer/image/image_io.h"
#include "tests/files.h"
#include "tests/notes.h"
#include "tests/renderer/image/random_picture.h"

namespace belvedere {
namespace {

using test::Folder;
using test::kind_of;
using test::random_picture;

TEST(ReadPainting, ComesInSrgbWithANoteOnWhatWasChanged) {
  const Folder folder("painting");
  test::Notes notes;
  const Grid<glm::vec3> picture = random_picture(40, 30);
  write_tiff16(folder / "s.tif", picture, {.icc_profile = srgb_profile(), .notes = {}});
  EXPECT_EQ(read_painting(folder / "s.tif", notes), read_picture(folder / "s.tif"));
  EXPECT_EQ(notes.text(), "");
  // Swapping red and green in the profile's tag table swaps them in the colours.
  std::vector<std::uint8_t> profile = srgb_profile();
  const std::string text(profile.begin(), profile.end());
  profile[text.find("rXYZ")] = 'g';
  profile[text.find("gXYZ")] = 'r';
  write_tiff16(folder / "p.tif", picture, {.icc_profile = profile, .notes = {}});
  const Grid<glm::vec3> painting = read_painting(folder / "p.tif", notes);
  EXPECT_THAT(notes.text(), testing::HasSubstr("converted to sRGB"));
  for (std::size_t i = 0; i < picture.size(); ++i) {
    EXPECT_NEAR(painting[i].x, picture[i].y, 1e-3);
    EXPECT_NEAR(painting[i].y, picture[i].x, 1e-3);
    EXPECT_NEAR(painting[i].z, picture[i].z, 1e-3);
  }
  write_tiff16(folder / "d.tif", picture, {.icc_profile = {1, 2, 3}, .notes = {}});
  EXPECT_EQ(kind_of([&] { read_painting(folder / "d.tif", notes); }), ErrorKind::input);
  EXPECT_NO_THROW(read_picture(folder / "d.tif"));
}

}  // namespace
}  // namespace belvedere
