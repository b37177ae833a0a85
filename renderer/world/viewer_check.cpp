#include "renderer/world/viewer_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <limits>
#include <span>
#include <vector>

#include "base/error.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "renderer/ground/scene_ground_map.h"
#include "terrain/io/crs.h"

namespace belvedere {
namespace {

// Data that are farther away than this many of their diagonals fill less than eleven degrees.
constexpr double max_diagonals = 5.0;

std::string written(const DataExtent& data) {
  return fmt::format("E {:.0f}…{:.0f}, N {:.0f}…{:.0f}{}", data.box.low.x, data.box.high.x,
                     data.box.low.y, data.box.high.y,
                     data.crs.empty() ? "" : " of " + describe_crs(data.crs));
}

std::string written(glm::dvec2 numbers, bool lonlat) {
  return lonlat ? fmt::format("{:.7g}° E {:.7g}° N", numbers.x, numbers.y)
                : fmt::format("E {:.10g} N {:.10g}", numbers.x, numbers.y);
}

// Nothing where the CRS does not reach it.
std::optional<glm::dvec2> in_crs(glm::dvec2 numbers, bool lonlat, const DataExtent& data) {
  if (!lonlat) return numbers;
  if (data.crs.empty() || std::abs(numbers.x) > 360.0 || std::abs(numbers.y) > 90.0)
    return std::nullopt;
  const glm::dvec2 there = PointTransform(normalize_crs("EPSG:4326"), data.crs).apply(numbers);
  if (!std::isfinite(there.x) || !std::isfinite(there.y)) return std::nullopt;
  return there;
}

bool looks_like_degrees(glm::dvec2 numbers) {
  return std::abs(numbers.x) <= 180.0 && std::abs(numbers.y) <= 180.0;
}

// Another reading of the numbers that lies in the data or not farther from them than their
// diagonal, in words; empty: none.
std::string other_reading(const GivenPosition& given, const DataExtent& data) {
  const glm::dvec2 swapped{given.numbers.y, given.numbers.x};
  struct Reading {
    glm::dvec2 numbers;
    bool lonlat;
    const char* question;
  };
  const std::array<Reading, 4> readings = {
      {{swapped, given.lonlat, "are the two numbers swapped?"},
       {given.numbers, true, "are these degrees?"},
       {swapped, true, "are these degrees, latitude before longitude?"},
       {given.numbers, false, "are these metres, easting and northing?"}}};
  for (const Reading& reading : readings) {
    const std::optional<glm::dvec2> there = in_crs(reading.numbers, reading.lonlat, data);
    if (!there || data.distance_outside_m(*there) > data.diagonal_m()) continue;
    const std::string text =
        fmt::format("{} {} {} the data", reading.question, written(reading.numbers, reading.lonlat),
                    data.distance_outside_m(*there) > 0.0 ? "is near" : "is in");
    if (given.key.starts_with('-')) return text;  // an option, which takes only degrees
    const std::string key =
        given.key.substr(0, given.key.find("_lonlat")) + (reading.lonlat ? "_lonlat" : "");
    return fmt::format("{}: {} = [{:.10g}, {:.10g}]", text, key, reading.numbers.x,
                       reading.numbers.y);
  }
  return "";
}

GivenPosition position_of(const SceneCamera& camera) {
  if (camera.position) return {"camera.position", *camera.position, false};
  if (camera.position_lonlat) return {"camera.position_lonlat", *camera.position_lonlat, true};
  throw Error(ErrorKind::usage, "camera", "no position",
              "camera.position or camera.position_lonlat");
}

// Whether one of the picture's rays, count.x by count.y, finds ground.
bool sees_ground(const Camera& camera, const Tracer& tracer, glm::ivec2 count) {
  const glm::dvec2 step = glm::dvec2(camera.size()) / glm::dvec2(count);
  std::vector<std::uint8_t> found(static_cast<std::size_t>(count.y), 0);
  parallel_rows(count.y, [&](int y) {
    constexpr int bundle = 16;  // rays that the tracer takes at once
    std::array<Ray, bundle> rays;
    std::array<Hit, bundle> hits;
    for (int x0 = 0; x0 < count.x; x0 += bundle) {
      const auto now = static_cast<std::size_t>(std::min(bundle, count.x - x0));
      for (std::size_t i = 0; i < now; ++i)
        rays[i] = camera.ray((glm::dvec2(x0 + static_cast<int>(i), y) + 0.5) * step);
      tracer.intersect(std::span(rays).first(now), std::span(hits).first(now));
      for (std::size_t i = 0; i < now; ++i)
        if (hits[i].found) found[static_cast<std::size_t>(y)] = 1;
      if (found[static_cast<std::size_t>(y)] != 0) return;
    }
  });
  return std::find(found.begin(), found.end(), 1) != found.end();
}

}  // namespace

double DataExtent::diagonal_m() const {
  return exact::hypot(box.high.x - box.low.x, box.high.y - box.low.y);
}

double DataExtent::distance_outside_m(glm::dvec2 position) const {
  const double east = std::max({box.low.x - position.x, position.x - box.high.x, 0.0});
  const double north = std::max({box.low.y - position.y, position.y - box.high.y, 0.0});
  return exact::hypot(east, north);
}

DataExtent extent_of(const Dem& dem) { return {box_of(dem), dem.crs}; }

glm::dvec2 place_near_data(const GivenPosition& given, const DataExtent& data, double max_m) {
  if (given.lonlat && data.crs.empty())
    throw Error(ErrorKind::usage, given.key, "longitude and latitude on a terrain without CRS",
                "easting and northing");
  const std::optional<glm::dvec2> there = in_crs(given.numbers, given.lonlat, data);
  if (there && data.distance_outside_m(*there) <= max_m) return *there;
  const std::string other = other_reading(given, data);
  const std::string away =
      there ? fmt::format("{:.1f} km outside the data", data.distance_outside_m(*there) / 1000.0)
            : "outside the valid area of " + describe_crs(data.crs);
  throw Error(ErrorKind::usage, given.key,
              fmt::format("{} is {}, which are in {}", written(given.numbers, given.lonlat), away,
                          written(data)),
              !other.empty() ? other
              : given.lonlat ? "longitude before latitude, in or near the data"
              : looks_like_degrees(given.numbers)
                  ? "metres, in or near the data; degrees, longitude before latitude, are "
                    "camera.position_lonlat"
                  : "a position in or near the data");
}

glm::dvec2 place_viewer(const SceneCamera& camera, const Dem& dem) {
  const DataExtent data = extent_of(dem);
  return place_near_data(position_of(camera), data, max_diagonals * data.diagonal_m());
}

std::optional<glm::dvec2> place_target(const SceneCamera& camera, const Dem& dem) {
  if (!camera.look_at && !camera.look_at_lonlat) return std::nullopt;
  const GivenPosition given =
      camera.look_at ? GivenPosition{"camera.look_at", *camera.look_at, false}
                     : GivenPosition{"camera.look_at_lonlat", *camera.look_at_lonlat, true};
  const DataExtent data = extent_of(dem);
  const bool mistaken = !other_reading(given, data).empty();
  return place_near_data(
      given, data,
      mistaken ? max_diagonals * data.diagonal_m() : std::numeric_limits<double>::infinity());
}

void check_ground_in_view(const Dem& dem, const Camera& camera, const Tracer& tracer,
                          Progress& progress) {
  const glm::ivec2 size = camera.size();
  constexpr glm::ivec2 few{64, 48}, many{1024, 512};
  const DataExtent data = extent_of(dem);
  const glm::dvec3 eye = camera.eye();
  const double outside_m = data.distance_outside_m(eye);
  const std::string place = outside_m > 0.0
                                ? fmt::format("{:.1f} km outside the data", outside_m / 1000.0)
                                : std::string("in the data");
  // Ground that only more rays find is a sliver.
  if (!sees_ground(camera, tracer, glm::min(few, size)) &&
      !sees_ground(camera, tracer, glm::min(many, size)))
    throw Error(ErrorKind::usage, "camera",
                fmt::format("no ground is in the picture; the viewer at {}, {:.0f} m, is {}, which "
                            "are in {}",
                            written(glm::dvec2(eye), false), eye.z, place, written(data)),
                "a direction, a pitch and a height that show ground");
  if (outside_m > data.diagonal_m())
    progress.note(fmt::format("the viewer is {}, which are in {}", place, written(data)));
}

namespace {

// The key of what folds the ground.
std::string place_of(const FoldSummary& summary, const SceneDeform& scene) {
  if (!summary.handle) return "deform.field";
  const std::string& name = scene.handles[*summary.handle].name;
  return fmt::format("deform.handles.{}{}", *summary.handle, name.empty() ? "" : " (" + name + ")");
}

}  // namespace

void check_folds(const SceneDeform& scene, const TerrainModel& terrain,
                 const Deformation& deformation, const Camera& camera, Progress& progress) {
  const std::vector<Fold> folds =
      find_folds(terrain.generalized_m, terrain.dem->transform, deformation);
  if (folds.empty()) return;
  std::vector<Fold> in_picture;
  for (const Fold& fold : folds) {
    const double altitude = static_cast<double>(terrain.generalized_m(fold.column, fold.row));
    const auto at = camera.project(deformation.point({fold.position, altitude}));
    if (at && at->x >= 0.0 && at->y >= 0.0 && at->x <= camera.size().x && at->y <= camera.size().y)
      in_picture.push_back(fold);
  }
  const bool refuse = !in_picture.empty() && !scene.allow_folds;
  for (const FoldSummary& summary :
       summarize_folds(refuse ? in_picture : folds, deformation.parameters())) {
    const std::string where = place_of(summary, scene);
    const std::string found = fmt::format("folds the ground{} around E {:.0f} N {:.0f}, {} facets",
                                          refuse ? " in the picture" : "", summary.centre.x,
                                          summary.centre.y, summary.facets);
    if (refuse)
      throw Error(ErrorKind::usage, where, found,
                  summary.handle ? "a smaller move_m, rotate_deg or scale, a larger radius_m, a "
                                   "smaller core_m, or deform.allow_folds = true"
                                 : "places that are displaced less unlike their neighbours, or "
                                   "deform.allow_folds = true");
    progress.note(where + " " + found);
  }
}

}  // namespace belvedere
