// `belvedere info` as users meet it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/image/picture_diff.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST_F(Program, InfoTellsSizeChannelsAndNotes) {
  write_tiff16(path("a.tif"), Grid<glm::vec3>(20, 10, glm::vec3(0.5F)),
               {.dots_per_inch = 254.0, .icc_profile = {}, .notes = {{"k", "one"}}});
  const Outcome words = run({"info", path("a.tif")});
  EXPECT_EQ(words.status, 0) << words.err;
  EXPECT_THAT(words.out,
              StartsWith(path("a.tif") + ": tiff, 20 × 10 pixels, 254 dpi (2 × 1 mm)\n"));
  EXPECT_THAT(words.out, HasSubstr("R (uint16)"));
  EXPECT_THAT(words.out, HasSubstr("k: one\n"));
  EXPECT_THAT(run({"info", path("a.tif"), "--json"}).out, HasSubstr("\"k\": \"one\""));
}

TEST_F(Program, InfoHashesPixels) {
  const std::string a = write_picture(
      "a.png", 8, 8, [](int x, int) { return glm::vec3(static_cast<float>(x) / 8.F); });
  const std::string hash = hash_picture(a).whole;
  EXPECT_THAT(run({"info", a, "--hash"}).out, HasSubstr("hash of the pixels: " + hash + "\n"));
  EXPECT_THAT(run({"info", a, "--hash", "--json"}).out, HasSubstr("\"hash\": \"" + hash + "\""));
  EXPECT_THAT(run({"info", a}).out, Not(HasSubstr(hash))) << "reading all pixels takes its time";
}

}  // namespace
}  // namespace belvedere
