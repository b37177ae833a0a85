#include "renderer/style/fit_style.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/parallel.h"
#include "renderer/style/style_file.h"
#include "tests/renderer/style/synthetic_painting.h"
#include "texture/synthesis/guide_stack.h"

namespace belvedere {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

Style fitted(const test::Landscape& landscape) {
  StyleFitParameters parameters;
  parameters.name = "bands";
  parameters.origin = "nobody";
  return fit_style(landscape.picture, landscape.mask, read_palette("summer"), parameters,
                   silent_progress());
}

std::string refusal(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& mask) {
  try {
    fit_style(picture, mask, read_palette("summer"), {}, silent_progress());
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(FitStyle, GivesAllThatASceneNeeds) {
  const Style style = fitted(test::make_landscape());
  EXPECT_EQ(style.name, "bands");
  EXPECT_EQ(style.palette.name, "bands");
  for (std::size_t c = 1; c < land_cover_class_count; ++c) {
    ASSERT_EQ(style.palette.classes[c].stops.size(), 1U);
    for (const glm::vec3& colour : style.palette.classes[c].stops[0].ramp)
      for (int k = 0; k < 3; ++k) {
        EXPECT_GE(colour[k], 0.0F);
        EXPECT_LE(colour[k], 1.0F);
      }
  }
  for (const LabRamp& ramp : palette_ramps(style.palette))
    for (std::size_t k = 1; k < 4; ++k) EXPECT_GE(ramp[k].x, ramp[k - 1].x);
  EXPECT_EQ(style.palette.sky.size(), 5U);
  EXPECT_EQ(style.sky.medians.width(), 3);
  EXPECT_GT(style.brushwork[0].length_px, 0.0);
  EXPECT_GT(style.brushwork[static_cast<std::size_t>(LandCoverClass::rock)].length_px, 0.0);
  EXPECT_EQ(style.brushwork[static_cast<std::size_t>(LandCoverClass::water)].length_px, 0.0);
  EXPECT_EQ(style.units_per_px, 2.6);  // a small painting is enlarged to the limit
  EXPECT_THAT(style.notes, Contains("classes seen: forest, rock, snow, pasture"));
  EXPECT_THAT(style.notes, Contains(HasSubstr("no far air")));
}

TEST(FitStyle, IsTheSameForAnyNumberOfThreads) {
  const test::Landscape landscape = test::make_landscape();
  const std::string text = style_text(fitted(landscape));
  const ThreadLimit one(1);
  EXPECT_EQ(style_text(fitted(landscape)), text);
}

// A painting at half the lightness gives ramps as light as a map needs; hues are unchanged.
TEST(FitStyle, DarkPaintingsAreCleaned) {
  test::Landscape dark = test::make_landscape();
  for (std::size_t i = 0; i < dark.picture.size(); ++i)
    dark.picture[i] = from_oklab(glm::dvec3(0.6F * dark.lab[i]));
  const Style style = fitted(dark);
  EXPECT_THAT(style.notes, Contains(HasSubstr("lightened")));
  EXPECT_GE(ground_lightness(palette_ramps(style.palette)), 0.55);
}

TEST(FitStyle, WithoutASkyThereIsAPlainOne) {
  test::Landscape landscape = test::make_landscape();
  for (std::uint8_t& label : landscape.mask)
    if (label == test::label_of(LandCoverClass::sky)) label = unused_label;
  const Style style = fitted(landscape);
  EXPECT_TRUE(style.sky.medians.empty());
  EXPECT_EQ(style.palette.sky.size(), 2U);
  EXPECT_THAT(style.notes, Contains(HasSubstr("no sky")));
  EXPECT_THAT(style.notes, Contains(HasSubstr("no water")));
}

TEST(FitStyle, RefusesMasksThatDoNotFit) {
  const test::Landscape landscape = test::make_landscape();
  EXPECT_THAT(refusal(landscape.picture, Grid<std::uint8_t>(10, 10, 4)),
              HasSubstr("the size of the painting"));
  Grid<std::uint8_t> strange = landscape.mask;
  strange(3, 3) = 77;
  EXPECT_THAT(refusal(landscape.picture, strange), HasSubstr("the number 77"));
  EXPECT_THAT(refusal(landscape.picture, Grid<std::uint8_t>(160, 120, 0)),
              HasSubstr("no class of the ground"));
}

}  // namespace
}  // namespace belvedere
