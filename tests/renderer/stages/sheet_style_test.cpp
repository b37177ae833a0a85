#include "renderer/stages/sheet_style.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "base/grid.h"
#include "base/parallel.h"
#include "renderer/stages/lit_picture.h"
#include "renderer/stages/stages.h"
#include "renderer/style/style_ground.h"
#include "renderer/world/picture_parameters.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/renderer/style/styled_sheet.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

constexpr PixelRect styled_rect{0, 0, 140, 120};

// A small scene painted in a style by the stages of a sheet.
struct StyledScene {
  struct Stages {
    Stages(StyledScene& scene, const Style* style, int tile_px)
        : graph(scene.scratch, silent_progress()),
          ground(add_ground_stages(graph, inputs_of(scene, style), tile_px)),
          picture(add_picture_stages(graph, ground, nullptr)) {}
    static GroundInputs inputs_of(StyledScene& scene, const Style* style) {
      const SheetView view = view_of(scene.world);
      GroundInputs inputs = make_ground_inputs(scene.world, view, scene.palette, {});
      const StylePaintParameters parameters{.pixels_per_unit = view.pixels_per_unit,
                                            .sheet_px = view.camera.size(),
                                            .contour_lines = 0.7};
      if (style != nullptr)
        inputs.style = make_sheet_style(*style, parameters, scene.world, view.camera, {});
      return inputs;
    }
    StageGraph graph;
    GroundStages ground;
    PictureStages picture;
  };
  Grid<glm::vec3> make(PixelRect rect, const Style* style, int tile_px = 96) {
    return Stages(*this, style, tile_px).picture.picture->read(rect).colour;
  }
  const Palette palette = read_palette("summer");
  const World world = make_world(
      test::small_scene({"output.width=140", "output.height=120", "output.sheet_width_mm=112",
                         "air.mist.0={ kind = \"sea\", to_m = 1100 }"}),
      silent_progress());
  const test::Folder folder;
  TileStore::Place scratch{folder.path(), 1U << 24U};
};

TEST(SheetStyle, SightHasTheLowestSkyAndMostOfTheDistances) {
  constexpr float sky = std::numeric_limits<float>::infinity();
  Grid<float> depth_m(100, 4, sky);
  for (const auto [x, y] : test::cells({0, 2, 100, 4}))
    depth_m(x, y) = static_cast<float>(1000 + x);
  depth_m(7, 2) = sky;
  const StyleSight sight = style_sight_of(depth_m, 5);
  EXPECT_EQ(sight.sky_rows, 15);
  EXPECT_NEAR(sight.near_m, 1003.0, 1.0);
  EXPECT_NEAR(sight.far_m, 1096.0, 1.0);
  EXPECT_EQ(style_sight_of(Grid<float>(3, 3, sky), 1).near_m, StylePaintParameters{}.near_m);
}

TEST(SheetStyle, AnyRectangleTilesAndThreadsGiveThePictureOfTheWhole) {
  StyledScene scene;
  const Style style = test::make_style();
  const Grid<glm::vec3> whole = scene.make(styled_rect, &style);
  const ThreadLimit one(1);
  EXPECT_TRUE(scene.make({70, 40, 120, 80}, &style, 64) == part_of(whole, {70, 40, 120, 80}));
}

TEST(SheetStyle, AStyleChangesThePictureAndNoneAddsNoStage) {
  StyledScene scene;
  const Style style = test::make_style();
  const PixelRect rect{60, 60, 80, 80};
  EXPECT_FALSE(scene.make(rect, &style) == scene.make(rect, nullptr));
  EXPECT_EQ(StyledScene::Stages(scene, nullptr, 96).picture.styled, nullptr);
}

TEST(SheetStyle, LayersMakeThePictureInStyleAgain) {
  StyledScene scene;
  const Style style = test::make_style();
  const PixelRect rect{60, 30, 80, 60};
  StyledScene::Stages stages(scene, &style, 96);
  const SheetPicture picture = stages.picture.picture->read(rect, with_layers);
  EXPECT_TRUE(picture.colour == scene.make(rect, &style));
  double most = 0.0;
  for (std::size_t i = 0; i < picture.colour.size(); ++i) {
    glm::dvec3 flat(0.0);
    for (std::size_t k = 0; k + 1 < layer_plane_count; ++k)
      lay_over(flat, picture.layers->planes[k][i]);
    for (int c = 0; c < 3; ++c)
      most = std::max(most, std::abs(flat[c] - static_cast<double>(picture.colour[i][c])));
  }
  EXPECT_LT(most, (flatten_steps + 1.0) / 65535.0);
}

// High mountains on a sheet of 115 × 105 mm, with glaciers above the line.
IcePlan plan_at(int width, int ice_line_m) {
  const World world = make_world(
      test::small_scene({fmt::format("output.width={}", width),
                         fmt::format("output.height={}", width * 105 / 115),
                         "output.sheet_width_mm=115", "terrain.synthetic.highest_m=3900",
                         fmt::format("land_cover.settings.ice_line_m={}", ice_line_m),
                         "land_cover.settings.treeline_m=400",
                         fmt::format("land_cover.settings.snowline_m={}", ice_line_m + 200)}),
      silent_progress());
  return make_ice_plan(world, {});
}

TEST(SheetIce, IsNoneWhereNoIceIs) {
  const IcePlan plan = plan_at(230, 9000);
  EXPECT_TRUE(plan.flow.direction.empty());
  EXPECT_TRUE(plan.ways.empty());
}

// On a sheet with four times the pixels it is the same, from the same trace.
TEST(SheetIce, IsThatOfThePaperNotOfThePixels) {
  const IcePlan small =
      plan_at(230, 1300);  // with bare ground beside the ice: firn alone has hardly any
  const IcePlan large = plan_at(920, 1300);
  EXPECT_GT(small.ways.size(), 5U);
  ASSERT_EQ(small.ways.size(), large.ways.size());
  EXPECT_TRUE(small.flow.direction == large.flow.direction);
  for (std::size_t i = 0; i < small.ways.size(); ++i)
    EXPECT_EQ(small.ways[i].positions, large.ways[i].positions);
}

// Rows are traced some at a time; the plan is that of all rows together, up to the edges of the
// sheet. The camera looks down, so that ice lies at the upper edge too.
TEST(SheetIce, IsThatOfAllRowsTracedAtOnce) {
  const World world =
      make_world(test::small_scene(
                     {"output.width=120", "output.height=280", "output.sheet_width_mm=60",
                      "camera.pitch_deg=-80", "terrain.synthetic.highest_m=3900",
                      "land_cover.settings.ice_line_m=1150", "land_cover.settings.treeline_m=400",
                      "land_cover.settings.snowline_m=1500"}),
                 silent_progress());
  const glm::ivec2 size = world.camera->size();
  const GuidanceBuffers seen = trace_forms(world, *world.camera, {0, 0, size.x, size.y}, {});
  StrokeParameters parameters;
  parameters.pixels_per_unit = world.scene.pixels_per_unit();
  parameters.seed = world.scene.seed;
  const IcePlan whole = plan_ice(seen, parameters);
  const auto is_ice = [](LandCoverClass id) { return has_trait(id, ClassTrait::icy); };
  ASSERT_TRUE(std::any_of(seen.land_cover.row(0), seen.land_cover.row(0) + size.x, is_ice));
  ASSERT_GT(whole.ways.size(), 2U);
  const IcePlan plan = make_ice_plan(world, {});
  EXPECT_TRUE(plan.flow.direction == whole.flow.direction);
  ASSERT_EQ(plan.ways.size(), whole.ways.size());
  for (std::size_t i = 0; i < plan.ways.size(); ++i)
    EXPECT_EQ(plan.ways[i].positions, whole.ways[i].positions);
}

}  // namespace
}  // namespace belvedere
