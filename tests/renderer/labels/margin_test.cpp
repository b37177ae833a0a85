#include "renderer/labels/margin.h"

#include <gtest/gtest.h>

#include "renderer/world/world.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

TEST(Margin, BarsHaveRoundLengths) {
  EXPECT_DOUBLE_EQ(bar_length_m(.1, 600.0), 5000.0);
  EXPECT_DOUBLE_EQ(bar_length_m(.1, 200.0), 2000.0);
  EXPECT_DOUBLE_EQ(bar_length_m(.1, 199.0), 1000.0);
  EXPECT_DOUBLE_EQ(bar_length_m(50.0, 20.0), 1.0);
  EXPECT_EQ(length_text(5000.0), "5\u00A0km");
  EXPECT_EQ(length_text(200.0), "200\u00A0m");
}

// All of it is on the paper and none on the picture, on wide and narrow sheets.
TEST(Margin, LeavesThePictureFree) {
  MarginContent content{.title = "Karwendel",
                        .subtitle = "from the north",
                        .classes = {{"forest", "#336633"},
                                    {"rock", "#aaaaaa"},
                                    {"snow", "#ffffff"},
                                    {"water", "#3366aa"},
                                    {"scree", "#bbaa99"},
                                    {"pasture", "#99aa55"}},
                        .features = {{.name = "main road"},
                                     {.name = "lift", .form = SwatchForm::cable},
                                     {.name = "path"}},
                        .scales = {{5000.0, .4}, {40000.0, .05}},
                        .directions = true,
                        .view_azimuth_deg = 182.0,
                        .sun_azimuth_deg = 315.0,
                        .sun_altitude_deg = 30.0,
                        .sources = {"ALOS World 3D 30 m, JAXA (free of charge with credit)",
                                    "names: general knowledge"}};
  const TextMeasure measure;
  for (const int width : {2400, 700}) {
    const Margin margin = lay_out_margin(content, {}, {width, 500}, 3.0, 30.0);
    EXPECT_EQ(margin.left, 30);
    EXPECT_EQ(margin.top, 30);
    EXPECT_GT(margin.bottom, 100);
    int texts = 0;
    for (const DrawnShape& shape : margin.drawing.shapes)
      if (const DrawnText* text = std::get_if<DrawnText>(&shape)) {
        ++texts;
        EXPECT_GT(text->at.y - .8 * text->type.size_px, 530.0) << text->text;
        EXPECT_LT(text->at.y, margin.drawing.size_px.y) << text->text;
        EXPECT_LT(
            text->at.x + (1.0 - text->anchor) * measure.measure(text->text, text->type).width_px,
            width + 60.0)
            << text->text;
      }
    EXPECT_GE(texts, 16);
  }
  EXPECT_EQ(lay_out_margin({}, {}, {700, 500}, 3.0, 0.0).bottom, 0) << "nothing to say, no paper";
}

// Looking south, north is below and a sun in the north-west on the lower right.
TEST(Margin, TheRoseTurnsWithTheView) {
  MarginContent content;
  content.directions = true;
  content.view_azimuth_deg = 180.0;
  content.sun_azimuth_deg = 315.0;
  const Margin margin = lay_out_margin(content, {}, {900, 300}, 3.0, 30.0);
  glm::dvec2 rose(0.0), sun(0.0), north(0.0);
  bool first = true;
  for (const DrawnShape& shape : margin.drawing.shapes) {
    if (const DrawnCircle* circle = std::get_if<DrawnCircle>(&shape)) {
      (first ? rose : sun) = circle->centre;
      first = false;
    }
    if (const DrawnText* text = std::get_if<DrawnText>(&shape);
        text != nullptr && text->text == "N")
      north = text->at;
  }
  EXPECT_GT(north.y, rose.y);
  EXPECT_NEAR(north.x, rose.x, 1e-6);
  EXPECT_GT(sun.x, rose.x);
  EXPECT_GT(sun.y, rose.y);
}

// The length of a bar is the distance of two ground points in the picture.
TEST(Margin, ScalesAreThoseOfTheGround) {
  const BareView bare = make_bare_view(test::small_scene({"output.width=960", "output.height=800"}),
                                       silent_progress());
  const GeoMap map = bare.geo_map();
  const std::vector<ScaleBar> bars =
      find_scales(map, glm::dvec2(bare.view.camera.eye), 100.0, {960, 800});
  ASSERT_FALSE(bars.empty());
  if (bars.size() == 2) {
    EXPECT_GT(bars[1].distance_m, bars[0].distance_m);
    EXPECT_LT(bars[1].px_per_m, bars[0].px_per_m);
  }
  const double focal_px =
      480.0 / std::tan(.5 * bare.view.camera.field_of_view_deg * std::acos(-1.0) / 180.0);
  for (const ScaleBar& bar : bars)
    EXPECT_NEAR(bar.px_per_m * bar.distance_m / focal_px, 1.0, .15) << bar.distance_m;
}

}  // namespace
}  // namespace belvedere
