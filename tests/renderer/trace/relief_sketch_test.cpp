#include "renderer/trace/relief_sketch.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>

#include "renderer/world/world.h"
#include "tests/grids.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

const GeoTransform sketch_frame{0.0, 0.0, 100.0, 100.0};
const glm::dvec3 overhead{0.0, 0.0, 1.0};
const glm::dvec2 sketch_viewer{3000.0, -6000.0};

// Ground of 6 km from a camera 3 km above its southern edge, looking north and slightly down: half
// sky, half land.
struct Sketch {
  explicit Sketch(Grid<float> ground) : altitude_m(std::move(ground)) {
    surface = deform(altitude_m, sketch_frame, glm::dvec3(sketch_viewer, 0.0), deformation);
    tracer = std::make_unique<Tracer>(surface);
    const CameraParameters parameters{.width = 60,
                                      .height = 40,
                                      .eye = {sketch_viewer, 3000.0},
                                      .pitch_deg = -30.0,
                                      .field_of_view_deg = 60.0};
    camera = make_camera(parameters);
  }
  Grid<glm::vec3> draw(glm::dvec3 sun, const Grid<std::uint8_t>& marked = {}) const {
    return make_relief_sketch(altitude_m, sketch_frame, marked, deformation, *tracer, *camera, sun);
  }
  Grid<float> altitude_m;
  Deformation deformation{DeformParameters{}, sketch_viewer};
  DeformedSurface surface;
  std::unique_ptr<Tracer> tracer;
  std::unique_ptr<Camera> camera;
};

Grid<float> level() { return Grid<float>(61, 61, 500.F); }

TEST(ReliefSketch, LevelGroundIsLighterTheHigherTheSun) {
  const Sketch sketch(level());
  const glm::vec3 high = sketch.draw(overhead)(30, 35);
  const glm::vec3 low = sketch.draw({0.9, 0.0, 0.4})(30, 35);
  EXPECT_GT(high.x, low.x + 0.1F);
  EXPECT_EQ(sketch.draw({0.0, 0.0, 7.0})(30, 35), high) << "only the direction counts";
}

TEST(ReliefSketch, SlopesTowardsTheSunAreLighter) {
  Grid<float> roof = level();  // its ridge runs north
  for (const auto [x, y] : test::cells(61, 61))
    roof(x, y) = 1500.F - 40.F * static_cast<float>(std::abs(x - 30));
  const Grid<glm::vec3> picture = Sketch(roof).draw({0.7, 0.0, 0.7});
  EXPECT_GT(picture(40, 30).x, picture(20, 30).x + 0.2F);
}

TEST(ReliefSketch, PalesWithDistanceTowardsTheSky) {
  const Grid<glm::vec3> picture = Sketch(level()).draw(overhead);
  const glm::vec3 sky = picture(30, 0);
  EXPECT_GT(sky.z, sky.x) << "a plain blue";
  EXPECT_EQ(picture(5, 0), sky);
  EXPECT_GT(picture(30, 20).z, picture(30, 39).z) << "further off it is bluer";
}

TEST(ReliefSketch, MarkedGroundIsYellowGreenAndTheRestAsBefore) {
  const Sketch sketch(level());
  Grid<std::uint8_t> west(61, 61, 0);
  for (const auto [x, y] : test::cells(30, 61)) west(x, y) = 1;
  const Grid<glm::vec3> plain = sketch.draw(overhead);
  const Grid<glm::vec3> marked = sketch.draw(overhead, west);
  EXPECT_GT(marked(15, 30).y, marked(15, 30).z + 0.2F);
  EXPECT_EQ(marked(45, 30), plain(45, 30));
  EXPECT_EQ(marked(15, 0), plain(15, 0)) << "the sky is not marked";
}

TEST(ClassView, IsTheClassThatOneSampleSees) {
  // Valleys are widened, so that ground is drawn elsewhere than its classes; a width that is not a
  // multiple of a bundle.
  for (const char* setting : {"generalize.widen_valleys_m=0", "generalize.widen_valleys_m=900"}) {
    const World world =
        make_world(test::small_scene({setting, "output.width=93"}), silent_progress());
    const GuidanceBuffers guidance =
        trace_guidance(world.terrain, *world.surface, world.tracer, *world.camera,
                       {.sampling = world.scene.sampling}, {0, 0, 93, 80}, silent_progress());
    TerrainModel bare;
    bare.dem = world.dem;
    bare.generalized_m = world.terrain.generalized_m;
    bare.came_from = world.terrain.came_from;
    bare.goes_to = world.terrain.goes_to;
    bare.land_cover = world.land_cover;
    const Grid<LandCoverClass> seen = trace_classes(bare, world.tracer, *world.camera);
    EXPECT_EQ(seen, guidance.land_cover) << setting;
    EXPECT_GT(std::set<LandCoverClass>(seen.begin(), seen.end()).size(), 3U);
  }
}

}  // namespace
}  // namespace belvedere
