#include "terrain/climate/map_position.h"

#include <cmath>
#include <vector>

#include "base/error.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "terrain/io/crs.h"

namespace belvedere {
namespace {

double rounded(double degrees) { return std::round(degrees * 1e7) * 1e-7; }

// From the values at the four corners: top left, top right, bottom left, bottom right.
MapPlane plane_of(const std::array<double, 4>& corner, int width, int height) {
  MapPlane plane;
  if (width > 1)
    plane.per_column = 0.5 * (corner[1] - corner[0] + corner[3] - corner[2]) / (width - 1);
  if (height > 1)
    plane.per_row = 0.5 * (corner[2] - corner[0] + corner[3] - corner[1]) / (height - 1);
  const double centre = 0.25 * (corner[0] + corner[1] + corner[2] + corner[3]);
  plane.at_first =
      centre - 0.5 * (width - 1) * plane.per_column - 0.5 * (height - 1) * plane.per_row;
  return plane;
}

}  // namespace

MapPosition make_map_position(const GeoTransform& transform, const std::string& crs, int width,
                              int height, std::optional<double> latitude_deg) {
  MapPosition position;
  position.width = width;
  position.height = height;
  if (crs.empty()) {
    if (!latitude_deg)
      throw Error(ErrorKind::usage, "latitude", "latitude unknown, because the terrain has no CRS",
                  "the latitude of the terrain, -90 … 90");
    position.cell_m = {transform.cell_x, transform.cell_y};
    position.latitude_deg.at_first = *latitude_deg;
    return position;
  }
  position.cell_m = ground_cell_m(transform, crs, width, height);
  std::vector<glm::dvec2> points;
  for (const int row : {0, height - 1})
    for (const int column : {0, width - 1}) {
      points.push_back(transform.to_crs(column, row));
      points.push_back(transform.to_crs(column, row - 1.0));  // one cell up
    }
  PointTransform(crs, normalize_crs("EPSG:4326")).apply(points);
  std::array<double, 4> longitude{};
  std::array<double, 4> latitude{};
  std::array<double, 4> north{};
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const glm::dvec2 here = points[2 * corner];
    const glm::dvec2 above = points[2 * corner + 1];
    if (!std::isfinite(here.x) || !std::isfinite(above.x))
      throw Error(ErrorKind::input, "crs",
                  "a corner of the map is outside the valid area of " + describe_crs(crs));
    // Corners on either side of the date line get continuous longitudes.
    const auto near = [](double degrees, double to) {
      return degrees - 360.0 * std::round((degrees - to) / 360.0);
    };
    longitude[corner] = rounded(near(here.x, points[0].x));
    latitude[corner] = rounded(here.y);
    const double east = (near(above.x, here.x) - here.x) * exact::cos(to_radians(here.y));
    north[corner] = rounded(
        near(to_degrees(exact::atan2(east, above.y - here.y)), corner == 0 ? 0.0 : north[0]));
  }
  position.longitude_deg = plane_of(longitude, width, height);
  position.latitude_deg = plane_of(latitude, width, height);
  position.grid_north_deg = plane_of(north, width, height);
  return position;
}

std::array<double, 3> earth_position_km(double longitude_deg, double latitude_deg) {
  const exact::Turn longitude = exact::turn(to_radians(longitude_deg));
  const exact::Turn latitude = exact::turn(to_radians(latitude_deg));
  return {earth_radius_km * latitude.cosine * longitude.cosine,
          earth_radius_km * latitude.cosine * longitude.sine, earth_radius_km * latitude.sine};
}

double squared_chord_km2(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  double sum = 0.0;
  for (std::size_t axis = 0; axis < a.size(); ++axis) sum += square(a[axis] - b[axis]);
  return sum;
}

}  // namespace belvedere
