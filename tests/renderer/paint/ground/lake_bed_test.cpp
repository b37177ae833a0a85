#include "renderer/paint/ground/lake_bed.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <memory>

#include "base/colour/water_colour.h"

namespace belvedere {
namespace {

constexpr double lake_west = 500000.0;
constexpr double lake_top = 5200000.0;

// A level lake at 900 m on cells of 10 m whose bed falls one metre per cell to the east, its layers
// of one colour.
TerrainModel lake(int size, GroundColour colour = GroundColour(170, 150, 110, 255)) {
  TerrainModel model;
  const GeoTransform transform{lake_west, lake_top, 10.0, 10.0};
  model.dem =
      std::make_shared<const Dem>(make_dem({Grid<float>(size, size, 900.F), transform, ""}));
  model.generalized_m = model.dem->altitude_m;
  LandCover cover{{Grid<LandCoverClass>(size, size, LandCoverClass::water), transform, ""},
                  {Grid<GroundColour>(size, size, colour), transform, ""},
                  {transform, {}, Grid<float>(size, size)}};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) cover.relief.lake_depth_m(x, y) = static_cast<float>(x);
  model.land_cover = std::make_shared<const LandCover>(std::move(cover));
  return model;
}

glm::dvec3 position_of(int x) { return {lake_west + 10.0 * (x + 0.5), lake_top - 205.0, 900.0}; }

TEST(LakeBed, IsSeenThroughShallowWaterAndNotThroughDeep) {
  const TerrainModel model = lake(60);
  const Palette palette = read_palette("summer");
  const auto tint = make_ground_tint(model, palette, 1.0);
  const glm::vec3 water(0.2F, 0.4F, 0.55F);
  const auto seen = [&](int x) {
    const LakeBed bed = lake_bed(*tint, palette, 900.0, position_of(x), 5.0);
    EXPECT_FLOAT_EQ(bed.depth_m, static_cast<float>(x));
    return bed.under(water, palette, 900.0, 0.6);
  };
  EXPECT_EQ(seen(0), water) << "no lake";
  // By the formula of water: the bed in the layers' colour, painted as debris, under this depth of
  // water.
  const glm::vec3 ground =
      tint_shift(*tint, palette, LandCoverClass::scree, 900.0, position_of(1), 5.0)
          .over(palette_colour(palette, LandCoverClass::scree, 900.0, 0.6));
  const glm::vec3 shallow = shallow_water(water);
  EXPECT_GT(shallow.g - water.g, 0.1F) << "paler and greener";
  EXPECT_GT(shallow.g - water.g, shallow.b - water.b + 0.05F);
  for (const int x : {1, 3, 8})
    EXPECT_LT(glm::distance(seen(x), water_colour(ground, static_cast<float>(x), {shallow, water})),
              1e-6F)
        << x;
  EXPECT_GT(seen(1).r, seen(4).r);
  EXPECT_GT(seen(4).g, seen(20).g);
  EXPECT_LT(glm::distance(seen(59), water), 0.003F) << "deep water is the palette's";
}

TEST(LakeBed, GoesOnlyAsFarAsTheColoursOfLayers) {
  const TerrainModel model = lake(30);
  const Palette palette = read_palette("summer");
  const glm::vec3 water(0.2F, 0.4F, 0.55F);
  const auto under = [&](double share) {
    return lake_bed(*make_ground_tint(model, palette, share), palette, 900.0, position_of(2), 5.0)
        .under(water, palette, 900.0, 0.6);
  };
  EXPECT_GT(glm::distance(under(1.0), water), glm::distance(under(0.5), water));
  EXPECT_EQ(lake_bed(*make_ground_tint(model, palette, 1.0), read_palette("winter"), 900.0,
                     position_of(2), 5.0)
                .depth_m,
            0.F);
  // Unknown ground has no visible bed.
  const TerrainModel unknown = lake(30, GroundColour(0));
  EXPECT_EQ(lake_bed(*make_ground_tint(unknown, palette, 1.0), palette, 900.0, position_of(2), 5.0)
                .under(water, palette, 900.0, 0.6),
            water);
}

// Inside a window its own depths apply.
TEST(LakeBed, WindowsHaveDepthsOfTheirOwn) {
  TerrainModel model = lake(64);
  TerrainModel window = lake(64);
  LandCover deeper = *window.land_cover;
  for (float& depth : deeper.relief.lake_depth_m) depth = 40.F;
  window.land_cover = std::make_shared<const LandCover>(std::move(deeper));
  model.windows.push_back({std::move(window), {10, 0, 64, 64}, {5, 0, 32, 32}});
  const auto tint = make_ground_tint(model, read_palette("summer"), 1.0);
  EXPECT_FLOAT_EQ(lake_depth_at(*tint, glm::dvec2(position_of(30))), 40.F);
  EXPECT_FLOAT_EQ(lake_depth_at(*tint, glm::dvec2(position_of(5))), 5.F);
}

}  // namespace
}  // namespace belvedere
