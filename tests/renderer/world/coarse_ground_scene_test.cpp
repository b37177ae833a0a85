#include "renderer/world/coarse_ground_scene.h"

#include <gtest/gtest.h>

#include "renderer/scene/draft.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

using test::small_scene;

LoadedScene scene_of_files() {
  LoadedScene loaded = small_scene();
  loaded.scene.terrain.synthetic.reset();
  return loaded;
}

TEST(CoarseGroundScene, CellsAreWholeTimesAsWideAndAboutAsManyAsAllowed) {
  const auto cell_m = [](double mcells, double max_mcells) {
    return with_coarse_ground(scene_of_files(), {mcells, 30.0}, max_mcells)
        .scene.terrain.dem.cell_m;
  };
  EXPECT_EQ(cell_m(9.0, 1.0), 90.0);
  EXPECT_EQ(cell_m(9.06, 1.0), 90.0) << "slightly more than allowed";
  EXPECT_EQ(cell_m(10.0, 1.0), 120.0);
  EXPECT_EQ(cell_m(9.0, 2.5), 60.0);
}

TEST(CoarseGroundScene, GroundThatIsSmallEnoughStays) {
  EXPECT_EQ(with_coarse_ground(scene_of_files(), {1.0, 30.0}, 1.0).scene.terrain.dem.cell_m, 0.0);
}

TEST(CoarseGroundScene, SyntheticTerrainKeepsItsCellsAndItsSizeIsThatOfItsGrid) {
  const LoadedScene loaded = small_scene();
  const auto& made = *loaded.scene.terrain.synthetic;
  const GroundSize size = ground_size_of(loaded);
  EXPECT_DOUBLE_EQ(size.mcells, 1e-6 * made.width * made.height);
  EXPECT_EQ(size.cell_m, made.cell_m);
  const LoadedScene coarse = with_coarse_ground(loaded, size, 1e-6);
  EXPECT_EQ(write_scene(coarse.scene), write_scene(loaded.scene));
}

TEST(CoarseGroundScene, ADraftOfSmallGroundIsADraftAlone) {
  const LoadedScene loaded = small_scene();
  EXPECT_EQ(write_scene(make_draft_scene(loaded).scene), write_scene(make_draft(loaded.scene)));
}

}  // namespace
}  // namespace belvedere
