#include "renderer/style/style_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "base/error.h"
#include "base/text/embedded.h"
#include "renderer/image/srgb.h"
#include "renderer/style/fit_style.h"
#include "tests/files.h"
#include "tests/renderer/style/synthetic_painting.h"

namespace belvedere {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const Style& example() {
  static const Style style = [] {
    const test::Landscape landscape = test::make_landscape();
    StyleFitParameters parameters;
    parameters.name = "bands \"of\" colour\\";
    parameters.origin = "Nobody, Bands, 1900; two\nlines";
    parameters.licence = "public domain";
    return fit_style(landscape.picture, landscape.mask, read_palette("summer"), parameters,
                     silent_progress());
  }();
  return style;
}

std::string error_of(const std::string& text) {
  return test::usage_error([&] { parse_style(text, "test.toml"); });
}

std::string changed(const std::string& from, const std::string& to) {
  std::string text = style_text(example());
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

void expect_near_colours(const glm::vec3& a, const glm::vec3& b, float within) {
  EXPECT_LE(glm::length(a - b), within);
}

TEST(StyleFile, ReadsWhatItWritesToThePrintedDigits) {
  const Style& style = example();
  const Style read = parse_style(style_text(style), "test.toml");
  constexpr float byte = 0.5F / 255.0F * 1.8F;  // half a step of each channel
  constexpr double digit = 0.0005 + 1e-9;
  EXPECT_EQ(read.name, style.name);
  EXPECT_EQ(read.origin, style.origin);
  EXPECT_EQ(read.licence, style.licence);
  EXPECT_EQ(read.notes, style.notes);
  EXPECT_NEAR(read.broken, style.broken, digit);
  EXPECT_NEAR(read.vapour, style.vapour, digit);
  EXPECT_NEAR(read.form_deviation, style.form_deviation, digit);
  EXPECT_NEAR(read.unevenness, style.unevenness, digit);
  EXPECT_NEAR(read.contour_lines, style.contour_lines, digit);
  EXPECT_NEAR(read.hue_by_light, style.hue_by_light, digit);
  EXPECT_NEAR(read.units_per_px, style.units_per_px, digit);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(read.trend[c], style.trend[c], digit);
  for (std::size_t c = 1; c < land_cover_class_count; ++c)
    for (std::size_t k = 0; k < 4; ++k)
      expect_near_colours(read.palette.classes[c].stops.at(0).ramp[k],
                          style.palette.classes[c].stops.at(0).ramp[k], byte);
  ASSERT_EQ(read.palette.sky.size(), style.palette.sky.size());
  expect_near_colours(read.palette.haze_near, style.palette.haze_near, byte);
  EXPECT_NEAR(read.palette.haze_share, style.palette.haze_share, digit);
  EXPECT_EQ(read.palette.growth.leaves.size(), 4U);
  for (std::size_t c = 0; c < land_cover_class_count; ++c) {
    const StyleBrushwork& a = read.brushwork[c];
    const StyleBrushwork& b = style.brushwork[c];
    EXPECT_NEAR(a.length_px, b.length_px, digit);
    EXPECT_NEAR(a.width_px, b.width_px, digit);
    EXPECT_NEAR(a.level, b.level, digit);
    EXPECT_NEAR(a.form, b.form, digit);
    EXPECT_NEAR(a.coherence, b.coherence, digit);
    EXPECT_NEAR(a.lightness_deviation, b.lightness_deviation, digit);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(a.steadiness[k], b.steadiness[k], digit);
    ASSERT_EQ(a.accents.size(), b.accents.size());
    for (std::size_t i = 0; i < a.accents.size(); ++i)
      expect_near_colours(a.accents[i], b.accents[i], 0.006F);
    for (std::size_t third = 0; third < 3; ++third) {
      ASSERT_EQ(a.residuals[third].size(), b.residuals[third].size());
      for (std::size_t i = 0; i < a.residuals[third].size(); ++i)
        expect_near_colours(a.residuals[third][i], b.residuals[third][i], 0.0009F);
    }
  }
  ASSERT_TRUE(read.sky.medians.same_size(style.sky.medians));
  for (std::size_t i = 0; i < read.sky.medians.size(); ++i)
    expect_near_colours(read.sky.medians[i], style.sky.medians[i], 0.006F);
  EXPECT_NEAR(read.sky.aspect, style.sky.aspect, digit);
  EXPECT_NEAR(read.sky.upper_edges, style.sky.upper_edges, digit);
  EXPECT_NEAR(read.sky.clear_share, style.sky.clear_share, digit);
  expect_near_colours(read.sky.clear, style.sky.clear, 0.0009F);
  ASSERT_EQ(read.sky.changes.size(), style.sky.changes.size());
  for (std::size_t k = 0; k < read.sky.changes.size(); ++k) {
    expect_near_colours(read.sky.changes[k].axis, style.sky.changes[k].axis, 1e-4F);
    EXPECT_NEAR(read.sky.changes[k].length_x, style.sky.changes[k].length_x, digit);
    for (std::size_t s = 0; s < 3; ++s)
      EXPECT_NEAR(read.sky.changes[k].streaks[s], style.sky.changes[k].streaks[s], digit);
    for (std::size_t q = 0; q < 7; ++q)
      EXPECT_NEAR(read.sky.changes[k].quantiles[q], style.sky.changes[k].quantiles[q], digit);
  }
}

TEST(StyleFile, WrittenAgainItIsTheSameText) {
  const std::string text = style_text(example());
  EXPECT_EQ(style_text(parse_style(text, "test.toml")), text);
  EXPECT_LT(text.size(), 40'000U);
}

TEST(StyleFile, ReadsAPaletteOfSeveralAltitudesAndItsBase) {
  const Style plain = parse_style("based_on = \"summer\"\nname = \"plain\"\n", "test.toml");
  EXPECT_EQ(plain.name, "plain");
  EXPECT_EQ(plain.brushwork[7].length_px, 0.0);
  EXPECT_TRUE(plain.sky.medians.empty());
  const std::string text = style_text(plain);
  EXPECT_THAT(text, HasSubstr("altitude_m = 1300"));
  EXPECT_EQ(style_text(parse_style(text, "test.toml")), text);
}

TEST(StyleFile, RefusesWhatItDoesNotKnowWithItsPlace) {
  EXPECT_THAT(error_of(changed("broken =", "brokn =")),
              AllOf(HasSubstr("test.toml:"), HasSubstr("brokn"), HasSubstr("broken")));
  EXPECT_THAT(error_of(changed("[brushwork.rock]", "[brushwork.rok]")),
              AllOf(HasSubstr("rok"), HasSubstr("rock")));
  EXPECT_THAT(error_of(changed("coherence =", "coherent =")), HasSubstr("coherent"));
  EXPECT_THAT(error_of(changed("length_x =", "length =")), HasSubstr("length"));
  EXPECT_THAT(error_of(changed("cloud_light", "clod_light")), HasSubstr("clod_light"));
  EXPECT_THAT(error_of(changed("[sky_grid]", "[sky_grd]")), HasSubstr("sky_grd"));
}

TEST(StyleFile, RefusesValuesOutOfRange) {
  EXPECT_THAT(error_of(changed("vapour = ", "vapour = 7")), HasSubstr("0 … 1"));
  EXPECT_THAT(error_of(changed("dark = [\n  [", "dark = [\n  [9000,")), HasSubstr("three numbers"));
  EXPECT_THAT(error_of(changed("accents = [\n  \"#", "accents = [\n  \"x")), HasSubstr("#rrggbb"));
  EXPECT_THAT(error_of(changed("quantiles = [", "quantiles = [1, ")), HasSubstr("8 quantiles"));
  EXPECT_THAT(error_of(changed("steadiness = [", "steadiness = [0.1, ")), HasSubstr("5 shares"));
  EXPECT_THAT(error_of(changed("steadiness = [", "steadiness = [0.001, 0.5, 0.4, 0.3] # [")),
              HasSubstr("descending"));
  EXPECT_THAT(error_of(changed("upper_edges = ", "upper_edges = 9")), HasSubstr("-1 … 1"));
  EXPECT_THAT(error_of(changed("streaks = [", "streaks = [7, ")), HasSubstr("three numbers"));
  EXPECT_THAT(error_of(changed("medians = [\n  [", "medians = [\n  [\"#112233\", ")),
              HasSubstr("a row of 3 colours"));
  EXPECT_THAT(error_of("based_on = \"summer\"\n[brushwork.rock]\nwidth_px = 2\n"),
              HasSubstr("no length_px"));
  EXPECT_THAT(error_of("name = \"x\"\n"), HasSubstr("classes"));
}

TEST(ReadStyle, ReadsFilesAndKnowsNames) {
  const test::Folder folder;
  const std::string file = folder.write("style.toml", style_text(example()));
  EXPECT_EQ(read_style(file).name, example().name);
  EXPECT_THROW(read_style("nobodys_style"), Error);
  EXPECT_THROW(read_style("/nowhere/style.toml"), Error);
}

// The built-in styles.
TEST(ReadStyle, BuiltInStylesAreCompleteAndNameTheirPainting) {
  for (const std::string& name : embedded_names("styles")) {
    const Style style = read_style(name);
    EXPECT_EQ(style.name, name);
    EXPECT_FALSE(style.origin.empty()) << name;
    EXPECT_FALSE(style.licence.empty()) << name;
    EXPECT_EQ(style.sky.medians.height(), 5) << name;
    EXPECT_EQ(style_text(style), std::string(embedded_file("styles/" + name + ".toml"))) << name;
  }
}

}  // namespace
}  // namespace belvedere
