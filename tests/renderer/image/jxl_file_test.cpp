#include "renderer/image/jxl_file.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/random.h"
#include "renderer/image/display_conversion.h"
#include "tests/files.h"
#include "tests/renderer/image/random_picture.h"

namespace belvedere {
namespace {

using test::Folder;
using test::random_picture;

void write_jxl16(const std::string& path, const Grid<glm::vec3>& encoded,
                 const PictureFileOptions& options) {
  write_whole(*open_jxl16(path, encoded.width(), encoded.height(), options), encoded);
}

TEST(Jxl, KeepsEveryValueAndRoundsToTheNearest) {
  const Folder folder("jxl");
  Grid<glm::vec3> picture =
      random_picture(530, 270);  // three groups of 256 across, the last one cut
  picture(1, 0) = glm::vec3(0.49F / 65535.0F, 0.51F / 65535.0F, 1.0F);
  write_jxl16(folder / "a.jxl", picture, {});
  const Grid<glm::vec3> again = read_jxl_picture(folder / "a.jxl", nullptr);
  ASSERT_TRUE(again.same_size(picture));
  EXPECT_EQ(again(1, 0), glm::vec3(0.0F, 1.0F / 65535.0F, 1.0F));
  for (std::size_t i = 0; i < picture.size(); ++i)
    for (int c = 0; c < 3; ++c)
      ASSERT_EQ(std::lround(again[i][c] * 65535.0),
                std::lround(static_cast<double>(picture[i][c]) * 65535.0))
          << i;
}

TEST(Jxl, WithoutAProfileItIsMarkedSrgb) {
  const Folder folder("jxl");
  write_jxl16(folder / "plain.jxl", random_picture(20, 10), {});
  EXPECT_TRUE(read_jxl_info(folder / "plain.jxl").icc_profile.empty());
  PictureFileOptions options;
  options.icc_profile = srgb_profile();
  write_jxl16(folder / "profile.jxl", random_picture(20, 10), options);
  EXPECT_EQ(read_jxl_info(folder / "profile.jxl").icc_profile, srgb_profile());
}

TEST(Jxl, RefusesAProfileThatIsNone) {
  const Folder folder("jxl");
  PictureFileOptions options;
  options.icc_profile.assign(1000, 7);
  const Error error =
      test::error_of([&] { write_jxl16(folder / "a.jxl", random_picture(20, 10), options); });
  EXPECT_EQ(error.kind(), ErrorKind::output);
  EXPECT_NE(error.found().find("profile"), std::string::npos);
  EXPECT_EQ(folder.count(), 0u) << "nothing stays behind";
}

TEST(Jxl, LongNotesComeWhole) {
  const Folder folder("jxl");
  const std::string scene(200000, 'x');  // longer than the pieces in which boxes are read
  PictureFileOptions options;
  options.notes = {{"scene", scene}};
  write_jxl16(folder / "a.jxl", random_picture(20, 10), options);
  EXPECT_EQ(read_jxl_info(folder / "a.jxl").notes.at("scene"), scene);
}

}  // namespace
}  // namespace belvedere
