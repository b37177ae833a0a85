#include "renderer/image/oiio_file.h"

#include <gtest/gtest.h>

#include "renderer/image/image_io.h"
#include "tests/files.h"

namespace belvedere {
namespace {

// Of this program: other tests of it call OpenImageIO themselves.
class LateOiio : public ::testing::Environment {
  void SetUp() override { load_oiio(); }
};
[[maybe_unused]] const ::testing::Environment* const late_oiio =
    ::testing::AddGlobalTestEnvironment(new LateOiio);

// That the program is not linked with it: Program.StartsWithoutOpenImageIO.
TEST(LateOiio, FindsEveryFunctionThatReadersAndWritersCall) {
  EXPECT_NO_THROW(load_oiio());
  const test::Folder folder;
  const Grid<glm::vec3> picture(5, 4, glm::vec3(0.25F, 0.5F, 1.0F));
  write_png8(folder / "a.png", picture, {});
  write_jpeg(folder / "a.jpg", picture, 95);
  EXPECT_EQ(read_image_info(folder / "a.png").width, 5);
  EXPECT_EQ(read_image_info(folder / "a.jpg").height, 4);
  EXPECT_NEAR(read_picture(folder / "a.png")(3, 2).y, 0.5F, 0.01F);
}

}  // namespace
}  // namespace belvedere
