#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/filter.h"
#include "base/math_exact.h"
#include "base/pyramid.h"
#include "renderer/world/generalize_view.h"
#include "renderer/world/scene_dem.h"
#include "renderer/world/view.h"
#include "terrain/io/dem_levels.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

// Ridges of every size down to two cells, high enough for crests, with a lake.
Raster<float> mountains(int side) {
  Raster<float> out{Grid<float>(side, side), {600000.0, 5200000.0, 30.0, 30.0}, "EPSG:32632"};
  for (const auto [x, y] : test::cells(side, side)) {
    double z = 1500.0;
    for (const double wave : {4.0, 9.0, 21.0, 45.0, 97.0, 205.0})
      z += 3.0 * wave * exact::sin(6.28 * x / wave) * exact::sin(6.28 * (y + 0.3 * x) / wave);
    out.cells(x, y) = static_cast<float>(z);
  }
  for (const auto [x, y] : test::cells({side / 2, side / 2, side / 2 + 30, side / 2 + 20}))
    out.cells(x, y) = 1100.F;
  out.crs = normalize_crs(out.crs);
  return out;
}

class PreviewGround : public testing::Test {
 protected:
  static constexpr int side = 384;
  PreviewGround() { write_raster(folder_ / "a.tif", mountains(side)); }
  LoadedScene scene(const std::string& generalize = "") {
    return parse_scene(
        "version = 1\n[[terrain.sources]]\nfile = \"a.tif\"\n[camera]\nposition = [605000, "
        "5189000]\nazimuth_deg = 0\npitch_deg = -15\nheight_m = 6000\n[output]\nwidth = 96\nheight "
        "= 48\n[generalize]\n" +
            generalize,
        "a.toml", folder_.path(), {});
  }
  // On a level with about a quarter (1) or a sixteenth (2) of the cells.
  static LoadedScene preview(LoadedScene scene, int level) {
    scene.scene.terrain.preview_mcells = 1e-6 * std::ldexp(side * side, -2 * level);
    return scene;
  }
  static Grid<float> ground(const LoadedScene& scene) {
    const SceneDem opened = open_scene_dem(scene, silent_progress());
    const View view = make_view(scene.scene, opened.dem, silent_progress(),
                                ground_altitude_of(opened), &opened.region);
    GroundMasks masks;
    if (opened.data)
      masks = preview_masks(scene, *opened.data, opened.dem.halved, nullptr, silent_progress());
    return generalize_for_view(scene, opened.dem, nullptr, view, silent_progress(), no_cache(),
                               {.masks = opened.data ? &masks : nullptr})
        .altitude_m;
  }
  const test::Folder folder_;
};

TEST_F(PreviewGround, LevelsHaveAboutAsManyCellsAsAllowed) {
  const auto level = [](int width, double max_cells) {
    return preview_level({{}, width, width, ""}, max_cells);
  };
  EXPECT_EQ(level(1000, 1e6), 0);
  EXPECT_EQ(level(1100, 1e6), 0) << "up to a third more";
  EXPECT_EQ(level(1200, 1e6), 1);
  EXPECT_EQ(level(3000, 1e6), 2);
  EXPECT_EQ(level(3000, 0.0), 0) << "no preview";
  EXPECT_EQ(preview_level({{}, 40, 100000, ""}, 1e4), 1) << "a narrow strip keeps some columns";
}

TEST_F(PreviewGround, AltitudesAreTheReducedOnesAndWaterKeepsItsLevel) {
  const Dem data = make_scene_dem(scene(), silent_progress());
  const Dem dem = make_scene_dem(preview(scene(), 2), silent_progress());
  EXPECT_EQ(dem.halved, 2);
  EXPECT_DOUBLE_EQ(dem.transform.cell_x, 120.0);
  EXPECT_EQ(dem.transform.to_crs(10, 7), data.transform.to_crs(40, 28));
  const Grid<float> reduced = reduce(reduce(data.altitude_m));
  ASSERT_TRUE(dem.altitude_m.same_size(reduced));
  int water = 0;
  for (std::size_t i = 0; i < reduced.size(); ++i)
    if (dem.altitude_m[i] == 1100.F)
      ++water;
    else
      ASSERT_EQ(dem.altitude_m[i], reduced[i]);
  EXPECT_NEAR(water, 20 * 30 / 16, 15);
}

// A Gaussian of the data is, at the centres of halved cells, the one that is left after halving.
TEST_F(PreviewGround, GaussiansMeanTheSameMetres) {
  const Dem data = make_scene_dem(scene(), silent_progress());
  const auto apart = [](const Grid<float>& a, const Grid<float>& b) {
    double sum = 0.0;
    for (const auto [x, y] : test::cells({8, 8, a.width() - 8, a.height() - 8}))
      sum += std::abs(a(x, y) - b(x, y));
    return sum;
  };
  for (const int level : {1, 2}) {
    const Dem dem = halved_dem(data, level);
    constexpr double sigma_m = 120.0;
    const Grid<float> whole = gaussian_blur(data.altitude_m, data.blur_cells(sigma_m));
    Grid<float> wanted(dem.width(), dem.height());
    for (const auto [x, y] : test::cells(dem)) wanted(x, y) = whole(x << level, y << level);
    const double left = apart(wanted, gaussian_blur(dem.altitude_m, dem.blur_cells(sigma_m)));
    EXPECT_LT(3.0 * left, apart(wanted, gaussian_blur(dem.altitude_m, sigma_m / dem.cell_m())))
        << level;
  }
}

TEST_F(PreviewGround, TheViewIsThatOfThePrint) {
  const auto view_of = [](const LoadedScene& scene) {
    const SceneDem opened = open_scene_dem(scene, silent_progress());
    return make_view(scene.scene, opened.dem, silent_progress(), ground_altitude_of(opened),
                     &opened.region);
  };
  const View print = view_of(scene());
  const View seen = view_of(preview(scene(), 2));
  EXPECT_EQ(seen.camera.eye, print.camera.eye);
  EXPECT_EQ(seen.camera.pitch_deg, print.camera.pitch_deg);
  EXPECT_EQ(seen.generalize.background_from_m, print.generalize.background_from_m);
  EXPECT_EQ(seen.air.scale_m, print.air.scale_m);
}

// Each band that is not finer than the level, the crest, and a slope mask act as in the print.
TEST_F(PreviewGround, SlidersActAsInThePrint) {
  const std::string plain = "foreground = [1, 1, 1, 1, 1, 1]\nbackground = [1, 1, 1, 1, 1, 1]\n";
  const std::vector<std::string> raised = {
      "foreground = [1, 1, 1.5, 1, 1, 1]\nbackground = [1, 1, 1.5, 1, 1, 1]\n",
      "foreground = [1, 1, 1, 1.5, 1, 1]\nbackground = [1, 1, 1, 1.5, 1, 1]\n",
      plain + "crest = 1\n", plain + "base = 1.2\nmask_slope_deg = [5, 25]\n"};
  for (const int level : {1, 2}) {
    const Grid<float> print = ground(scene(plain));
    const Grid<float> seen = ground(preview(scene(plain), level));
    for (const std::string& with : raised) {
      Grid<float> wanted = ground(scene(with));
      for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] -= print[i];
      Grid<float> change = ground(preview(scene(with), level));
      for (std::size_t i = 0; i < change.size(); ++i) change[i] -= seen[i];
      for (int k = level - 1; k >= 0; --k)
        change = expand(change, level_cells(side, k), level_cells(side, k));
      double aa = 0.0;
      double ab = 0.0;
      double bb = 0.0;
      for (std::size_t i = 0; i < change.size(); ++i) {
        aa += static_cast<double>(wanted[i]) * wanted[i];
        ab += static_cast<double>(wanted[i]) * change[i];
        bb += static_cast<double>(change[i]) * change[i];
      }
      // What a crest adds has details that the second level cannot show.
      const double lost = level == 2 && with.find("crest") != std::string::npos ? 0.07 : 0.04;
      EXPECT_GT(ab / std::sqrt(aa * bb), 1.0 - 0.5 * lost) << level << "\n" << with;
      EXPECT_NEAR(std::sqrt(bb / aa), 1.0, lost) << level << "\n" << with;
    }
  }
}

// Without the finest bands a preview shows the print's ground itself.
TEST_F(PreviewGround, IsTheReducedGroundOfThePrint) {
  const std::string coarse =
      "foreground = [1, 1.3, 1, 1, 0, 0]\nbackground = [1, 1.3, 1, 1, 0, "
      "0]\nkeep_lakes = false\nautomatic_mask = false\n";
  const Grid<float> print = reduce(reduce(ground(scene(coarse))));
  const Grid<float> seen = ground(preview(scene(coarse), 2));
  double sum = 0.0;
  for (std::size_t i = 0; i < print.size(); ++i) {
    const double d = static_cast<double>(print[i]) - seen[i];
    sum += d * d;
  }
  EXPECT_LT(std::sqrt(sum / static_cast<double>(print.size())), 3.0);
}

}  // namespace
}  // namespace belvedere
