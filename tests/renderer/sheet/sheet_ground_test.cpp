#include "renderer/sheet/sheet_ground.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/grid_part.h"
#include "tests/files.h"
#include "tests/scenes.h"
#include "tests/shared_cache.h"

namespace belvedere {
namespace {

// Pixels in tiles of several sizes, asked for in any order, against the picture made in one piece.
class SheetGroundTest : public testing::TestWithParam<int> {
 protected:
  // Ice among the hills: its strokes hang on the sheet as a whole.
  SheetGroundTest()
      : world_(test::small_scene({"output.width=230", "output.height=210", "output.sheet_width_mm=115", "terrain.synthetic.highest_m=3900",
                                  "land_cover.settings.ice_line_m=900", "land_cover.settings.snowline_m=1100",
                                  "land_cover.settings.treeline_m=400"}),
               silent_progress(), test::shared_cache()) {}
  const Palette palette_ = read_palette("summer");
  const World world_;
  const test::Folder folder_;
  TileStore::Place place_{folder_.path(), 1U << 20U};
  const belvedere::Run run_;
};

TEST_P(SheetGroundTest, AnyRectangleEqualsThePictureInOnePiece) {
  const PixelRect sheet{0, 0, 230, 210};
  const LitPicture whole = make_lit_picture(world_, palette_, sheet, {});
  SheetGround ground(world_, view_of(world_), palette_, place_, run_, GetParam());
  for (const PixelRect rect : {PixelRect{200, 150, 230, 210}, PixelRect{63, 63, 65, 66}, PixelRect{0, 0, 1, 1}, sheet}) {
    const GuidanceBuffers guidance = ground.read_all_guidance(rect);
    EXPECT_EQ(guidance.origin_m, whole.guidance.origin_m);
    for (const GuidanceChannel& channel : guidance_channels())
      std::visit(
          [&](auto member) {
            if (!(whole.guidance.*member).empty()) {
              EXPECT_TRUE(guidance.*member == part_of(whole.guidance.*member, rect)) << channel.names[0];
            }
          },
          channel.member);
    const BasePicture base = ground.read_base(rect);
    EXPECT_TRUE(base.darker == part_of(whole.base.darker, rect));
    EXPECT_TRUE(base.tree_density == part_of(whole.base.tree_density, rect));
  }
}

TEST_P(SheetGroundTest, TheDraftIsThatOfTheWhole) {
  SheetGround one(world_, view_of(world_), palette_, place_, run_, 4096);
  SheetGround many(world_, view_of(world_), palette_, place_, run_, GetParam());
  const PixelRect rect{40, 90, 190, 200};
  const PaintDraft whole = one.read_draft(rect);
  const PaintDraft part = many.read_draft(rect);
  EXPECT_TRUE(part.land_cover == whole.land_cover);
  EXPECT_TRUE(part.base == whole.base);
  EXPECT_TRUE(part.under == whole.under);
  EXPECT_TRUE(part.under_share == whole.under_share);
  std::size_t reached_over = 0;
  const Grid<LandCoverClass> own = many.read_guidance(rect, {&GuidanceBuffers::land_cover}, false).land_cover;
  for (std::size_t i = 0; i < own.size(); ++i) reached_over += own[i] != whole.land_cover[i] ? 1 : 0;
  EXPECT_GT(reached_over, 0U) << "strokes reach over borders of classes";
  const GuideStack a = one.read_guides(rect);
  const GuideStack b = many.read_guides(rect);
  EXPECT_TRUE(a.label == b.label);
  ASSERT_EQ(a.guides.size(), b.guides.size());
  for (std::size_t i = 0; i < a.guides.size(); ++i) EXPECT_TRUE(a.guides[i].values == b.guides[i].values) << a.guides[i].name;
}

// Colours of the ground's own are looked up pixel by pixel, so no tile moves them.
TEST_P(SheetGroundTest, ColoursOfLayersAreThoseOfTheWholeInAnyTiles) {
  folder_.write("two.layers.toml",
                "version = 1\nground = { class = \"pasture\", colour = \"#7a5a3a\" }\n[[layers]]\nname = \"high\"\nclass = \"rock\"\n"
                "colour = \"#5a6a8a\"\nwhen = \"altitude > 1500 + 300 * n660\"\n");
  const auto world = [&](const std::string& colours) {
    return std::make_unique<World>(
        test::small_scene({"output.width=230", "output.height=210", "output.sheet_width_mm=115", "terrain.synthetic.highest_m=3900",
                           "land_cover.layers=two.layers.toml", "land_cover.colours=" + colours},
                          folder_.path()),
        silent_progress(), test::shared_cache());
  };
  const PixelRect rect{40, 90, 190, 200};
  const auto base = [&](const World& of, int tile_px) {
    return SheetGround(of, view_of(of), palette_, place_, run_, tile_px).read_base(rect);
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

// The sea fills the valleys: what it mirrors is traced pixel by pixel and drawn out downwards, over the borders of tiles.
TEST_P(SheetGroundTest, WhatWaterMirrorsIsThatOfTheWholeInAnyTiles) {
  const auto world = [&](const std::string& mirror) {
    return std::make_unique<World>(
        test::small_scene({"output.width=230", "output.height=210", "output.sheet_width_mm=115", "terrain.synthetic.highest_m=3900",
                           "land_cover.sea_level_m=1100", "water.mirror=" + mirror}),
        silent_progress(), test::shared_cache());
  };
  const auto base = [&](const World& of, const PixelRect& rect, int tile_px) {
    return SheetGround(of, view_of(of), palette_, place_, run_, tile_px).read_base(rect);
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
  // Water alone is another with another mirror.
  const auto column = world("column");
  SheetGround looked_up(*column, view_of(*column), palette_, place_, run_, 4096);
  const Grid<glm::vec3> other = looked_up.read_base(sheet).colour;
  const Grid<LandCoverClass> land_cover = looked_up.read_guidance(sheet, {&GuidanceBuffers::land_cover}, false).land_cover;
  std::size_t differ = 0;
  for (std::size_t i = 0; i < other.size(); ++i) {
    if (other[i] == whole.colour[i]) continue;
    ASSERT_EQ(land_cover[i], LandCoverClass::water);
    ++differ;
  }
  EXPECT_GT(differ, 200U);
}

// Four pixels a unit and more: light and base picture look around in a wide view, whose pixels no window and no tile may move. The sheet is
// wider than what any of them looks at.
class PrintGroundTest : public testing::TestWithParam<const char*> {
 protected:
  // The world and the sheet in one tile, made once for each scale.
  struct Print {
    explicit Print(const char* scale)
        : world(test::small_scene({"output.width=1100", "output.height=620", scale, "terrain.synthetic.highest_m=3900",
                                   "land_cover.settings.ice_line_m=2900", "land_cover.settings.snowline_m=2500",
                                   "land_cover.settings.treeline_m=1700", "sampling.sky_directions=2"}),
                silent_progress(), test::shared_cache()),
          whole(world, view_of(world), palette, place, run, 4096) {}
    const Palette palette = read_palette("summer");
    const World world;
    const test::Folder folder{"whole"};
    TileStore::Place place{folder.path(), 1U << 28U};
    const belvedere::Run run;
    SheetGround whole;
  };
  static void TearDownTestSuite() { prints_.clear(); }
  SheetGround tiles_of(int tile_px) {
    return SheetGround(print_.world, view_of(print_.world), print_.palette, place_, print_.run, tile_px);
  }

  static inline std::map<std::string, std::unique_ptr<Print>> prints_;
  static Print& print_of(const char* scale) {
    std::unique_ptr<Print>& print = prints_[scale];
    if (print == nullptr) print = std::make_unique<Print>(scale);
    return *print;
  }
  Print& print_ = print_of(GetParam());
  SheetGround& one_ = print_.whole;
  const test::Folder folder_;
  TileStore::Place place_{folder_.path(), 1U << 28U};
};

TEST_P(PrintGroundTest, APartIsThatOfTheWhole) {
  const GuidanceBuffers seen = one_.read_all_guidance(one_.sheet());
  const BasePicture painted = one_.read_base(one_.sheet());
  const PixelRect inside{590, 560, 650, 620};
  for (const auto& [tile_px, rects] :
       {std::pair<int, std::vector<PixelRect>>{64, {{0, 300, 30, 340}, {1075, 330, 1100, 371}, inside}}, {100, {inside}}}) {
    for (const PixelRect& rect : rects) {
      SheetGround part = tiles_of(tile_px);
      const PaintDraft draft = part.read_draft(rect);
      const PaintDraft whole = one_.read_draft(rect);
      EXPECT_TRUE(draft.land_cover == whole.land_cover);
      EXPECT_TRUE(draft.base == whole.base);
      EXPECT_TRUE(draft.under == whole.under);
      const GuidanceBuffers guidance = part.read_all_guidance(rect);
      EXPECT_TRUE(guidance.tone == part_of(seen.tone, rect)) << "light, tiles of " << tile_px << ", column " << rect.x0;
      EXPECT_TRUE(guidance.base == part_of(seen.base, rect)) << "tiles of " << tile_px << ", column " << rect.x0;
      const BasePicture base = part.read_base(rect);
      EXPECT_TRUE(base.darker == part_of(painted.darker, rect));
      EXPECT_TRUE(base.lighter == part_of(painted.lighter, rect));
      EXPECT_TRUE(base.accent == part_of(painted.accent, rect));
      EXPECT_TRUE(base.tree_density == part_of(painted.tree_density, rect));
      EXPECT_TRUE(base.haze == part_of(painted.haze, rect));
    }
  }
}

// What a stage is told to keep to is enough for the stages after it: nothing else is asked for, and its pixels are the same.
TEST_P(PrintGroundTest, APartLooksAtNoMoreThanItSays) {
  for (const PixelRect rect : {PixelRect{0, 300, 30, 340}, PixelRect{1075, 330, 1100, 371}, PixelRect{590, 560, 650, 620}}) {
    SheetGround part = tiles_of(64);
    part.keep_only({.guidance = rect, .base = rect, .draft = rect});
    const PaintDraft whole = one_.read_draft(rect);
    EXPECT_TRUE(part.read_draft(rect).base == whole.base) << rect.x0;
    EXPECT_TRUE(part.read_guides(rect).label == one_.read_guides(rect).label);
    EXPECT_TRUE(part.read_base(rect).colour == one_.read_base(rect).colour);
    EXPECT_TRUE(part.read_all_guidance(rect).tone == one_.read_all_guidance(rect).tone);
    EXPECT_EQ(place_.asked_beyond, 0) << rect.x0;
    SheetGround base = tiles_of(64);
    base.keep_only({.guidance = {}, .base = rect, .draft = {}});
    EXPECT_TRUE(base.read_base(rect).colour == one_.read_base(rect).colour);
    EXPECT_EQ(place_.asked_beyond, 0) << rect.x0;
  }
  SheetGround beyond = tiles_of(64);
  beyond.keep_only({.guidance = {20, 300, 30, 340}, .base = {}, .draft = {}});
  beyond.read_all_guidance({20, 300, 30, 340});
  EXPECT_TRUE(beyond.read_draft({0, 300, 30, 340}).base == one_.read_draft({0, 300, 30, 340}).base);
  EXPECT_GT(place_.asked_beyond, 0) << "what is asked for beyond it comes all the same";
}

// Memory: the windows of a stage never stand around those of the stages behind it (SheetStage::prepare).
TEST_P(PrintGroundTest, NoStageHoldsWindowsWhileAnotherIsMade) {
  const PixelRect rect{590, 560, 650, 620};
  SheetGround ground = tiles_of(64);
  ground.read_draft(rect);
  ground.read_guides(rect);
  ground.read_all_guidance(rect);
  EXPECT_EQ(place_.made_around, 0);
}

// 4 and 6 pixels a unit: wide pixels of 2 × 2 and 3 × 3.
INSTANTIATE_TEST_SUITE_P(Prints, PrintGroundTest, testing::Values("output.sheet_width_mm=137.5", "output.sheet_width_mm=91.6"));

INSTANTIATE_TEST_SUITE_P(Tiles, SheetGroundTest, testing::Values(64, 100, 1024));

}  // namespace
}  // namespace belvedere
