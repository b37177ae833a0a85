#include "renderer/style/winter_style.h"

#include <gtest/gtest.h>

#include "renderer/style/style_file.h"
#include "tests/renderer/style/styled_sheet.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

glm::vec3 lit(const Palette& palette, LandCoverClass id) {
  return glm::vec3(to_oklab(palette_colour(palette, id, 1500.0, 0.7)));
}

TEST(WinterStyle, OpenGroundIsAsWhiteAsTheStylesSnow) {
  for (const char* name : {"segantini", "gogh", "bruegel"}) {
    const Style summer = read_style(std::string("data/styles/") + name + ".toml");
    const Style winter = winter_style(summer);
    EXPECT_TRUE(winter.palette.winter);
    const glm::vec3 snow_colour = lit(summer.palette, snow);
    for (const LandCoverClass id : {pasture, alpine_grass, valley_floor, scree})
      EXPECT_NEAR(lit(winter.palette, id).x, snow_colour.x, 0.06F) << name << " " << class_name(id);
    EXPECT_EQ(lit(winter.palette, rock), lit(summer.palette, rock)) << name;
    EXPECT_LT(lit(winter.palette, forest).x, snow_colour.x - 0.15F) << name;
  }
}

TEST(WinterStyle, SnowHasTheStrokesOfSnow) {
  Style style = test::make_style();
  style.palette = read_palette("summer");
  style.brushwork[static_cast<std::size_t>(snow)].width_px = 4.0;
  const Style winter = winter_style(style);
  EXPECT_EQ(winter.brushwork[static_cast<std::size_t>(pasture)].width_px, 4.0);
  EXPECT_NE(winter.brushwork[static_cast<std::size_t>(forest)].width_px, 4.0);
}

}  // namespace
}  // namespace belvedere
