#include "renderer/labels/labels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/parallel.h"
#include "base/random.h"
#include "renderer/world/world.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

using testing::AllOf;
using testing::HasSubstr;

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
  EXPECT_EQ(sheet.labels[0].text, "A");
  EXPECT_EQ(sheet.labels[0].altitude, "2749\u00A0m");
  EXPECT_EQ(sheet.labels[1].altitude, "1000\u00A0m");
  EXPECT_EQ(sheet.labels[2].text, "1000\u00A0m") << "a summit that nobody named";
  EXPECT_EQ(sheet.labels[3].text, "C");
  EXPECT_EQ(sheet.labels[3].altitude, "") << "towns say no altitude";
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
  EXPECT_DOUBLE_EQ(scale(1200), style.min_px / smallest)
      << "letters of that size, and all else along with them";
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

TEST(Labels, FontsOfTheStyleAreRequired) {
  LabelStyle style = load_label_style("classic");
  EXPECT_NO_THROW(require_fonts(style)) << "tools/setup installs them";
  style.kinds[0].family = "No Such Font At All";
  EXPECT_THAT(test::input_error([&] { require_fonts(style); }),
              AllOf(HasSubstr("No Such Font At All"), HasSubstr("fonts-ebgaramond")));
}

// Rules of Imhof (1975) for names on maps, with the classic style.

const LabelStyle& classic() {
  static const LabelStyle style = load_label_style("classic");
  return style;
}

LabelSheet sheet_of(const std::vector<LabelPoint>& points, const std::vector<LabelMark>& marks,
                    const std::vector<std::vector<glm::dvec2>>& lines = {}) {
  return make_labels(points, marks, no_sky_of_2000, classic(), {2000, 800}, 500.0, lines);
}

LabelPoint of_kind(const char* name, const char* kind, double rank = 5.0) {
  LabelPoint p = point(name, std::nullopt, classic().find(kind));
  p.rank = rank;
  return p;
}

TEST(PlacingRules, ATownsNameStandsToTheUpperRight) {
  const LabelSheet sheet = sheet_of({of_kind("Schwaz", "town")}, {seen_at(900, 400)});
  const LabelBox& box = sheet.labels[0].spot.text;
  EXPECT_GT(box.left, 900.0);
  EXPECT_LT(box.bottom, 400.0 + .5 * (box.bottom - box.top));
}

TEST(PlacingRules, NamesOfPointsAreLevelAndSummitsHaveThemAbove) {
  const LabelSheet sheet = sheet_of({of_kind("Habicht", "summit"), of_kind("Vomp", "village")},
                                    {seen_at(500, 400), seen_at(1200, 400)});
  for (const Label& label : sheet.labels) EXPECT_TRUE(label.spot.baseline.empty());
  EXPECT_LT(sheet.labels[0].spot.text.bottom, 400.0);
  EXPECT_NEAR(.5 * (sheet.labels[0].spot.text.left + sheet.labels[0].spot.text.right), 500.0, 1e-6);
}

// A river passes right of the town, where its name would stand.
TEST(PlacingRules, ATownsNameStaysOnItsSideOfTheRiver) {
  for (const double river : {930.0, 870.0}) {
    const LabelSheet sheet =
        sheet_of({of_kind("Schwaz", "town"), of_kind("Inn", "river")},
                 {seen_at(900, 400), seen_at(river, 400)}, {{}, {{river, 10}, {river, 790}}});
    ASSERT_TRUE(sheet.labels[0].spot.placed);
    const LabelBox& box = sheet.labels[0].spot.text;
    EXPECT_TRUE(river > 900.0 ? box.right < river : box.left > river) << river;
  }
}

// Letters of a river's name stand over it or under it, and its line passes through none of them.
TEST(PlacingRules, ARiversNameDoesNotStraddleIt) {
  std::vector<glm::dvec2> line;
  for (int k = 0; k <= 60; ++k)
    line.emplace_back(300.0 + 20.0 * k, 400.0 + 30.0 * std::sin(.05 * k));
  const LabelSheet sheet = sheet_of({of_kind("Isar", "river")}, {seen_at(900, 400)}, {line});
  const Label& label = sheet.labels[0];
  ASSERT_FALSE(label.spot.baseline.empty());
  const double size_px = sheet.type_of(label).size_px;
  for (const glm::dvec2 p : label.spot.baseline) {
    double nearest = 1e9;
    for (const glm::dvec2 q : line) nearest = std::min(nearest, glm::length(q - p));
    EXPECT_GT(nearest, .25 * size_px) << "deeper than letters reach below their baseline";
  }
}

TEST(PlacingRules, NamesAlongLinesAreNeverUpsideDown) {
  for (const double turn : {0.0, .4, 2.7, 3.14159, 3.6, 5.9}) {
    const glm::dvec2 way(std::cos(turn), std::sin(turn));
    const glm::dvec2 centre(1000.0, 400.0);
    const LabelSheet sheet = sheet_of({of_kind("Inntal", "valley")}, {seen_at(1000, 400)},
                                      {{centre - 320.0 * way, centre + 320.0 * way}});
    const std::vector<glm::dvec2>& baseline = sheet.labels[0].spot.baseline;
    ASSERT_FALSE(baseline.empty()) << turn;
    for (std::size_t i = 0; i + 1 < baseline.size(); ++i)
      EXPECT_GT(baseline[i + 1].x, baseline[i].x) << turn;
  }
}

// The name of an area reaches over half of it, with equal spaces, in its middle.
TEST(PlacingRules, NamesOfAreasAreSpreadEvenlyOverThem) {
  const LabelSheet sheet = sheet_of({of_kind("Nordkette", "range", 3.0)}, {seen_at(1000, 400)},
                                    {{{600, 400}, {1400, 400}}});
  const Label& label = sheet.labels[0];
  ASSERT_FALSE(label.spot.letters.empty());
  EXPECT_GT(label.spot.text.right - label.spot.text.left, 400.0);
  EXPECT_NEAR(.5 * (label.spot.text.left + label.spot.text.right), 1000.0, 15.0);
  // What follows a letter beyond its own width is the same everywhere.
  const TextMeasure measure;
  TextStyle plain = sheet.type_of(label);
  plain.spacing = 0.0;
  const std::vector<TextLetter> bare = measure.letters(label.text, plain);
  const std::vector<TextLetter> set = measure.letters(label.text, sheet.type_of(label));
  ASSERT_EQ(bare.size(), set.size());
  double least = 1e9, most = 0.0;
  for (std::size_t i = 1; i + 1 < bare.size(); ++i) {
    const double alone = measure.measure(bare[i].text, plain).width_px;
    least = std::min(least, set[i].width_px - alone);
    most = std::max(most, set[i].width_px - alone);
  }
  EXPECT_GT(least, .2 * plain.size_px);
  EXPECT_LT(most - least, .05 * plain.size_px);
}

// A crowd of all kinds: nothing overlaps, nothing crosses the neat line, the best ranks stay, and
// there are no more names around any one than the style allows.
TEST(PlacingRules, ACrowdIsThinnedByRank) {
  std::vector<LabelPoint> points;
  std::vector<LabelMark> marks;
  for (int i = 0; i < 300; ++i) {
    const char* kinds[] = {"summit", "town", "village", "hut"};
    points.push_back(
        of_kind("Ödkarspitzen", kinds[i % 4], 1.0 + std::floor(9.0 * random_uniform(3, i, 0))));
    marks.push_back(seen_at(2000.0 * random_uniform(3, i, 1), 800.0 * random_uniform(3, i, 2)));
  }
  const LabelSheet sheet = sheet_of(points, marks);
  const double margin_px = classic().margin_mm * sheet.px_per_mm;
  std::size_t placed = 0, crowded = 0;
  for (std::size_t i = 0; i < sheet.labels.size(); ++i) {
    const LabelSpot& spot = sheet.labels[i].spot;
    crowded += spot.crowded ? 1U : 0U;
    if (!spot.placed) continue;
    ++placed;
    EXPECT_FALSE(spot.crowded);
    EXPECT_GE(std::min(spot.text.left, spot.text.top), margin_px - 1e-9);
    EXPECT_LE(spot.text.right, 2000.0 - margin_px + 1e-9);
    EXPECT_LE(spot.text.bottom, 800.0 - margin_px + 1e-9);
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(sheet.labels[j].spot.placed && sheet.labels[j].spot.text.overlaps(spot.text));
  }
  EXPECT_GT(placed, 30U);
  EXPECT_GT(crowded, 50U);
  const double radius_px = 56.419 * sheet.px_per_mm;
  for (const Label& label : sheet.labels)
    if (label.spot.placed) {
      const auto around =
          std::count_if(sheet.labels.begin(), sheet.labels.end(), [&](const Label& other) {
            return other.spot.placed && other.point.rank <= label.point.rank &&
                   glm::length(other.mark.pixel - label.mark.pixel) < radius_px;
          });
      EXPECT_LE(around, 2.0 * classic().names_per_dm2) << "about as many as of better rank";
    }
}

// The smaller the picture, the fewer names, and the more important ones.
TEST(PlacingRules, SmallPicturesHaveFewerNames) {
  std::vector<LabelPoint> points;
  for (int i = 0; i < 120; ++i) points.push_back(of_kind("Birkkarspitze", "summit", 1.0 + i % 9));
  std::size_t last = 1000;
  for (const int width : {6000, 3000, 1500, 700}) {
    std::vector<LabelMark> marks;
    for (int i = 0; i < 120; ++i)
      marks.push_back(
          seen_at(width * random_uniform(4, i, 1), .5 * width * random_uniform(4, i, 2)));
    const LabelSheet sheet =
        make_labels(points, marks, std::vector<double>(static_cast<std::size_t>(width), 0.0),
                    classic(), {width, width / 2}, 1200.0);
    std::size_t placed = 0;
    double ranks = 0.0;
    for (const Label& label : sheet.labels)
      if (label.spot.placed) {
        ++placed;
        ranks += label.point.rank;
      }
    EXPECT_LE(placed, last) << width;
    EXPECT_TRUE(width == 6000 || ranks / static_cast<double>(placed) < 4.9) << width;
    last = placed;
  }
  EXPECT_LT(last, 25U);
}

TEST(Labels, NumbersOfRunsStandInDiscsOnTheirLines) {
  const LabelSheet sheet = sheet_of({of_kind("Run 12b", "run_easy"), of_kind("Lift 3", "lift")},
                                    {seen_at(500, 400), seen_at(1000, 400)},
                                    {{{300, 200}, {700, 600}}, {{1000, 100}, {1000, 700}}});
  EXPECT_EQ(sheet.labels[0].text, "12");
  EXPECT_EQ(sheet.labels[1].text, "3");
  for (const Label& label : sheet.labels) ASSERT_TRUE(label.spot.placed);
  const LabelBox& box = sheet.labels[0].spot.text;
  EXPECT_NEAR(.5 * (box.left + box.right), 500.0, 1e-6);
  EXPECT_NEAR(.5 * (box.top + box.bottom), 400.0, 1e-6);
}

// A lake that runs away from the viewer is narrow: its name would lie across both banks.
TEST(Labels, ANameWiderThanItsWaterStandsBesideIt) {
  const auto box_of = [](double lake_px) {
    LabelMark lake = seen_at(1000, 400);
    lake.width_px = lake_px;
    return sheet_of({of_kind("Achensee", "lake")}, {lake}, {{{1000, 300}, {1000, 500}}})
        .labels[0]
        .spot.text;
  };
  EXPECT_GT(box_of(24.0).left, 1012.0);
  const LabelBox wide = box_of(900.0);
  EXPECT_NEAR(.5 * (wide.left + wide.right), 1000.0, 1e-6) << "over its own water";
}

// Letters are light only where the ground is dark, and spaced ones already on forest.
TEST(Labels, InksFollowTheGround) {
  LabelSheet sheet = sheet_of({of_kind("Dunkel", "summit"), of_kind("Hell", "summit")},
                              {seen_at(500, 400), seen_at(1500, 400)});
  Grid<float> luminance(200, 80, .4F);
  for (const auto [x, y] : test::cells(100, 80)) luminance(x, y) = .02F;
  choose_inks(sheet, luminance);
  EXPECT_TRUE(sheet.labels[0].on_dark);
  EXPECT_FALSE(sheet.labels[1].on_dark);
  sheet = sheet_of({of_kind("Wald", "valley"), of_kind("Wald", "summit")},
                   {seen_at(500, 400), seen_at(1500, 400)});
  choose_inks(sheet, Grid<float>(200, 80, .12F));
  EXPECT_TRUE(sheet.labels[0].on_dark);
  EXPECT_FALSE(sheet.labels[1].on_dark);
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
