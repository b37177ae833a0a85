#include "renderer/register/registered_ground.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "renderer/register/registered_scene.h"
#include "terrain/io/raster_io.h"
#include "tests/grids.h"
#include "tests/terrain/register/synthetic_view.h"

namespace belvedere {
namespace {

constexpr float sky = std::numeric_limits<float>::quiet_NaN();

TEST(RegisteredGround, IsTheGroundThatTheRegistrationShows) {
  // Ground that rises to the north.
  const Dem dem = make_dem({test::grid_of(200, 200, [](int, int y) { return 1500.0 - 5.0 * y; }),
                            {660000.0, 5280000.0, 250.0, 250.0},
                            normalize_crs("EPSG:32632")});
  std::vector<ControlPair> pairs = test::synthetic_places(40);
  for (ControlPair& pair : pairs)
    pair.altitude_m = 1500.0 - 5.0 * (dem.transform.to_cell(0.0, pair.position.y).y);
  const test::SyntheticView truth = test::synthetic_view(ViewKind::plane, pairs);
  test::paint(truth, pairs);
  std::erase_if(pairs, [](const ControlPair& p) {
    return p.pixel.x < 0.0 || p.pixel.x > 1200.0 || p.pixel.y < 0.0 || p.pixel.y > 550.0;
  });
  ASSERT_GE(pairs.size(), 12U);
  const Registration found = register_pairs(pairs, {1200, 550});
  const RegisteredView view(found, registered_scene(found, {1200, 550}), dem, {300, 138},
                            silent_progress());
  const RegisteredGround ground = trace_registered(view);
  EXPECT_EQ(folded_facets(view), 0U);
  int near = 0;
  for (const ControlPair& pair : pairs) {
    const int x = std::min(299, static_cast<int>(pair.pixel.x / 4.0));
    const int y = std::min(137, static_cast<int>(pair.pixel.y / 4.0));
    near += std::abs(ground.altitude_m(x, y) - pair.altitude_m) < 25.0 ? 1 : 0;
    EXPECT_LT(ground.sigma_px(x, y), 12.F);
  }
  EXPECT_GE(near, static_cast<int>(pairs.size()) - 1);
}

TEST(RegisteredGround, ContoursLieBetweenAltitudes) {
  RegisteredGround ground{
      test::grid_of(8, 4, [](int x, int y) { return y == 0 ? sky : 90.0 + 5.0 * x; }),
      Grid<float>(8, 4, 1000.F), Grid<float>(8, 4, 1.F)};
  for (int x = 0; x < 8; ++x) ground.distance_m(x, 0) = sky;
  const Grid<glm::vec3> grey(8, 4, glm::vec3(0.5F));
  const Grid<glm::vec3> drawn = contours_over(grey, ground, 100.0);
  // 100 m lies between x = 1 and 2; the skyline between the first two rows.
  EXPECT_LT(drawn(1, 2).x, 0.4F);
  EXPECT_EQ(drawn(3, 2), glm::vec3(0.5F));
  EXPECT_GT(drawn(3, 0).x, 0.9F);
  EXPECT_LT(drawn(3, 0).y, 0.2F);
}

TEST(RegisteredGround, ContoursAreTenOrMore) {
  EXPECT_EQ(contour_step_m(test::grid_of(100, 2, [](int x, int) { return 30.0 * x; })), 200.0);
  EXPECT_EQ(contour_step_m(test::grid_of(100, 2, [](int x, int) { return 2.0 * x; })), 20.0);
  EXPECT_EQ(contour_step_m(Grid<float>(3, 3, sky)), 20.0);
}

TEST(RegisteredGround, TrustFadesToTheLimit) {
  Grid<float> sigma(3, 1, 0.F);
  sigma(1, 0) = 12.F;
  sigma(2, 0) = sky;
  const Grid<glm::vec3> picture = trust_picture(sigma, 12.0);
  EXPECT_GT(picture(0, 0).y, 0.9F);
  EXPECT_LT(picture(1, 0).y, 0.2F);
  EXPECT_GT(picture(2, 0).z, 0.75F);
}

}  // namespace
}  // namespace belvedere
