#include "renderer/world/scene_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "base/random.h"
#include "renderer/world/world.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/notes.h"
#include "tests/scenes.h"
#include "tests/shared_cache.h"

namespace belvedere {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::IsEmpty;

// A small scene with values of its own for some keys.
LoadedScene hills(std::vector<std::string> settings = {}) {
  settings.insert(settings.begin(),
                  {"terrain.synthetic.width=30", "terrain.synthetic.height=28",
                   "terrain.synthetic.cell_m=400", "output.width=48", "output.height=40"});
  return test::small_scene(settings);
}

// ---- equal to a world that is made at once, whatever changed before

void expect_same_ground(const World& kept, const World& fresh) {
  EXPECT_TRUE(kept.dem->altitude_m == fresh.dem->altitude_m);
  EXPECT_TRUE(kept.dem->filled == fresh.dem->filled);
  EXPECT_EQ(kept.dem->transform, fresh.dem->transform);
  EXPECT_EQ(kept.dem->crs, fresh.dem->crs);
  const LandCover& a = *kept.land_cover;
  const LandCover& b = *fresh.land_cover;
  EXPECT_TRUE(a.classes.cells == b.classes.cells);
  EXPECT_EQ(a.classes.transform, b.classes.transform);
  EXPECT_TRUE(a.below == b.below);
  EXPECT_EQ(a.inferred_rivers.size(), b.inferred_rivers.size());
  for (double x = 50.0; x < 12000.0; x += 410.0)
    for (double y = 50.0; y < 11200.0; y += 410.0)
      ASSERT_EQ(a.at(x, y), b.at(x, y)) << x << " " << y;
}

void expect_same_terrain(const TerrainModel& kept, const TerrainModel& fresh) {
  EXPECT_TRUE(kept.generalized_m == fresh.generalized_m);
  EXPECT_TRUE(kept.came_from == fresh.came_from);
  EXPECT_TRUE(kept.goes_to == fresh.goes_to);
  EXPECT_TRUE(kept.detail_smooth_m == fresh.detail_smooth_m);
  EXPECT_TRUE(kept.shape_smooth_m == fresh.shape_smooth_m);
  EXPECT_TRUE(kept.relief_s_m == fresh.relief_s_m);
  EXPECT_TRUE(kept.relief_m_m == fresh.relief_m_m);
  EXPECT_TRUE(kept.relief_l_m == fresh.relief_l_m);
  EXPECT_TRUE(kept.valley_height_m == fresh.valley_height_m);
  EXPECT_TRUE(kept.rim_m == fresh.rim_m);
  EXPECT_TRUE(kept.flow == fresh.flow);
  EXPECT_TRUE(kept.floor_plan.built == fresh.floor_plan.built);
  EXPECT_TRUE(kept.floor_plan.grain == fresh.floor_plan.grain);
  EXPECT_EQ(kept.exaggeration, fresh.exaggeration);
  EXPECT_EQ(kept.detail_boost, fresh.detail_boost);
  EXPECT_EQ(kept.windows.size(), fresh.windows.size());
  ASSERT_EQ(kept.local.has_value(), fresh.local.has_value());
  for (double x = 500.0; kept.local && x < 12000.0; x += 1100.0)
    EXPECT_EQ(kept.local->shape_jacobian({x, 0.9 * x, 1000.0}),
              fresh.local->shape_jacobian({x, 0.9 * x, 1000.0}));
}

void expect_same_view(const World& kept, const World& fresh) {
  const View& a = kept.view;
  const View& b = fresh.view;
  EXPECT_EQ(a.camera.eye, b.camera.eye);
  EXPECT_EQ(a.viewer_xy, b.viewer_xy);
  EXPECT_EQ(a.sun_direction, b.sun_direction);
  EXPECT_EQ(a.sun_image_x, b.sun_image_x);
  EXPECT_EQ(a.air.from_m, b.air.from_m);
  EXPECT_EQ(a.air.rim_fade_m, b.air.rim_fade_m);
  ASSERT_EQ(a.derived.size(), b.derived.size());
  for (std::size_t i = 0; i < a.derived.size(); ++i)
    EXPECT_EQ(a.derived[i].value, b.derived[i].value) << a.derived[i].key;
  EXPECT_EQ(kept.horizon_px, fresh.horizon_px);
  ASSERT_EQ(kept.light_field == nullptr, fresh.light_field == nullptr);
  EXPECT_EQ(kept.mist.layers.size(), fresh.mist.layers.size());
  EXPECT_EQ(kept.mist.farthest_m, fresh.mist.farthest_m);
  EXPECT_TRUE(kept.mist.ground.floor_m == fresh.mist.ground.floor_m);
  for (double x = 500.0; x < 12000.0; x += 700.0) {
    const glm::dvec2 at(x, 12000.0 - x);
    if (kept.light_field) {
      EXPECT_EQ(kept.light_field->at(at).sun, fresh.light_field->at(at).sun);
      EXPECT_EQ(kept.light_field->at(at).strength, fresh.light_field->at(at).strength);
    }
  }
}

// What rays through the picture hit.
void expect_same_rays(const World& kept, const World& fresh) {
  EXPECT_TRUE(kept.surface->vertices_m == fresh.surface->vertices_m);
  EXPECT_EQ(kept.surface->origin, fresh.surface->origin);
  std::vector<Ray> rays;
  for (const auto [x, y] : test::cells({2, 2, fresh.camera->size().x, fresh.camera->size().y}, 5)) {
    rays.push_back(fresh.camera->ray({x, y}));
    const Ray other = kept.camera->ray({x, y});
    ASSERT_EQ(other.origin, rays.back().origin);
    ASSERT_EQ(other.direction, rays.back().direction);
  }
  std::vector<Hit> a(rays.size());
  std::vector<Hit> b(rays.size());
  kept.tracer.intersect(rays, a);
  fresh.tracer.intersect(rays, b);
  std::size_t found = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(a[i].found, b[i].found);
    EXPECT_EQ(a[i].distance_m, b[i].distance_m);
    EXPECT_EQ(a[i].column, b[i].column);
    found += a[i].found ? 1 : 0;
  }
  EXPECT_GT(found, rays.size() / 4);
  EXPECT_EQ(kept.tracer.description(), fresh.tracer.description());
  EXPECT_EQ(&kept.terrain, kept.ground.terrain.get());
  EXPECT_EQ(kept.terrain.dem, kept.dem);
  EXPECT_EQ(kept.terrain.land_cover, kept.land_cover);
}

// What somebody may turn: each row has one of its values at a time.
const std::vector<std::vector<std::string>>& changeable() {
  static const std::vector<std::vector<std::string>> rows = {
      {"camera.position=[6000,-4000]", "camera.position=[4000,-3000]"},
      {"camera.height_m=6000", "camera.height_m=4500"},
      {"camera.azimuth_deg=0", "camera.azimuth_deg=20"},
      {"camera.field_of_view_deg=50", "camera.field_of_view_deg=30"},
      {"camera.projection=perspective", "camera.projection=cylindrical"},
      {"sun.azimuth_deg=315", "sun.azimuth_deg=100", "sun.azimuth_deg=200"},
      {"deform.exaggeration=1", "deform.exaggeration=1.6"},
      {"deform.background_exaggeration=1", "deform.background_exaggeration=1.4"},
      {"deform.bend.radius_m=0", "deform.bend.radius_m=60000"},
      {"deform.earth_curvature=false", "deform.earth_curvature=true"},
      {"deform.handles=[]",
       "deform.handles=[{ position = [6000, 5000], radius_m = 3000, raise_m = 400 }]",
       "deform.handles=[{ position = [6000, 5000], radius_m = 3000, move_m = [300, 0] }]"},
      {"deform.field.places=[]",
       "deform.field.places=[{ position = [6000, 5000], moved_m = [300, 200] }]",
       "deform.field.places=[{ position = [6000, 5000], moved_m = [300, 200], noise_m = [9, 9] }]"},
      {"camera.shift=[0, 0]", "camera.shift=[0.1, 0]"},
      {"generalize.foreground=[1, 1, 1, 1, 1, 1]", "generalize.foreground=[1, 1.3, 1, 0.6, 0, 0]"},
      {"generalize.print_detail_px=0", "generalize.print_detail_px=3"},
      {"generalize.widen_valleys_m=0", "generalize.widen_valleys_m=300"},
      {"generalize.mask_classes={}", "generalize.mask_classes={ forest = 0 }"},
      {"land_cover.settings.treeline_m=1500", "land_cover.settings.treeline_m=1000"},
      {"land_cover.smallest_patch_m2=0", "land_cover.smallest_patch_m2=400000"},
      {"season.date=07-15", "season.date=02-01"},
      {"palette=summer", "palette=winter"},
      {"seed=1", "seed=2"},
      {"terrain.synthetic.seed=3", "terrain.synthetic.seed=8"},
      {"sampling.instruction_set=any", "sampling.instruction_set=sse2"},
      {"sampling.shadow_rays=2", "sampling.shadow_rays=3"},
      {"light.regions=[]",
       "light.regions=[{ position = [6000, 5000], radius_m = 2000, turn_deg = 60 }]"},
      {"air.mist=[]", "air.mist=[{ kind = \"sea\", to_m = 1200 }]"},
      {"output.width=48", "output.width=64"}};
  return rows;
}

// Makes a world of a scene with kept values and one without, and compares them.
void expect_same_world(const LoadedScene& scene, ValueStore& kept) {
  const World one = make_world(scene, silent_progress(), no_cache(), {}, &kept);
  const World other = make_world(scene, silent_progress());
  expect_same_ground(one, other);
  expect_same_terrain(one.terrain, other.terrain);
  expect_same_view(one, other);
  expect_same_rays(one, other);
}

// Every row is turned once, one after the other, so that worlds have more and more of them.
TEST(SceneValues, ValuesAreThoseOfAWorldThatIsMadeAtOnceInAnyOrderOfChanges) {
  std::vector<std::size_t> order;
  std::vector<std::string> settings;
  for (const std::vector<std::string>& row : changeable()) {
    const auto place = random_index(static_cast<std::uint32_t>(order.size() + 1), 5,
                                    static_cast<std::int64_t>(order.size()), 0);
    order.insert(order.begin() + place, order.size());
    settings.push_back(row.front());
  }
  ValueStore kept;
  for (const std::size_t row : order) {
    settings[row] = changeable()[row].back();
    SCOPED_TRACE(settings[row]);
    expect_same_world(hills(settings), kept);
    ASSERT_FALSE(testing::Test::HasFailure());
  }
}

// Each alone, there and back.
TEST(SceneValuesLong, NoChangeIsOverlooked) {
  ValueStore kept;
  for (const std::vector<std::string>& row : changeable())
    for (const std::string& setting : row) {
      SCOPED_TRACE(setting);
      expect_same_world(hills({setting}), kept);
      ASSERT_FALSE(testing::Test::HasFailure());
    }
}

// ---- what a change makes again

std::vector<std::string> stages_after(const std::string& change) {
  static ValueStore kept;
  { const World first = make_world(hills(), silent_progress(), no_cache(), {}, &kept); }
  test::Stages stages;
  const World second = make_world(hills({change}), stages, no_cache(), {}, &kept);
  return stages.all;
}

TEST(SceneValues, AtFirstEverythingIsMade) {
  ValueStore kept;
  test::Stages stages;
  const World world = make_world(hills(), stages, no_cache(), {}, &kept);
  EXPECT_THAT(stages.all, ElementsAre("synthetic terrain", "class rules", "generalize",
                                      "building the ray tracer"));
}

TEST(SceneValues, LightCameraAndColoursMakeNothingAgain) {
  for (const char* change :
       {"title=\"Hills\"", "sun.azimuth_deg=100", "camera.height_m=4500", "camera.azimuth_deg=20",
        "camera.pitch_deg=-30", "camera.field_of_view_deg=30", "palette=autumn", "light.sun=1",
        "air.haze=0.5", "sampling.shadow_rays=5", "output.width=64", "water.wind=0.5"})
    EXPECT_THAT(stages_after(change), IsEmpty()) << change;
}

TEST(SceneValues, BentGroundNeedsOnlyItsRayTracer) {
  for (const char* change :
       {"deform.bend.radius_m=60000", "deform.exaggeration=1.5",
        "deform.handles=[{ position = [6000, 5000], radius_m = 3000, raise_m = 400 }]"})
    EXPECT_THAT(stages_after(change), ElementsAre("building the ray tracer")) << change;
  // … also where the processor's instructions are others.
  EXPECT_THAT(stages_after("sampling.instruction_set=sse2"),
              ElementsAre("building the ray tracer"));
}

TEST(SceneValues, WeightsGeneralizeAgainAndClassesStay) {
  for (const char* change : {"generalize.foreground=[1, 1.3, 1, 0.6, 0, 0]",
                             "generalize.foreground_to_m=20000", "camera.position=[5000,-4000]"})
    EXPECT_THAT(stages_after(change), ElementsAre("generalize", "building the ray tracer"))
        << change;
}

TEST(SceneValues, ClassesAreMadeAgainOnTheSameGround) {
  for (const char* change : {"land_cover.settings.treeline_m=1000", "season.date=\"02-01\"",
                             "land_cover.smallest_patch_m2=400000", "palette=winter", "seed=9"})
    EXPECT_THAT(stages_after(change), ElementsAre("class rules")) << change;
}

TEST(SceneValues, GroundThatIsMaskedByClassesFollowsThem) {
  const std::string masked = "generalize.mask_classes={ forest = 0 }";
  ValueStore kept;
  { const World first = make_world(hills({masked}), silent_progress(), no_cache(), {}, &kept); }
  test::Stages stages;
  const World second = make_world(hills({masked, "land_cover.settings.treeline_m=1000"}), stages,
                                  no_cache(), {}, &kept);
  EXPECT_THAT(stages.all, ElementsAre("class rules", "generalize", "building the ray tracer"));
}

TEST(SceneValues, NotesAreToldAgainWithTheValuesThatAreKept) {
  const LoadedScene scene = hills({"land_cover.sea_level_m=1100"});
  ValueStore kept;
  test::Notes first;
  { const World world = make_world(scene, first, no_cache(), {}, &kept); }
  ASSERT_THAT(first.all, testing::Contains(testing::StartsWith("sea: ")));
  test::Notes again;
  const World world = make_world(scene, again, no_cache(), {}, &kept);
  EXPECT_EQ(again.all, first.all);
}

TEST(SceneValues, AnotherTerrainIsAnotherWorld) {
  const auto all = {"synthetic terrain", "class rules", "generalize", "building the ray tracer"};
  EXPECT_THAT(stages_after("terrain.synthetic.seed=8"), ElementsAreArray(all));
}

TEST(SceneValues, HoldsOneValueOfEachKind) {
  ValueStore kept;
  { const World world = make_world(hills(), silent_progress(), no_cache(), {}, &kept); }
  const std::shared_ptr<void> tracer = kept.find("tracer", kept.key("tracer"))->value;
  ASSERT_NE(tracer, nullptr);
  EXPECT_EQ(tracer.use_count(), 2) << "the world is gone";
  { const World world = make_world(hills({"seed=2"}), silent_progress(), no_cache(), {}, &kept); }
  EXPECT_EQ(kept.find("tracer", kept.key("tracer"))->value, tracer) << "a seed touches no ground";
  {
    const World world =
        make_world(hills({"deform.exaggeration=2"}), silent_progress(), no_cache(), {}, &kept);
  }
  EXPECT_NE(kept.find("tracer", kept.key("tracer"))->value, tracer);
  EXPECT_EQ(tracer.use_count(), 1) << "the tracer before is not kept";
}

TEST(SceneValues, AfterAnErrorTheNextWorldIsRight) {
  ValueStore kept;
  const std::string fold =
      "deform.handles=[{ position = [6000, 6000], radius_m = 3000, core_m = 1000, move_m = [2500, "
      "0] }]";
  const std::vector<std::string> above = {"camera.position=[6000,6000]", "camera.height_m=12000",
                                          "camera.pitch_deg=-90", "camera.field_of_view_deg=90"};
  std::vector<std::string> folded = above;
  folded.push_back(fold);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(test::kind_of([&] {
                const World world =
                    make_world(hills(folded), silent_progress(), no_cache(), {}, &kept);
              }),
              ErrorKind::usage);
    expect_same_world(hills(above), kept);
  }
}

// ---- files

// A slope to the east with its foot at `foot_m`.
void write_slope(const std::string& path, float foot_m) {
  Raster<float> raster{
      Grid<float>(40, 40), {600000.0, 5204000.0, 100.0, 100.0}, normalize_crs("EPSG:32632")};
  for (const auto [x, y] : test::cells(40, 40)) {
    const auto east = static_cast<float>(x);
    raster.cells(x, y) = foot_m + 20.F * east + static_cast<float>((x * 7 + y * 3) % 5);
  }
  write_raster(path, raster);
}

LoadedScene slope_scene(const std::string& folder, const std::vector<std::string>& settings = {}) {
  return parse_scene(R"(version = 1
[[terrain.sources]]
file = "slope.tif"
[camera]
position = [602000, 5198000]
height_m = 4000
azimuth_deg = 0
pitch_deg = -30
[output]
width = 48
height = 40
)",
                     "slope.toml", folder, {.data_folders = {}, .settings = settings});
}

// Rivers are as wide as the camera needs them, and lie in the cover that ground is made from. The
// climate of the place is taken from the cache, whose keys are others.
TEST(SceneValues, RiversOfAMapFollowTheCamera) {
  const test::Folder folder;
  write_slope(folder / "slope.tif", 500.F);
  folder.write("river.geojson",
               R"({"type": "FeatureCollection", "features": [{"type": "Feature",
                   "properties": {}, "geometry": {"type": "LineString",
                   "coordinates": [[600200, 5200300], [602000, 5202000], [603500, 5203800]]}}]})");
  const std::string river =
      "features.0={ source = \"river.geojson\", kind = \"river\", crs = \"EPSG:32632\" }";
  ValueStore kept;
  for (const char* change :
       {"seed=1", "camera.height_m=5000", "camera.position=[603000, 5199000]", "output.width=24",
        "output.sheet_width_mm=24", "deform.exaggeration=2", "features.0.width_mm=4",
        "generalize.foreground=[1, 1, 0.5, 0, 0, 0]"}) {
    SCOPED_TRACE(change);
    const LoadedScene scene = slope_scene(folder.path(), {river, change});
    const World one = make_world(scene, silent_progress(), test::shared_cache(), {}, &kept);
    const World other = make_world(scene, silent_progress(), test::shared_cache());
    expect_same_terrain(one.terrain, other.terrain);
    EXPECT_TRUE(one.land_cover->classes.cells == other.land_cover->classes.cells);
    int water = 0;
    for (double x = 600050.0; x < 604000.0; x += 30.0)
      for (double y = 5200050.0; y < 5204000.0; y += 90.0) {
        const LandCoverClass id = one.land_cover->at(x, y);
        ASSERT_EQ(id, other.land_cover->at(x, y)) << x << " " << y;
        water += id == LandCoverClass::water ? 1 : 0;
      }
    EXPECT_GT(water, 0);
  }
}

TEST(SceneValues, AFileThatChangedIsReadAgain) {
  const test::Folder folder;
  write_slope(folder / "slope.tif", 500.F);
  const LoadedScene scene = slope_scene(folder.path());
  ValueStore kept;
  {
    const World world = make_world(scene, silent_progress(), test::shared_cache(), {}, &kept);
    EXPECT_EQ(world.dem->altitude_m(0, 0), 500.F);
  }
  write_slope(folder / "slope.tif", 700.F);
  std::filesystem::last_write_time(
      folder / "slope.tif", std::filesystem::file_time_type::clock::now() + std::chrono::hours(1));
  test::Stages stages;
  const World world = make_world(scene, stages, test::shared_cache(), {}, &kept);
  EXPECT_EQ(world.dem->altitude_m(0, 0), 700.F);
  EXPECT_THAT(stages.all, testing::Contains("generalize"));
  // And one that is gone is an error, not the values of before.
  std::filesystem::remove(folder / "slope.tif");
  EXPECT_EQ(test::error_of([&] {
              const World gone =
                  make_world(scene, silent_progress(), test::shared_cache(), {}, &kept);
            }).kind(),
            ErrorKind::input);
}

// The beds of water refer to the ground they lie in, also after a run that was cancelled while it
// made another ground.
TEST(SceneValues, WaterIsThatOfItsOwnGround) {
  class Cancelled : public Progress {
   public:
    void begin(std::string_view stage, double) override {
      if (stage == "generalize") throw Error(ErrorKind::interrupted, "picture", "cancelled");
    }
  };
  const LoadedScene scene = hills({"land_cover.sea_level_m=1100"});
  ValueStore kept;
  const auto expect_own_waters = [&] {
    const World world = make_world(scene, silent_progress(), no_cache(), {}, &kept);
    ASSERT_NE(world.waters->get(), nullptr);
    EXPECT_EQ(world.waters->get()->terrain, &world.terrain);
  };
  expect_own_waters();
  const auto other =
      kept.find("terrain", kept.key("terrain"))->value;  // its place in memory stays taken
  Cancelled cancelled;
  EXPECT_THROW(make_world(hills({"land_cover.sea_level_m=1100", "generalize.crest=1"}), cancelled,
                          no_cache(), {}, &kept),
               Error);
  expect_own_waters();
}

// ---- keys

// Sources of virtual rasters, and the files beside a shapefile.
TEST(SceneValues, FilesBesideThoseThatASceneNamesCount) {
  const test::Folder folder;
  write_slope(folder / "part.tif", 500.F);
  folder.write("slope.tif.vrt", R"(<VRTDataset rasterXSize="40" rasterYSize="40">
  <GeoTransform>600000, 100, 0, 5204000, 0, -100</GeoTransform>
  <VRTRasterBand dataType="Float32" band="1"><SimpleSource>
    <SourceFilename relativeToVRT="1">part.tif</SourceFilename><SourceBand>1</SourceBand>
  </SimpleSource></VRTRasterBand></VRTDataset>)");
  folder.write("rivers.shp", "");
  folder.write("rivers.dbf", "");
  const LoadedScene scene =
      slope_scene(folder.path(), {"terrain.sources.0.file=\"slope.tif.vrt\"",
                                  "features.0={ source = \"rivers.shp\", kind = \"river\" }"});
  ValueStore kept;
  const SceneValues values(scene, &kept, silent_progress());
  int made = 0;
  const auto make = [&] {
    return *values.make<int>(
        "files",
        [](Scene& to, const Scene& from) {
          to.terrain = from.terrain;
          to.features = from.features;
        },
        {}, [&](const Making&) { return ++made; });
  };
  ASSERT_EQ(make(), 1);
  EXPECT_EQ(make(), 1);
  int count = 1;
  for (const char* part : {"part.tif", "rivers.dbf"}) {
    std::filesystem::last_write_time(
        folder / part, std::filesystem::file_time_type::clock::now() + std::chrono::hours(1));
    EXPECT_EQ(make(), ++count) << part;
    EXPECT_EQ(make(), count) << part;
  }
}

// ---- declared parts

TEST(SceneValues, AMakerSeesOnlyThePartsThatItDeclared) {
  const LoadedScene scene =
      hills({"seed=9", "deform.exaggeration=2", "title=\"Hills\"", "palette=\"none.toml\""});
  const SceneValues values(scene, nullptr, silent_progress());
  values.make<int>(
      "seed", [](Scene& to, const Scene& from) { to.seed = from.seed; }, {},
      [&](const Making& m) {
        EXPECT_EQ(m.scene.scene.seed, 9U);
        EXPECT_EQ(m.scene.scene.palette, Scene().palette);
        EXPECT_EQ(m.scene.scene.output.width, Scene().output.width);
        EXPECT_FALSE(m.scene.scene.terrain.synthetic.has_value());
        EXPECT_EQ(m.scene.name, scene.name);
        return 0;
      });
}

TEST(SceneValues, AreMadeAgainWhereAPartOrAnInputDiffers) {
  ValueStore kept;
  int made = 0;
  const auto make = [&](const LoadedScene& scene, const std::string& input) {
    SceneValues(scene, &kept, silent_progress())
        .make<int>(
            "sun", [](Scene& to, const Scene& from) { to.sun = from.sun; }, {{"", input}},
            [&](const Making&) { return ++made; });
    return made;
  };
  EXPECT_EQ(make(hills(), "a"), 1);
  EXPECT_EQ(make(hills({"camera.height_m=4000", "seed=5", "title=\"Hills\""}), "a"), 1);
  EXPECT_EQ(make(hills({"sun.azimuth_deg=10"}), "a"), 2);
  EXPECT_EQ(make(hills({"sun.azimuth_deg=10"}), "b"), 3);
}

// What is made from a value goes with it: it may point at it.
TEST(SceneValues, AValueThatIsMadeAgainTakesItsReadersWithIt) {
  ValueStore kept;
  const auto make = [&](const std::string& of_ground, bool all) {
    const LoadedScene scene = hills();
    const SceneValues values(scene, &kept, silent_progress());
    const auto one = [](const Making&) { return 1; };
    const auto ground = values.make<int>("ground", reads_nothing, {{"", of_ground}}, one);
    if (!all) return;
    const auto surface = values.make<int>("surface", reads_nothing, {ground}, one);
    values.make<int>("tracer", reads_nothing, {surface}, one);
    values.make<int>("sky", reads_nothing, {}, one);
  };
  make("a", true);
  EXPECT_FALSE(kept.key("tracer").empty());
  make("b", false);
  EXPECT_EQ(kept.key("surface"), "");
  EXPECT_EQ(kept.key("tracer"), "");
  EXPECT_FALSE(kept.key("sky").empty());
}

}  // namespace
}  // namespace belvedere
