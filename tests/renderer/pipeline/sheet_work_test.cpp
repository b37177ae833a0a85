#include "renderer/pipeline/sheet_work.h"

#include <gtest/gtest.h>

#include "renderer/rock/rock_ground.h"  // Clang asks for the whole type
#include "tests/files.h"
#include "tests/paths.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

// Ground with rock.
LoadedScene rocks() {
  return test::small_scene({"synthesis.enabled=false", "land_cover.settings.treeline_m=400",
                            "terrain.synthetic.highest_m=3900"});
}

SheetRequest guidance_alone() { return {.panorama = false, .block_px = 64}; }

TEST(SheetWork, WithoutRockReliefTheGroundIsThatOfTheRays) {
  const LoadedScene loaded = rocks();
  SheetWork smooth(loaded, guidance_alone(), {.scratch_folder = {}, .rock_relief = false}, {}, {});
  EXPECT_EQ(smooth.ground.crests, nullptr);
  EXPECT_EQ(smooth.ground.relief, nullptr);
  EXPECT_EQ(smooth.ground.raised, smooth.ground.traced);
  const PixelRect sheet{0, 0, 96, 80};
  const BasePicture plain = smooth.ground.base->read(sheet);
  SheetWork rough(loaded, guidance_alone(), {}, {}, {});
  EXPECT_NE(rough.ground.crests, nullptr);
  EXPECT_NE(rough.ground.relief, nullptr);
  EXPECT_NE(rough.ground.raised, rough.ground.traced);
  EXPECT_FALSE(rough.ground.base->read(sheet).colour == plain.colour) << "rock is seen";
}

TEST(SheetWork, TakesOverValuesOfTheWorldBefore) {
  const LoadedScene loaded = rocks();
  ValueStore kept;
  std::weak_ptr<const Dem> dem;
  {
    const SheetWork work(loaded, guidance_alone(), {.scratch_folder = {}, .kept = &kept}, {}, {});
    dem = work.world.dem;
  }
  const SheetWork next(loaded, guidance_alone(), {.scratch_folder = {}, .kept = &kept}, {}, {});
  EXPECT_EQ(next.world.dem, dem.lock());
}

// Those of a scene by rules, with rivers, in a preview in light and colour.
TEST(SheetWork, TheArchitecturePageDrawsTheValues) {
  ValueStore kept;
  const SheetWork work(rocks(), guidance_alone(),
                       {.scratch_folder = {},
                        .rock_relief = false,
                        .kept = &kept,
                        .kept_paint = &kept,
                        .keep_rays = true},
                       {}, {});
  const std::string page = test::read_bytes(test::source_folder() + "/docs/architecture.md");
  const std::string begin = "flowchart LR\n";
  const std::size_t first = page.find(begin);
  ASSERT_NE(first, std::string::npos) << kept.draw();
  EXPECT_EQ(page.substr(first, page.find("```", first) - first), kept.draw())
      << "put the current drawing into the page";
}

TEST(SheetWork, PaintsSquaresOfTheRequestedSize) {
  const SheetWork work(rocks(), guidance_alone(), {}, {}, {});
  EXPECT_EQ(work.block_px, 64);
  EXPECT_EQ(work.view.camera.size(), glm::ivec2(96, 80));
}

TEST(SheetWork, CopiesOnlyForAPanorama) {
  Scene scene = rocks().scene;
  EXPECT_FALSE(is_copied(scene, {}));
  scene.synthesis.enabled = true;
  EXPECT_TRUE(is_copied(scene, {}));
  EXPECT_FALSE(is_copied(scene, guidance_alone()));
}

}  // namespace
}  // namespace belvedere
