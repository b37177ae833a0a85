#include "terrain/io/crs.h"

#include <fmt/core.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "base/math_exact.h"
#include "terrain/io/gdal/gdal_files.h"

namespace belvedere {
namespace {

// Only text that names a CRS: the library must not open file names or addresses.
OGRSpatialReference parse(const std::string& text) {
  const GdalErrors errors;
  OGRSpatialReference crs;
  const char* const options[] = {"ALLOW_NETWORK_ACCESS=NO", "ALLOW_FILE_ACCESS=NO", nullptr};
  if (text.empty() || crs.SetFromUserInput(text.c_str(), options) != OGRERR_NONE) {
    throw Error(ErrorKind::usage, "crs",
                errors.say(fmt::format("unknown coordinate system \"{}\"", text.substr(0, 80))),
                "a code such as \"EPSG:32632\", or WKT");
  }
  // Heights are handled separately (raster_file.cpp).
  if (crs.IsCompound() != 0) crs.StripVertical();
  crs.DemoteTo2D(nullptr);
  if (crs.IsGeographic() == 0 && crs.IsProjected() == 0) {
    throw Error(ErrorKind::usage, "crs",
                fmt::format("\"{}\" is neither geographic nor projected",
                            crs.GetName() ? crs.GetName() : text),
                "a coordinate system of the earth's surface, such as \"EPSG:32632\"");
  }
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return crs;
}

std::string to_wkt(const OGRSpatialReference& crs) {
  const GdalErrors errors;
  char* text = nullptr;
  const char* const options[] = {"FORMAT=WKT2_2019", "MULTILINE=NO", nullptr};
  const OGRErr result = crs.exportToWkt(&text, options);
  std::string wkt = text != nullptr ? text : "";
  CPLFree(text);
  if (result != OGRERR_NONE)
    throw Error(ErrorKind::usage, "crs", errors.say("cannot be expressed as WKT"));
  return wkt;
}

constexpr glm::dvec2 nowhere{std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::quiet_NaN()};

}  // namespace

std::string normalize_crs(const std::string& crs) { return to_wkt(parse(crs)); }

std::string describe_crs(const std::string& crs) {
  if (crs.empty()) return "no coordinate system";
  const OGRSpatialReference reference = parse(crs);
  const auto code_of = [](const OGRSpatialReference& known) {
    const char* authority = known.GetAuthorityName(nullptr);
    const char* code = known.GetAuthorityCode(nullptr);
    return authority != nullptr && code != nullptr ? fmt::format("{}:{}", authority, code)
                                                   : std::string();
  };
  if (std::string code = code_of(reference); !code.empty()) return code;
  // A .prj file has no code, but usually the same name as a CRS that has one.
  const GdalErrors errors;
  const std::unique_ptr<OGRSpatialReference> match(reference.FindBestMatch());
  if (match)
    if (std::string code = code_of(*match); !code.empty()) return code;
  const char* name = reference.GetName();
  return name != nullptr ? name : "an unnamed coordinate system";
}

CrsTraits crs_traits(const std::string& crs) {
  const OGRSpatialReference reference = parse(crs);
  CrsTraits traits;
  traits.geographic = reference.IsGeographic() != 0;
  traits.metric = reference.IsProjected() != 0 && std::abs(reference.GetLinearUnits() - 1.0) < 1e-9;
  return traits;
}

bool same_crs(const std::string& a, const std::string& b) {
  if (a == b) return true;
  if (a.empty() || b.empty()) return false;
  const char* const options[] = {"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES", "CRITERION=EQUIVALENT",
                                 nullptr};
  const OGRSpatialReference first = parse(a);
  const OGRSpatialReference second = parse(b);
  const GdalErrors errors;
  return first.IsSame(&second, options) != 0;
}

std::string doubt_of_place(const std::string& crs, glm::dvec2 point) {
  constexpr double slack_east = 6.0;  // zones are used somewhat beyond their borders
  constexpr double slack_north = 3.0;
  double west = 0.0;
  double south = 0.0;
  double east = 0.0;
  double north = 0.0;
  const OGRSpatialReference reference = parse(crs);
  if (!reference.GetAreaOfUse(&west, &south, &east, &north, nullptr)) return {};
  if (east < west) east += 360.0;
  const glm::dvec2 at = PointTransform(crs, "EPSG:4326").apply(point);
  if (!std::isfinite(at.x) || !std::isfinite(at.y)) return {};
  const double off_centre = std::remainder(at.x - .5 * (west + east), 360.0);
  if (std::abs(off_centre) <= .5 * (east - west) + slack_east && at.y >= south - slack_north &&
      at.y <= north + slack_north)
    return {};
  return fmt::format(
      "{:.0f}° {} {:.0f}° {}, far outside the area of {} ({:.0f}° … {:.0f}° E, {:.0f}° … {:.0f}° "
      "N)",
      std::abs(at.y), at.y < 0.0 ? "S" : "N", std::abs(at.x), at.x < 0.0 ? "W" : "E",
      describe_crs(crs), west, east, south, north);
}

std::string utm_crs(glm::dvec2 lon_lat) {
  if (!std::isfinite(lon_lat.x) || !std::isfinite(lon_lat.y)) return {};
  if (lon_lat.y > 84.0) return normalize_crs("EPSG:32661");
  if (lon_lat.y < -80.0) return normalize_crs("EPSG:32761");
  const double turns = std::floor((lon_lat.x + 180.0) / 360.0);
  const int zone =
      std::clamp(1 + static_cast<int>((lon_lat.x + 180.0 - 360.0 * turns) / 6.0), 1, 60);
  return normalize_crs(fmt::format("EPSG:{}", (lon_lat.y < 0.0 ? 32700 : 32600) + zone));
}

namespace {

// Length of ±reach (CRS units) along x and y on the ground, m, on the WGS 84 ellipsoid: radii of
// curvature in the meridian M and in the prime vertical N.
glm::dvec2 ground_lengths_m(const std::string& crs, glm::dvec2 point, glm::dvec2 reach) {
  const PointTransform to_degrees(crs, "EPSG:4326");
  std::vector<glm::dvec2> p = {point, point + glm::dvec2{-reach.x, 0.0},
                               point + glm::dvec2{reach.x, 0.0}, point + glm::dvec2{0.0, -reach.y},
                               point + glm::dvec2{0.0, reach.y}};
  to_degrees.apply(p);
  constexpr double a = 6378137.0;
  constexpr double e2 = 6.69437999014e-3;
  constexpr double degree = std::numbers::pi / 180.0;
  const double sine = exact::sin(p[0].y * degree);
  const double n = a / std::sqrt(1.0 - e2 * sine * sine);
  const double m = n * (1.0 - e2) / (1.0 - e2 * sine * sine);
  const auto metres = [&](glm::dvec2 d) {
    d.x -= 360.0 * std::round(d.x / 360.0);
    return exact::hypot(d.x * degree * n * exact::cos(p[0].y * degree), d.y * degree * m);
  };
  return {metres(p[2] - p[1]), metres(p[4] - p[3])};
}

}  // namespace

double scale_of_crs(const std::string& crs, glm::dvec2 point) {
  constexpr double reach = 500.0;
  const glm::dvec2 ground = ground_lengths_m(crs, point, {reach, reach});
  return 2.0 * reach / std::sqrt(ground.x * ground.y);
}

glm::dvec2 ground_cell_m(const GeoTransform& transform, const std::string& crs, int width,
                         int height) {
  const glm::dvec2 cell{transform.cell_x, transform.cell_y};
  if (crs.empty()) return cell;
  const glm::dvec2 ground =
      ground_lengths_m(crs, transform.to_crs(0.5 * (width - 1), 0.5 * (height - 1)), 0.5 * cell);
  if (!std::isfinite(ground.x) || !std::isfinite(ground.y) || !(ground.x > 0.0) ||
      !(ground.y > 0.0)) {
    throw Error(ErrorKind::input, "crs",
                fmt::format("the raster is outside the valid area of {}", describe_crs(crs)));
  }
  const auto near = [](double a, double b) { return std::abs(a / b - 1.0) < 0.03; };
  return crs_traits(crs).metric && near(ground.x, cell.x) && near(ground.y, cell.y) ? cell : ground;
}

struct PointTransform::State {
  std::unique_ptr<OGRCoordinateTransformation> transformation;  // null: identity
  std::string from, to;
};

PointTransform::PointTransform(const std::string& from_crs, const std::string& to_crs)
    : state_(std::make_unique<State>()) {
  if (same_crs(from_crs, to_crs)) return;
  // The result must not depend on whether a machine can download datum grids.
  OSRSetPROJEnableNetwork(0);
  const OGRSpatialReference from = parse(from_crs);
  const OGRSpatialReference to = parse(to_crs);
  const GdalErrors errors;
  state_->from = from_crs;
  state_->to = to_crs;
  state_->transformation.reset(OGRCreateCoordinateTransformation(&from, &to));
  if (!state_->transformation) {
    throw Error(ErrorKind::input, "crs",
                errors.say(fmt::format("no transformation from {} to {}", describe_crs(from_crs),
                                       describe_crs(to_crs))));
  }
}

PointTransform::~PointTransform() = default;
PointTransform::PointTransform(PointTransform&&) noexcept = default;
PointTransform& PointTransform::operator=(PointTransform&&) noexcept = default;

void PointTransform::apply(std::vector<glm::dvec2>& points) const {
  if (!state_->transformation || points.empty()) return;
  std::vector<double> x(points.size());
  std::vector<double> y(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    x[i] = points[i].x;
    y[i] = points[i].y;
  }
  const GdalErrors errors;
  std::vector<int> done(points.size(), 0);
  // The return value only tells whether all succeeded; each point has its own flag.
  state_->transformation->Transform(static_cast<int>(points.size()), x.data(), y.data(), nullptr,
                                    done.data());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool good = done[i] != 0 && std::isfinite(x[i]) && std::isfinite(y[i]);
    points[i] = good ? glm::dvec2{x[i], y[i]} : nowhere;
  }
}

glm::dvec2 PointTransform::apply(glm::dvec2 point) const {
  std::vector<glm::dvec2> points = {point};
  apply(points);
  return points[0];
}

glm::dvec2 transform_point(const std::string& from_crs, const std::string& to_crs,
                           glm::dvec2 point) {
  const glm::dvec2 there = PointTransform(from_crs, to_crs).apply(point);
  if (!std::isfinite(there.x)) {
    throw Error(ErrorKind::input, "crs",
                fmt::format("the point {}, {} of {} is outside the valid area of {}", point.x,
                            point.y, describe_crs(from_crs), describe_crs(to_crs)));
  }
  return there;
}

}  // namespace belvedere
