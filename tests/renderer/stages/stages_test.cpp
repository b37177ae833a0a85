#include "renderer/stages/stages.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/grid.h"
#include "renderer/stages/lit_picture.h"
#include "tests/files.h"
#include "tests/paths.h"
#include "tests/scenes.h"
#include "tests/shared_cache.h"
#include "texture/sheet/plan_data.h"
#include "texture/sheet/synthesis_plan.h"

namespace belvedere {
namespace {

// The stages of a sheet, with a given size of tiles.
struct Sheet {
  Sheet(const World& world, const Palette& palette, TileStore::Place& scratch, int tile_px)
      : graph(scratch, silent_progress()),
        ground(add_ground_stages(graph, make_ground_inputs(world, view_of(world), palette, {}),
                                 tile_px)) {}
  void keep_only(std::initializer_list<StageGraph::Request> requests) {
    graph.keep_only(std::vector(requests));
  }
  StageGraph graph;
  GroundStages ground;
};

GuidanceBuffers classes_of(const GroundStages& ground, PixelRect rect) {
  return ground.raised->read(
      rect, with_channels({&GuidanceBuffers::depth_m, &GuidanceBuffers::land_cover}, {}));
}

// Pixels in tiles of several sizes, requested in any order, compared with the picture made in one
// piece.
class GroundStagesTest : public testing::TestWithParam<int> {
 protected:
  // Ice among the hills: its strokes depend on the sheet as a whole.
  GroundStagesTest()
      : world_(make_world(
            test::small_scene(
                {"output.width=230", "output.height=210", "output.sheet_width_mm=115",
                 "terrain.synthetic.highest_m=3900", "land_cover.settings.ice_line_m=900",
                 "land_cover.settings.snowline_m=1100", "land_cover.settings.treeline_m=400"}),
            silent_progress(), test::shared_cache())) {}
  const Palette palette_ = read_palette("summer");
  const World world_;
  const test::Folder folder_;
  TileStore::Place scratch_{folder_.path(), 1U << 20U};
};

TEST_P(GroundStagesTest, AnyRectangleEqualsThePictureInOnePiece) {
  const PixelRect sheet{0, 0, 230, 210};
  const LitPicture whole = make_lit_picture(world_, palette_, sheet, {});
  Sheet tiles(world_, palette_, scratch_, GetParam());
  const GroundStages& ground = tiles.ground;
  for (const PixelRect rect :
       {PixelRect{200, 150, 230, 210}, PixelRect{63, 63, 65, 66}, PixelRect{0, 0, 1, 1}, sheet}) {
    const GuidanceBuffers guidance = ground.guidance->read(rect);
    EXPECT_EQ(guidance.origin_m, whole.guidance.origin_m);
    for (const GuidanceChannel& channel : guidance_channels())
      std::visit(
          [&](auto member) {
            if (!(whole.guidance.*member).empty()) {
              EXPECT_TRUE(guidance.*member == part_of(whole.guidance.*member, rect))
                  << channel.names[0];
            }
          },
          channel.member);
    const BasePicture base = ground.base->read(rect);
    EXPECT_TRUE(base.darker == part_of(whole.base.darker, rect));
    EXPECT_TRUE(base.tree_density == part_of(whole.base.tree_density, rect));
  }
}

TEST_P(GroundStagesTest, TheDraftIsThatOfTheWhole) {
  Sheet one_tile(world_, palette_, scratch_, 4096);
  Sheet many_tiles(world_, palette_, scratch_, GetParam());
  const GroundStages& one = one_tile.ground;
  const GroundStages& many = many_tiles.ground;
  const PixelRect rect{40, 90, 190, 200};
  const PaintDraft whole = one.draft->read(rect);
  const PaintDraft part = many.draft->read(rect);
  EXPECT_TRUE(part.land_cover == whole.land_cover);
  EXPECT_TRUE(part.base == whole.base);
  EXPECT_TRUE(part.under == whole.under);
  EXPECT_TRUE(part.under_share == whole.under_share);
  std::size_t reached_over = 0;
  const Grid<LandCoverClass> own = classes_of(many, rect).land_cover;
  for (std::size_t i = 0; i < own.size(); ++i)
    reached_over += own[i] != whole.land_cover[i] ? 1 : 0;
  EXPECT_GT(reached_over, 0U) << "strokes reach over borders of classes";
  const GuideStack a = one.guides->read(rect);
  const GuideStack b = many.guides->read(rect);
  EXPECT_TRUE(a.label == b.label);
  ASSERT_EQ(a.guides.size(), b.guides.size());
  for (std::size_t i = 0; i < a.guides.size(); ++i)
    EXPECT_TRUE(a.guides[i].values == b.guides[i].values) << a.guides[i].name;
}

// The ground's own colours are looked up pixel by pixel, so tiles do not change them.
TEST_P(GroundStagesTest, ColoursOfLayersAreThoseOfTheWholeInAnyTiles) {
  folder_.write("two.layers.toml",
                "version = 1\nground = { class = \"pasture\", colour = \"#7a5a3a\" "
                "}\n[[layers]]\nname = \"high\"\nclass = \"rock\"\n"
                "colour = \"#5a6a8a\"\nwhen = \"altitude > 1500 + 300 * n660\"\n");
  const auto world = [&](const std::string& colours) {
    return std::unique_ptr<World>(new World(make_world(
        test::small_scene({"output.width=230", "output.height=210", "output.sheet_width_mm=115",
                           "terrain.synthetic.highest_m=3900", "land_cover.layers=two.layers.toml",
                           "land_cover.colours=" + colours},
                          folder_.path()),
        silent_progress(), test::shared_cache())));
  };
  const PixelRect rect{40, 90, 190, 200};
  const auto base = [&](const World& of, int tile_px) {
    return Sheet(of, palette_, scratch_, tile_px).ground.base->read(rect);
  };
  const auto tinted = world("layers");
  const BasePicture whole = base(*tinted, 4096);
  EXPECT_TRUE(base(*tinted, GetParam()).colour == whole.colour);
  EXPECT_TRUE(base(*tinted, GetParam()).lighter == whole.lighter);
  const Grid<glm::vec3> palette = base(*world("palette"), 4096).colour;
  std::size_t differ = 0;
  for (std::size_t i = 0; i < palette.size(); ++i) differ += palette[i] != whole.colour[i] ? 1 : 0;
  EXPECT_GT(differ, palette.size() / 2) << "nearly all of it is ground";
}

// The sea fills the valleys: its reflections are traced pixel by pixel and stretched downwards,
// across the borders of tiles.
TEST_P(GroundStagesTest, WhatWaterMirrorsIsThatOfTheWholeInAnyTiles) {
  const auto world = [&](const std::string& mirror) {
    return std::unique_ptr<World>(new World(make_world(
        test::small_scene({"output.width=230", "output.height=210", "output.sheet_width_mm=115",
                           "terrain.synthetic.highest_m=3900", "land_cover.sea_level_m=1100",
                           "water.mirror=" + mirror}),
        silent_progress(), test::shared_cache())));
  };
  const auto base = [&](const World& of, const PixelRect& rect, int tile_px) {
    return Sheet(of, palette_, scratch_, tile_px).ground.base->read(rect);
  };
  const PixelRect sheet{0, 0, 230, 210};
  const auto traced = world("traced");
  const BasePicture whole = base(*traced, sheet, 4096);
  EXPECT_TRUE(base(*traced, sheet, GetParam()).colour == whole.colour);
  for (const PixelRect rect : {PixelRect{30, 90, 190, 200}, PixelRect{101, 150, 110, 151}}) {
    EXPECT_TRUE(base(*traced, rect, GetParam()).colour == part_of(whole.colour, rect));
    EXPECT_TRUE(base(*traced, rect, GetParam()).lighter == part_of(whole.lighter, rect));
  }
  EXPECT_TRUE(make_lit_picture(*traced, palette_, sheet, {}).base.colour == whole.colour);
  // Only water changes with another kind of reflection.
  const auto column = world("column");
  Sheet looked_up(*column, palette_, scratch_, 4096);
  const Grid<glm::vec3> other = looked_up.ground.base->read(sheet).colour;
  const Grid<LandCoverClass> land_cover = classes_of(looked_up.ground, sheet).land_cover;
  std::size_t differ = 0;
  for (std::size_t i = 0; i < other.size(); ++i) {
    if (other[i] == whole.colour[i]) continue;
    ASSERT_EQ(land_cover[i], LandCoverClass::water);
    ++differ;
  }
  EXPECT_GT(differ, 200U);
}

// Four pixels per unit and more: light and base picture read a wide view, whose pixels must not
// depend on windows and tiles. The sheet is wider than any of their reaches.
class PrintGroundTest : public testing::TestWithParam<const char*> {
 protected:
  // The world and the sheet in one tile, made once for each scale.
  struct Print {
    explicit Print(const char* scale)
        : world(make_world(
              test::small_scene(
                  {"output.width=1100", "output.height=620", scale,
                   "terrain.synthetic.highest_m=3900", "land_cover.settings.ice_line_m=2900",
                   "land_cover.settings.snowline_m=2500", "land_cover.settings.treeline_m=1700",
                   "sampling.sky_directions=2"}),
              silent_progress(), test::shared_cache())),
          whole(world, palette, scratch, 4096) {}
    const Palette palette = read_palette("summer");
    const World world;
    const test::Folder folder{"whole"};
    TileStore::Place scratch{folder.path(), 1U << 28U};
    Sheet whole;
  };
  static void TearDownTestSuite() { prints_.clear(); }
  std::unique_ptr<Sheet> tiles_of(int tile_px) {
    return std::make_unique<Sheet>(print_.world, print_.palette, scratch_, tile_px);
  }

  static inline std::map<std::string, std::unique_ptr<Print>> prints_;
  static Print& print_of(const char* scale) {
    std::unique_ptr<Print>& print = prints_[scale];
    if (print == nullptr) print = std::make_unique<Print>(scale);
    return *print;
  }
  Print& print_ = print_of(GetParam());
  const GroundStages& one_ = print_.whole.ground;
  const PixelRect sheet_ = one_.base->sheet();
  const test::Folder folder_;
  TileStore::Place scratch_{folder_.path(), 1U << 28U};
};

TEST_P(PrintGroundTest, APartIsThatOfTheWhole) {
  const GuidanceBuffers seen = one_.guidance->read(sheet_);
  const BasePicture painted = one_.base->read(sheet_);
  const PixelRect inside{590, 560, 650, 620};
  for (const auto& [tile_px, rects] : {std::pair<int, std::vector<PixelRect>>{
                                           64, {{0, 300, 30, 340}, {1075, 330, 1100, 371}, inside}},
                                       {100, {inside}}}) {
    for (const PixelRect& rect : rects) {
      const std::unique_ptr<Sheet> tiles = tiles_of(tile_px);
      const GroundStages& part = tiles->ground;
      const PaintDraft draft = part.draft->read(rect);
      const PaintDraft whole = one_.draft->read(rect);
      EXPECT_TRUE(draft.land_cover == whole.land_cover);
      EXPECT_TRUE(draft.base == whole.base);
      EXPECT_TRUE(draft.under == whole.under);
      const GuidanceBuffers guidance = part.guidance->read(rect);
      EXPECT_TRUE(guidance.tone == part_of(seen.tone, rect))
          << "light, tiles of " << tile_px << ", column " << rect.x0;
      EXPECT_TRUE(guidance.base == part_of(seen.base, rect))
          << "tiles of " << tile_px << ", column " << rect.x0;
      const BasePicture base = part.base->read(rect);
      EXPECT_TRUE(base.darker == part_of(painted.darker, rect));
      EXPECT_TRUE(base.lighter == part_of(painted.lighter, rect));
      EXPECT_TRUE(base.accent == part_of(painted.accent, rect));
      EXPECT_TRUE(base.tree_density == part_of(painted.tree_density, rect));
      EXPECT_TRUE(base.haze == part_of(painted.haze, rect));
    }
  }
}

// What is kept for a part of the sheet is sufficient: nothing outside it is made, and nothing
// twice.
TEST_P(PrintGroundTest, APartLooksAtNoMoreThanItsStagesReach) {
  const auto made_px = [](const Sheet& sheet) {
    std::uint64_t pixels = 0;
    for (const auto& stage : sheet.graph.stages()) pixels += stage->made_px();
    return pixels;
  };
  for (const PixelRect rect : {PixelRect{0, 300, 30, 340}, PixelRect{1075, 330, 1100, 371},
                               PixelRect{590, 560, 650, 620}}) {
    const std::unique_ptr<Sheet> part = tiles_of(64);
    const GroundStages& ground = part->ground;
    part->keep_only({{ground.draft, rect}, {ground.guides, rect}, {ground.guidance, rect}});
    EXPECT_TRUE(ground.draft->read(rect).base == one_.draft->read(rect).base) << rect.x0;
    EXPECT_TRUE(ground.guides->read(rect).label == one_.guides->read(rect).label);
    EXPECT_TRUE(ground.base->read(rect).colour == one_.base->read(rect).colour);
    EXPECT_TRUE(ground.guidance->read(rect).tone == one_.guidance->read(rect).tone);
    const std::uint64_t made = made_px(*part);
    // Larger tiles make the same pixels: only the requested ones.
    const std::unique_ptr<Sheet> large = tiles_of(4096);
    large->keep_only({{large->ground.draft, rect},
                      {large->ground.guides, rect},
                      {large->ground.guidance, rect}});
    large->ground.guidance->read(rect);
    large->ground.guides->read(rect);
    EXPECT_LE(made, made_px(*large)) << rect.x0;
  }
  const std::unique_ptr<Sheet> beyond = tiles_of(64);
  beyond->keep_only({{beyond->ground.guidance, {20, 300, 30, 340}}});
  beyond->ground.guidance->read({20, 300, 30, 340});
  EXPECT_TRUE(beyond->ground.draft->read({0, 300, 30, 340}).base ==
              one_.draft->read({0, 300, 30, 340}).base)
      << "requests beyond it still work";
}

// The drawing in the architecture page matches the stages, at 8 pixels per unit: 20000 pixels on
// 1.2 m.
TEST(Stages, TheArchitecturePageDrawsThem) {
  constexpr double print_ppu = 8.0;
  GroundInputs inputs = estimate_ground_inputs(
      test::small_scene({"output.width=20000", "output.height=8000"}).scene, print_ppu);
  inputs.has_mist = true;
  CopyPlan plan;
  plan.synthesis.emplace(std::make_unique<SynthesisPlanData>());
  plan.synthesis->data().sheet = divide_sheet(20000, 8000);
  plan.models.lit[1] = plan.models.shaded[1] = 0;
  plan.seams.emplace();
  TileStore::Place nowhere;
  StageGraph graph(nowhere, silent_progress());
  add_picture_stages(graph, add_ground_stages(graph, inputs, 1024), &plan);
  const std::string page = test::read_bytes(test::source_folder() + "/docs/architecture.md");
  const std::string begin = "```mermaid\n";
  const std::size_t first = page.find(begin) + begin.size();
  EXPECT_EQ(page.substr(first, page.find("```", first) - first), graph.draw(print_ppu))
      << "put the current drawing into the page";
}

// 4 and 6 pixels a unit: wide pixels of 2 × 2 and 3 × 3.
INSTANTIATE_TEST_SUITE_P(Prints, PrintGroundTest,
                         testing::Values("output.sheet_width_mm=137.5",
                                         "output.sheet_width_mm=91.6"));

INSTANTIATE_TEST_SUITE_P(Tiles, GroundStagesTest, testing::Values(64, 100, 1024));

}  // namespace
}  // namespace belvedere
