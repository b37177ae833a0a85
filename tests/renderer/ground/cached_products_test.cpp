#include "renderer/ground/cached_products.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

#include "base/cache/cache.h"
#include "renderer/image/provenance.h"
#include "renderer/world/generalize_view.h"
#include "renderer/world/world.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using test::small_scene;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

struct Told : Progress {
  void begin(std::string_view stage, double) override { stages.emplace_back(stage); }
  void note(std::string_view text) override { notes.emplace_back(text); }
  std::vector<std::string> stages;
  std::vector<std::string> notes;
};

class CachedProducts : public ::testing::Test {
 protected:
  // Stages that had to run for a world; cached ones are not listed.
  std::vector<std::string> stages(const std::vector<std::string>& settings) const {
    Told told;
    const World world = make_world(small_scene(settings), told, cache_);
    return told.stages;
  }
  test::Folder folder_{"cache"};
  Cache cache_{{.folder = folder_.path(), .limit_bytes = 0}};
};

TEST_F(CachedProducts, StandInTheTableInTheirOrder) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < cached_products().size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(cached_products()[i].id), i);
    names.insert(cached_products()[i].name);
  }
  EXPECT_EQ(names.size(), cached_products().size());
}

TEST_F(CachedProducts, KeysNameTheProgramAndAllThatIsGiven) {
  const CacheKey key =
      make_cache_key(CachedProduct::land_cover, CacheKeyText().add("seed", 3), "karwendel");
  EXPECT_THAT(key.text, AllOf(HasSubstr(program_version()), HasSubstr(hash_file("/proc/self/exe")),
                              HasSubstr("format=2\nseed=3\n")));
  EXPECT_NE(key.product,
            make_cache_key(CachedProduct::example_sheet, CacheKeyText().add("seed", 3), "karwendel")
                .product);
}

TEST_F(CachedProducts, AreMadeOnceAndBringTheirRemarksAlong) {
  int made = 0;
  const auto get = [&](Progress& progress) {
    return cached<std::string>(
        cache_, [] { return make_cache_key(CachedProduct::land_cover, CacheKeyText(), "test"); },
        progress,
        [&](Progress& watcher) {
          ++made;
          watcher.begin("working", 1.0);
          watcher.note("something was filled");
          return std::string("value");
        });
  };
  Told first;
  Told second;
  EXPECT_EQ(get(first), "value");
  EXPECT_EQ(get(second), "value");
  EXPECT_EQ(made, 1);
  EXPECT_THAT(first.stages, ElementsAre("working"));
  EXPECT_THAT(second.stages, IsEmpty());
  EXPECT_THAT(first.notes, ElementsAre("something was filled"));
  EXPECT_EQ(second.notes, first.notes);
  // Bytes that another format left under this key are ignored.
  cache_.store(make_cache_key(CachedProduct::land_cover, CacheKeyText(), "test"), Bytes(7), first);
  EXPECT_EQ(get(second), "value");
  EXPECT_EQ(made, 2);
}

TEST_F(CachedProducts, AWorldIsTheSameFromAColdOrAWarmCacheOrNone) {
  const std::vector<std::string> settings = {"generalize.foreground=[1.4,0.8,0.6,1.2]",
                                             "generalize.background=[1,0.2,0.1,1]",
                                             "generalize.widen_valleys_m=700"};
  const World none = make_world(small_scene(settings), silent_progress());
  const World cold = make_world(small_scene(settings), silent_progress(), cache_);
  EXPECT_EQ(folder_.count(), 4U);
  Told told;
  const World warm = make_world(small_scene(settings), told, cache_);
  EXPECT_THAT(told.stages, ElementsAre("building the ray tracer"));
  ASSERT_FALSE(none.terrain.came_from.empty());
  for (const World* other : {&cold, &warm}) {
    EXPECT_EQ(other->dem->altitude_m, none.dem->altitude_m);
    EXPECT_EQ(other->dem->filled, none.dem->filled);
    EXPECT_EQ(other->dem->transform, none.dem->transform);
    EXPECT_EQ(other->land_cover->classes.cells, none.land_cover->classes.cells);
    EXPECT_EQ(other->land_cover->classes.transform, none.land_cover->classes.transform);
    EXPECT_EQ(other->terrain.generalized_m, none.terrain.generalized_m);
    EXPECT_EQ(other->terrain.came_from, none.terrain.came_from);
    EXPECT_EQ(other->terrain.goes_to, none.terrain.goes_to);
    EXPECT_EQ(other->terrain.valley_height_m, none.terrain.valley_height_m);
    EXPECT_EQ(other->terrain.rim_m, none.terrain.rim_m);
    EXPECT_EQ(other->terrain.flow, none.terrain.flow);
    EXPECT_EQ(other->terrain.floor_plan.built, none.terrain.floor_plan.built);
    EXPECT_EQ(other->terrain.floor_plan.grain, none.terrain.floor_plan.grain);
  }
}

// They report no stage of their own: entries are counted, and results for other land and another
// cover are compared with uncached ones.
TEST_F(CachedProducts, SurroundingsHangOnElevationAndLandCoverAlone) {
  const auto kept = [&] {
    const std::vector<CacheEntry> entries = cache_entries(folder_.path());
    return std::count_if(entries.begin(), entries.end(), [](const CacheEntry& entry) {
      return entry.product == "surroundings of the ground";
    });
  };
  const World first = make_world(small_scene(), silent_progress(), cache_);
  for (const char* same : {"sun.altitude_deg=12", "camera.position=[6000, -4001]",
                           "generalize.crest=0.5", "deform.exaggeration=1.3"}) {
    stages({same});
    EXPECT_EQ(kept(), 1) << same;
  }
  const char* town = "land_cover.towns.0={ name = \"A\", position = [3000, 3000], radius_m = 400 }";
  int entries = 1;
  for (const char* other : {town, "terrain.synthetic.seed=4"}) {
    const World cold = make_world(small_scene({other}), silent_progress(), cache_);
    EXPECT_EQ(kept(), ++entries) << other;
    const World warm = make_world(small_scene({other}), silent_progress(), cache_);
    EXPECT_EQ(kept(), entries) << other;
    const World none = make_world(small_scene({other}), silent_progress());
    for (const World* world : {&cold, &warm}) {
      EXPECT_EQ(world->terrain.flow, none.terrain.flow) << other;
      EXPECT_EQ(world->terrain.floor_plan.built, none.terrain.floor_plan.built) << other;
    }
    EXPECT_FALSE(warm.terrain.floor_plan.built == first.terrain.floor_plan.built &&
                 warm.terrain.flow == first.terrain.flow)
        << other;
  }
}

TEST_F(CachedProducts, DamagedOnesAreMadeAgain) {
  const World none = make_world(small_scene(), silent_progress());
  EXPECT_EQ(stages({}).size(), 4U);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_.path())) {
    std::string bytes = test::read_bytes(entry.path());
    bytes[bytes.size() - 40] ^= 1;
    test::write_bytes(entry.path(), bytes);
  }
  Told told;
  const World again = make_world(small_scene(), told, cache_);
  EXPECT_EQ(told.stages.size(), 4U);
  EXPECT_THAT(told.notes, Contains(HasSubstr("damaged")).Times(4));
  EXPECT_EQ(again.terrain.generalized_m, none.terrain.generalized_m);
  EXPECT_THAT(stages({}), ElementsAre("building the ray tracer"));
}

// What each product depends on, and what it does not.
TEST_F(CachedProducts, AreFoundExactlyWhereAllThatGoesInIsTheSame) {
  stages({});
  const std::string tracer = "building the ray tracer";
  for (const char* same :
       {"sun.altitude_deg=12", "output.width=48", "palette=autumn", "camera.pitch_deg=-30",
        "title=Hills", "deform.exaggeration=1.3", "light.sun=0.5", "synthesis.residual=0.5"})
    EXPECT_THAT(stages({same}), ElementsAre(tracer)) << same;
  for (const char* other : {"terrain.synthetic.seed=4", "terrain.synthetic.cell_m=99"})
    EXPECT_THAT(stages({other}),
                ElementsAre("synthetic terrain", "class rules", "generalize", tracer))
        << other;
  // So small a map has summits lower than either: another terrain with the same heights, and so the
  // same ground.
  EXPECT_THAT(stages({"terrain.synthetic.highest_m=3300"}),
              ElementsAre("synthetic terrain", tracer));
  for (const char* other :
       {"seed=2", "palette=winter", "land_cover.settings.treeline_m=1500",
        "land_cover.towns.0={ name = \"A\", position = [3000, 3000], radius_m = 400 }"})
    EXPECT_THAT(stages({other}), ElementsAre("class rules", tracer)) << other;
  for (const char* other :
       {"generalize.crest=0.5", "camera.position=[6000, -4001]", "generalize.keep_lakes=false",
        "generalize.print_detail_px=2", "generalize.foreground_to_m=31000"})
    EXPECT_THAT(stages({other}), ElementsAre("generalize", tracer)) << other;
  // What the print can show depends on camera and size.
  for (const char* other : {"output.width=48", "camera.pitch_deg=-30", "deform.exaggeration=1.3",
                            "camera.field_of_view_deg=40"})
    EXPECT_THAT(stages({"generalize.print_detail_px=2", other}), ElementsAre("generalize", tracer))
        << other;
}

// The same name, size and time, other contents.
TEST_F(CachedProducts, FilesCountByWhatIsInThem) {
  const test::Folder scene_folder("scene");
  Raster<float> raster{
      Grid<float>(64, 64, 900.F), {500000.0, 5200000.0, 100.0, 100.0}, normalize_crs("EPSG:32632")};
  for (const auto [x, y] : test::cells(64, 64))
    raster.cells(x, y) += static_cast<float>(20 * ((x * 7 + y * 5) % 40));
  const LoadedScene scene = parse_scene(
      "version = 1\n[[terrain.sources]]\nfile = \"dem.asc\"\n[camera]\nposition = [503000, "
      "5190000]\nheight_m = 9000\n[output]\nwidth "
      "= 64\nheight = 64\n",
      "s.toml", scene_folder.path(), {});
  const std::string file = scene_folder / "dem.asc";
  write_raster(file, raster);
  const auto size = fs::file_size(file);
  const auto time = fs::last_write_time(file);
  const auto made = [&](const Cache& cache) {
    Told told;
    const World world = make_world(scene, told, cache);
    return std::pair(told.stages, world.terrain.generalized_m);
  };
  const auto first = made(cache_);
  EXPECT_THAT(made(cache_).first, Not(Contains("class rules")));
  raster.cells(30, 30) = 901.F;  // of as many digits
  write_raster(file, raster);
  fs::last_write_time(file, time);
  ASSERT_EQ(fs::file_size(file), size);
  const auto changed = made(cache_);
  EXPECT_THAT(changed.first, AllOf(Contains("class rules"), Contains("generalize")));
  EXPECT_EQ(changed.second, made(no_cache()).second);
  EXPECT_NE(changed.second, first.second);
}

}  // namespace
}  // namespace belvedere
