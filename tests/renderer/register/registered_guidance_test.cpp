#include "renderer/register/registered_guidance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "renderer/scene/scene_file.h"
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

LoadedScene scene_with_sun(double azimuth_deg) {
  LoadedScene loaded = test::small_scene({"air.rim_fade_m=0"});
  loaded.scene.output.width = 300;
  loaded.scene.output.height = 160;
  loaded.scene.sun.azimuth_deg = azimuth_deg;
  loaded.scene.sun.altitude_deg = 30.0;
  return loaded;
}

// The base picture of hills in a secret sun, as a painting.
struct SunnyHills {
  Grid<glm::vec3> painting;
  GuidanceBuffers guidance;  // traced in another sun
  glm::dvec2 eye;
};

SunnyHills sunny_hills(double azimuth_deg) {
  const LoadedScene loaded = scene_with_sun(azimuth_deg);
  const World world = make_world(loaded, silent_progress());
  const PixelRect all{0, 0, loaded.scene.output.width, loaded.scene.output.height};
  SunnyHills out;
  out.painting = make_lit_picture(world, read_palette("summer"), all, {}).base.colour;
  out.guidance =
      trace_registered_guidance(scene_with_sun(0.0), world.dem, {all.width(), all.height()}, {});
  out.eye = world.view.viewer_xy;
  return out;
}

TEST(RegisteredLight, IsThatOfThePainting) {
  const SunnyHills hills = sunny_hills(290.0);
  const RegisteredLight light = find_registered_light(hills.painting, hills.guidance, hills.eye);
  EXPECT_TRUE(light.sun.trusted());
  EXPECT_NEAR(light.sun.azimuth_deg, 290.0, 10.0);
  EXPECT_NEAR(std::remainder(light.bearing_deg, 360.0), 0.0, 8.0) << "seen from the south";
  EXPECT_GT(light.regions(3, 1).bearing_deg, light.regions(2, 1).bearing_deg);
  Scene scene;
  light_scene(light, scene);
  EXPECT_NEAR(scene.sun.azimuth_deg.value(), 290.0, 10.0);
  EXPECT_TRUE(scene.light_regions.empty());
}

TEST(RegisteredLight, GivesPartsOfOtherLightTheirOwn) {
  RegisteredLight light{.sun = {300.0, 30.0, 0.3, 0.3, 0.1, 5000},
                        .regions = Grid<RegisteredRegion>(2, 2)};
  const std::vector<glm::dvec2> square = {{0, 0}, {4000, 0}, {4000, 4000}, {0, 4000}};
  light.regions(0, 0) = {{60.0, 40.0, 0.3, 0.1, 0.1, 900}, 10.0, square};
  light.regions(1, 0) = {{315.0, 30.0, 0.3, 0.1, 0.1, 900}, 20.0, square};  // nearly the same
  light.regions(0, 1) = {
      {60.0, 30.0, 0.3, 0.28, 0.1, 900}, 10.0, square};  // as good as the whole's
  light.regions(1, 1) = {{60.0, 30.0, 0.3, 0.1, 0.28, 900}, 10.0, square};  // not trusted
  Scene scene;
  light_scene(light, scene);
  ASSERT_EQ(scene.light_regions.size(), 1U);
  EXPECT_EQ(scene.light_regions[0].azimuth_deg, 60.0);
  EXPECT_EQ(scene.light_regions[0].points, square);
  EXPECT_NEAR(scene.light_regions[0].blend_m, 1000.0, 1.0);
  light.sun.elsewhere = 0.29;
  Scene usual;
  light_scene(light, usual);
  EXPECT_FALSE(usual.sun.azimuth_deg.has_value()) << "the paint does not tell";
}

}  // namespace
}  // namespace belvedere
