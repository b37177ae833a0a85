#include "renderer/stages/stages.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/grid.h"
#include "base/parallel.h"
#include "renderer/stages/lit_picture.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

constexpr PixelRect sheet{0, 0, 230, 210};

// A scene whose picture is painted in strokes only, in the stages of a sheet.
struct PaintedSheet {
  struct Stages {
    Stages(PaintedSheet& sheet, int tile_px)
        : graph(sheet.scratch, silent_progress()),
          ground(add_ground_stages(
              graph, make_ground_inputs(sheet.world, view_of(sheet.world), sheet.palette, {}),
              tile_px)),
          picture(add_picture_stages(graph, ground, nullptr)) {}
    StageGraph graph;
    GroundStages ground;
    PictureStages picture;
  };
  explicit PaintedSheet(std::vector<std::string> settings)
      : world(make_world((settings.insert(settings.end(), {"output.width=230", "output.height=210",
                                                           "output.sheet_width_mm=115"}),
                          test::small_scene(settings)),
                         silent_progress())) {}
  Grid<glm::vec3> make(PixelRect rect, int tile_px = 96) {
    return Stages(*this, tile_px).picture.picture->read(rect).colour;
  }
  const Palette palette = read_palette("summer");
  const World world;
  const test::Folder folder;
  TileStore::Place scratch{folder.path(), 1U << 24U};
};

const std::vector<std::string> misty = {
    "air.mist.0={ kind = \"sea\", to_m = 1100 }", "air.mist.1={ kind = \"valley\" }",
    "air.mist.2={ kind = \"lee\", position = [6000, 7000], size_m = 2500 }"};

TEST(MistOfASheet, AnyRectangleTilesAndThreadsGiveThePictureOfTheWhole) {
  PaintedSheet painted(misty);
  const Grid<glm::vec3> whole = painted.make(sheet);
  const ThreadLimit one(1);
  for (const PixelRect rect : {PixelRect{150, 90, 230, 170}, {63, 63, 65, 66}})
    EXPECT_TRUE(painted.make(rect, 64) == part_of(whole, rect)) << rect.x0;
}

TEST(MistOfASheet, ASeaBelowAllGroundChangesNothing) {
  PaintedSheet dry({});
  PaintedSheet low({"air.mist.0={ kind = \"sea\", to_m = -400, billows = 0 }"});
  EXPECT_TRUE(dry.make(sheet) == low.make(sheet));
}

// Deep under fog neither trees nor ground are visible: the picture is the mist's paint.
TEST(MistOfASheet, NothingStandsOutOfDeepFog) {
  PaintedSheet deep({"air.mist.0={ kind = \"sea\", to_m = 3900, visibility_m = 60, billows = 0 }"});
  const PaintedSheet::Stages stages(deep, 96);
  Grid<glm::vec3> fog(230, 210, glm::vec3(0.F));
  lay_mist(fog, {0, 0}, stages.picture.mist_paint->read(sheet));
  const Grid<float> veil = stages.picture.mist_sight->read(sheet).share;
  const Grid<glm::vec3> picture = deep.make(sheet);
  int hidden = 0;
  for (const auto [x, y] : test::cells({40, 100, 190, 210})) {
    if (veil(x, y) < 0.999F) continue;
    ++hidden;
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(picture(x, y)[c], fog(x, y)[c], 0.08F)
          << "edges are softened; a tree is .3 darker";
  }
  EXPECT_GT(hidden, 8000);
}

}  // namespace
}  // namespace belvedere
