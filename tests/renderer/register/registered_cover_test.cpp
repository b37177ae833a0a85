#include "renderer/register/registered_cover.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/register/registered_light.h"
#include "renderer/stages/lit_picture.h"
#include "renderer/world/world.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

constexpr int covered_width = 160;
constexpr int covered_height = 90;

LoadedScene hills_with(const std::vector<std::string>& settings) {
  LoadedScene loaded = test::small_scene(settings);
  loaded.scene.output.width = covered_width;
  loaded.scene.output.height = covered_height;
  return loaded;
}

// The base picture of hills with a painter's treeline, and what the climate says of them.
struct CoveredHills {
  LoadedScene scene = hills_with({});  // without the painter's line
  std::shared_ptr<const Dem> dem;
  Grid<glm::vec3> painting;
  GuidanceBuffers guidance;
  Grid<LandCoverClass> truth;
};

// Painted with forest up to 1500 m; made once.
const CoveredHills& low_treeline() {
  static const CoveredHills hills = [] {
    const World world =
        make_world(hills_with({"land_cover.settings.treeline_m=1500"}), silent_progress());
    CoveredHills out;
    out.dem = world.dem;
    const LitPicture picture =
        make_lit_picture(world, read_palette("summer"), {0, 0, covered_width, covered_height}, {});
    out.painting = picture.base.colour;
    out.truth = picture.guidance.land_cover;
    out.guidance =
        trace_registered_guidance(out.scene, out.dem, {covered_width, covered_height}, {});
    return out;
  }();
  return hills;
}

double share_alike(const Grid<LandCoverClass>& a, const Grid<LandCoverClass>& b) {
  double alike = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) alike += a[i] == b[i] ? 1.0 : 0.0;
  return alike / static_cast<double>(a.size());
}

TEST(RegisteredCover, HasTheLinesOfThePainter) {
  const CoveredHills& hills = low_treeline();
  const Grid<float> exact(covered_width, covered_height, 0.F);
  const RegisteredCover cover = find_registered_cover(hills.painting, exact, hills.guidance,
                                                      hills.scene, *hills.dem, silent_progress());
  EXPECT_NEAR(cover.climate.treeline_m, 1820.0, 150.0);
  EXPECT_NEAR(cover.lines.treeline_m, 1500.0, 60.0);
  LoadedScene own = hills.scene;
  cover_scene(cover, own.scene);
  EXPECT_THAT(own.scene.land_cover.settings, testing::Contains(std::pair<std::string, double>(
                                                 "treeline_m", cover.lines.treeline_m)));
  GuidanceBuffers renewed = hills.guidance;
  renew_land_cover(own, *hills.dem, renewed, silent_progress());
  const double wrong_before = 1.0 - share_alike(hills.guidance.land_cover, hills.truth);
  const double wrong_after = 1.0 - share_alike(renewed.land_cover, hills.truth);
  EXPECT_GT(wrong_before, 0.05);
  EXPECT_LT(wrong_after, 0.5 * wrong_before);
}

TEST(RegisteredCover, NeedsGroundThatIsKnown) {
  const CoveredHills& hills = low_treeline();
  const Grid<float> unknown(covered_width, covered_height, 30.F);
  const RegisteredCover cover = find_registered_cover(hills.painting, unknown, hills.guidance,
                                                      hills.scene, *hills.dem, silent_progress());
  Scene scene;
  cover_scene(cover, scene);
  EXPECT_TRUE(scene.land_cover.settings.empty());
}

}  // namespace
}  // namespace belvedere
