#include "renderer/world/scene_dem.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/cache/cache.h"
#include "renderer/scene/scene_settings.h"
#include "renderer/world/generalize_view.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/notes.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

// A valley between ridges whose rows stand too high and too low in turn, read by a scene with these
// settings.
class TerrainOperators : public testing::Test {
 protected:
  void SetUp() override {
    striped_ = valley(0.0);
    for (const auto [x, y] : test::cells(striped_.cells))
      striped_.cells(x, y) += y / 2 % 2 == 0 ? 4.F : -4.F;
    write_raster(folder_ / "striped.tif", striped_);
    write_raster(folder_ / "clean.tif", valley());
  }
  // Its gullies run nearly along columns and could be taken for stripes.
  static Raster<float> valley(double gullies_m = 60.0) {
    Raster<float> raster{
        Grid<float>(160, 200), {500000.0, 5200000.0, 100.0, 100.0}, normalize_crs("EPSG:32632")};
    for (const auto [x, y] : test::cells(160, 200))
      raster.cells(x, y) =
          static_cast<float>(900.0 - y + 18.0 * std::abs(x - 80.0) +
                             gullies_m * std::sin(x / 3.0) * std::sin(y / 11.0 + x));
    return raster;
  }
  LoadedScene scene(const std::string& file, const std::string& settings,
                    const std::vector<std::string>& changes = {}) const {
    return parse_scene(
        "version = 1\n[[terrain.sources]]\nfile = \"" + file + "\"\n[generalize]\n" + settings,
        "s.toml", folder_.path(), {.data_folders = {}, .settings = changes});
  }
  Grid<float> generalized(const std::string& settings) const {
    const LoadedScene loaded = scene("clean.tif", settings);
    return generalize_for_view(loaded, make_scene_dem(loaded, silent_progress()), nullptr, {},
                               silent_progress())
        .altitude_m;
  }

  Raster<float> striped_;
  test::Folder folder_;
};

TEST_F(TerrainOperators, AreOffUnlessASceneAsksForThem) {
  EXPECT_EQ(make_scene_dem(scene("striped.tif", ""), silent_progress()).altitude_m, striped_.cells);
  EXPECT_EQ(generalized(""), valley().cells);
}

TEST_F(TerrainOperators, StripesLeaveTheDemItself) {
  const Grid<float> before = make_scene_dem(scene("striped.tif", ""), silent_progress()).altitude_m;
  const Grid<float> after =
      make_scene_dem(scene("striped.tif", "destripe = true\n"), silent_progress()).altitude_m;
  const auto error = [](const Grid<float>& z) {
    const Grid<float> expected = valley(0.0).cells;
    double sum = 0.0;
    for (std::size_t i = 0; i < z.size(); ++i) sum += std::abs(z[i] - expected[i]);
    return sum;
  };
  EXPECT_LT(error(after), 0.5 * error(before));
}

TEST_F(TerrainOperators, SlopesBecomePlainAndValleysWide) {
  const Grid<float> bare = valley().cells;
  const Grid<float> plain = generalized("line_integral = true\n");
  const Grid<float> wide = generalized("widen_valleys_m = 1000\n");
  const auto roughness = [](const Grid<float>& z) {
    double sum = 0.0;
    for (const auto [x, y] : test::cells({20, 20, 60, 180}))
      sum += std::abs(z(x - 1, y) - 2.F * z(x, y) + z(x + 1, y));
    return sum;
  };
  EXPECT_LT(roughness(plain), 0.5 * roughness(bare));
  // Walls of 18 % stand back by up to 500 m: the ground at their feet comes to lie lower.
  double lower = 0.0;
  for (int y = 100; y < 160; ++y)
    for (int x = 70; x <= 90; ++x) lower += bare(x, y) - wide(x, y);
  EXPECT_GT(lower / (60.0 * 21.0), 8.0);
}

// The same cells and notes, until a file or a setting changes.
TEST_F(TerrainOperators, ElevationIsFoundInTheCache) {
  Raster<float> holed = valley();
  holed.cells(40, 50) = std::numeric_limits<float>::quiet_NaN();
  write_raster(folder_ / "clean.tif", holed);
  const std::string kept = folder_ / "cache";
  const Cache cache({.folder = kept, .limit_bytes = std::uint64_t{1} << 30});
  const auto read = [&](const std::vector<std::string>& changes, test::Notes& notes) {
    return make_scene_dem(scene("clean.tif", "", changes), notes, cache);
  };
  test::Notes first;
  test::Notes second;
  const Dem made = read({}, first);
  const Dem found = read({}, second);
  EXPECT_EQ(cache_entries(kept).size(), 1U);
  EXPECT_EQ(found.altitude_m, made.altitude_m);
  EXPECT_EQ(found.filled, made.filled);
  EXPECT_EQ(found.crs, made.crs);
  EXPECT_EQ(second.all, first.all);
  EXPECT_FALSE(first.all.empty()) << "a void is filled";
  read({"terrain.max_void_share=0.5"}, first);
  EXPECT_EQ(cache_entries(kept).size(), 2U);
  write_raster(folder_ / "clean.tif", valley());
  EXPECT_EQ(read({}, first).altitude_m, valley().cells);
  EXPECT_EQ(cache_entries(kept).size(), 3U);
}

// Ground is facets between the centres of cells: one row has none.
TEST_F(TerrainOperators, TwoCellsAcrossAreGroundAndOneIsRefused) {
  for (const auto& [columns, rows] : {std::pair{1, 1}, {1, 9}, {9, 1}, {2, 2}}) {
    Raster<float> small{Grid<float>(columns, rows, 700.F), striped_.transform, striped_.crs};
    write_raster(folder_ / "small.tif", small);
    const auto open = [&] { return open_scene_dem(scene("small.tif", ""), silent_progress()); };
    if (columns == 2)
      EXPECT_EQ(open().dem.width(), 2);
    else
      EXPECT_EQ(test::input_error(open),
                fmt::format("terrain: too small: {} × {} cells\n  allowed: at least 2 × 2 cells: a "
                            "larger `extent`, smaller cells (`cell_m`) or more data",
                            columns, rows));
  }
}

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
