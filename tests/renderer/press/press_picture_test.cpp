#include "renderer/press/press_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "renderer/image/image_io.h"
#include "renderer/image/rows/picture_files.h"
#include "tests/files.h"
#include "tests/renderer/image/icc/press_profile.h"
#include "tests/renderer/image/rows/write_pictures.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

TEST(PressPicture, IsThePictureOfAFolderThatIsRgb) {
  const test::Folder folder;
  const Image picture(20, 10, glm::vec3(0.5F));
  test::write_pictures(folder / "panorama", {"tif", "png", "exr"}, picture);
  EXPECT_EQ(find_press_picture(folder.path()).file, folder / "panorama.tif");
  EXPECT_EQ(find_press_picture(folder.path()).width, 20);
  EXPECT_NEAR(find_press_picture(folder.path()).dots_per_inch, 300.0, 1e-3);
  test::write_pictures(folder / "panorama", {"tif"}, picture, {{}, test::press_profile()});
  EXPECT_EQ(find_press_picture(folder.path()).file, folder / "panorama.png")
      << "the TIFF is CMYK now";
}

TEST(PressPicture, SaysWhatItCannotTake) {
  const test::Folder folder;
  const Image picture(20, 10, glm::vec3(0.5F));
  test::write_pictures(folder / "panorama", {"tif", "exr"}, picture, {{}, test::press_profile()});
  const auto refused = [&](const std::string& path) {
    return test::message_of(ErrorKind::input, [&] { find_press_picture(path); });
  };
  EXPECT_THAT(refused(folder / "panorama.tif"), HasSubstr("CMYK"));
  EXPECT_THAT(refused(folder / "panorama.exr"), HasSubstr("linear light"));
  EXPECT_THAT(refused(folder / "absent.png"), HasSubstr("file not found"));
  EXPECT_THAT(refused(folder.path()), HasSubstr("has no panorama"));
}

}  // namespace
}  // namespace belvedere
