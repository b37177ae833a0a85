#include "renderer/world/valley_view.h"

#include <fmt/core.h>

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/math.h"
#include "base/error.h"
#include "base/math_exact.h"
#include "renderer/ground/scene_ground_map.h"
#include "renderer/trace/camera.h"
#include "renderer/world/generalize_view.h"
#include "renderer/world/scene_dem.h"
#include "renderer/world/world.h"
#include "terrain/cover/map_cover.h"

namespace belvedere {
namespace {

constexpr int sight_line_count = 400;

// The visible part of a vertical line, or nothing.
std::optional<SightLine> shown(const Camera& camera, double azimuth_deg) {
  const double azimuth = to_radians(azimuth_deg);
  const auto inside = [&](double altitude_deg) {
    const double altitude = to_radians(altitude_deg);
    constexpr double far_m = 1000.0;  // any distance: only the direction counts
    const auto at =
        camera.project(camera.eye() + far_m * glm::dvec3(exact::sin(azimuth) * exact::cos(altitude),
                                                         exact::cos(azimuth) * exact::cos(altitude),
                                                         exact::sin(altitude)));
    return at && at->x >= 0.0 && at->y >= 0.0 && at->x <= camera.size().x &&
           at->y <= camera.size().y;
  };
  const auto edge = [&](double in, double out) {
    for (int halving = 0; halving < 40; ++halving) {
      const double centre = 0.5 * (in + out);
      (inside(centre) ? in : out) = centre;
    }
    return exact::tan(to_radians(in));
  };
  constexpr double step_deg = 0.5;
  constexpr int steepest = 179;  // steps
  std::optional<double> lowest;
  std::optional<double> highest;
  for (int step = -steepest; step <= steepest; ++step) {
    const double altitude = step * step_deg;
    if (!inside(altitude)) continue;
    if (!lowest) lowest = altitude;
    highest = altitude;
  }
  if (!lowest) return std::nullopt;
  return SightLine{azimuth_deg, edge(*lowest, *lowest - step_deg),
                   edge(*highest, *highest + step_deg)};
}

}  // namespace

BareView bare_view_of(const World& world) {
  const std::shared_ptr<const TerrainModel>& terrain = world.ground.terrain;
  return {world.view,
          world.dem,
          {terrain, &terrain->generalized_m},
          {terrain, &terrain->goes_to},
          world.deformation,
          world.ground.surface,
          make_camera(world.view.camera),
          world.ground.tracer};
}

BareView make_bare_view(const LoadedScene& loaded, Progress& progress, const Cache& cache) {
  BareView bare;
  SceneDem opened = open_scene_dem(loaded, progress, cache);
  bare.view =
      make_view(loaded.scene, opened.dem, progress, ground_altitude_of(opened), &opened.region);
  const auto dem = std::make_shared<const Dem>(std::move(opened.dem));
  bare.dem = dem;
  bare.camera = make_camera(bare.view.camera);
  // Lakes of the map keep their level, as in the picture.
  const std::shared_ptr<const MapCover> areas = areas_of_map(loaded, *dem, cache);
  std::optional<GroundMasks> masks;
  if (opened.data)
    masks = preview_masks(loaded, *opened.data, dem->halved - opened.data->halved, areas.get(),
                          progress);
  GeneralizedTerrain generalized =
      generalize_for_view(loaded, *dem, nullptr, bare.view, progress, cache,
                          {.masks = masks ? &*masks : nullptr, .areas = areas.get()});
  bare.generalized_m = std::make_shared<const Grid<float>>(std::move(generalized.altitude_m));
  bare.goes_to = std::make_shared<const Grid<glm::vec2>>(std::move(generalized.goes_to));
  bend_again(bare, bare.view.deform.bend);
  return bare;
}

void bend_again(BareView& bare, const BendCurve& bend) {
  bare.view.deform.bend = bend;
  bare.deformation = Deformation(bare.view.deform, bare.view.viewer_xy);
  bare.tracer.reset();
  bare.surface = std::make_shared<const DeformedSurface>(
      deform(*bare.generalized_m, bare.dem->transform, glm::dvec3(bare.view.viewer_xy, 0.0),
             bare.deformation));
  bare.tracer = std::make_shared<const Tracer>(*bare.surface);
}

std::vector<SightLine> sight_lines(const CameraParameters& parameters, int count) {
  if (const Projection* projection = find_projection(parameters.projection);
      projection != nullptr && projection->widest_deg == 0.0) {
    std::string central;
    for (const Projection& other : projections())
      if (other.widest_deg > 0.0)
        central += fmt::format("{}\"{}\"", central.empty() ? "" : " or ", other.name);
    throw Error(ErrorKind::usage, "camera.projection",
                fmt::format("\"{}\", whose lines of sight are parallel", projection->name),
                central);
  }
  const std::unique_ptr<Camera> camera = make_camera(parameters);
  // First the width of the view, then evenly over that.
  constexpr int quarters = 720;  // half a turn in quarters of a degree, to either side
  int first = quarters;
  int last = -quarters;
  for (int q = -quarters; q < quarters; ++q) {
    if (!shown(*camera, parameters.azimuth_deg + 0.25 * q)) continue;
    first = std::min(first, q);
    last = std::max(last, q);
  }
  std::vector<SightLine> lines;
  const double from = parameters.azimuth_deg + 0.25 * first;
  const double width = 0.25 * (last - first);
  for (int i = 0; i < count; ++i)
    if (const auto line = shown(*camera, from + width * (i + 0.5) / count)) lines.push_back(*line);
  if (lines.empty())
    throw Error(ErrorKind::usage, "camera", "a picture without any direction of view",
                "a wider view");
  return lines;
}

Grid<float> known_altitude(const Dem& dem) {
  Grid<float> known = dem.altitude_m;
  if (!dem.filled.empty())
    for (std::size_t i = 0; i < known.size(); ++i)
      if (dem.filled[i] != 0) known[i] = std::numeric_limits<float>::quiet_NaN();
  return known;
}

ValleySight make_valley_sight(const BareView& bare) {
  return {known_altitude(*bare.dem), bare.dem->transform, bare.deformation, bare.view.camera.eye.z,
          sight_lines(bare.view.camera, sight_line_count)};
}

}  // namespace belvedere
