// `belvedere texture judge` as users meet it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.h"
#include "tests/texture/statistical/texture_crops.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class TextureJudge : public Program {
 protected:
  std::string write_rgb(const std::string& name, const Grid<Rgb8>& picture) const {
    return write_picture(name, picture.width(), picture.height(), [&](int x, int y) {
      const Rgb8& c = picture(x, y);
      return glm::vec3(c[0], c[1], c[2]) / 255.F;
    });
  }
};

// A crop is at no distance from itself and copied whole; noise of the same size is far off and copies nothing.
TEST_F(TextureJudge, TellsACopyFromNoise) {
  const std::string crop = write_rgb("crop.png", test::meadow_crop(72, 64));
  Grid<Rgb8> noise(72, 64);
  for (std::size_t i = 0; i < noise.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      noise[i][c] = static_cast<std::uint8_t>(random_bits(3, static_cast<std::int64_t>(i), static_cast<std::int64_t>(c)) & 255U);
  const std::string other = write_rgb("noise.png", noise);
  ASSERT_EQ(run({"texture", "learn", crop, "--types", "20", "--out", path("m.model"), "-q"}).status, 0);
  const Outcome judged = run({"texture", "judge", path("m.model"), crop, crop, other, "--json", "-q"});
  ASSERT_EQ(judged.status, 0) << judged.err;
  EXPECT_THAT(judged.out, AllOf(HasSubstr("halves"), HasSubstr("\"longest_copy_px\": 16"), HasSubstr("\"longest_copy_px\": 0")));
  const auto number = [&](const std::string& key, int nth) {
    std::size_t at = 0;
    for (int i = 0; i <= nth; ++i) at = judged.out.find("\"" + key + "\":", at) + key.size() + 3;
    return std::stod(judged.out.substr(at));
  };
  EXPECT_LT(number("held_out", 1), 1e-6);
  EXPECT_GT(number("held_out", 2), 0.5);
  EXPECT_GT(number("selected", 2), 0.5);
  // Layout is asked of pictures alone.
  EXPECT_LT(number("by_height", 0), 1e-6);
  EXPECT_LT(number("far_pairs", 0), 1e-6);
  EXPECT_GT(number("by_height", 1), 0.5);
}

TEST_F(TextureJudge, SaysWhatIsMissing) {
  const Outcome judged = run({"texture", "judge", path("none.model"), path("a.png"), path("b.png")});
  EXPECT_EQ(judged.status, 3);
  EXPECT_THAT(judged.err, HasSubstr("none.model"));
}

}  // namespace
}  // namespace belvedere
