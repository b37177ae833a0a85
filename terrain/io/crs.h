#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <vector>

#include "terrain/io/raster.h"

namespace belvedere {

// Coordinate reference systems as text: a code ("EPSG:32632") or WKT. Error(usage) for invalid
// text.

// Width and height of a cell on the ground, m, at the centre of a raster of that size, for degrees,
// feet or projections with distortion. Cells of a metric CRS with less than 3 % distortion, and
// cells without a CRS, are returned unchanged.
glm::dvec2 ground_cell_m(const GeoTransform& transform, const std::string& crs, int width,
                         int height);
// A point between two CRS; geographic CRS are in longitude, latitude order.
glm::dvec2 transform_point(const std::string& from_crs, const std::string& to_crs,
                           glm::dvec2 point);
// "EPSG:4326" and other codes to WKT2; Error(usage) for invalid text.
std::string normalize_crs(const std::string& crs);
// A short name for messages, "EPSG:32632" or the CRS's name.
std::string describe_crs(const std::string& crs);

struct CrsTraits {
  bool geographic = false;  // degrees
  bool metric = false;      // projected, in metres
};
CrsTraits crs_traits(const std::string& crs);
bool same_crs(const std::string& a, const std::string& b);
// WGS 84 / UTM, or the polar stereographic CRS beyond 84° of latitude.
std::string utm_crs(glm::dvec2 lon_lat);
// A phrase for a position outside the area of use of its CRS by more than 6° of longitude or 3° of
// latitude: "51° N 118° W, far outside the area of …". It detects a wrong CRS. Empty if the
// position is plausible or the CRS has no area of use.
std::string doubt_of_place(const std::string& crs, glm::dvec2 point);
// Scale factor: metres of the CRS per metre of ground at a point (of that CRS): 1.47 for Web
// Mercator at 47° N.
double scale_of_crs(const std::string& crs, glm::dvec2 point);

// Coordinates from one CRS to another; longitude before latitude. Equal CRS (and empty ones) leave
// points unchanged. Not thread-safe.
class PointTransform {
 public:
  PointTransform(const std::string& from_crs, const std::string& to_crs);
  ~PointTransform();
  PointTransform(PointTransform&&) noexcept;
  PointTransform& operator=(PointTransform&&) noexcept;

  // All points in one call, because the operation between two datums is chosen for their mean.
  // Points that cannot be transformed become NaN.
  void apply(std::vector<glm::dvec2>& points) const;
  glm::dvec2 apply(glm::dvec2 point) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace belvedere
