#include "renderer/exemplar/scan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "base/random.h"
#include "renderer/exemplar/harmonize.h"
#include "renderer/exemplar/uncertain_places.h"
#include "renderer/image/guidance_io.h"
#include "renderer/image/image_io.h"
#include "tests/renderer/image/picture_bytes.h"
#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/synthesize.h"

namespace belvedere {
namespace {

constexpr int scan_width = 96;
constexpr int scan_height = 80;
const glm::vec3 lettering(1.F, 0.F, 0.2F);

Grid<std::uint8_t> guide(const ScannedPainting& scan, const std::string& name) {
  const Grid<std::uint8_t>* found = scan.painted.exemplar.guides.find(name);
  return found == nullptr ? Grid<std::uint8_t>(scan_width, scan_height, 128) : *found;
}

// Sky above, snow (8) left, rock (7) right, each lighter to the right; the signature is in the
// rock's corner.
class Scans : public testing::Test {
 protected:
  Scans() {
    Grid<glm::vec3> picture(scan_width, scan_height);
    Grid<glm::vec3> classes(scan_width, scan_height);
    Grid<glm::vec3> exclude(scan_width, scan_height, glm::vec3(0.F));
    for (int y = 0; y < scan_height; ++y)
      for (int x = 0; x < scan_width; ++x) {
        const int id = y < 20 ? 0 : x < 48 ? 8 : 7;
        const float light = static_cast<float>(x % 48) / 48.F;
        const float stroke = 0.06F * static_cast<float>(random_uniform(3, x / 4, y) - 0.5);
        if (id == 0)
          picture(x, y) = glm::mix(glm::vec3(0.3F, 0.5F, 0.8F), glm::vec3(0.9F, 0.8F, 0.7F),
                                   static_cast<float>(y) / 20.F);
        if (id == 8)
          picture(x, y) =
              glm::vec3(0.55F, 0.65F, 0.85F) + 0.35F * light * glm::vec3(1.F, 0.8F, 0.3F) + stroke;
        if (id == 7)
          picture(x, y) =
              glm::vec3(0.45F, 0.25F, 0.2F) + 0.4F * light * glm::vec3(1.F, 0.9F, 0.6F) + stroke;
        if (is_lettering(x, y)) {
          picture(x, y) = lettering;
          exclude(x, y) = glm::vec3(1.F);
        }
        classes(x, y) = glm::vec3(static_cast<float>(is_corner(x, y) ? 3 : id) / 255.F);
      }
    write_png8(folder_ / "a.png", picture, {});
    write_grey("classes.png", classes);
    write_grey("exclude.png", exclude);
    for (glm::vec3& colour : picture)
      colour = glm::vec3(0.1F) + 0.6F * glm::vec3(colour.z, colour.y, colour.x);
    write_png8(folder_ / "b.png", picture, {});
  }

  // A piece of settlement (3), most of it covered by the signature.
  static bool is_corner(int x, int y) { return x >= 58 && x < 94 && y >= 46 && y < 76; }
  static bool is_lettering(int x, int y) { return x >= 60 && x < 92 && y >= 50 && y < 72; }

  void write_grey(const std::string& name, const Grid<glm::vec3>& values) const {
    std::string rows;
    for (const glm::vec3& value : values) rows += static_cast<char>(std::lround(value.x * 255.F));
    test::write_bytes(folder_ / name, test::make_png(values.width(), values.height(), 8, 0, rows));
  }

  std::vector<ScannedPainting> read(const std::string& keys, const std::string& more = "") const {
    const LoadedScene scene = parse_scene(
        "version = 1\n[camera]\nposition = [0, 0]\n[[exemplar]]\npicture = \"a.png\"\nclasses = "
        "\"classes.png\"\n" +
            keys + "\n" + more,
        "s.toml", folder_.path(), {});
    check_paintings(scene);
    return read_scans(scene, silent_progress());
  }

  test::Folder folder_;
};

TEST_F(Scans, AMaskAloneGivesToneShadowAndBase) {
  const ScannedPainting scan = read("stroke_px = 3\nexclude = \"exclude.png\"").front();
  const GuideStack& guides = scan.painted.exemplar.guides;
  std::vector<std::string> names;
  for (const Guide& each : guides.guides) names.push_back(each.name);
  EXPECT_THAT(names, testing::UnorderedElementsAre("tone", "shadow", "fall_line_x", "fall_line_y",
                                                   "valley"));
  EXPECT_EQ(guides.label(10, 5), unused_label) << "sky is painted, not copied";
  EXPECT_EQ(guides.label(10, 50), 8);
  const Grid<std::uint8_t> tone = guide(scan, "tone");
  EXPECT_GT(tone(40, 50), tone(6, 50) + 100);
  EXPECT_GT(tone(90, 40), tone(54, 40) + 100);
  // The base follows the light and not the strokes.
  const Grid<glm::vec3>& base = scan.painted.base;
  EXPECT_LT(std::abs(base(60, 40).x - (0.45F + 0.4F * 12.F / 48.F)), 0.04F);
  EXPECT_LT(std::abs(base(84, 40).x - (0.45F + 0.4F * 36.F / 48.F)), 0.04F);
}

TEST_F(Scans, WhatIsExcludedIsNeverCopied) {
  const ScannedPainting with = read("").front();
  const ScannedPainting without = read("exclude = \"exclude.png\"").front();
  GuideStack target;
  target.label = Grid<std::uint8_t>(120, 60, 3);
  const auto copied = [&](const ScannedPainting& scan) {
    const MatchField matches = synthesize({scan.painted.exemplar}, target, {}, silent_progress());
    return std::count_if(matches.begin(), matches.end(),
                         [](const Match& m) { return is_lettering(m.x, m.y); });
  };
  EXPECT_GT(copied(with), 50);
  EXPECT_EQ(copied(without), 0);
  // Its colour does not enter ramps either.
  for (const glm::vec3& colour : without.ramps[3].ramps[0]) EXPECT_GT(colour.y, 0.4F * colour.x);
  EXPECT_LT(with.ramps[3].ramps[0][2].y, 0.3F * with.ramps[3].ramps[0][2].x);
}

// A cut-out picture is the same paint whatever colour lies under its transparency.
TEST_F(Scans, WhatIsTransparentIsNotPaint) {
  const Grid<glm::vec3> picture = read_picture(folder_ / "a.png");
  std::vector<ScannedPainting> scans;
  for (const std::string& hidden : {std::string("\xff\0\xff\0", 4), std::string("\0\xff\0\0", 4)}) {
    std::string rows;
    for (int y = 0; y < picture.height(); ++y)
      for (int x = 0; x < picture.width(); ++x) {
        if (is_lettering(x, y)) {
          rows += hidden;
          continue;
        }
        for (int c = 0; c < 3; ++c)
          rows += static_cast<char>(std::lround(picture(x, y)[c] * 255.F));
        rows += '\xff';
      }
    test::write_bytes(folder_ / "a.png",
                      test::make_png(picture.width(), picture.height(), 8, 6, rows));
    scans.push_back(read("").front());
  }
  EXPECT_EQ(scans[0].painted.exemplar.guides.label(70, 60), unused_label);
  EXPECT_EQ(scans[0].painted.exemplar.picture, scans[1].painted.exemplar.picture);
  EXPECT_EQ(scans[0].painted.base, scans[1].painted.base);
  EXPECT_EQ(scans[0].ramps[3].ramps[0], scans[1].ramps[3].ramps[0]);
  for (const glm::vec3& colour : scans[0].ramps[3].ramps[0])
    EXPECT_GT(colour.y, 0.4F * colour.x) << "of what is seen";
}

TEST_F(Scans, WhatIsExcludedIsFilledWhereTheSceneSaysSo) {
  // Rock everywhere, with a red title across it that has no class.
  Grid<glm::vec3> picture(160, 120);
  Grid<glm::vec3> classes(160, 120, glm::vec3(7.F / 255.F));
  Grid<glm::vec3> title(160, 120, glm::vec3(0.F));
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) {
      picture(x, y) = glm::vec3(0.5F, 0.45F, 0.4F) +
                      0.2F * static_cast<float>(random_uniform(3, x / 4, y / 2) - 0.5);
      if (x < 30 || x >= 130 || y < 50 || y >= 60) continue;
      picture(x, y) = lettering;
      classes(x, y) = title(x, y) = glm::vec3(1.F);
    }
  write_png8(folder_ / "a.png", picture, {});
  write_grey("classes.png", classes);
  write_grey("exclude.png", title);
  const ScannedPainting skipped = read("exclude = \"exclude.png\"").front();
  EXPECT_EQ(skipped.painted.exemplar.guides.label(80, 55), unused_label);
  const ScannedPainting filled = read("exclude = \"exclude.png\"\nexcluded = \"fill\"").front();
  EXPECT_EQ(filled.painted.exemplar.guides.label(80, 55), 7);
  for (int y = 50; y < 60; ++y)
    for (int x = 30; x < 130; ++x) {
      const glm::vec3 paint = filled.painted.picture(x, y);
      ASSERT_LT(paint.x - paint.y, 0.3F) << x << " " << y;
    }
  EXPECT_EQ(filled.painted.picture(20, 20), skipped.painted.picture(20, 20));
  EXPECT_THAT([&] { read("excluded = \"fill\""); }, testing::Throws<Error>());
}

TEST_F(Scans, ServesOnlyWhatItShall) {
  const ScannedPainting scan = read("serves = [\"snow\"]").front();
  for (int x = 0; x < scan_width; ++x)
    EXPECT_EQ(scan.painted.exemplar.guides.label(x, 60), x < 48 ? 8 : unused_label) << x;
  // Rock comes from its fallback class.
  GuideStack target;
  target.label = Grid<std::uint8_t>(40, 40, 7);
  SynthesisParameters parameters;
  parameters.fallback = {{7, 8}};
  for (const Match& m : synthesize({scan.painted.exemplar}, target, parameters, silent_progress()))
    ASSERT_LT(m.x, 48);
}

TEST_F(Scans, FoundShadowIsLeftOutWhereTheSceneSaysSo) {
  // The right part of the snow lies in blue shade.
  Grid<glm::vec3> picture = read_picture(folder_ / "a.png");
  for (int y = 20; y < scan_height; ++y)
    for (int x = 0; x < 48; ++x)
      picture(x, y) = x < 28 ? glm::vec3(0.95F, 0.9F, 0.85F) : glm::vec3(0.6F, 0.68F, 0.85F);
  write_png8(folder_ / "a.png", picture, {});
  const auto label_at = [&](const std::string& how, int x) {
    return read("stroke_px = 2\nfound_shadow = \"" + how + "\"")
        .front()
        .painted.exemplar.guides.label(x, 50);
  };
  EXPECT_EQ(label_at("guide", 40), 8);
  EXPECT_EQ(label_at("exclude", 40), unused_label);
  EXPECT_EQ(label_at("exclude", 10), 8);
  const ScannedPainting guided = read("stroke_px = 2").front();
  const Grid<std::uint8_t> shadow = guide(guided, "shadow");
  EXPECT_LT(shadow(40, 50), 30);
  EXPECT_GT(shadow(10, 50), 225);
  EXPECT_EQ(read("found_shadow = \"ignore\"").front().painted.exemplar.guides.find("shadow"),
            nullptr);
}

TEST_F(Scans, AShadowImageIsTheGuideAsItStands) {
  Grid<glm::vec3> shadow(scan_width, scan_height, glm::vec3(1.F));
  for (int x = 0; x < scan_width; ++x) shadow(x, 60) = glm::vec3(0.2F);
  write_grey("shadow.png", shadow);
  const ScannedPainting scan = read("shadow = \"shadow.png\"").front();
  EXPECT_EQ(guide(scan, "shadow")(30, 60), 51);
  EXPECT_EQ(guide(scan, "shadow")(30, 61), 255);
}

TEST_F(Scans, AShadowImageOf16BitsIsReadAsSuch) {
  std::string rows;
  for (int i = 0; i < scan_width * scan_height; ++i) rows += std::string("\x00\xc8", 2);
  test::write_bytes(folder_ / "shadow.png", test::make_png(scan_width, scan_height, 16, 0, rows));
  const ScannedPainting scan = read("shadow = \"shadow.png\"").front();
  EXPECT_EQ(guide(scan, "shadow")(30, 60), 1) << "200 of 65535 is black";
}

TEST_F(Scans, ADistanceImageIsAGuideInEqualRatios) {
  Grid<glm::vec3> distance(scan_width, scan_height, glm::vec3(0.F));
  for (int y = 0; y < scan_height; ++y)
    for (int x = 0; x < scan_width; ++x) distance(x, y) = glm::vec3(y < 50 ? 1.F : 51.F / 255.F);
  write_grey("distance.png", distance);
  const ScannedPainting scan =
      read("distance = \"distance.png\"\ndistance_range_m = [500, 500000]").front();
  EXPECT_EQ(guide(scan, "distance")(30, 40), 255);
  EXPECT_EQ(guide(scan, "distance")(30, 60), 51);
  EXPECT_EQ(guide(scan, "distance")(30, 5), 0) << "the sky";
  // Its jumps are silhouettes.
  EXPECT_GT(scan.painted.exemplar.guides.depth_m(30, 40), 400000.F);
  EXPECT_THAT([&] { read("distance = \"distance.png\"\ndistance_range_m = [9000, 800]"); },
              testing::Throws<Error>());
}

TEST_F(Scans, WhatIsNotTrustedGuidesByItsClassOnly) {
  Grid<glm::vec3> altitude(scan_width, scan_height, glm::vec3(0.F));
  Grid<glm::vec3> trust(scan_width, scan_height, glm::vec3(0.F));
  for (int y = 0; y < scan_height; ++y)
    for (int x = 0; x < scan_width; ++x) {
      altitude(x, y) = glm::vec3(static_cast<float>(x % 48) / 48.F);
      trust(x, y) = glm::vec3(y < 50 ? 1.F : 0.F);
    }
  write_grey("altitude.png", altitude);
  write_grey("trust.png", trust);
  const ScannedPainting scan =
      read("altitude = \"altitude.png\"\naltitude_range_m = [0, 5000]\ntrust = \"trust.png\"")
          .front();
  const Grid<std::uint8_t> guides = guide(scan, "altitude");
  EXPECT_GT(guides(44, 40), guides(4, 40) + 150);
  EXPECT_NEAR(guides(44, 70), guides(4, 70), 60) << "nearly the mean of the class";
}

// A painting of the program, registered like any other: its guidance is that of another scene.
TEST_F(Scans, GuidanceOfAnotherSceneNeedsTrust) {
  PictureFileOptions options;
  options.notes["belvedere:scene"] = "its own";
  write_png8(folder_ / "a.png", Grid<glm::vec3>(scan_width, scan_height, glm::vec3(0.4F)), options);
  GuidanceBuffers guidance;
  guidance.depth_m = Grid<float>(scan_width, scan_height, 900.F);
  guidance.land_cover = Grid<LandCoverClass>(scan_width, scan_height, LandCoverClass::rock);
  guidance.base = Image(scan_width, scan_height, glm::vec3(0.9F));
  write_guidance(folder_ / "guidance.exr", guidance,
                 {{"belvedere:scene", "that of the registration"}});
  write_grey("trust.png", Grid<glm::vec3>(scan_width, scan_height, glm::vec3(1.F)));
  const std::string keys = "guidance = \"guidance.exr\"";
  EXPECT_THAT([&] { read(keys); },
              testing::ThrowsMessage<Error>(testing::AllOf(testing::HasSubstr("different painting"),
                                                           testing::HasSubstr("trust.png"))));
  const ScannedPainting scan = read(keys + "\ntrust = \"trust.png\"").front();
  EXPECT_LT(scan.painted.base(30, 40).x, 0.6F) << "fitted to its own paint";
}

// The skyline is registered five pixels too low, a river beside its bed.
TEST_F(Scans, WhatIsNarrowerThanARegistrationIsExactIsNotTrusted) {
  constexpr int width = 1200, height = 50;
  Grid<glm::vec3> picture(width, height, glm::vec3(0.5F, 0.4F, 0.3F));
  GuidanceBuffers guidance;
  guidance.depth_m = Grid<float>(width, height, 900.F);
  guidance.land_cover = Grid<LandCoverClass>(width, height, LandCoverClass::rock);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (y < 20) picture(x, y) = glm::vec3(0.3F, 0.5F, 0.8F);
      if (y < 25) guidance.depth_m(x, y) = std::numeric_limits<float>::infinity();
      if (y < 25) guidance.land_cover(x, y) = LandCoverClass::sky;
      const bool river = x >= 300 && x < 302, lake = x >= 600 && x < 640;
      if (y >= 30 && (river || lake)) guidance.land_cover(x, y) = LandCoverClass::water;
    }
  write_png8(folder_ / "a.png", picture, {});
  write_guidance(folder_ / "guidance.exr", guidance, {});
  Grid<glm::vec3> sure(width, height, glm::vec3(1.F));
  write_grey("trust.png", sure);
  const LoadedScene scene = parse_scene(
      "version = 1\n[camera]\nposition = [0, 0]\n[[exemplar]]\npicture = \"a.png\"\nguidance = "
      "\"guidance.exr\"\ntrust = \"trust.png\"",
      "s.toml", folder_.path(), {});
  const ScannedPainting scan = read_scans(scene, silent_progress()).front();
  const Grid<std::uint8_t>& labels = scan.painted.exemplar.guides.label;
  EXPECT_EQ(labels(300, 40), unused_label);
  EXPECT_EQ(labels(620, 40), static_cast<std::uint8_t>(LandCoverClass::water));
  EXPECT_EQ(labels(900, 40), static_cast<std::uint8_t>(LandCoverClass::rock));
  // The silhouette is where it is painted.
  EXPECT_EQ(scan.painted.exemplar.guides.depth_m(900, 20), 900.F);
  EXPECT_TRUE(std::isinf(scan.painted.exemplar.guides.depth_m(900, 19)));
  ASSERT_FALSE(scan.sky.empty());
  for (const auto& [height_share, colour] : scan.sky) EXPECT_NEAR(colour.z, 0.8F, 0.01F);
}

TEST_F(Scans, ClassesOfARegistrationAreCorrectedByThePaint) {
  GuidanceBuffers guidance;
  guidance.depth_m = guidance.altitude_m = Grid<float>(scan_width, scan_height, 1500.F);
  guidance.land_cover = Grid<LandCoverClass>(scan_width, scan_height);
  for (int y = 0; y < scan_height; ++y)
    for (int x = 0; x < scan_width; ++x) {
      if (y < 20) guidance.depth_m(x, y) = std::numeric_limits<float>::infinity();
      guidance.land_cover(x, y) = y < 20   ? LandCoverClass::sky
                                  : x < 48 ? LandCoverClass::snow
                                           : LandCoverClass::rock;
    }
  for (int y = 40; y < 46; ++y)
    for (int x = 20; x < 26; ++x) guidance.land_cover(x, y) = LandCoverClass::rock;
  write_guidance(folder_ / "guidance.exr", guidance, {});
  const auto label = [&](const std::string& keys) {
    const LoadedScene scene = parse_scene(
        "version = 1\n[camera]\nposition = [0, 0]\n[[exemplar]]\npicture = \"a.png\"\nguidance = "
        "\"guidance.exr\"\n" +
            keys,
        "s.toml", folder_.path(), {});
    return read_scans(scene, silent_progress()).front().painted.exemplar.guides.label(23, 43);
  };
  EXPECT_EQ(label(""), 8) << "the paint is that of snow";
  EXPECT_EQ(label("classes_from = \"guidance\""), 7);
  EXPECT_EQ(label("classes = \"classes.png\""), 8);
}

TEST_F(Scans, SeveralPaintingsAreHarmonizedWhereTheSceneSaysSo) {
  const std::string second =
      "[[exemplar]]\npicture = \"b.png\"\nclasses = \"classes.png\"\n[synthesis]\nharmonize = ";
  const auto distance = [&](const std::string& how) {
    const std::vector<ScannedPainting> scans = read("", second + how + "\n");
    const auto view = [&](std::size_t i) {
      return LabelledPicture{&scans[i].painted.picture, &scans[i].painted.exemplar.guides.label};
    };
    return colour_distance(view(0), view(1), 7);
  };
  const double apart = distance("\"off\"");
  EXPECT_GT(apart, 0.05);
  EXPECT_LT(distance("\"common\""), 0.2 * apart);
  EXPECT_LT(distance("\"first\""), 0.2 * apart);
  // By regions, whatever the classes: with red and blue exchanged nothing matches better
  // (docs/textures.md), but the picture changes.
  EXPECT_NE(distance("\"regions\""), apart);
}

TEST_F(Scans, TheirColoursBecomeThePalette) {
  const std::vector<ScannedPainting> scans = read("stroke_px = 3\nexclude = \"exclude.png\"");
  const Palette summer = read_palette("summer");
  const Palette taken =
      take_colours(summer, scans, {{LandCoverClass::glacier, LandCoverClass::snow}});
  // Rock is the painted brown at each tone, darker in shade.
  const glm::vec3 shade = palette_colour(taken, LandCoverClass::rock, 800.0, 0.2);
  const glm::vec3 light = palette_colour(taken, LandCoverClass::rock, 2800.0, 0.9);
  EXPECT_GT(light.x, shade.x + 0.2F);
  for (const glm::vec3& colour : {shade, light}) EXPECT_GT(colour.x, colour.z + 0.1F);
  EXPECT_EQ(taken.classes[9].stops.front().ramp, taken.classes[8].stops.front().ramp)
      << "glacier as snow";
  // Forest is not in the painting: the palette's own, shifted.
  EXPECT_NE(palette_colour(taken, LandCoverClass::forest, 800.0, 0.5),
            palette_colour(summer, LandCoverClass::forest, 800.0, 0.5));
  EXPECT_EQ(taken.classes[4].stops.size(), summer.classes[4].stops.size());
  EXPECT_LT(glm::length(taken.sky.front().second - glm::vec3(0.36F, 0.56F, 0.78F)), 0.08F);
  EXPECT_LT(glm::length(taken.sky.back().second - glm::vec3(0.84F, 0.77F, 0.71F)), 0.08F);
  // Without a painting nothing changes.
  EXPECT_EQ(take_colours(summer, {}, {}).sky, summer.sky);
}

TEST_F(Scans, GuidesOfAnotherSizeAreRefusedBeforeTheWork) {
  write_grey("exclude.png", Grid<glm::vec3>(10, 10));
  EXPECT_THAT([&] { read("exclude = \"exclude.png\""); }, testing::Throws<Error>());
}

}  // namespace
}  // namespace belvedere
