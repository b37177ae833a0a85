#include "renderer/world/coarse_ground_scene.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "renderer/scene/draft.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

using test::small_scene;

TEST(CoarseGroundScene, TheSizeOfTheGroundIsThatOfItsFiles) {
  const GroundSize synthetic = ground_size_of(test::small_scene());
  EXPECT_DOUBLE_EQ(synthetic.mcells, 0.0144);
  EXPECT_DOUBLE_EQ(synthetic.cell_m, 100.0);
  const test::Folder folder;
  write_raster(folder / "a.tif", Raster<float>{Grid<float>(60, 50, 7.F),
                                               {600000.0, 5200000.0, 25.0, 25.0},
                                               normalize_crs("EPSG:32632")});
  const auto scene = [&](const std::vector<std::string>& settings = {}) {
    return parse_scene(
        "version = 1\n[[terrain.sources]]\nfile = \"a.tif\"\n[camera]\nposition = [0, 0]\n",
        "a.toml", folder.path(), {.data_folders = {}, .settings = settings});
  };
  EXPECT_DOUBLE_EQ(ground_size_of(scene()).mcells, 0.003);
  EXPECT_DOUBLE_EQ(ground_size_of(scene()).cell_m, 25.0);
  EXPECT_DOUBLE_EQ(ground_size_of(scene({"terrain.cell_m=50"})).cell_m, 50.0);
  EXPECT_NEAR(ground_size_of(scene({"terrain.cell_m=50"})).mcells, 0.00075, 0.00005);
  EXPECT_EQ(test::error_of([&] {
              ground_size_of(scene({"terrain.sources=[{ file = \"none.tif\" }]"}));
            }).kind(),
            ErrorKind::input);
}

TEST(CoarseGroundScene, TheSizeOfSyntheticTerrainIsThatOfItsGrid) {
  const LoadedScene loaded = small_scene();
  const auto& made = *loaded.scene.terrain.synthetic;
  const GroundSize size = ground_size_of(loaded);
  EXPECT_DOUBLE_EQ(size.mcells, 1e-6 * made.width * made.height);
  EXPECT_EQ(size.cell_m, made.cell_m);
}

TEST(CoarseGroundScene, ADraftOfSmallGroundIsADraftAlone) {
  const LoadedScene loaded = small_scene();
  EXPECT_EQ(write_scene(make_draft_scene(loaded).scene), write_scene(make_draft(loaded.scene)));
}

}  // namespace
}  // namespace belvedere
