#include "renderer/ground/refined_cover.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "renderer/world/scene_land_cover.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

// A valley of 100 km² down column 50 whose eastern half is forest in the raster, and grass in the
// west.
TEST(RefinedRivers, RunWhereTheirClassMayBecomeWater) {
  const test::Folder folder;
  folder.write("rules.toml",
               "version = 1\nname = \"wet\"\nrivers = \"1\"\n[parameters]\nspeck_cells = "
               "0\n[[layers]]\nclass = \"pasture\"\nwhen = \"1\"\n");
  const GeoTransform transform{500000.0, 5200000.0, 100.0, 100.0};
  Dem valley = make_dem({Grid<float>(101, 101), transform, normalize_crs("EPSG:32632")});
  Raster<float> codes{Grid<float>(101, 101), transform, valley.crs};
  for (int y = 0; y < 101; ++y)
    for (int x = 0; x < 101; ++x) {
      valley.altitude_m(x, y) =
          900.F - 2.F * static_cast<float>(y) + 20.F * std::abs(static_cast<float>(x - 50));
      codes.cells(x, y) = y < 60 ? 30.F : 10.F;
    }
  write_raster(folder / "cover.tif", codes);
  const auto water_at = [&](const std::string& refine, int row) {
    const LoadedScene scene = parse_scene(
        "version = 1\n[land_cover]\nlegend = \"esa_worldcover\"\nrules = \"rules.toml\"\n" +
            refine + "[[land_cover.sources]]\nfile = \"cover.tif\"\n",
        "s.toml", folder.path(), {});
    const LandCover cover = make_scene_land_cover(scene, valley, silent_progress());
    const glm::dvec2 position = transform.to_crs(50, row);
    return cover.at(position.x, position.y) == water;
  };
  EXPECT_TRUE(water_at("refine = { water = \"pasture\" }\n", 55));
  EXPECT_FALSE(water_at("refine = { water = \"pasture\" }\n", 90)) << "forest there";
  EXPECT_TRUE(water_at("refine = { water = \"forest\" }\n", 90));
  EXPECT_FALSE(water_at("refine = { snow = \"pasture\" }\n", 55));
  EXPECT_FALSE(water_at("", 55)) << "the raster alone decides";
}

}  // namespace
}  // namespace belvedere
