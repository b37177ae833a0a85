#include "renderer/world/view.h"

#include <fmt/core.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "base/filter.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "renderer/scene/scene_table.h"
#include "renderer/world/viewer_check.h"
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

namespace {

bool on_terrain(const Dem& dem, glm::dvec2 position) {
  const glm::dvec2 cell = dem.transform.to_cell(position.x, position.y);
  return cell.x >= 0.0 && cell.y >= 0.0 && cell.x <= dem.width() - 1.0 &&
         cell.y <= dem.height() - 1.0;
}

double ground_altitude_m(const Dem& dem, glm::dvec2 position) {
  const glm::dvec2 cell = dem.transform.to_cell(position.x, position.y);
  return sample_bilinear(dem.altitude_m, cell.x, cell.y);
}

// Grid convergence at a position: the azimuth of the meridian in the grid.
double meridian_azimuth_deg(const Dem& dem, glm::dvec2 lonlat) {
  const glm::dvec2 here = position_of_lonlat(dem, lonlat, "sun.time");
  const glm::dvec2 north = position_of_lonlat(dem, lonlat + glm::dvec2(0.0, 1e-3), "sun.time");
  return to_degrees(exact::atan2(north.x - here.x, north.y - here.y));
}

SunPosition resolve_sun(const SceneSun& sun, const Dem& dem, double view_azimuth_deg,
                        std::vector<DerivedValue>& derived) {
  if (sun.time.empty()) return resolve_sun(sun, view_azimuth_deg, derived);
  if (dem.crs.empty())
    throw Error(ErrorKind::usage, "sun.time", "a time on a terrain without CRS",
                "sun.azimuth_deg and sun.altitude_deg");
  const glm::dvec2 centre = dem.transform.to_crs(0.5 * (dem.width() - 1), 0.5 * (dem.height() - 1));
  const glm::dvec2 lonlat = transform_point(dem.crs, normalize_crs("EPSG:4326"), centre);
  SunPosition position = sun_position(lonlat.x, lonlat.y, sun.time);
  position.azimuth_deg += meridian_azimuth_deg(dem, lonlat);
  return position;
}

// Pitch and azimuth towards a point.
void look_towards(CameraParameters& camera, glm::dvec3 point) {
  const glm::dvec3 line = point - camera.eye;
  const double horizontal = exact::hypot(line.x, line.y);
  if (horizontal < 1e-6)
    throw Error(ErrorKind::usage, "camera.look_at", "is straight below the viewer",
                "a point away from it");
  camera.azimuth_deg = to_degrees(exact::atan2(line.x, line.y));
  camera.pitch_deg = to_degrees(exact::atan2(line.z, horizontal));
}

}  // namespace

DeformParameters resolve_deform(const SceneDeform& scene_deform, const Dem& dem) {
  DeformParameters deform = scene_deform.written();
  for (std::size_t i = 0; i < scene_deform.summits.size(); ++i) {
    const SceneSummit& given = scene_deform.summits[i];
    SummitExaggeration& summit = deform.summits.emplace_back(given.summit);
    summit.centre = resolve_place(dem, given.position, given.position_lonlat,
                                  fmt::format("deform.summits.{}", i));
  }
  for (std::size_t i = 0; i < scene_deform.handles.size(); ++i) {
    const SceneHandle& given = scene_deform.handles[i];
    DeformHandle& handle = deform.handles.emplace_back(given.handle);
    constexpr double core_share = 0.5;
    handle.centre = resolve_place(dem, given.position, given.position_lonlat,
                                  fmt::format("deform.handles.{}", i));
    handle.move_m = {given.move_m[0], given.move_m[1]};
    handle.core_m = given.core_m.value_or(core_share * handle.radius_m);
  }
  for (std::size_t i = 0; i < scene_deform.field_places.size(); ++i) {
    const SceneDisplacedPlace& given = scene_deform.field_places[i];
    DisplacedPlace& place = deform.field.places.emplace_back();
    place.position = resolve_place(dem, given.position, given.position_lonlat,
                                   fmt::format("deform.field.places.{}", i));
    place.moved = {given.moved_m[0], given.moved_m[1]};
    place.noise = {given.noise_m[0], given.noise_m[1]};
  }
  in_section("deform", [&] { return Deformation(deform, {0.0, 0.0}); });
  return deform;
}

View make_view(const Scene& scene, const Dem& dem, Progress& progress,
               const GroundAltitude& known_m, const CoarseAltitudes* known_region) {
  const auto altitude_m = [&](glm::dvec2 position) {
    return known_m && on_terrain(dem, position) ? known_m(position)
                                                : ground_altitude_m(dem, position);
  };
  View view;
  view.camera.projection = scene.camera.projection;
  view.camera.width = scene.output.width;
  view.camera.height = scene.output.height;
  view.camera.field_of_view_deg = scene.camera.field_of_view_deg;
  view.camera.view_width_m = scene.camera.view_width_m;
  view.camera.shift = {scene.camera.shift[0], scene.camera.shift[1]};

  view.viewer_xy = place_viewer(scene.camera, dem);
  std::optional<ViewTarget> target;
  if (const std::optional<glm::dvec2> position = place_target(scene.camera, dem))
    target = {*position, scene.camera.look_at_altitude_m ? *scene.camera.look_at_altitude_m
                                                         : altitude_m(*position)};
  if (target) view.target_altitude_m = target->altitude_m;
  std::optional<double> viewer_ground_m;
  if (on_terrain(dem, view.viewer_xy)) viewer_ground_m = altitude_m(view.viewer_xy);
  const LazyValue<std::optional<CoarseGround>> region([&] {
    return region_of(known_region != nullptr ? *known_region : coarse_altitudes_of(dem));
  });
  const ResolvedView resolved =
      resolve_view(scene, {view.viewer_xy, viewer_ground_m, target}, region, view.derived);
  const SceneCamera& camera = resolved.camera;

  view.deform = resolve_deform(resolved.deform, dem);
  const Deformation deformation(view.deform, view.viewer_xy);
  // Handles may have moved other ground below the viewer.
  const glm::dvec2 below = deformation.source_of(view.viewer_xy).value_or(view.viewer_xy);
  const bool known_ground = on_terrain(dem, below);
  const glm::dvec3 ground{below, known_ground ? altitude_m(below) : 0.0};
  double eye_m = *camera.height_m;
  if (camera.height_above_ground) {
    if (!known_ground)
      throw Error(ErrorKind::usage, "camera.height_above_ground",
                  "a position outside the terrain, whose ground is not known",
                  "a position on the terrain, or height_above_ground = false");
    eye_m += deformation.unbent(ground).z;
  }
  view.camera.eye = {view.viewer_xy, eye_m};
  if (known_ground) {
    // The ground as seen by the camera: exaggerated and bent.
    const double ground_m = deformation.point(ground).z;
    if (eye_m < ground_m)
      throw Error(
          ErrorKind::usage, "camera.height_m",
          fmt::format("the viewer at {:.0f} m is below the ground, which is at {:.0f} m there",
                      eye_m, ground_m),
          fmt::format("more than {:.0f} m above the datum", ground_m));
  }

  if (target) {
    // On the exaggerated ground before it is bent or rearranged, so that only those change what is
    // in the picture.
    DeformParameters plain = view.deform;
    plain.summits.clear();
    plain.handles.clear();
    plain.field = {};
    look_towards(view.camera,
                 Deformation(plain, view.viewer_xy).unbent({target->position, target->altitude_m}));
  } else {
    view.camera.azimuth_deg = *camera.azimuth_deg;
    view.camera.pitch_deg = *camera.pitch_deg;
  }
  view.camera.pitch_deg +=
      resolve_tilt(scene.camera, resolved, view.camera.pitch_deg, view.derived);
  in_section("camera", [&] { return make_camera(view.camera); });

  view.sun = resolve_sun(scene.sun, dem, view.camera.azimuth_deg, view.derived);
  view.sun_direction = sun_direction(view.sun);
  view.sun_image_x = exact::sin(to_radians(view.sun.azimuth_deg - view.camera.azimuth_deg));
  if (view.sun.altitude_deg <= 0.0)
    progress.note(fmt::format("the sun stands {:.1f}° below the horizon: only the sky gives light",
                              -view.sun.altitude_deg));
  const ViewDistances distances =
      resolve_distances(scene, deformation, view.camera, region, view.derived);
  view.air = distances.air;
  view.generalize = distances.generalize;
  return view;
}

}  // namespace belvedere
