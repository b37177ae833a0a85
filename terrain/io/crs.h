#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <vector>

#include "terrain/io/raster.h"

namespace belvedere {

// Coordinate reference systems as text: a code ("EPSG:32632") or WKT. Error(usage) where a text means none.

// Width and height of a cell on the ground, m, in the middle of a raster of that size: of degrees, feet or a map that stretches. Cells of a
// metric CRS that is true within 3 %, and cells of no CRS, count as they are.
glm::dvec2 ground_cell_m(const GeoTransform& transform, const std::string& crs, int width, int height);
// A point between two CRS; geographic CRS are in longitude, latitude order.
glm::dvec2 transform_point(const std::string& from_crs, const std::string& to_crs, glm::dvec2 point);
// "EPSG:4326" and the like to WKT2; Error(usage) where it means nothing.
std::string normalize_crs(const std::string& crs);
// A short name for people, "EPSG:32632" or the CRS's name.
std::string describe_crs(const std::string& crs);

struct CrsTraits {
  bool geographic = false;  // degrees
  bool metric = false;      // projected, in metres
};
CrsTraits crs_traits(const std::string& crs);
bool same_crs(const std::string& a, const std::string& b);
// WGS 84 / UTM, or the polar stereographic CRS beyond 84° of latitude.
std::string utm_crs(glm::dvec2 lon_lat);
// Words for a place that lies far from where its CRS is meant for, by 6° of longitude or 3° of latitude and more: "51° N 118° W, far from
// where … is used". A CRS that is not the data's own is found so. Empty where nothing is to be said, or the CRS says no area.
std::string doubt_of_place(const std::string& crs, glm::dvec2 point);
// How many metres of the CRS are one metre of ground at a point (of that CRS): 1.47 for Web Mercator at 47° N.
double scale_of_crs(const std::string& crs, glm::dvec2 point);

// Coordinates from one CRS to another; longitude before latitude. Equal CRS (and empty ones) leave points as they are.
// For one thread at a time.
class PointTransform {
 public:
  PointTransform(const std::string& from_crs, const std::string& to_crs);
  ~PointTransform();
  PointTransform(PointTransform&&) noexcept;
  PointTransform& operator=(PointTransform&&) noexcept;

  // In one call for all, because the operation between two datums is chosen for the mean of the points. Points that
  // have no image become NaN.
  void apply(std::vector<glm::dvec2>& points) const;
  glm::dvec2 apply(glm::dvec2 point) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace belvedere
