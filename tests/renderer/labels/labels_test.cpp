#include "renderer/labels/labels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/parallel.h"
#include "renderer/world/valley_view.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

LabelPoint point(const char* name, std::optional<double> altitude_m = std::nullopt, int kind = 0) {
  LabelPoint p;
  p.name = name;
  p.altitude_m = altitude_m;
  p.kind = kind;
  return p;
}

LabelMark seen_at(double x, double y, double dem_m = 1000.0) {
  LabelMark mark;
  mark.pixel = {x, y};
  mark.dem_altitude_m = dem_m;
  mark.state = MarkState::seen;
  return mark;
}

const std::vector<double> no_sky_of_2000(2000, 0.0);

TEST(Labels, AreSetWithTheAltitudeOfTheFileOrElseOfTheGround) {
  const LabelStyle style = load_label_style("classic");
  const LabelSheet sheet = make_labels(
      {point("A", 2749.4), point("B"), point(""), point("C", 570.0, style.find("town"))},
      {seen_at(200, 300), seen_at(600, 300), seen_at(1000, 300), seen_at(1500, 300)},
      no_sky_of_2000, style, {2000, 800}, 1000.0);
  EXPECT_EQ(sheet.labels[0].text,
            "A\u2002"
            "2749\u00A0m");
  EXPECT_EQ(sheet.labels[1].text,
            "B\u2002"
            "1000\u00A0m");
  EXPECT_EQ(sheet.labels[2].text, "1000\u00A0m") << "a summit that nobody named";
  EXPECT_EQ(sheet.labels[3].text, "C") << "towns say no altitude";
  for (const Label& label : sheet.labels) EXPECT_TRUE(label.spot.placed);
}

TEST(Labels, AreAsLargeAsTheSheetAndNeverUnreadable) {
  const LabelStyle style = load_label_style("classic");
  double smallest = 100.0;
  for (const LabelKindStyle& kind : style.kinds) smallest = std::min(smallest, kind.size_mm);
  const auto scale = [&](int width) {
    return make_labels({point("A")}, {seen_at(10, 10)}, no_sky_of_2000, style, {width, 800}, 1200.0)
        .px_per_mm;
  };
  EXPECT_DOUBLE_EQ(scale(20000), 20000.0 / 1200.0);
  EXPECT_DOUBLE_EQ(scale(1200), 11.0 / smallest)
      << "letters of 11 px, and all else along with them";
}

TEST(Labels, OnlyWhatIsSeenAsksForRoom) {
  LabelMark hidden = seen_at(500, 300);
  hidden.state = MarkState::hidden;
  hidden.in_front = GeoPosition{{1000.0, 1000.0}, 900.0, 5000.0};
  LabelMark front = seen_at(500, 320);
  front.drawn_position = {1400.0, 1000.0};
  LabelMark farther = seen_at(900, 320);
  farther.drawn_position = {1000.0, 2900.0};
  const LabelSheet sheet =
      make_labels({point("Hidden"), point("Front"), point("Farther")}, {hidden, front, farther},
                  no_sky_of_2000, load_label_style("classic"), {2000, 800}, 1000.0);
  EXPECT_FALSE(sheet.labels[0].spot.placed);
  EXPECT_EQ(sheet.labels[0].hidden_by, "Front");
  EXPECT_TRUE(sheet.labels[1].spot.placed && sheet.labels[2].spot.placed);
}

// Valleys are set with room between their letters; letters that join stay together, on a point and
// along a line.
TEST(Labels, LettersThatJoinAreNotDrawnApart) {
  const LabelStyle style = load_label_style("classic");
  const int valley = style.find("valley");
  ASSERT_GT(style.kinds[static_cast<std::size_t>(valley)].spacing, 0.0);
  const std::vector<glm::dvec2> line = {{100, 600}, {900, 600}};
  const LabelSheet sheet =
      make_labels({point("Tal", 1.0, valley), point("وادي", 1.0, valley), point("עמק", 1.0, valley),
                   point("وادي", 1.0, valley)},
                  {seen_at(200, 100), seen_at(600, 100), seen_at(1000, 100), seen_at(500, 600)},
                  no_sky_of_2000, style, {2000, 800}, 1000.0, {{}, {}, {}, line});
  EXPECT_GT(sheet.labels[0].spacing, 0.0);
  EXPECT_EQ(sheet.labels[1].spacing, 0.0);
  EXPECT_GT(sheet.labels[2].spacing, 0.0) << "Hebrew letters do not join";
  EXPECT_EQ(sheet.labels[3].spacing, 0.0);
  EXPECT_FALSE(sheet.labels[3].spot.baseline.empty());
}

// Where the picture shows sky above a row and ground below it.
TEST(Skyline, PartsSkyAndLandInEveryColumn) {
  const BareView bare = make_bare_view(test::small_scene({"output.width=192", "output.height=160"}),
                                       silent_progress());
  const GeoMap map = bare.geo_map();
  const std::vector<double> skyline = find_skyline(map, {192, 160});
  ASSERT_EQ(skyline.size(), 192U);
  for (std::size_t x = 0; x < skyline.size(); ++x) {
    const double column = static_cast<double>(x) + .5;
    EXPECT_FALSE(skyline[x] > .5 && map.to_geo({column, skyline[x] - .5}));
    EXPECT_TRUE(skyline[x] >= 159.0 || map.to_geo({column, skyline[x] + .25}));
  }
  const ThreadLimit one(1);
  EXPECT_EQ(find_skyline(map, {192, 160}), skyline);
}

}  // namespace
}  // namespace belvedere
