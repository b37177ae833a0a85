#include "renderer/exemplar/example_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <set>
#include <utility>

#include "base/error.h"
#include "renderer/exemplar/available_texels.h"
#include "renderer/exemplar/exemplar_files.h"
#include "renderer/exemplar/exemplars.h"
#include "renderer/exemplar/scan.h"
#include "renderer/image/guidance_io.h"
#include "renderer/image/image_io.h"
#include "renderer/paint/composite.h"
#include "tests/files.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

// Two panels of one small terrain.
constexpr const char* two_panels = R"(
width = 256
height = 256
columns = 2
dots_per_inch = 25.4
scene = """
version = 1
[terrain.synthetic]
width = 130
height = 140
cell_m = 120
[camera]
position = [8000, -6000]
height_m = 9000
pitch_deg = -35
[sampling]
pixel_samples = 1
shadow_rays = 2
sky_directions = 4
"""
[terrains]
high = ["terrain.synthetic.seed=4"]
[views]
left = ["camera.azimuth_deg=-10"]
right = ["camera.azimuth_deg=20"]
[[panels]]
terrain = "high"
view = "left"
[[panels]]
terrain = "high"
view = "right"
set = ["sun.altitude_deg=20"]
)";

ExampleSheetPlan small_plan() { return parse_example_sheet_plan(two_panels, "two.toml"); }

TEST(ExampleSheetPlan, PanelsCoverTheSheetWithMarginsBetweenThem) {
  for (const int size : {256, 266, 1000, 4096}) {
    ExampleSheetPlan plan = built_in_example_sheet_plan();
    plan.width = plan.height = size;
    Grid<int> covered(plan.width, plan.height, 0);
    for (int p = 0; p < static_cast<int>(plan.panels.size()); ++p) {
      const PixelRect cell = panel_cell(plan, p);
      const PixelRect inner = panel_rect(plan, p);
      EXPECT_GT(inner.x0, cell.x0);
      EXPECT_LT(inner.y1, cell.y1);
      EXPECT_GE(inner.width(), 16);
      EXPECT_TRUE(cell.y0 % 64 == 0);  // otherwise files could not be written row by row
      for (int y = cell.y0; y < cell.y1; ++y)
        for (int x = cell.x0; x < cell.x1; ++x) ++covered(x, y);
    }
    EXPECT_EQ(std::count(covered.begin(), covered.end(), 1),
              static_cast<std::ptrdiff_t>(covered.size()));
  }
}

TEST(ExampleSheetPlan, IsWrittenAsItIsRead) {
  ExampleSheetPlan plan = built_in_example_sheet_plan();
  plan.width = 777;
  plan.palette = "winter";
  plan.seed = 12;
  plan.dots_per_inch = 101.6;
  const ExampleSheetPlan again = parse_example_sheet_plan(write_example_sheet_plan(plan), "again");
  EXPECT_EQ(write_example_sheet_plan(again), write_example_sheet_plan(plan));
  ASSERT_EQ(again.panels.size(), plan.panels.size());
  for (int p = 0; p < static_cast<int>(plan.panels.size()); ++p)
    for (const bool winter : {false, true})
      EXPECT_EQ(write_scene(panel_scene(again, p, winter).scene),
                write_scene(panel_scene(plan, p, winter).scene))
          << p;
}

TEST(ExampleSheetPlan, RefusesWhatItDoesNotUnderstand) {
  const auto with = [](const std::string& more) { return std::string("columns = 1\n") + more; };
  EXPECT_NO_THROW(parse_example_sheet_plan(with("[[panels]]\n"), "p"));
  for (const char* wrong :
       {"", "rows = 2\n[[panels]]\n", "width = 10\n[[panels]]\n",
        "[[panels]]\nterrain = \"none\"\n", "[[panels]]\nsets = []\n", "palette = 3\n[[panels]]\n"})
    EXPECT_THROW(parse_example_sheet_plan(with(wrong), "p"), Error) << wrong;
  EXPECT_THROW(parse_example_sheet_plan("columns = 2\n[[panels]]\n", "p"),
               Error);  // a row that is not full
  ExampleSheetPlan plan = small_plan();
  plan.panels[0].settings.emplace_back("camera.colour=red");
  EXPECT_THROW(panel_scene(plan, 0, false), Error);
}

TEST(ExampleSheetPlan, LightFallsFromTheSameSideInAllPanels) {
  const ExampleSheetPlan plan = built_in_example_sheet_plan();
  for (int p = 0; p < static_cast<int>(plan.panels.size()); ++p) {
    const Scene scene = panel_scene(plan, p, false).scene;
    EXPECT_NEAR(std::remainder(scene.sun.azimuth_deg.value() -
                                   scene.camera.azimuth_deg.value_or(0.0) - plan.light_from_deg,
                               360.0),
                0.0, 1e-9)
        << p;
  }
}

TEST(ExampleSheetPlan, WinterLaysSnowWherePanelsSaySo) {
  const ExampleSheetPlan plan = built_in_example_sheet_plan();
  const auto snowed = [&](bool winter) {
    int count = 0;
    for (int p = 0; p < static_cast<int>(plan.panels.size()); ++p)
      for (const auto& [key, value] : panel_scene(plan, p, winter).scene.land_cover.settings)
        count += key == "winter" && value > 0.0 ? 1 : 0;
    return count;
  };
  EXPECT_GT(snowed(true), snowed(false));
  EXPECT_LT(snowed(true), static_cast<int>(plan.panels.size()) /
                              2);  // otherwise winter would have too little of everything else
}

TEST(ExampleSheetPainter, IndicesOfPaintCountInTheWholeSheet) {
  ExampleSheetPainter painter(small_plan(), {read_palette("summer"), std::nullopt});
  ASSERT_EQ(painter.rows(), 1);
  const ExamplePainting row = painter.paint_row(0, {}, {});
  const GuidanceBuffers& g = row.guidance;
  ASSERT_EQ(g.width(), 256);
  const PixelRect right = panel_rect(painter.plan(), 1);
  int elsewhere = 0;
  for (int y = right.y0; y < right.y1; ++y)
    for (int x = right.x0; x < right.x1; ++x) {
      const std::uint32_t from = g.ground_from(x, y);
      const int fx = static_cast<int>(from % 256U);
      const int fy = static_cast<int>(from / 256U);
      // Paint comes from the same panel, from at most a stroke's length away.
      ASSERT_TRUE(fx >= right.x0 && fx < right.x1 && fy >= right.y0 && fy < right.y1);
      EXPECT_LT(std::hypot(fx - x, fy - y), 40.0);
      elsewhere += fx != x || fy != y ? 1 : 0;
      EXPECT_EQ(g.painted_class(x, y), g.land_cover[g.painted_from(x, y)]);
    }
  EXPECT_GT(elsewhere, 0);
  // Margins are paper: nothing is copied from them.
  EXPECT_TRUE(g.is_sky(g.depth_m.index(128, 128)));
  EXPECT_EQ(g.land_cover(128, 128), LandCoverClass::sky);
  EXPECT_EQ(row.ground_layer(0, 0), row.painting(128, 128));
  // No stroke has a number twice: the panels' numbers are disjoint.
  std::set<std::uint32_t> left_strokes;
  std::set<std::uint32_t> right_strokes;
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x)
      if (g.stroke(x, y) > 0) (x < 128 ? left_strokes : right_strokes).insert(g.stroke(x, y));
  EXPECT_GT(left_strokes.size(), 500U);
  EXPECT_LT(*left_strokes.rbegin(), *right_strokes.begin());
}

TEST(ExampleSheetPlan, SeedAndResolutionChangeEveryPanel) {
  ExampleSheetPlan plan = small_plan();
  const Scene usual = panel_scene(plan, 1, false).scene;
  EXPECT_EQ(usual.terrain.synthetic->seed, 4U);  // as in the panel, for the plan's own seed
  // Another seed gives other terrains, and none of a neighbouring seed's. Seeds stay within what
  // files hold exactly.
  std::set<std::uint64_t> terrains = {usual.terrain.synthetic->seed};
  for (int k = 0; k < 5; ++k) {
    ++plan.seed;
    terrains.insert(panel_scene(plan, 1, false).scene.terrain.synthetic->seed);
  }
  EXPECT_EQ(terrains.size(), 6U);
  EXPECT_LE(*terrains.rbegin(), ExampleSheetPlan::largest_seed);
  EXPECT_NE(panel_scene(plan, 1, false).scene.seed, usual.seed);
  // Strokes are sized in millimetres: 25.4 dpi are one pixel per millimetre, half a unit.
  EXPECT_NEAR(usual.pixels_per_unit(), 0.5, 1e-9);
  plan.dots_per_inch = 101.6;
  EXPECT_NEAR(panel_scene(plan, 1, false).scene.pixels_per_unit(), 2.0, 1e-9);
}

TEST(ExampleSheetPainter, PanelsHaveTheTerrainRulesAndStrokesOfTheirOwn) {
  ExampleSheetPlan plan = small_plan();
  plan.panels[1] = plan.panels[0];  // equal at first
  const PixelRect left = panel_rect(plan, 0);
  const PixelRect right = panel_rect(plan, 1);
  // Share of the ground that is equal in both panels, in a channel.
  const auto alike = [&](const ExamplePainting& row, const auto& channel) {
    int same = 0;
    int ground = 0;
    for (int y = left.y0; y < left.y1; ++y)
      for (int x = left.x0; x < left.x1; ++x) {
        if (row.guidance.is_sky(channel.index(x, y))) continue;
        ++ground;
        same += channel(x, y) == channel(right.x0 + x - left.x0, y) ? 1 : 0;
      }
    return static_cast<double>(same) / ground;
  };
  const auto painted = [&] {
    ExampleSheetPainter painter(plan, {read_palette("summer"), std::nullopt});
    return painter.paint_row(0, {.painting = false, .sky = false}, {});
  };
  const ExamplePainting twins = painted();
  // Rock differs slightly: its spurs are the painter's.
  EXPECT_GT(alike(twins, twins.guidance.altitude_m), 0.95);
  EXPECT_GT(alike(twins, twins.guidance.land_cover), 0.95);
  EXPECT_LT(alike(twins, twins.ground_layer),
            0.3);  // but no stroke is at the same position in both panels
  plan.panels[1].settings.emplace_back("land_cover.settings.treeline_m=900");
  const ExamplePainting other_rules = painted();
  EXPECT_GT(alike(other_rules, other_rules.guidance.altitude_m), 0.95);
  EXPECT_LT(alike(other_rules, other_rules.guidance.land_cover), 0.93);
  plan.panels[1].settings.emplace_back("terrain.synthetic.seed=6");
  const ExamplePainting other_terrain = painted();
  EXPECT_LT(alike(other_terrain, other_terrain.guidance.altitude_m), 0.2);
}

TEST(ExampleSheetPainter, PaintsInTheHandOfItsPicture) {
  const ExampleSheetPlan plan = small_plan();
  const auto mean_tone_and_blue = [&](const char* palette,
                                      const std::optional<LightParameters>& light) {
    ExampleSheetPainter painter(plan, {read_palette(palette), light});
    const ExamplePainting row = painter.paint_row(0, {.painting = false, .sky = false}, {});
    glm::dvec2 sum(0.0);
    double ground = 0.0;
    for (std::size_t i = 0; i < row.ground_layer.size(); ++i) {
      if (row.guidance.is_sky(i)) continue;
      sum += glm::dvec2(row.guidance.tone[i], row.ground_layer[i].z);
      ground += 1.0;
    }
    return sum / ground;
  };
  const glm::dvec2 summer = mean_tone_and_blue("summer", std::nullopt);
  EXPECT_GT(mean_tone_and_blue("winter", std::nullopt).y, summer.y + 0.05);
  EXPECT_LT(mean_tone_and_blue("summer", LightParameters{.sun = 0.4}).x, summer.x - 0.05);
}

class ExemplarFiles : public testing::Test {
 protected:
  std::string out(const std::string& name) const { return folder_ / name; }
  void paint(const std::string& name, int threads, int tile) const {
    write_example_sheet(small_plan(), out(name), {.threads = threads, .tile_px = tile});
  }
  static LoadedScene copying(const std::string& picture, const std::string& guidance,
                             const std::string& folder) {
    return parse_scene("version = 1\n[[exemplar]]\npicture = \"" + picture + "\"\nguidance = \"" +
                           guidance + "\"\n",
                       "s.toml", folder, {});
  }
  test::Folder folder_;
};

TEST_F(ExemplarFiles, SameBytesForAnyThreadsAndWhenMadeAgainFromTheirPlan) {
  paint("a", 1, 32);
  write_example_sheet(read_example_sheet_plan(out("a/sheet.toml")), out("b"),
                      {.threads = 2, .tile_px = 64});
  for (const char* file : {"painting.tif", "ground.tif", "painting.png", "guidance.exr",
                           "sheet.toml", "coverage.json"}) {
    const std::string left = test::read_bytes(out(std::string("a/") + file));
    EXPECT_FALSE(left.empty()) << file;
    EXPECT_TRUE(left == test::read_bytes(out(std::string("b/") + file))) << file;
  }
}

TEST_F(ExemplarFiles, AreReadAsTheSheetThatWasPainted) {
  paint("a", 0, 32);
  ExampleSheetPainter painter(small_plan(), {read_palette("summer"), std::nullopt});
  const ExamplePainting row = painter.paint_row(0, {}, {});
  for (const char* layer : {"ground.tif", "painting.tif"}) {
    const bool ground = std::string(layer) == "ground.tif";
    const PaintedExemplar read =
        read_scans(copying(layer, "guidance.exr", out("a")), silent_progress()).at(0).painted;
    const Grid<glm::vec3>& picture = ground ? row.ground_layer : row.painting;
    const PaintedClasses classes = classes_of_paint(
        row.guidance, ground ? row.guidance.ground_from : row.guidance.painted_from);
    const GuideStack guides = make_guide_stack(row.guidance, classes.land_cover);
    ASSERT_TRUE(read.picture.same_size(picture));
    EXPECT_EQ(read.exemplar.guides.label, guides.label) << layer;
    EXPECT_GT(std::count(guides.label.begin(), guides.label.end(),
                         static_cast<std::uint8_t>(LandCoverClass::forest)),
              1000);
    double colour = 0.0;
    double base = 0.0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        colour = std::max(colour, static_cast<double>(std::abs(
                                      read.picture[i][c] - std::clamp(picture[i][c], 0.F, 1.F))));
        base = std::max(base, static_cast<double>(std::abs(read.base[i][c] - classes.base[i][c])));
      }
    }
    EXPECT_LT(colour, 1.0 / 65535.0) << layer;
    EXPECT_LT(base, 0.0003) << layer;  // half floats: 2⁻¹² of the light, less in encoded values
    // Guides of half floats may round to the neighbouring step where they lie within 2⁻¹² of the
    // half of one: of 255 steps at most a sixteenth of the range does, seldom more than one value
    // in a hundred.
    ASSERT_EQ(read.exemplar.guides.guides.size(), guides.guides.size());
    for (std::size_t k = 0; k < guides.guides.size(); ++k) {
      const Guide& guide = guides.guides[k];
      EXPECT_EQ(read.exemplar.guides.guides[k].name, guide.name);
      std::size_t other = 0;
      for (std::size_t i = 0; i < guides.label.size(); ++i) {
        const int step = std::abs(read.exemplar.guides.guides[k].values[i] - guide.values[i]);
        ASSERT_LE(step, 1) << guide.name;
        other += static_cast<std::size_t>(step);
      }
      EXPECT_LT(other, guides.label.size() / 100) << guide.name;
    }
  }
  // It matters which layer a picture is: where trees stand, paint of the painting is forest's and
  // of the ground below another's.
  EXPECT_NE(row.guidance.painted_from, row.guidance.ground_from);
}

TEST_F(ExemplarFiles, CountedIsTheClassOfThePaintThatIsCopied) {
  const AvailableTexels counted = write_example_sheet(small_plan(), out("a"), {});
  const GuidanceBuffers guidance = read_guidance(out("a/guidance.exr"));
  AvailableTexels of_ground_paint;
  AvailableTexels of_classes;
  add_available(of_ground_paint, guidance,
                classes_of_paint(guidance, guidance.ground_from).land_cover);
  add_available(of_classes, guidance, guidance.land_cover);
  EXPECT_EQ(counted.pixels, 256 * 256);
  EXPECT_EQ(counted.texels, of_ground_paint.texels);
  EXPECT_EQ(counted.border, of_ground_paint.border);
  EXPECT_NE(counted.texels, of_classes.texels);
  EXPECT_EQ(test::read_bytes(out("a/coverage.json")),
            available_json(counted, find_gaps(counted, built_in_needed_texels(), {})));
}

TEST_F(ExemplarFiles, GuidanceOfAnotherPaintingIsRefused) {
  paint("a", 0, 32);
  ExampleSheetPlan plan = small_plan();
  plan.panels[1].settings.emplace_back("sun.altitude_deg=25");
  write_example_sheet(plan, out("b"), {});
  std::filesystem::copy_file(out("b/guidance.exr"), out("a/guidance.exr"),
                             std::filesystem::copy_options::overwrite_existing);
  try {
    read_scans(copying("ground.tif", "guidance.exr", out("a")), silent_progress());
    FAIL() << "taken for one painting";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    EXPECT_NE(std::string(error.what()).find("guidance.exr"), std::string::npos);
  }
}

TEST_F(ExemplarFiles, GuidanceWithPaintFromBeyondThePictureIsRefused) {
  GuidanceBuffers g;
  g.depth_m = Grid<float>(16, 16, 1000.F);
  g.land_cover = g.painted_class = Grid<LandCoverClass>(16, 16, LandCoverClass::rock);
  g.base = Image(16, 16);
  g.painted_from = Grid<std::uint32_t>(16, 16, 256U);
  write_guidance(out("g.exr"), g, {});
  write_png8(out("p.png"), Grid<glm::vec3>(16, 16), {});
  EXPECT_THROW(read_scans(copying("p.png", "g.exr", folder_.path()), silent_progress()), Error);
}

TEST(ExampleSheetSize, GrowsWithThePrint) {
  const auto size = [](int width, int height, const SceneExemplar& settings = {}) {
    SceneOutput output;
    output.width = width;
    output.height = height;
    return example_sheet_size(settings, output);
  };
  EXPECT_EQ(size(800, 400), glm::ivec2(2000, 1400)) << "never less";
  EXPECT_EQ(size(20000, 8000), glm::ivec2(5345, 3742)) << "a texel for eight pixels";
  EXPECT_EQ(size(60000, 30000), size(40000, 16000)) << "never more";
  SceneExemplar wide;
  wide.width = 700;
  EXPECT_EQ(size(20000, 8000, wide), glm::ivec2(700, 490));
  wide.height = 300;
  EXPECT_EQ(size(20000, 8000, wide), glm::ivec2(700, 300));
}

class ExamplePaintings : public testing::Test {
 protected:
  ExamplePaintings()
      : world_(make_world(test::small_scene(), silent_progress())),
        palette_(read_palette("summer")) {}
  LitPicture lit() const { return make_lit_picture(world_, palette_, {0, 0, 96, 80}, {}); }
  ExamplePainting paint(const ExampleLayers& layers) const {
    return paint_example(world_, palette_, lit(), layers, silent_progress());
  }

  World world_;
  Palette palette_;
};

TEST_F(ExamplePaintings, EveryPixelKnowsWhosePaintItShows) {
  const ExamplePainting example = paint({});
  const GuidanceBuffers& g = example.guidance;
  int reached_over = 0;
  for (std::size_t i = 0; i < g.painted_from.size(); ++i) {
    ASSERT_EQ(g.painted_class[i], g.land_cover[g.painted_from[i]]);
    reached_over += g.painted_class[i] != g.land_cover[i] ? 1 : 0;
  }
  EXPECT_GT(reached_over, 0) << "strokes overlap the borders of classes";
  EXPECT_FALSE(example.painting == example.ground_layer) << "trees are in the painting only";
  EXPECT_FALSE(g.painted_from == g.ground_from);
  EXPECT_TRUE(g.stroke.same_size(g.depth_m));
}

TEST_F(ExamplePaintings, TheGroundIsTheSameWithoutThePainting) {
  const ExamplePainting ground = paint({.painting = false});
  EXPECT_TRUE(ground.painting.empty());
  EXPECT_TRUE(ground.guidance.painted_class.empty());
  EXPECT_TRUE(ground.guidance.painted_from.empty());
  EXPECT_TRUE(ground.guidance.stroke.empty());
  const ExamplePainting whole = paint({});
  EXPECT_TRUE(ground.ground_layer == whole.ground_layer);
  EXPECT_TRUE(ground.guidance.ground_from == whole.guidance.ground_from);
}

TEST_F(ExamplePaintings, WithoutASkyTheBaseLiesBare) {
  const ExamplePainting example = paint({.painting = false, .sky = false});
  const LitPicture base = lit();
  int sky = 0;
  for (std::size_t i = 0; i < base.base.colour.size(); ++i)
    if (base.guidance.is_sky(i)) {
      ++sky;
      ASSERT_EQ(example.ground_layer[i], base.base.colour[i]);
    }
  EXPECT_GT(sky, 100);
}

TEST_F(ExamplePaintings, ClassAndColourOfPaintAreThoseOfThePlaceItGrewFrom) {
  const GuidanceBuffers guidance = paint({.painting = false}).guidance;
  const PaintedClasses classes = classes_of_paint(guidance, guidance.ground_from);
  for (std::size_t i = 0; i < guidance.ground_from.size(); ++i)
    ASSERT_EQ(classes.land_cover[i], guidance.land_cover[guidance.ground_from[i]]) << i;
}

// Grass that overhangs a brook must not be copied into rivers.
TEST_F(ExamplePaintings, WaterUnderThePaintOfItsBanksIsToldOfAsThatPaint) {
  LitPicture picture = lit();
  for (int y = 60; y < 64; ++y)
    for (int x = 0; x < 96; ++x) picture.guidance.land_cover(x, y) = LandCoverClass::water;
  const GuidanceBuffers g =
      paint_example(world_, palette_, std::move(picture), {}, silent_progress()).guidance;
  const auto covered = [&](const Grid<std::uint32_t>& from) {
    int count = 0;
    for (std::size_t i = 0; i < from.size(); ++i)
      count +=
          g.land_cover[i] == LandCoverClass::water && g.land_cover[from[i]] != LandCoverClass::water
              ? 1
              : 0;
    return count;
  };
  EXPECT_GT(covered(g.ground_from), 0);
  EXPECT_GT(covered(g.painted_from), 0);
}

}  // namespace

}  // namespace belvedere
