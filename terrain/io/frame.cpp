#include <fmt/core.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "base/error.h"
#include "terrain/io/crs.h"
#include "terrain/io/raster_file.h"
#include "terrain/io/raster_io.h"

namespace belvedere {
namespace {

struct Box {
  glm::dvec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  glm::dvec2 high{-std::numeric_limits<double>::infinity(),
                  -std::numeric_limits<double>::infinity()};

  void add(glm::dvec2 point) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) return;
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
};

// The file's outline in another CRS; sides are sampled, because they become curves.
Box box_in(const RasterFile& file, const std::string& crs) {
  constexpr int steps = 32;
  std::vector<glm::dvec2> outline;
  for (int i = 0; i <= steps; ++i) {
    const double x = static_cast<double>(file.width()) * i / steps;
    const double y = static_cast<double>(file.height()) * i / steps;
    outline.push_back(file.affine().to_crs({x, 0.0}));
    outline.push_back(file.affine().to_crs({x, static_cast<double>(file.height())}));
    outline.push_back(file.affine().to_crs({0.0, y}));
    outline.push_back(file.affine().to_crs({static_cast<double>(file.width()), y}));
  }
  PointTransform(file.required_crs(), crs).apply(outline);
  Box box;
  for (const glm::dvec2& point : outline) box.add(point);
  return box;
}

// Width and height of a cell at the file's centre, in the CRS's metres.
glm::dvec2 cell_in(const RasterFile& file, const std::string& crs) {
  const CellAffine& a = file.affine();
  const glm::dvec2 c{0.5 * file.width(), 0.5 * file.height()};
  std::vector<glm::dvec2> p = {a.to_crs(c), a.to_crs(c + glm::dvec2{1.0, 0.0}),
                               a.to_crs(c + glm::dvec2{0.0, 1.0})};
  PointTransform(file.required_crs(), crs).apply(p);
  const glm::dvec2 cell{glm::length(p[1] - p[0]), glm::length(p[2] - p[0])};
  if (std::isfinite(cell.x) && std::isfinite(cell.y) && cell.x > 0.0 && cell.y > 0.0) return cell;
  throw Error(ErrorKind::input, file.source().path,
              fmt::format("is outside the valid area of {}", describe_crs(crs)));
}

// Rounds a length to three digits.
double rounded(double metres) {
  double unit = 1.0;
  while (metres >= 1000.0 * unit) unit *= 10.0;
  while (metres < 100.0 * unit) unit /= 10.0;
  return std::round(metres / unit) * unit;
}

// Projections with strong distortion, such as Web Mercator, would make mountains too flat.
constexpr double max_stretch = 1.03;

bool true_to_scale(const std::string& crs, glm::dvec2 point) {
  const double scale = scale_of_crs(crs, point);
  return scale < max_stretch && scale > 1.0 / max_stretch;
}

// The centre of all files, longitude and latitude. Files are taken in the turn nearest to the
// first: those on both sides of the date line are neighbours.
glm::dvec2 centre_of(const std::vector<RasterFile>& files) {
  Box box;
  double first = std::numeric_limits<double>::quiet_NaN();
  for (const RasterFile& file : files) {
    Box part = box_in(file, "EPSG:4326");
    // A file that crosses the date line itself: from its centre.
    const glm::dvec2 middle = PointTransform(file.crs(), "EPSG:4326").apply(centre_of(file));
    if (part.high.x - part.low.x > 180.0) part.low.x = part.high.x = middle.x;
    if (!std::isfinite(first)) first = middle.x;
    const double turns = 360.0 * std::round((first - middle.x) / 360.0);
    box.add({part.low.x + turns, part.low.y});
    box.add({part.high.x + turns, part.high.y});
  }
  return 0.5 * (box.low + box.high);
}

std::string choose_crs(const std::vector<RasterFile>& files, const std::string& requested) {
  const RasterFile& first = files[0];
  const std::string& own = first.required_crs();
  const glm::dvec2 centre = centre_of(files);
  const std::string utm = utm_crs(centre);
  if (utm.empty()) {
    throw Error(ErrorKind::input, first.source().path,
                fmt::format("is outside the valid area of {}", describe_crs(own)), "another `crs`");
  }
  const auto fits = [&centre](const std::string& crs) {
    const glm::dvec2 there = PointTransform("EPSG:4326", crs).apply(centre);
    return crs_traits(crs).metric && std::isfinite(there.x) && true_to_scale(crs, there);
  };
  if (requested.empty()) return fits(own) ? own : utm;
  std::string crs = normalize_crs(requested);
  if (fits(crs)) return crs;
  throw Error(
      ErrorKind::usage, "crs", fmt::format("{} distorts distances here", describe_crs(crs)),
      fmt::format("a metric coordinate system for this region, such as {}", describe_crs(utm)));
}

}  // namespace

RasterFrame choose_frame(const std::vector<RasterSource>& sources, const std::string& crs,
                         double cell_m, const std::optional<std::array<double, 4>>& extent) {
  if (sources.empty())
    throw Error(ErrorKind::usage, "sources", "no raster given", "at least one raster");
  std::vector<RasterFile> files;
  files.reserve(sources.size());
  for (const RasterSource& source : sources) files.emplace_back(source);
  RasterFrame frame;
  frame.crs = choose_crs(files, crs);
  Box box;
  glm::dvec2 finest{0.0, 0.0};
  const CellAffine* lattice = nullptr;  // of the finest file, if its cells can be used unchanged
  for (const RasterFile& file : files) {
    const Box part = box_in(file, frame.crs);
    box.add(part.low);
    box.add(part.high);
    const glm::dvec2 cell = cell_in(file, frame.crs);
    if (finest.x > 0.0 && cell.x * cell.y > finest.x * finest.y * (1.0 - 1e-6)) continue;
    finest = cell;
    lattice = nullptr;
    if (file.affine().axis_aligned() && same_crs(file.crs(), frame.crs) &&
        std::abs(cell.x / cell.y - 1.0) < 0.01)
      lattice = &file.affine();
  }
  GeoTransform& t = frame.transform;
  t.cell_x = t.cell_y = cell_m > 0.0 ? cell_m : rounded(std::sqrt(finest.x * finest.y));
  glm::dvec2 anchor{0.0, 0.0};
  const bool keep =
      lattice != nullptr && (cell_m == 0.0 || (std::abs(cell_m / finest.x - 1.0) < 1e-6 &&
                                               std::abs(cell_m / finest.y - 1.0) < 1e-6));
  if (keep) {
    t.cell_x = std::abs(lattice->x_column);
    t.cell_y = std::abs(lattice->y_row);
    anchor = {lattice->x0, lattice->y0};
  }
  if (extent) {
    if (!((*extent)[0] < (*extent)[2] && (*extent)[1] < (*extent)[3])) {
      throw Error(ErrorKind::usage, "extent", "has no area",
                  "west, south, east, north, in metres of the scene's coordinate system");
    }
    const Box data = box;
    box.low = {(*extent)[0], (*extent)[1]};
    box.high = {(*extent)[2], (*extent)[3]};
    if (box.low.x >= data.high.x || box.high.x <= data.low.x || box.low.y >= data.high.y ||
        box.high.y <= data.low.y) {
      throw Error(ErrorKind::input, "extent", "is outside the data",
                  fmt::format("within E {:.0f}…{:.0f}, N {:.0f}…{:.0f} of {}", data.low.x,
                              data.high.x, data.low.y, data.high.y, describe_crs(frame.crs)));
    }
  }
  // Outwards to whole cells of the lattice; a millionth of a cell is rounding.
  const double left = std::floor((box.low.x - anchor.x) / t.cell_x + 1e-6);
  const double right = std::ceil((box.high.x - anchor.x) / t.cell_x - 1e-6);
  const double bottom = std::floor((box.low.y - anchor.y) / t.cell_y + 1e-6);
  const double top = std::ceil((box.high.y - anchor.y) / t.cell_y - 1e-6);
  t.origin_x = anchor.x + left * t.cell_x;
  t.origin_y = anchor.y + top * t.cell_y;
  constexpr double longest = 1 << 20;
  if (!(right - left <= longest) || !(top - bottom <= longest)) {
    throw Error(
        ErrorKind::limit, sources[0].path,
        fmt::format("needs {:.0f} × {:.0f} cells of {} m", right - left, top - bottom, t.cell_x),
        "larger cells (`cell_m`) or a smaller `extent`");
  }
  frame.width = static_cast<int>(right - left);
  frame.height = static_cast<int>(top - bottom);
  return frame;
}

}  // namespace belvedere
