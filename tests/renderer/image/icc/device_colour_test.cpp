#include "renderer/image/icc/device_colour.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/error.h"
#include "renderer/image/display_conversion.h"
#include "renderer/image/icc/press_colour.h"
#include "renderer/image/image_io.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

glm::vec3 convert(glm::vec3 srgb, const std::string& space) {
  return ProfileConversion(colour_space_profile(space), {RenderingIntent::relative, false})
      .convert(Grid<glm::vec3>(1, 1, srgb))(0, 0);
}

// Steps of 17 levels a channel would be 4913 colours; of 6 they are 216, corners and greys among
// them.
Grid<glm::vec3> chart() {
  Grid<glm::vec3> out(36, 6);
  for (int i = 0; i < 216; ++i)
    out[static_cast<std::size_t>(i)] = glm::vec3(i % 6, i / 6 % 6, i / 36) / 5.0F;
  return out;
}

// Numbers from the primaries alone (matrix of linear light, then the curve): SMPTE EG 432-1 and
// Adobe RGB (1998).
TEST(DeviceColor, PrimariesOfSrgbHaveTheirKnownPlaces) {
  const glm::vec3 p3_red = convert({1, 0, 0}, "display-p3");
  EXPECT_NEAR(p3_red.x, 0.9175, 1e-3);
  EXPECT_NEAR(p3_red.y, 0.2003, 1e-3);
  EXPECT_NEAR(p3_red.z, 0.1386, 1e-3);
  const glm::vec3 adobe_green = convert({0, 1, 0}, "adobe-rgb");
  EXPECT_NEAR(adobe_green.x, 0.5650, 1e-3);
  EXPECT_NEAR(adobe_green.y, 1.0000, 1e-3);
  EXPECT_NEAR(adobe_green.z, 0.2344, 1e-3);
  for (const char* space : {"srgb", "display-p3", "adobe-rgb"})
    for (const float grey : {0.0F, 1.0F})
      EXPECT_LT(std::abs(convert(glm::vec3(grey), space).y - grey), 1e-4F) << space;
}

// Through the file, as a printer would read it: 16 bits, profile embedded, and back.
TEST(DeviceColor, AChartComesBackFromEverySpace) {
  const test::Folder folder;
  const Grid<glm::vec3> colours = chart();
  const Grid<glm::vec3> lab = rgb_to_lab(colours);
  for (const std::string& space : colour_space_names()) {
    const std::vector<std::uint8_t> profile = colour_space_profile(space);
    const DeviceParameters exact = {RenderingIntent::relative, false};
    write_tiff16(folder / "a.tif", ProfileConversion(profile, exact).convert(colours),
                 {.icc_profile = profile, .notes = {}});
    const Grid<glm::vec3> back =
        rgb_to_lab(read_picture(folder / "a.tif"), read_image_info(folder / "a.tif").icc_profile);
    for (std::size_t i = 0; i < lab.size(); ++i)
      EXPECT_LT(delta_e_2000(lab[i], back[i]), 0.05) << space << " " << i;
  }
}

TEST(DeviceColor, ProfilesAreTheSameBytesAndKnowTheirNames) {
  for (const std::string& space : colour_space_names()) {
    EXPECT_EQ(colour_space_profile(space), colour_space_profile(space));
    EXPECT_TRUE(is_rgb_profile(colour_space_profile(space)));
  }
  EXPECT_EQ(profile_name(colour_space_profile("display-p3")), "Display P3");
  EXPECT_THAT(test::usage_error([] { colour_space_profile("prophoto"); }),
              HasSubstr("srgb, display-p3, adobe-rgb"));
}

TEST(DeviceColor, IntentsHaveNames) {
  for (const RenderingIntentName& one : rendering_intents())
    EXPECT_EQ(rendering_intent(std::string(one.name)), one.intent);
  EXPECT_THAT(test::usage_error([] { rendering_intent("nice"); }),
              HasSubstr("perceptual, relative, saturation, absolute"));
}

}  // namespace
}  // namespace belvedere
