#include "renderer/close/roofs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "tests/grids.h"
#include "tests/renderer/close/close_ground.h"

namespace belvedere {
namespace {

constexpr RoofSize example_size{.spacing_units = 20.0F, .slender = 0.5F, .lean_rad = 0.2F};

struct Sheet {
  GuidanceBuffers g =
      test::make_close_hills(240, 200, 1.0, 8.0, LandCoverClass::snow, LandCoverClass::snow);
  WideView wide{g, 1, {0, 0}};
  Grid<glm::vec2> fall = smooth_fall_lines(wide, 1.0, {0, 0, 240, 200});
  SpurGround ground{wide, fall, 1.0, 3};

  SpurCells grow(PixelRect rect, glm::vec2 way) const {
    return grow_roofs(ground, example_size, 1, rect,
                      [&](std::size_t) { return std::optional(way); });
  }
};

// The height that a roof's slope promises, in every direction that roofs may lie in.
TEST(Roofs, SlopesAreTheGradientsOfTheirHeights) {
  const Sheet sheet;
  for (const glm::vec2 way : {glm::vec2(0, 1), glm::vec2(1, 0), glm::vec2(-0.6F, -0.8F)}) {
    const SpurCells roofs = sheet.grow({60, 120, 180, 180}, way);
    int compared = 0;
    for (int y = 120; y < 180; y += 7)
      for (int x = 60; x < 180; x += 7) {
        const auto at = [&](float dx, float dy) {
          return highest_spur(roofs, example_size.slender,
                              {static_cast<float>(x) + dx, static_cast<float>(y) + dy},
                              sheet.g.depth_m(x, y), 0);
        };
        const SpurHit hit = at(0.0F, 0.0F);
        const SpurHit right = at(0.25F, 0.0F);
        if (hit.spur == nullptr || hit.part != SpurPart::back || right.part != hit.part ||
            right.spur != hit.spur || right.side != hit.side)
          continue;
        const float rise = (right.height - hit.height) / (0.25F / example_size.spacing_units);
        EXPECT_NEAR(rise, hit.slope.x, 0.45F) << "flanks widen along, so only about";
        ++compared;
      }
    EXPECT_GT(compared, 10);
  }
}

TEST(Roofs, LieInTheirDirection) {
  const Sheet sheet;
  double aside = 0.0;
  int count = 0;
  for (const Spur& roof : sheet.grow({0, 60, 240, 200}, {1.0F, 0.0F}).spurs) {
    if (!roof.grown) continue;
    EXPECT_NEAR(std::hypot(roof.down.x, roof.down.y), 1.0F, 1e-5F);
    aside += static_cast<double>(roof.down.y) * static_cast<double>(roof.down.y);
    ++count;
  }
  EXPECT_GT(count, 60);
  EXPECT_NEAR(std::sqrt(aside / count), 0.2, 0.06) << "lean_rad";
}

TEST(Roofs, OfAPartAreThoseOfTheWhole) {
  const Sheet sheet;
  const SpurCells whole = sheet.grow({0, 0, 240, 200}, {0.0F, 1.0F});
  const SpurCells part = sheet.grow({100, 130, 120, 150}, {0.0F, 1.0F});
  for (const auto [x, y] : test::cells({100, 130, 120, 150}, 3)) {
    const glm::vec2 position(x, y);
    const float depth_m = sheet.g.depth_m(x, y);
    const SpurHit a = highest_spur(whole, 0.5F, position, depth_m, 0);
    const SpurHit b = highest_spur(part, 0.5F, position, depth_m, 0);
    EXPECT_EQ(a.height, b.height);
    EXPECT_EQ(a.flank_id(), b.flank_id());
  }
  EXPECT_EQ(roof_reach_units(example_size), 84.0F);
}

TEST(Roofs, StartOnlyWhereThereIsADirection) {
  const Sheet sheet;
  const SpurCells none = grow_roofs(sheet.ground, example_size, 1, {0, 0, 240, 200},
                                    [](std::size_t) { return std::optional<glm::vec2>(); });
  EXPECT_EQ(highest_spur(none, 0.5F, {100.0F, 150.0F}, sheet.g.depth_m(100, 150), 0).spur, nullptr);
}

}  // namespace
}  // namespace belvedere
