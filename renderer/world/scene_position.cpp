#include "renderer/world/scene_position.h"

#include "base/error.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

glm::dvec2 position_of_lonlat(const Dem& dem, glm::dvec2 lonlat, const std::string& key) {
  if (dem.crs.empty())
    throw Error(ErrorKind::usage, key, "longitude and latitude on a terrain without CRS",
                "easting and northing");
  return transform_point(normalize_crs("EPSG:4326"), dem.crs, lonlat);
}

glm::dvec2 resolve_place(const Dem& dem, const std::optional<glm::dvec2>& position,
                         const std::optional<glm::dvec2>& position_lonlat, const std::string& key) {
  if (position) return *position;
  if (!position_lonlat)
    throw Error(ErrorKind::usage, key, "no position", "position or position_lonlat");
  return position_of_lonlat(dem, *position_lonlat, key + ".position_lonlat");
}

}  // namespace belvedere
