#include "renderer/world/world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/math.h"
#include "renderer/world/scene_dem.h"
#include "renderer/world/scene_land_cover.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/notes.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

using test::small_scene;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(World, IsMadeInOrder) {
  test::Stages stages;
  const World world = make_world(small_scene(), stages);
  EXPECT_THAT(stages.all, ElementsAre("synthetic terrain", "class rules", "generalize",
                                      "building the ray tracer"));
}

TEST(World, ItsValuesFitEachOther) {
  const World world = make_world(small_scene(), silent_progress());
  EXPECT_EQ(world.camera->size(), glm::ivec2(96, 80));
  EXPECT_EQ(world.camera->eye(), world.view.camera.eye);
  EXPECT_EQ(world.terrain.dem, world.dem);
  EXPECT_EQ(world.terrain.land_cover, world.land_cover);
  EXPECT_TRUE(world.terrain.generalized_m.same_size(world.dem->altitude_m));
  EXPECT_FALSE(world.terrain.local.has_value()) << "nothing is rearranged";
  // Hills reach into the sky: the skyline is in the picture, and above its centre.
  EXPECT_GT(world.horizon_px, 0.0);
  EXPECT_LT(world.horizon_px, 40.0);
}

TEST(World, APictureWithoutTerrainIsRefused) {
  EXPECT_THAT(test::usage_error(
                  [] { make_world(small_scene({"camera.pitch_deg=60"}), silent_progress()); }),
              HasSubstr("no ground is in the picture"));
}

TEST(World, SharesTheTerrainThatIsThere) {
  const LoadedScene loaded = small_scene();
  const auto dem = std::make_shared<const Dem>(make_scene_dem(loaded, silent_progress()));
  const auto cover =
      std::make_shared<const LandCover>(make_scene_land_cover(loaded, *dem, silent_progress()));
  test::Stages stages;
  const World world = make_world(loaded, stages, no_cache(), {dem, cover});
  EXPECT_EQ(world.dem, dem);
  EXPECT_EQ(world.land_cover, cover);
  EXPECT_THAT(stages.all, ElementsAre("generalize", "building the ray tracer"));
  EXPECT_EQ(world.terrain.generalized_m,
            make_world(loaded, silent_progress()).terrain.generalized_m);
}

// ---- refused as early as possible

constexpr const char* no_files = R"(version = 1
[[terrain.sources]]
file = "none.tif"
[camera]
position = [0, 0]
)";

TEST(World, RefusesAMachineThatCannotBeforeItReadsAnything) {
  const char* old = std::getenv("BELVEDERE_INSTRUCTION_SET");
  const std::string kept = old == nullptr ? "" : old;
  setenv("BELVEDERE_INSTRUCTION_SET", "sse4.2", 1);
  test::Stages stages;
  EXPECT_THAT(test::message_of(ErrorKind::limit,
                               [&] {
                                 const World world = make_world(
                                     parse_scene(no_files, "s.toml", ".",
                                                 {.data_folders = {},
                                                  .settings = {"sampling.instruction_set=avx2"}}),
                                     stages);
                               }),
              HasSubstr("sampling.instruction_set"));
  if (old == nullptr)
    unsetenv("BELVEDERE_INSTRUCTION_SET");
  else
    setenv("BELVEDERE_INSTRUCTION_SET", kept.c_str(), 1);
  EXPECT_THAT(stages.all, IsEmpty());
}

TEST(World, RefusesAnEyeBelowTheGroundBeforeLandCoverIsMade) {
  test::Stages stages;
  EXPECT_THAT(test::usage_error([&] {
                const World world = make_world(
                    small_scene({"camera.position=[6000,6000]", "camera.height_m=-500"}), stages);
              }),
              HasSubstr("below the ground"));
  EXPECT_THAT(stages.all, ElementsAre("synthetic terrain"));
}

TEST(World, RefusesFoldedGroundBeforeTheTracerIsBuilt) {
  test::Stages stages;
  EXPECT_THAT(
      test::usage_error([&] {
        const World world = make_world(
            small_scene({"camera.position=[6000,6000]", "camera.height_m=12000",
                         "camera.pitch_deg=-90", "camera.field_of_view_deg=90",
                         "deform.handles.0={ position = [6000, 6000], radius_m = 3000, core_m = "
                         "1000, move_m = [2500, 0] }"}),
            stages);
      }),
      HasSubstr("folds"));
  EXPECT_THAT(stages.all, ElementsAre("synthetic terrain", "class rules", "generalize"));
}

FileNotes notes_of(const LoadedScene& loaded) {
  return make_world_notes(loaded, make_world(loaded, silent_progress()));
}

TEST(WorldNotes, SayCameraAndSun) {
  const FileNotes notes = notes_of(
      small_scene({"camera.azimuth_deg=12.5", "sun.azimuth_deg=250", "sun.altitude_deg=31"}));
  EXPECT_EQ(notes.at("belvedere:camera"),
            "perspective eye 6000.000 -4000.000 6000.000 azimuth 12.500000 pitch -22.000000 field "
            "50.0000");
  EXPECT_EQ(notes.at("belvedere:sun"), "azimuth 250.0000 altitude 31.0000");
  EXPECT_EQ(notes.at("belvedere:crs"), "none") << "synthetic terrain has no position";
}

TEST(WorldNotes, TheSceneInThemMakesThePictureAgain) {
  const LoadedScene loaded = small_scene({"seed=77", "title=Hills"});
  const std::string written = notes_of(loaded).at("belvedere:scene");
  EXPECT_EQ(written, write_scene(loaded.scene));
  EXPECT_EQ(parse_scene(written, "again.toml", ".", {}).scene.seed, 77U);
}

TEST(WorldNotes, NameTheCoordinateSystemAndEveryFileThatWasRead) {
  const test::Folder folder;
  write_raster(folder / "dem.tif", Raster<float>{Grid<float>(60, 60, 500.F),
                                                 {500000.0, 5200000.0, 100.0, 100.0},
                                                 normalize_crs("EPSG:32632")});
  const auto notes = [&] {
    return notes_of(
        parse_scene("version = 1\n[[terrain.sources]]\nfile = \"dem.tif\"\n[camera]\nposition = "
                    "[503000, 5190000]\n"
                    "height_m = 3000\n[output]\nwidth = 32\nheight = 32\n",
                    "s.toml", folder.path(), {}));
  };
  const auto inputs = [](const FileNotes& all) {
    std::string text;
    for (const auto& [key, value] : all)
      if ((key + value).find("dem.tif") != std::string::npos && key != "belvedere:scene")
        text += key + value;
    return text;
  };
  const FileNotes before = notes();
  EXPECT_EQ(before.at("belvedere:crs"), "EPSG:32632");
  EXPECT_NE(inputs(before), "");
  // The recorded hash of a file changes with its cells.
  write_raster(folder / "dem.tif", Raster<float>{Grid<float>(60, 60, 501.F),
                                                 {500000.0, 5200000.0, 100.0, 100.0},
                                                 normalize_crs("EPSG:32632")});
  EXPECT_NE(inputs(notes()), inputs(before));
}

TEST(SceneMist, AScenesMistIsNoneWhereItAsksForNone) {
  EXPECT_TRUE(make_world(test::small_scene(), silent_progress()).mist.empty());
}

TEST(SceneMist, IsWhatTheSceneSays) {
  const World world = make_world(
      test::small_scene({"air.mist.0={ kind = \"sea\", to_m = 900, visibility_m = 222 }",
                         "air.mist.1={ kind = \"valley\" }",
                         "air.mist.2={ kind = \"lee\", position = [6000, 6000], size_m = 1500 }"}),
      silent_progress());
  ASSERT_EQ(world.mist.layers.size(), 2U);
  EXPECT_EQ(world.mist.layers[0].kind, MistKind::sea);
  EXPECT_EQ(world.mist.layers[0].to_m, 900.0);
  EXPECT_EQ(world.mist.layers[0].visibility_m, 222.0);
  EXPECT_EQ(world.mist.layers[1].kind, MistKind::valley);
  EXPECT_EQ(world.mist.layers[1].patches, 0.35);
  EXPECT_FALSE(world.mist.ground.floor_m.empty());
  ASSERT_EQ(world.mist.clouds.size(), 1U);
  EXPECT_EQ(world.mist.rim_fade_m, 4000.0);
  EXPECT_GT(world.mist.farthest_m, 16000.0) << "the northern corners";
}

TEST(SceneMist, WhatIsMissingIsNamed) {
  const auto message = [](const char* mist) {
    return test::usage_error([&] { test::small_scene({std::string("air.mist.0=") + mist}); });
  };
  EXPECT_THAT(message("{ kind = \"sea\" }"), HasSubstr("to_m"));
  EXPECT_THAT(message("{ kind = \"lee\" }"), HasSubstr("position"));
  EXPECT_THAT(message("{ kind = \"valley\", radius_m = 900 }"), HasSubstr("position"));
  EXPECT_THAT(message("{ kind = \"smoke\" }"), HasSubstr("lee"));
}

using testing::AllOf;

// A level perspective 90° wide: its plane lies half a width before the eye, so that the picture's
// rim is seen at a slope of (height / width) · cos(angle off the middle).
TEST(SightLines, OfALevelPerspective) {
  const CameraParameters camera{.width = 400,
                                .height = 100,
                                .azimuth_deg = 30.0,
                                .pitch_deg = 0.0,
                                .field_of_view_deg = 90.0};
  const std::vector<SightLine> lines = sight_lines(camera, 9);
  ASSERT_EQ(lines.size(), 9U);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double off_deg = lines[i].azimuth_deg - 30.0;
    EXPECT_NEAR(off_deg, (static_cast<double>(i) - 4.0) * 10.0, 0.2) << "evenly spaced";
    EXPECT_NEAR(lines[i].highest, 0.25 * std::cos(to_radians(off_deg)), 1e-6);
    EXPECT_NEAR(lines[i].lowest, -0.25 * std::cos(to_radians(off_deg)), 1e-6);
  }
}

TEST(SightLines, ParallelOnesMeetInNoEye) {
  CameraParameters camera;
  camera.projection = "oblique";
  EXPECT_THAT(test::usage_error([&] { sight_lines(camera, 9); }),
              AllOf(HasSubstr("camera.projection"), HasSubstr("\"perspective\"")));
}

TEST(KnownAltitude, IsVoidWhereSomethingWasFilled) {
  Raster<float> raster{Grid<float>(8, 8, 100.F), {0.0, 0.0, 10.0, 10.0}, {}};
  raster.cells(3, 4) = NAN;
  const Grid<float> known = known_altitude(make_dem(std::move(raster)));
  for (const auto [x, y] : test::cells(8, 8))
    EXPECT_EQ(std::isnan(known(x, y)), x == 3 && y == 4) << x << ' ' << y;
}

// The search for a bend tries many on one ground.
TEST(BareView, BentAnewIsAsIfItHadBeenMadeSo) {
  const std::string bend =
      "deform.bend.points=[{ distance_m = 3000, inclination_deg = 15 }, { distance_m = 12000, "
      "inclination_deg = 0 }]";
  const BareView bent = make_bare_view(test::small_scene({bend}), silent_progress());
  BareView again = make_bare_view(test::small_scene(), silent_progress());
  const auto position = [](const BareView& bare) {
    return bare.deformation.point({6000.0, 1000.0, 1000.0});
  };
  EXPECT_NE(position(again), position(bent));
  bend_again(again, bent.view.deform.bend);
  EXPECT_EQ(position(again), position(bent));
}

}  // namespace
}  // namespace belvedere
