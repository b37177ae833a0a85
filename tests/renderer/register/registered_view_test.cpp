#include "renderer/register/registered_view.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "renderer/register/registered_scene.h"
#include "terrain/io/crs.h"
#include "tests/grids.h"
#include "tests/terrain/register/synthetic_view.h"

namespace belvedere {
namespace {

// Ground of the DEM is seen where the painting has it, at half its size.
TEST(RegisteredView, ShowsPlacesWhereThePaintingDoes) {
  const Dem dem = make_dem({test::grid_of(200, 200, [](int, int y) { return 1500.0 - 5.0 * y; }),
                            {660000.0, 5280000.0, 250.0, 250.0},
                            normalize_crs("EPSG:32632")});
  std::vector<ControlPair> pairs = test::synthetic_places(40);
  for (ControlPair& pair : pairs)
    pair.altitude_m = 1500.0 - 5.0 * dem.transform.to_cell(0.0, pair.position.y).y;
  test::paint(test::synthetic_view(ViewKind::plane, pairs), pairs);
  const Registration found = register_pairs(pairs, {1200, 550});
  const RegisteredView view(found, registered_scene(found, {1200, 550}), dem, {600, 275},
                            silent_progress());
  EXPECT_EQ(view.size_px(), glm::ivec2(600, 275));
  int in_picture = 0;
  for (const ControlPair& pair : pairs) {
    const auto at = view.map().to_image(pair.position);
    ASSERT_TRUE(at);
    EXPECT_LT(glm::length(2.0 * at->pixel - pair.pixel), 1.0);
    if (!at->visible) continue;
    ++in_picture;
    const auto back = view.map().to_geo(at->pixel);
    ASSERT_TRUE(back);
    EXPECT_LT(glm::length(back->position - pair.position), 1.0);
  }
  EXPECT_GT(in_picture, 10);
}

}  // namespace
}  // namespace belvedere
