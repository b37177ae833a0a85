#include "renderer/world/scene_position.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <optional>

#include "terrain/io/raster_io.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

Dem ground(const std::string& crs) {
  return make_dem({Grid<float>(10, 10, 0.F),
                   {500000.0, 5200000.0, 100.0, 100.0},
                   crs.empty() ? std::string() : normalize_crs(crs)});
}

TEST(ScenePlace, DegreesAreLongitudeFirst) {
  // UTM zone 32: its central meridian is 9° east.
  const glm::dvec2 position =
      position_of_lonlat(ground("EPSG:32632"), {9.0, 47.0}, "camera.position_lonlat");
  EXPECT_NEAR(position.x, 500000.0, 1e-3);
  EXPECT_NEAR(position.y, 5205000.0, 1000.0);
}

TEST(ScenePlace, MetresAreTakenAsTheyAreAndDegreesConverted) {
  const Dem dem = ground("EPSG:32632");
  EXPECT_EQ(resolve_place(dem, glm::dvec2(1.0, 2.0), std::nullopt, "deform.handles.0"),
            glm::dvec2(1.0, 2.0));
  EXPECT_EQ(resolve_place(ground(""), glm::dvec2(1.0, 2.0), std::nullopt, "deform.handles.0"),
            glm::dvec2(1.0, 2.0));
  EXPECT_EQ(resolve_place(dem, std::nullopt, glm::dvec2(9.0, 47.0), "deform.handles.0"),
            position_of_lonlat(dem, {9.0, 47.0}, ""));
}

TEST(ScenePlace, RefusesNeitherAndDegreesWithoutACoordinateSystem) {
  EXPECT_THAT(
      test::message_of(
          ErrorKind::usage,
          [] { resolve_place(ground(""), std::nullopt, std::nullopt, "deform.handles.0"); }),
      HasSubstr("deform.handles.0: no position"));
  EXPECT_THAT(test::message_of(ErrorKind::usage,
                               [] {
                                 resolve_place(ground(""), std::nullopt, glm::dvec2(9.0, 47.0),
                                               "deform.handles.0");
                               }),
              HasSubstr("deform.handles.0.position_lonlat"));
}

}  // namespace
}  // namespace belvedere
