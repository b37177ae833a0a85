// Generalization for a view: ground per pixel, the print's detail, and that every view has its own.
#include "renderer/world/generalize_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "base/pyramid.h"
#include "renderer/world/scene_dem.h"
#include "terrain/generalize/mask.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

Dem plane(int width, int height, double cell) {
  Dem dem;
  dem.altitude_m = Grid<float>(width, height, 0.F);
  dem.filled = Grid<std::uint8_t>(width, height, 0);
  dem.transform = {0.0, cell * height, cell, cell};
  return dem;
}

// A perspective over the plane z = 0. Pixels are f (x, y) / c with x, y, c the point's coordinates
// in the camera, so the map from ground to picture has the derivatives below; on the central ray
// that is d / f across and d² / (f h) = d / f / sin(incidence) along the view.
TEST(GroundMetresPerPixel, AreThoseOfAPerspectiveOverAPlane) {
  const Dem dem = plane(161, 161, 50.0);
  View view;
  view.camera.width = 1000;
  view.camera.height = 600;
  view.camera.field_of_view_deg = 60.0;
  view.camera.pitch_deg = -30.0;
  const double h = 2500.0;
  view.camera.eye = {dem.transform.to_crs(80, 0).x, dem.transform.to_crs(0, 112).y, h};
  view.viewer_xy = {view.camera.eye.x, view.camera.eye.y};
  const PixelGround ground = ground_m_per_pixel(dem, view);
  ASSERT_EQ(ground.step_cells, 16);
  ASSERT_GE(ground.m_per_pixel.width(), 11);
  const auto shown = [&](int column, int row) { return ground.m_per_pixel(column / 16, row / 16); };
  const double f = 500.0 / std::tan(30.0 * degree);
  const double sine = std::sin(30.0 * degree);
  const double cosine = std::cos(30.0 * degree);
  int checked = 0;
  for (int row = 0; row <= 160; row += 16)
    for (int column = 0; column <= 160; column += 16) {
      const glm::dvec2 p = dem.transform.to_crs(column, row) - view.viewer_xy;
      const double c = p.y * cosine + h * sine;
      if (c < 500.0) continue;
      const double up = p.y * sine - h * cosine;
      const glm::dvec2 east(f / c, 0.0);
      const glm::dvec2 north = f / (c * c) * glm::dvec2(-p.x * cosine, sine * c - up * cosine);
      // The larger singular value, by trying directions.
      double largest = 0.0;
      for (int i = 0; i < 720; ++i) {
        const double t = i * 0.25 * degree;
        largest = std::max(largest, glm::length(std::cos(t) * east + std::sin(t) * north));
      }
      EXPECT_NEAR(shown(column, row), 1.0 / largest, 0.015 / largest) << column << ' ' << row;
      ++checked;
    }
  EXPECT_GT(checked, 90);
  // Below the viewer the view is steep: c = h / 2, and a metre along the view takes more pixels
  // than one across.
  EXPECT_NEAR(shown(80, 112), h * sine * sine / f, 0.005 * h / f);
  // Ahead (row 16: 4800 m away on the ground) one across takes more.
  EXPECT_NEAR(shown(80, 16), (4800.0 * cosine + h * sine) / f, 0.001 * 5000.0 / f);
}

TEST(GroundMetresPerPixel, GoOnBehindTheEyeAsTheDistanceDoes) {
  const Dem dem = plane(97, 97, 100.0);
  View view;
  view.camera.pitch_deg = -5.0;
  view.camera.eye = {dem.transform.to_crs(48, 48).x, dem.transform.to_crs(48, 48).y, 300.0};
  const PixelGround ground = ground_m_per_pixel(dem, view);
  const auto shown = [&](int column, int row) { return ground.m_per_pixel(column / 16, row / 16); };
  for (const float metres : ground.m_per_pixel) ASSERT_TRUE(std::isfinite(metres) && metres > 0.F);
  const auto distance = [&](int row) { return std::hypot((row - 48) * 100.0, 300.0); };
  EXPECT_NEAR(shown(48, 96) / shown(48, 80), distance(96) / distance(80), 1e-3);
}

// A rugged slope, seen from the position of a scene and a test.
class ViewedGround : public testing::Test {
 protected:
  void SetUp() override {
    ground_ = {
        Grid<float>(160, 200), {500000.0, 5200000.0, 100.0, 100.0}, normalize_crs("EPSG:32632")};
    for (const auto [x, y] : test::cells(160, 200))
      ground_.cells(x, y) = static_cast<float>(
          900.0 + 3.0 * x + 20.0 * std::sin(x * 1.9) * std::cos(y * 1.3) + 30.0 * std::sin(y * .4));
    write_raster(folder_ / "dem.tif", ground_);
  }
  LoadedScene scene(const std::string& settings,
                    const std::string& camera = "position = [508000, 5190000]") const {
    return parse_scene(
        "version = 1\n[[terrain.sources]]\nfile = \"dem.tif\"\n[camera]\nheight_m = 5000\n" +
            camera + "\n[generalize]\n" + settings,
        "s.toml", folder_.path(), {});
  }
  Grid<float> seen(const LoadedScene& loaded, const View* view = nullptr) const {
    const Dem dem = make_scene_dem(loaded, silent_progress());
    const View made = make_view(loaded.scene, dem, silent_progress());
    return generalize_for_view(loaded, dem, nullptr, view == nullptr ? made : *view,
                               silent_progress())
        .altitude_m;
  }
  // Straight down, with this many metres per pixel.
  static View from_above(double m_per_pixel) {
    View view;
    view.camera.width = 1000;
    view.camera.height = 1000;
    view.camera.pitch_deg = -90.0;
    view.camera.eye = {
        508000.0, 5190000.0,
        1500.0 + m_per_pixel * 500.0 / std::tan(0.5 * view.camera.field_of_view_deg * degree)};
    view.viewer_xy = {508000.0, 5190000.0};
    return view;
  }

  Raster<float> ground_;
  test::Folder folder_;
};

// Bands have wavelengths of 400, 800 … m, and 2.5 pixels must fit in one: 160 m, 320 m … per pixel;
// at twice that a band vanishes.
TEST_F(ViewedGround, BandsFinerThanThePrintGoAndOthersStay) {
  const std::string print =
      "keep_lakes = false\nforeground = [1, 1, 1]\nbackground = [1, 1, 1]\nprint_detail_px = ";
  const View limit = from_above(318.0);
  const Grid<float> without_finest =
      seen(scene("keep_lakes = false\nforeground = [1, 1, 0]\nbackground = [1, 1, 0]\n"), &limit);
  ASSERT_GT(test::largest_difference(without_finest, ground_.cells), 15.0);
  EXPECT_LT(test::largest_difference(seen(scene(print + "2.5\n"), &limit), without_finest), 0.5);
  const View near = from_above(150.0);
  EXPECT_EQ(seen(scene(print + "2.5\n"), &near), ground_.cells);
  EXPECT_EQ(seen(scene(print + "1\n"), &limit), ground_.cells);  // a finer print shows it
  EXPECT_EQ(seen(scene(print + "0\n"), &limit), ground_.cells);
}

// Attenuation of a band by distance: its remaining share, cell by cell, falls at most 8/7 as fast
// as a straight line would.
TEST_F(ViewedGround, NoStepWithDistanceIsMuchLargerThanALinearOne) {
  const double near = 5000.0;
  const double far = 11000.0;
  const Grid<float> out =
      seen(scene("keep_lakes = false\nforeground = [1]\nbackground = [0]\nforeground_to_m = 5000\n"
                 "background_from_m = 11000\n"));
  const Grid<float> band = make_laplacian_pyramid(ground_.cells, 1).bands[0];
  const auto share = [&](int x, int y) {
    return 1.0 - (static_cast<double>(ground_.cells(x, y)) - out(x, y)) / band(x, y);
  };
  int checked = 0;
  double min = 1.0;
  double max = 0.0;
  for (const auto [x, y] : test::cells({0, 1, 160, 200})) {
    if (std::abs(band(x, y)) < 3.F || std::abs(band(x, y - 1)) < 3.F) continue;
    EXPECT_LE(std::abs(share(x, y) - share(x, y - 1)), 8.0 / 7.0 * 100.0 / (far - near) + 2e-4)
        << x << ' ' << y;
    const glm::dvec2 position = ground_.transform.to_crs(x, y);
    const double distance = std::hypot(position.x - 508000.0, position.y - 5190000.0);
    EXPECT_NEAR(share(x, y), foreground_share(distance, near, far), 2e-4) << x << ' ' << y;
    min = std::min(min, share(x, y));
    max = std::max(max, share(x, y));
    ++checked;
  }
  EXPECT_GT(checked, 5000);
  EXPECT_LT(min, 0.05);
  EXPECT_GT(max, 0.99);
}

TEST_F(ViewedGround, TwoViewsOfOneSceneHaveEachItsOwn) {
  const std::string settings =
      "keep_lakes = false\nforeground = [1, 1, 1]\nbackground = [1, 0.5, 0]\nforeground_to_m = "
      "4000\nbackground_from_m = 7000\n";
  const Grid<float> from_south_west = seen(scene(settings, "position = [501000, 5181000]"));
  const Grid<float> from_north_east = seen(scene(settings, "position = [515000, 5199000]"));
  const Grid<float> all_far =
      seen(scene("keep_lakes = false\nforeground = [1, 0.5, 0]\nbackground = [1, 0.5, 0]\n"));
  EXPECT_GT(test::largest_difference(from_south_west, from_north_east), 15.0);
  for (const auto [x, y] : test::cells(15, 15)) {
    // Cells at the south-western and at the north-eastern corner: unchanged near the viewer, only
    // background at the other.
    const glm::ivec2 west(x, 199 - y);
    const glm::ivec2 east(159 - x, y);
    ASSERT_EQ(from_south_west(west.x, west.y), ground_.cells(west.x, west.y));
    ASSERT_EQ(from_north_east(east.x, east.y), ground_.cells(east.x, east.y));
    ASSERT_NEAR(from_south_west(east.x, east.y), all_far(east.x, east.y), 1e-3);
    ASSERT_NEAR(from_north_east(west.x, west.y), all_far(west.x, west.y), 1e-3);
  }
}

// Stripes along the view: their change divided by its largest is the background's share.
TEST_F(ViewedGround, TheShareFallsWithDistanceWithoutAJump) {
  for (const auto [x, y] : test::cells(160, 200)) ground_.cells(x, y) = x % 2 == 0 ? 1050.F : 950.F;
  write_raster(folder_ / "dem.tif", ground_);
  const std::string bands = "keep_lakes = false\nforeground = [1, 1]\nbackground = [1, 0]\n";
  const std::string view = "position = [508000, 5175000]";  // 5 km south of the rim
  const Grid<float> out =
      seen(scene(bands + "foreground_to_m = 8000\nbackground_from_m = 16000\n", view));
  const int x = 80;
  const double whole = 1050.0 - out(x, 0);  // more than 17 km away
  ASSERT_GT(whole, 40.0);
  double before = 0.0;
  double centre = -1.0;
  for (int y = 199; y >= 0; --y) {
    const double far = (1050.0 - out(x, y)) / whole;
    const double distance_m = 5000.0 + 100.0 * (199 - y) + 50.0;
    if (distance_m < 8000.0) {
      ASSERT_EQ(out(x, y), 1050.F) << y;
    }
    if (distance_m > 16000.0) {
      ASSERT_NEAR(far, 1.0, 1e-5) << y;
    }
    ASSERT_GE(far, before - 1e-6) << y;
    ASSERT_LE(far - before, 8.0 / 7.0 * 100.0 / 8000.0 + 1e-5) << y;
    if (centre < 0.0 && distance_m >= 12000.0) centre = far;
    before = far;
  }
  EXPECT_NEAR(centre, 0.5, 0.02);
}

// Operators of every kind leave the ground where the scene's mask is 0, and the base reaches it.
TEST_F(ViewedGround, WhereTheMaskIsZeroNothingChangesWhateverActs) {
  // A valley that falls to the south.
  for (const auto [x, y] : test::cells(160, 200))
    ground_.cells(x, y) +=
        12.F * static_cast<float>(std::abs(x - 80)) + 2.F * static_cast<float>(200 - y);
  write_raster(folder_ / "dem.tif", ground_);
  Raster<float> mask = ground_;
  for (const auto [x, y] : test::cells(160, 200)) mask.cells(x, y) = y < 90 ? 0.F : 1.F;
  write_raster(folder_ / "mask.tif", mask);
  for (const char* what :
       {"line_integral = true\n", "widen_valleys_m = 600\n", "base = 1.2\n",
        "foreground = [1.5, 2, 0]\n",
        "line_integral = true\nwiden_valleys_m = 600\nforeground = [1.5, 2, 0]\n"}) {
    SCOPED_TRACE(what);
    const std::string settings = std::string("keep_lakes = false\n") + what;
    const Grid<float> all = seen(scene(settings));
    const Grid<float> out = seen(scene(settings + "mask = \"mask.tif\"\n"));
    double changed = 0.0;
    for (const auto [x, y] : test::cells(160, 200)) {
      if (y < 90) {
        ASSERT_EQ(out(x, y), ground_.cells(x, y)) << x << ' ' << y;
      }
      changed = std::max(changed, static_cast<double>(std::abs(all(x, y) - ground_.cells(x, y))));
    }
    EXPECT_GT(changed, 20.0);
    // Bands as wide as the distance to the mask's border still know of it.
    EXPECT_LT(std::abs(out(80, 190) - all(80, 190)), 1.0 + 0.01 * changed);
  }
}

}  // namespace
}  // namespace belvedere
