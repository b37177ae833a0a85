#include "renderer/exemplar/exemplars.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "base/cache/cache.h"
#include "tests/files.h"
#include "tests/scenes.h"
#include "tests/shared_cache.h"

namespace belvedere {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::SizeIs;

const std::string files = "classes = \"c.png\"";

ScannedPainting scan(const std::string& name) {
  ScannedPainting scan;
  scan.painted.exemplar.name = name;
  scan.painted.picture = Grid<glm::vec3>(4, 3, glm::vec3(0.5F));
  return scan;
}

std::vector<PaintedExemplar> made(const std::vector<std::string>& settings,
                                  std::vector<ScannedPainting> scans) {
  return make_exemplars(test::small_scene(settings), View{}, read_palette("summer"),
                        std::move(scans), silent_progress());
}

std::vector<std::string> names(const std::vector<PaintedExemplar>& exemplars) {
  std::vector<std::string> all;
  for (const PaintedExemplar& painted : exemplars) all.push_back(painted.exemplar.name);
  return all;
}

TEST(Exemplars, PaintingsComeInTheOrderOfTheirBlocks) {
  const std::vector<std::string> two = {"exemplar.0={ picture = \"a.png\", " + files + " }",
                                        "exemplar.1={ picture = \"b.png\", " + files + " }"};
  EXPECT_THAT(names(made(two, {scan("a"), scan("b")})), ElementsAre("a", "b"));
  EXPECT_THAT(names(made(two, {{}, scan("b")})), ElementsAre("b"))
      << "an optional one that is missing";
}

TEST(Exemplars, ABlockWithoutAPictureIsASheetOfItsSize) {
  const std::vector<PaintedExemplar> both =
      made({"exemplar.0={ width = 256, height = 256 }",
            "exemplar.1={ picture = \"b.png\", " + files + " }"},
           {{}, scan("b")});
  ASSERT_THAT(both, SizeIs(2));
  EXPECT_EQ(both[0].picture.width(), 256);
  EXPECT_EQ(both[0].picture.height(), 256);
  EXPECT_TRUE(both[0].base.same_size(both[0].picture))
      << "what the program painted has its base picture";
  EXPECT_EQ(both[1].exemplar.name, "b");
}

std::vector<std::string> products_in(const test::Folder& folder) {
  std::vector<std::string> products;
  for (const CacheEntry& entry : cache_entries(folder.path())) products.push_back(entry.product);
  return products;
}

std::ptrdiff_t terrains_in(const test::Folder& folder) {
  const std::vector<std::string> products = products_in(folder);
  return std::count(products.begin(), products.end(), "synthetic terrain");
}

// The sheet itself, or only the terrains of its panels, come from the cache; the picture is the
// same in each case.
TEST(Exemplars, SheetsAreTheSameFromAColdOrAWarmCacheOrNone) {
  const test::Folder folder("cache");
  const Cache cache({.folder = folder.path(), .limit_bytes = 0});
  const auto sheet = [](const Cache& from, const std::vector<std::string>& settings,
                        const View& view) {
    std::vector<std::string> all = {"exemplar.0={ width = 256, height = 256 }"};
    all.insert(all.end(), settings.begin(), settings.end());
    const LoadedScene scene = test::small_scene(all);
    return std::move(
        make_exemplars(scene, view, read_palette(scene.scene.palette), {}, silent_progress(), from)
            .front());
  };
  const auto expect_same = [](const PaintedExemplar& a, const PaintedExemplar& b) {
    EXPECT_EQ(a.exemplar.name, b.exemplar.name);
    EXPECT_EQ(a.exemplar.picture, b.exemplar.picture);
    EXPECT_EQ(a.picture, b.picture);
    EXPECT_EQ(a.base, b.base);
    EXPECT_EQ(a.exemplar.guides.label, b.exemplar.guides.label);
    ASSERT_EQ(a.exemplar.guides.guides.size(), b.exemplar.guides.guides.size());
    for (std::size_t g = 0; g < a.exemplar.guides.guides.size(); ++g) {
      EXPECT_EQ(a.exemplar.guides.guides[g].name, b.exemplar.guides.guides[g].name);
      EXPECT_EQ(a.exemplar.guides.guides[g].values, b.exemplar.guides.guides[g].values);
    }
  };
  const PaintedExemplar none = sheet(no_cache(), {}, {});
  expect_same(sheet(cache, {}, {}), none);
  const auto first = products_in(folder);
  EXPECT_THAT(first, Contains("example sheet").Times(1));
  EXPECT_THAT(first, Contains("synthetic terrain"));
  expect_same(sheet(cache, {}, {}), none);
  EXPECT_EQ(products_in(folder).size(), first.size());

  // Neither the sun's height nor the residual changes the painting; the residual changes the
  // picture by which seams are evaluated.
  View low_sun;
  low_sun.sun.altitude_deg = 3.0;
  low_sun.sun.azimuth_deg += 6.0;  // in steps of 15°: scenes of a season share a sheet
  expect_same(sheet(cache, {}, low_sun), none);
  expect_same(sheet(cache, {"synthesis.residual=0.5"}, {}),
              sheet(no_cache(), {"synthesis.residual=0.5"}, {}));
  EXPECT_EQ(products_in(folder).size(), first.size());
  // A change of the sheet's content makes another sheet on the same terrains, or on new ones.
  std::size_t sheets = 1;
  View other_side;
  other_side.sun.azimuth_deg = 90.0;
  const std::vector<std::pair<std::string, View>> others = {{"palette=autumn", {}},
                                                            {"light.sun=0.5", {}},
                                                            {"seed=5", other_side},
                                                            {"output.sheet_width_mm=60", {}}};
  for (const auto& [setting, view] : others) {
    EXPECT_NE(sheet(cache, {setting}, view).picture, none.picture) << setting;
    EXPECT_THAT(products_in(folder), Contains("example sheet").Times(++sheets)) << setting;
    // Larger strokes need larger ground.
    if (setting != "output.sheet_width_mm=60") {
      EXPECT_EQ(std::count(first.begin(), first.end(), "synthetic terrain"), terrains_in(folder))
          << setting;
    }
  }
  expect_same(sheet(cache, {"palette=autumn"}, {}), sheet(no_cache(), {"palette=autumn"}, {}));
}

// The classes known without painting: each is on a sheet of the minimum size for which they are
// stated.
TEST(Exemplars, SheetsHaveTheClassesThatAreToldWithoutPainting) {
  for (const char* palette : {"summer", "winter"}) {
    const LoadedScene scene = test::small_scene(
        {"exemplar.0={ width = 500, height = 350 }", std::string("palette=") + palette});
    const ExemplarClasses known = look_at_classes(scene, {});
    EXPECT_THAT(known.names, ElementsAre("painted sheet"));
    std::array<bool, land_cover_class_count> found{};
    const std::vector<PaintedExemplar> painted = make_exemplars(
        scene, {}, read_palette(palette), {}, silent_progress(), test::shared_cache());
    for (const std::uint8_t label : painted.front().exemplar.guides.label)
      if (label < found.size()) found[label] = true;
    EXPECT_EQ(found, known.offered) << palette;
    EXPECT_EQ(painted.front().exemplar.name, known.names.front());
  }
}

TEST(Exemplars, PaintingsAreLookedAtThemselves) {
  ScannedPainting painting = scan("a");
  painting.painted.exemplar.guides.label =
      Grid<std::uint8_t>(4, 3, static_cast<std::uint8_t>(LandCoverClass::sand));
  const ExemplarClasses found =
      look_at_classes(test::small_scene({"exemplar.0={ picture = \"a.png\", " + files + " }",
                                         "exemplar.1={ width = 500 }"}),
                      {painting, {}});
  EXPECT_THAT(found.names, ElementsAre("a", "painted sheet"));
  EXPECT_TRUE(found.offered[static_cast<std::size_t>(LandCoverClass::sand)]);
  EXPECT_TRUE(found.offered[static_cast<std::size_t>(LandCoverClass::forest)]);
  EXPECT_FALSE(found.offered[static_cast<std::size_t>(LandCoverClass::sky)]);
}

}  // namespace
}  // namespace belvedere
