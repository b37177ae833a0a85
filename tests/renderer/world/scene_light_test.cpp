#include "renderer/world/scene_light.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "renderer/stages/lit_picture.h"
#include "renderer/trace/light_field.h"
#include "renderer/world/world.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/notes.h"
#include "tests/renderer/trace/synthetic_ground.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

using test::small_scene_text;
using testing::HasSubstr;

LoadedScene with(const std::string& blocks) {
  return parse_scene(small_scene_text + blocks, "small.toml", ".", {});
}

constexpr const char* turned =
    "[[light.regions]]\nposition = [6000, 6000]\nradius_m = 2500\nblend_m = 1500\nturn_deg = "
    "120\nwarmth = 0.6\n";
constexpr const char* cloud =
    "[[light.clouds]]\nposition = [3000, 7000]\nradius_m = 1500\nstrength = 0.8\n";

LitPicture lit(const LoadedScene& scene, PixelRect part, int tile_px = 32) {
  const World world = make_world(scene, silent_progress());
  Run run;
  run.tile_px = tile_px;
  return make_lit_picture(world, read_palette("summer"), part, run);
}

TEST(SceneLight, SaysNothingWhereTheSceneSaysNothing) {
  EXPECT_EQ(make_world(with(""), silent_progress()).light_field, nullptr);
}

TEST(SceneLight, RegionsTurnTheScenesSunOrHaveTheirOwn) {
  const std::string blocks = std::string(turned) +
                             "[[light.regions]]\npoints = [[0, 0], [2000, 0], [1000, "
                             "2000]]\nazimuth_deg = 90\naltitude_deg = 50\n"
                             "strength = 1.5\nblend_m = 0\n";
  const World world = make_world(with(blocks), silent_progress());
  ASSERT_NE(world.light_field, nullptr);
  const GroundLight turned_light = world.light_field->at({6000.0, 6000.0});
  EXPECT_LT(glm::length(turned_light.sun - sun_direction({315.0 + 120.0, 30.0})), 1e-12);
  EXPECT_NEAR(turned_light.warmth, 0.6F, 1e-6F);
  EXPECT_EQ(turned_light.side, 1.0F) << "from the east, in a view to the north";
  const GroundLight own = world.light_field->at({1000.0, 500.0});
  EXPECT_LT(glm::length(own.sun - sun_direction({90.0, 50.0})), 1e-12);
  EXPECT_EQ(own.strength, 1.5F);
  EXPECT_EQ(world.light_field->at({11000.0, 500.0}).sun, world.view.sun_direction);
  EXPECT_EQ(world.light_field->at({11000.0, 500.0}).side, -1.0F);
}

TEST(SceneLight, ReadsTheAreasOfAFile) {
  const test::Folder folder;
  folder.write("ranges.geojson",
               R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"name":"a"},"geometry":{"type":"Polygon","coordinates":[[[11.0,47.0],[11.1,47.0],[11.1,47.1],[11.0,47.1],[11.0,47.0]]]}},
{"type":"Feature","properties":{"name":"b"},"geometry":{"type":"Polygon","coordinates":[[[11.3,47.0],[11.4,47.0],[11.4,47.1],[11.3,47.1],[11.3,47.0]]]}}]})");
  const Dem dem = make_dem({Grid<float>(10, 10, 0.F),
                            {650000.0, 5220000.0, 1000.0, 1000.0},
                            normalize_crs("EPSG:32632")});
  View view;
  view.sun = {315.0, 30.0};
  view.sun_direction = sun_direction(view.sun);
  const auto field = [&](const std::string& more) {
    return make_light_field(
        parse_scene(small_scene_text +
                        std::string("[[light.regions]]\nfile = \"ranges.geojson\"\nstrength = 0.5\n"
                                    "blend_m = 0\n") +
                        more,
                    "small.toml", folder.path(), {}),
        dem, view);
  };
  const glm::dvec2 in_a = transform_point(normalize_crs("EPSG:4326"), dem.crs, {11.05, 47.05});
  const glm::dvec2 in_b = transform_point(normalize_crs("EPSG:4326"), dem.crs, {11.35, 47.05});
  const glm::dvec2 between = transform_point(normalize_crs("EPSG:4326"), dem.crs, {11.2, 47.05});
  EXPECT_EQ(field("")->at(in_a).strength, 0.5F);
  EXPECT_EQ(field("")->at(in_b).strength, 0.5F);
  EXPECT_EQ(field("")->at(between).strength, 1.0F);
  EXPECT_EQ(field("where = \"name = 'b'\"\n")->at(in_a).strength, 1.0F);
}

// A note names the block and says where to get its file; the picture is that without the block.
TEST(SceneLight, NotesAnOptionalFileThatIsMissing) {
  test::Notes progress;
  const std::string block =
      "[[light.regions]]\nfile = \"nowhere.gpkg\"\nget_from = \"the club\"\nturn_deg = 40\n";
  EXPECT_EQ(make_world(with(block + "optional = true\n"), progress).light_field, nullptr);
  EXPECT_THAT(progress.all,
              testing::Contains("light.regions.0 is left out: nowhere.gpkg is missing; the club"));
  const World beside = make_world(with(block + "optional = true\n" + cloud), silent_progress());
  ASSERT_NE(beside.light_field, nullptr) << "the cloud stays";
  EXPECT_THAT(test::input_error([&] { make_world(with(block), silent_progress()); }),
              HasSubstr("nowhere.gpkg"));
}

TEST(SceneLight, RefusesWhatCannotBe) {
  const auto refused = [](const std::string& blocks) {
    return test::usage_error([&] { make_world(with(blocks), silent_progress()); });
  };
  EXPECT_THAT(refused("[[light.regions]]\nturn_deg = 90\n"),
              HasSubstr("light.regions.0 has no position"));
  EXPECT_THAT(refused("[[light.regions]]\nposition = [1, 1]\n"), HasSubstr("without a radius"));
  EXPECT_THAT(refused("[[light.regions]]\npoints = [[1, 1], [2, 2]]\n"),
              HasSubstr("three positions or more"));
  EXPECT_THAT(refused("[[light.regions]]\npoints = [[1, 1], [2, 2], [3]]\n"),
              HasSubstr("three positions or more"));
  EXPECT_THAT(
      refused(
          "[[light.regions]]\nposition = [1, 1]\nradius_m = 9\nazimuth_deg = 1\nturn_deg = 1\n"),
      HasSubstr("exclude each other"));
  EXPECT_THAT(refused("[[light.clouds]]\nradius_m = 100\n"),
              HasSubstr("light.clouds.0 has no position"));
  LoadedScene night = with(turned);
  night.scene.sun.altitude_deg = -2.0;
  EXPECT_THAT(test::usage_error([&] { make_world(night, silent_progress()); }),
              HasSubstr("below the horizon"));
}

TEST(SceneLight, TurnsWhatLiesInTheRegionAndNothingElse) {
  const PixelRect whole{0, 0, 96, 80};
  const World world = make_world(with(turned), silent_progress());
  const LitPicture plain = lit(with(""), whole);
  const LitPicture local = lit(with(turned), whole);
  int changed = 0;
  int far = 0;
  for (std::size_t i = 0; i < plain.guidance.tone.size(); ++i) {
    if (plain.guidance.is_sky(i)) continue;
    const glm::dvec2 position =
        glm::dvec2(plain.guidance.position_m[i]) + glm::dvec2(plain.guidance.origin_m);
    const double from = glm::length(position - glm::dvec2(6000.0, 6000.0));
    if (from < 2500.0 && std::abs(plain.guidance.tone[i] - local.guidance.tone[i]) > 0.1F)
      ++changed;
    if (from > 4000.0) {
      ++far;
      ASSERT_EQ(plain.guidance.shadow[i], local.guidance.shadow[i]);
    }
  }
  EXPECT_GT(changed, 200);
  EXPECT_GT(far, 1000);
}

TEST(SceneLight, PartsAndTilesHaveTheBitsOfTheWhole) {
  const LoadedScene scene = with(std::string(turned) + cloud);
  const LitPicture whole = lit(scene, {0, 0, 96, 80});
  const LitPicture tiles = lit(scene, {0, 0, 96, 80}, 8);
  EXPECT_TRUE(tiles.base.colour == whole.base.colour);
  EXPECT_TRUE(tiles.guidance.tone == whole.guidance.tone);
  // The lower part needs what is above it, no more than half of the picture here.
  const PixelRect part{0, 8, 96, 80};
  const LitPicture lower = lit(scene, part);
  for (const auto [x, y] : test::cells({0, 72, 96, 80}))
    ASSERT_EQ(lower.guidance.shadow(x, y - part.y0), whole.guidance.shadow(x, y));
}

TEST(SceneLight, WrittenScenesReadBackTheSame) {
  const LoadedScene scene =
      with(std::string(turned) + cloud +
           "[[light.regions]]\npoints_lonlat = [[11, 47], [11.5, 47], [11.2, 47.25]]\n");
  const std::string text = write_scene(scene.scene);
  EXPECT_THAT(text, HasSubstr("points_lonlat = [[11, 47], [11.5, 47], [11.2, 47.25]]"));
  EXPECT_EQ(write_scene(parse_scene(text, "again.toml", ".", {}).scene), text);
}

using test::all_meadow;
using test::make_world;
using test::small_scene;
using test::SyntheticWorld;

// Two cones of 1500 m on a plain, 9 km apart from west to east; the camera is north of them and
// looks south, so that it sees the sides that a sun in the south leaves dark.
class TwoCones : public testing::Test {
 protected:
  SyntheticWorld world_ = make_world(
      600, 400,
      [](double x, double y) {
        const auto cone = [&](double cx) {
          return std::max(0.0, 1500.0 - 0.6 * std::hypot(x - cx, y - 5000.0));
        };
        return std::max(cone(4500.0), cone(13500.0));
      },
      all_meadow);
  std::unique_ptr<const Camera> camera_;
  View view_;

  TwoCones() {
    const CameraParameters p{.width = 160,
                             .height = 90,
                             .eye = {659000.0, 5328000.0, 5000.0},
                             .azimuth_deg = 180.0,
                             .pitch_deg = -18.0,
                             .field_of_view_deg = 75.0};
    camera_ = make_camera(p);
    view_.camera = p;
    set_sun(180.0, 20.0);  // low enough that more than the middle of the seen sides is turned away
  }
  void set_sun(double azimuth_deg, double altitude_deg) {
    view_.sun = {azimuth_deg, altitude_deg};
    view_.sun_direction = sun_direction(view_.sun);
  }
  std::vector<SeenSlope> slopes() const {
    return see_slopes(world_.terrain, 1.0, *world_.tracer, *camera_, 1);
  }
  std::vector<SeenRange> lit_ranges() const {
    const std::vector<SeenSlope> seen = slopes();
    std::vector<SeenRange> ranges = find_ranges(seen);
    light_ranges(ranges, seen, *world_.tracer, view_.sun_direction, nullptr);
    return ranges;
  }
};

TEST_F(TwoCones, EachIsARange) {
  const std::vector<SeenRange> ranges = lit_ranges();
  ASSERT_EQ(ranges.size(), 2U);
  for (const SeenRange& range : ranges) {
    const double cone = range.summit.x < 659000.0 ? 654500.0 : 663500.0;
    EXPECT_LT(glm::length(range.summit - glm::dvec2(cone, 5315000.0)), 400.0);
    EXPECT_NEAR(range.altitude_m, 1500.0, 150.0);
    EXPECT_GT(range.centre.y, 5315000.0) << "the side that is seen";
    EXPECT_NEAR(range.lit + range.cast + range.away, 1.0, 1e-12);
  }
  EXPECT_NEAR(ranges[0].share + ranges[1].share, 1.0, 1e-12);
}

TEST_F(TwoCones, StandInShadeWithTheSunBehindThem) {
  for (const SeenRange& range : lit_ranges()) {
    EXPECT_TRUE(range.in_shade());
    EXPECT_GT(range.away, 0.4);
  }
  set_sun(340.0, 35.0);
  for (const SeenRange& range : lit_ranges()) {
    EXPECT_FALSE(range.in_shade());
    EXPECT_GT(range.lit, 0.8);
  }
}

TEST_F(TwoCones, TheProposalTurnsThemToTheLightAndLoads) {
  const LoadedScene scene = small_scene();
  const std::vector<SeenSlope> seen = slopes();
  const std::vector<ProposedLight> proposed =
      propose_light(scene, *world_.terrain.dem, view_, seen, *world_.tracer);
  ASSERT_EQ(proposed.size(), 2U);
  for (const ProposedLight& one : proposed) {
    EXPECT_LT(one.lit_before, 0.4);
    EXPECT_GT(one.lit_after, one.lit_before + 0.2);
  }
  const std::string text = proposed_light_text(proposed);
  const LoadedScene again = parse_scene(small_scene_text + text, "small.toml", ".", {});
  ASSERT_EQ(again.scene.light_regions.size(), 2U);
  EXPECT_EQ(again.scene.light_regions[0].turn_deg, proposed[0].region.turn_deg);
  EXPECT_EQ(again.scene.light_regions[1].position, proposed[1].region.position);
  EXPECT_EQ(again.scene.light_regions[1].radius_m, proposed[1].region.radius_m);
  // A turned region needs no further one.
  EXPECT_TRUE(propose_light(again, *world_.terrain.dem, view_, seen, *world_.tracer).empty());
  EXPECT_EQ(
      proposed_light_text(propose_light(scene, *world_.terrain.dem, view_, seen, *world_.tracer)),
      text)
      << "each time the same";
}

TEST_F(TwoCones, NothingIsProposedWhereTheLightIsGood) {
  set_sun(320.0, 35.0);
  const std::vector<ProposedLight> none =
      propose_light(small_scene(), *world_.terrain.dem, view_, slopes(), *world_.tracer);
  EXPECT_TRUE(none.empty());
  EXPECT_THAT(proposed_light_text(none), HasSubstr("# No range"));
}

// A high wall north of a cone, outside the picture, casts its shadow on it.
TEST(SeenRanges, ToldFromTurnedAwayIsWhatLiesInCastShadow) {
  const auto cone_behind_wall = [](double wall) {
    return make_world(
        300, 400,
        [wall](double x, double y) {
          if (y > 1500.0 && y < 1800.0) return wall;
          return std::max(0.0, 900.0 - 0.5 * std::hypot(x - 4500.0, y - 5000.0));
        },
        all_meadow);
  };
  const CameraParameters p{.width = 96,
                           .height = 64,
                           .eye = {654500.0, 5318000.0, 9000.0},
                           .azimuth_deg = 180.0,
                           .pitch_deg = -70.0};
  const auto camera = make_camera(p);
  const auto shares = [&](double wall) {
    const SyntheticWorld world = cone_behind_wall(wall);
    const std::vector<SeenSlope> seen = see_slopes(world.terrain, 1.0, *world.tracer, *camera, 1);
    std::vector<SeenRange> ranges = find_ranges(seen);
    light_ranges(ranges, seen, *world.tracer, sun_direction({0.0, 30.0}), nullptr);
    double lit = 0.0;
    double cast = 0.0;
    for (const SeenRange& range : ranges) {
      if (std::abs(range.summit.y - 5315000.0) > 1000.0) continue;
      lit = range.lit;
      cast = range.cast;
    }
    return glm::dvec2(lit, cast);
  };
  EXPECT_GT(shares(0.0).x, 0.4);
  EXPECT_EQ(shares(0.0).y, 0.0);
  EXPECT_GT(shares(3000.0).y, shares(0.0).x - 0.15) << "what was lit lies in its shadow";
}

}  // namespace
}  // namespace belvedere
