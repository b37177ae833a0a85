// The keys of [deform]: their meaning, and what they refuse.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/view.h"
#include "tests/files.h"
#include "tests/renderer/scene/written_scene.h"

namespace belvedere {
namespace {

using test::refused;
using test::scene_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* every_deform_key = R"([deform]
exaggeration = 1.6
background_exaggeration = 1.2
exaggeration_base_m = 500
allow_folds = true
[[deform.bend.points]]
distance_m = 10000
inclination_deg = 20
[[deform.bend.points]]
distance_m = 80000
inclination_deg = 0
[[deform.summits]]
name = "Birkkarspitze"
position = [683000, 5253000]
factor = 1.4
base_m = 1500
[[deform.handles]]
name = "Kaiser"
position = [680000, 5250000]
radius_m = 8000
move_m = [500, -200]
rotate_deg = 50
[[deform.handles]]
position = [670000, 5250000]
radius_m = 4000
core_m = 100
pin = true
)";

TEST(SceneDeform, KeysBecomeADeformation) {
  const Scene scene = scene_of(every_deform_key);
  Dem dem;
  dem.altitude_m = Grid<float>(2, 2);
  const DeformParameters p = resolve_deform(scene.deform, dem);
  EXPECT_EQ(p.background_exaggeration, 1.2);
  ASSERT_EQ(p.bend.points.size(), 2U);
  EXPECT_EQ(p.bend.points[0].inclination_deg, 20.0);
  EXPECT_FALSE(p.bend.points[0].drop_m);
  ASSERT_EQ(p.summits.size(), 1U);
  EXPECT_EQ(p.summits[0].factor, 1.4);
  EXPECT_EQ(p.summits[0].radius_m, 5000.0);
  EXPECT_EQ(p.summits[0].base_m, 1500.0);
  ASSERT_EQ(p.handles.size(), 2U);
  EXPECT_EQ(p.handles[0].centre, glm::dvec2(680000.0, 5250000.0));
  EXPECT_EQ(p.handles[0].core_m, 4000.0);  // half of the radius
  EXPECT_EQ(p.handles[0].move_m, glm::dvec2(500.0, -200.0));
  EXPECT_EQ(p.handles[0].rotate_deg, 50.0);
  EXPECT_EQ(p.handles[1].core_m, 100.0);
  EXPECT_TRUE(p.handles[1].pin);
  EXPECT_TRUE(scene.deform.allow_folds);
  // Longitude and latitude need a CRS.
  const Scene lonlat = scene_of("[[deform.handles]]\nposition_lonlat = [11.4, 47.3]\n");
  EXPECT_THROW(resolve_deform(lonlat.deform, dem), Error);
  // Errors that only the deformation can detect get the scene's key.
  const Scene overlap =
      scene_of("[[deform.handles]]\nposition = [0, 0]\n[[deform.handles]]\nposition = [4000, 0]\n");
  const Error error = test::error_of([&] { resolve_deform(overlap.deform, dem); });
  EXPECT_EQ(error.where(), "deform.handles.1");
  EXPECT_THAT(error.found(), HasSubstr("handles.0 overlap"));
}

TEST(SceneDeform, WrittenReadsBackAndSettingsReachEachElement) {
  const Scene scene = scene_of(every_deform_key, {"deform.handles.0.rotate_deg=-30",
                                                  "deform.bend.points.1.inclination_deg=-2"});
  EXPECT_EQ(scene.deform.handles[0].handle.rotate_deg, -30.0);
  EXPECT_EQ(scene.deform.ground.bend.points[1].inclination_deg, -2.0);
  const std::string written = write_scene(scene);
  EXPECT_EQ(write_scene(parse_scene(written, "again.toml", ".", {}).scene), written);
  EXPECT_THAT(written, AllOf(HasSubstr("[[deform.bend.points]]"), HasSubstr("[[deform.summits]]"),
                             HasSubstr("rotate_deg = -30")));
}

TEST(SceneDeform, ExaggerationByDistanceAndAField) {
  const std::string text = R"([[deform.exaggeration_points]]
distance_m = 9000
factor = 1.3
[[deform.exaggeration_points]]
distance_m = 40000
factor = 0.9
[deform.field]
length_m = 3000
[[deform.field.places]]
position = [680000, 5250000]
moved_m = [250, -40]
noise_m = [60, 70]
[[deform.field.places]]
name = "Kaiser"
position = [690000, 5250000]
)";
  const Scene scene = scene_of(text);
  Dem dem;
  dem.altitude_m = Grid<float>(2, 2);
  const DeformParameters p = resolve_deform(scene.deform, dem);
  ASSERT_EQ(p.exaggeration_points.size(), 2U);
  EXPECT_EQ(p.exaggeration_points[1].factor, 0.9);
  EXPECT_EQ(p.field.length_m, 3000.0);
  EXPECT_EQ(p.field.reach_m, DisplacementParameters{}.reach_m);
  ASSERT_EQ(p.field.places.size(), 2U);
  EXPECT_EQ(p.field.places[0].position, glm::dvec2(680000.0, 5250000.0));
  EXPECT_EQ(p.field.places[0].moved.lateral_m, 250.0);
  EXPECT_EQ(p.field.places[0].moved.upward_m, -40.0);
  EXPECT_EQ(p.field.places[0].noise.upward_m, 70.0);
  EXPECT_EQ(p.field.places[1].moved.lateral_m, 0.0);
  const std::string written = write_scene(scene);
  EXPECT_EQ(write_scene(parse_scene(written, "again.toml", ".", {}).scene), written);
  EXPECT_THAT(refused("[[deform.field.places]]\nmoved_m = [1, 2]\n"),
              HasSubstr("deform.field.places.0 has no position"));
  EXPECT_THAT(refused("[deform]\nbackground_exaggeration = 2\n" + text),
              HasSubstr("one of the two"));
  EXPECT_THAT(refused(text + "[[deform.exaggeration_points]]\ndistance_m = 5\nfactor = 1\n"),
              HasSubstr("ascending order"));
}

TEST(SceneDeform, RefusesWhatCannotBe) {
  const std::string points = "[[deform.bend.points]]\ndistance_m = 1000\ninclination_deg = 9\n";
  EXPECT_THAT(refused(points), AllOf(HasSubstr("s.toml:2:"), HasSubstr("a single control point")));
  EXPECT_THAT(refused(points + points), HasSubstr("distances in ascending order"));
  EXPECT_THAT(refused(points + "[[deform.bend.points]]\ndistance_m = 2000\ndrop_m = 9\n"),
              HasSubstr("one curve"));
  EXPECT_THAT(refused(points + "[[deform.bend.points]]\ndistance_m = 2000\n"),
              HasSubstr("neither"));
  EXPECT_THAT(refused("[[deform.bend.points]]\ndistance_m = 1\ndrop_m = 1\ninclination_deg = 1\n"),
              HasSubstr("exclude each other"));
  EXPECT_THAT(refused("[[deform.bend.points]]\ndrop_m = 1\n"), HasSubstr("distance_m is missing"));
  EXPECT_THAT(refused("[[deform.bend.points]]\ndistance_m = 1\ninclination_deg = 85\n"),
              HasSubstr("-80 … 80"));
  EXPECT_THAT(refused("[deform.bend]\nradius_m = 90000\n" + points +
                      "[[deform.bend.points]]\ndistance_m = 2000\ninclination_deg = 0\n"),
              HasSubstr("together with radius_m"));
  EXPECT_THAT(refused("[deform]\nforeground_to_m = 95000\nbackground_exaggeration = 2\n"),
              HasSubstr("beyond"));
  EXPECT_THAT(refused("[[deform.handles]]\nradius_m = 5\n"),
              HasSubstr("deform.handles.0 has no position"));
  EXPECT_THAT(refused("[[deform.summits]]\nradius_m = 50\n"),
              HasSubstr("deform.summits.0 has no position"));
  EXPECT_THAT(refused("[[deform.handles]]\nposition = [0, 0]\nradius_m = 500\ncore_m = 500\n"),
              HasSubstr("s.toml:5:10: "));
  EXPECT_THAT(refused("[[deform.handles]]\nposition = [0, 0]\nrotate_deg = 200\n"),
              HasSubstr("-170 … 170°"));
  EXPECT_THAT(refused("[[deform.summits]]\nposition = [0, 0]\nfactor = 0.1\n"),
              HasSubstr("0.3 … 5"));
}

}  // namespace
}  // namespace belvedere
