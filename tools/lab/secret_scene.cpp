#include "tools/lab/secret_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "base/error.h"
#include "base/filter.h"
#include "base/math.h"
#include "base/random.h"
#include "base/statistics.h"
#include "renderer/register/registered_ground.h"
#include "renderer/scene/scene_file.h"
#include "terrain/generalize/widen_valleys.h"
#include "terrain/io/crs.h"

namespace belvedere::bench {
namespace {

constexpr int secret_width = 1200, secret_height = 550;

glm::dvec2 direction(double azimuth_deg) {
  return {std::sin(to_radians(azimuth_deg)), std::cos(to_radians(azimuth_deg))};
}

double altitude_at(const Dem& dem, glm::dvec2 position) {
  const glm::dvec2 cell = dem.transform.to_cell(position.x, position.y);
  return static_cast<double>(sample_bilinear(dem.altitude_m, cell.x, cell.y));
}

glm::dvec2 middle_of(const Dem& dem) {
  return dem.transform.to_crs(0.5 * (dem.width() - 1), 0.5 * (dem.height() - 1));
}

// Altitude below which a tenth of the DEM lies.
double valley_of(const Dem& dem) {
  std::vector<float> some;
  for (std::size_t i = 0; i < dem.altitude_m.size(); i += 97) some.push_back(dem.altitude_m[i]);
  return static_cast<double>(value_at_share(std::move(some), 0.1));
}

// The view and the bend, without local changes.
void draw_view(SecretScene& scene, const SecretRegion& region, Draws& draws) {
  const double kind = draws.between(0.0, 1.0);
  const bool plane = kind<0.5, panini = kind> 0.9;
  const double side = region.side_m;
  const double off_east = draws.between(-0.12, 0.12) * side;
  const double off_north = draws.between(-0.12, 0.12) * side;
  const glm::dvec2 target = middle_of(*scene.dem) + glm::dvec2(off_east, off_north);
  const double azimuth = draws.between(0.0, 360.0);
  const double distance = side * (plane ? draws.between(0.7, 1.1) : draws.between(0.55, 0.75));
  const double shown = side * draws.between(0.6, 0.85);
  CameraParameters& camera = scene.camera;
  camera.projection = plane ? "perspective" : panini ? "panini" : "cylindrical";
  camera.width = secret_width;
  camera.height = secret_height;
  camera.azimuth_deg = azimuth;
  camera.field_of_view_deg = 2.0 * to_degrees(std::atan(0.5 * shown / distance));

  DeformParameters& deform = scene.deform;
  const double base = valley_of(*scene.dem);
  deform.exaggeration_base_m = base;
  deform.exaggeration = draws.between(1.2, 2.1);
  deform.background_exaggeration = draws.between(1.2, 2.1);
  deform.foreground_to_m = 0.7 * distance;
  deform.background_from_m = 1.4 * distance;
  const double near = distance - 0.45 * side, far = distance + 0.45 * side;
  const double crest = far * draws.between(0.85, 1.05);
  const double tilt = std::tan(to_radians(draws.between(4.0, 15.0)));
  const double down = std::tan(to_radians(draws.between(11.0, 22.0)));
  if (draws.between(0.0, 1.0) < 0.6) {
    deform.bend.crest_m = crest;
    deform.bend.radius_m = (crest - near) / tilt;
  } else {
    const double inclined = to_degrees(std::atan(tilt));
    deform.bend.points = {{std::max(near, 0.0), {}, inclined},
                          {distance, {}, inclined * draws.between(0.3, 0.9)},
                          {far, {}, 0.0}};
  }
  const glm::dvec2 eye = target - distance * direction(azimuth);
  const Deformation bent(deform, eye);
  const double relief = 700.0 * deform.exaggeration;
  const double height = base + relief + distance * down - bent.drop_m(distance);
  camera.eye = {eye, height};
  // A level far ground lies a seventh of the picture's height below its top.
  const double far_tangent = (base + relief - bent.drop_m(far) - height) / far;
  const double focal =
      plane ? 0.5 * secret_width / std::tan(0.5 * to_radians(camera.field_of_view_deg))
            : secret_width / to_radians(camera.field_of_view_deg);
  const double above = (0.5 - 1.0 / 7.0) * secret_height / focal;
  camera.pitch_deg = to_degrees(plane ? std::atan(far_tangent) - std::atan(above)
                                      : std::atan(far_tangent - above));
}

void prepare(SecretScene& scene) {
  const glm::dvec2 eye(scene.camera.eye);
  scene.map.reset();
  scene.tracer.reset();
  scene.deformation = std::make_unique<Deformation>(scene.deform, eye);
  scene.surface = std::make_unique<DeformedSurface>(
      deform(scene.drawn_m, scene.dem->transform, glm::dvec3(eye, 0.0), *scene.deformation));
  scene.made_camera = make_camera(scene.camera);
  scene.tracer = std::make_unique<Tracer>(*scene.surface);
  scene.map = std::make_unique<GeoMap>(scene.dem->altitude_m, scene.goes_to, scene.dem->transform,
                                       *scene.deformation, *scene.surface, *scene.made_camera,
                                       *scene.tracer);
}

// Share of the picture below its upper fifth that shows ground.
double ground_share(const SecretScene& scene) {
  int all = 0, ground = 0;
  for (int y = secret_height / 5; y < secret_height; y += 24)
    for (int x = 12; x < secret_width; x += 24) {
      ++all;
      ground += scene.map->to_geo({x, y}) ? 1 : 0;
    }
  return static_cast<double>(ground) / all;
}

// Mountains that a painter moves, on ground that is seen.
void draw_handles(SecretScene& scene, Draws& draws) {
  const std::size_t count = 3 + draws.below(4);
  const std::vector<SeenPixel> seen = seen_pixels(scene, 60, draws.below(1U << 30U));
  for (const SeenPixel& at : seen) {
    if (scene.deform.handles.size() == count) break;
    DeformHandle handle;
    handle.centre = at.position;
    handle.radius_m = draws.between(2500.0, 7000.0);
    handle.core_m = handle.radius_m * draws.between(0.3, 0.5);
    const bool apart = std::all_of(scene.deform.handles.begin(), scene.deform.handles.end(),
                                   [&](const DeformHandle& other) {
                                     return glm::length(handle.centre - other.centre) >
                                            0.8 * (handle.radius_m + other.radius_m);
                                   });
    const double far = std::min(2000.0, (handle.radius_m - handle.core_m) / 2.2);
    const double length = draws.between(200.0, far);
    const double azimuth = draws.between(0.0, 360.0);
    const double turn = draws.between(15.0, 50.0) * draws.sign();
    const double turned = draws.between(0.0, 1.0);
    const double raise = draws.between(0.0, 350.0);
    const double raised = draws.between(0.0, 1.0);
    if (!apart) continue;
    handle.move_m = length * direction(azimuth);
    if (turned < 0.5) handle.rotate_deg = turn;
    if (raised < 0.4) handle.raise_m = raise;
    scene.deform.handles.push_back(handle);
  }
  for (std::size_t i = 0; i < 2 && i < seen.size(); ++i) {
    const SeenPixel& at = seen[seen.size() - 1 - i];
    SummitExaggeration summit;
    summit.centre = at.position;
    summit.radius_m = draws.between(2500.0, 5000.0);
    summit.factor = draws.between(1.15, 1.35);
    summit.base_m = at.altitude_m - 400.0;
    scene.deform.summits.push_back(summit);
  }
}

void widen(SecretScene& scene, Draws& draws) {
  const double widened = draws.between(0.0, 1.0);
  const double width = draws.between(250.0, 450.0);
  scene.drawn_m = scene.dem->altitude_m;
  if (widened < 0.5) return;
  scene.widened_m = width;
  WidenedValleys wide = widen_valleys(scene.dem->altitude_m, {}, {}, scene.dem->cell_m(),
                                      {.width_m = static_cast<float>(width)}, silent_progress());
  scene.drawn_m = std::move(wide.altitude_m);
  scene.goes_to = std::move(wide.goes_to);
}

// Whether a cell is higher or lower than all around it, or a pass: four or more changes between
// higher and lower on its way around.
bool is_landmark(const Grid<float>& z, int x, int y) {
  constexpr int reach = 3;
  constexpr int ring[8][2] = {{-1, -1}, {0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}};
  if (x < reach || y < reach || x + reach >= z.width() || y + reach >= z.height()) return false;
  int higher = 0, lower = 0, changes = 0;
  bool last = z(x - reach, y) > z(x, y);
  for (const auto& step : ring) {
    const bool is_higher = z(x + reach * step[0], y + reach * step[1]) > z(x, y);
    (is_higher ? higher : lower) += 1;
    changes += is_higher != last ? 1 : 0;
    last = is_higher;
  }
  return higher == 0 || lower == 0 || changes >= 4;
}

}  // namespace

double Draws::between(double low, double high) {
  return low + (high - low) * random_uniform(seed_, 0, 0, count_++);
}

double Draws::normal(double deviation) { return deviation * random_normal(seed_, 1, 0, count_++); }

std::size_t Draws::below(std::size_t count) {
  return random_index(static_cast<std::uint32_t>(count), seed_, 2, 0, count_++);
}

const std::vector<SecretRegion>& secret_regions() {
  static const std::vector<SecretRegion> regions = {
      {"karwendel", "innsbruck/innsbruck_utm32_30m.tif", 60.0, 42000.0},
      {"rainier", "rainier/mt_rainier_90m.tif", 90.0, 60000.0},
      {"oetztal", "oetztal/srtm_oetztal.tif", 80.0, 36000.0},
      {"zion", "zion/srtm.tif", 80.0, 34000.0},
  };
  return regions;
}

Dem read_secret_region(const SecretRegion& region, const std::string& data_folder) {
  DemParameters parameters;
  RasterSource source;
  source.path = data_folder + "/" + region.file;
  parameters.sources = {source};
  parameters.cell_m = region.cell_m;
  return read_dem(parameters, silent_progress());
}

bool SecretScene::on_moved_ground(glm::dvec2 position) const {
  return std::any_of(deform.handles.begin(), deform.handles.end(), [&](const DeformHandle& h) {
    return glm::length(position - h.centre) < 0.8 * h.radius_m;
  });
}

SecretScene make_secret_scene(const Dem& dem, const SecretRegion& region, std::uint64_t seed) {
  Draws draws(seed);
  SecretScene scene;
  scene.dem = &dem;
  constexpr int tries = 100;
  constexpr double min_ground = 0.85;
  scene.drawn_m = dem.altitude_m;
  bool good = false;
  for (int i = 0; i < tries && !good; ++i) {
    scene.deform = {};
    draw_view(scene, region, draws);
    prepare(scene);
    good = ground_share(scene) >= min_ground;
  }
  if (!good) throw Error(ErrorKind::bug, region.name, "no view shows enough ground");
  draw_handles(scene, draws);
  widen(scene, draws);
  prepare(scene);
  const std::vector<SeenPixel> seen = seen_pixels(scene, 400, seed);
  for (const SeenPixel& at : seen)
    scene.moved_share += scene.on_moved_ground(at.position) ? 1.0 / 400.0 : 0.0;
  return scene;
}

std::string secret_scene_text(const SecretScene& secret, const SecretRegion& region) {
  Scene scene;
  scene.title = region.name;
  SceneSource& source = scene.terrain.sources.emplace_back();
  source.file = region.file.substr(region.file.find('/') + 1);
  scene.terrain.dem.cell_m = region.cell_m;
  scene.output.width = secret.camera.width;
  scene.output.height = secret.camera.height;
  scene.output.sheet_width_mm = secret.camera.width / 2.0;
  scene.camera.projection = secret.camera.projection;
  scene.camera.position = glm::dvec2(secret.camera.eye);
  scene.camera.height_m = secret.camera.eye.z;
  scene.camera.azimuth_deg = secret.camera.azimuth_deg;
  scene.camera.pitch_deg = secret.camera.pitch_deg;
  scene.camera.tilt_deg = 0.0;
  scene.camera.field_of_view_deg = secret.camera.field_of_view_deg;
  scene.deform.ground = secret.deform;
  scene.deform.exaggeration = secret.deform.exaggeration;
  scene.deform.exaggeration_base_m = secret.deform.exaggeration_base_m;
  scene.deform.bend_radius_m = secret.deform.bend.radius_m;
  scene.deform.bend_crest_m = secret.deform.bend.crest_m;
  scene.deform.allow_folds = true;
  scene.generalize.valleys.width_m = static_cast<float>(secret.widened_m);
  for (const SummitExaggeration& summit : secret.deform.summits)
    scene.deform.summits.push_back(
        {.name = "", .position = summit.centre, .position_lonlat = {}, .summit = summit});
  for (const DeformHandle& handle : secret.deform.handles)
    scene.deform.handles.push_back(scene_handle(handle));
  return write_scene(scene);
}

std::string secret_pairs_text(const SecretScene& scene, const SecretPairs& pairs) {
  std::string text = "x_px,y_px,lon,lat,name\n";
  for (std::size_t i = 0; i < pairs.pairs.size(); ++i) {
    const ControlPair& pair = pairs.pairs[i];
    const glm::dvec2 at = transform_point(scene.dem->crs, "EPSG:4326", pair.position);
    text += fmt::format("{:.2f},{:.2f},{:.7f},{:.7f},{} {}\n", pair.pixel.x, pair.pixel.y, at.x,
                        at.y, pairs.wrong[i] ? "wrong" : "place", i + 1);
  }
  return text;
}

std::vector<SeenPixel> seen_pixels(const SecretScene& scene, std::size_t count,
                                   std::uint64_t seed) {
  Draws draws(mix_bits(seed + 1));
  std::vector<SeenPixel> out;
  while (out.size() < count) {
    const double x = draws.between(0.0, secret_width);
    const double y = draws.between(0.0, secret_height);
    if (const std::optional<GeoPosition> at = scene.map->to_geo({x, y}))
      out.push_back({{x, y}, at->position, at->altitude_m});
  }
  return out;
}

SecretPairs make_secret_pairs(const SecretScene& scene, const SecretPairsParameters& parameters,
                              std::uint64_t seed) {
  Draws draws(mix_bits(seed + 2));
  constexpr int columns = 10, rows = 6;
  std::vector<std::vector<SeenPixel>> fields(columns * rows);
  const Dem& dem = *scene.dem;
  for (int y = 0; y < dem.height(); ++y)
    for (int x = 0; x < dem.width(); ++x) {
      if (!is_landmark(dem.altitude_m, x, y)) continue;
      const glm::dvec2 position = dem.transform.to_crs(x, y);
      const auto at = scene.map->to_image(position);
      if (!at || !at->visible) continue;
      const int column =
          std::min(columns - 1, static_cast<int>(at->pixel.x * columns / secret_width));
      const int row = std::min(rows - 1, static_cast<int>(at->pixel.y * rows / secret_height));
      fields[static_cast<std::size_t>(row * columns + column)].push_back(
          {at->pixel, position, altitude_at(dem, position)});
    }
  // From fields in random order, again and again until there are enough.
  SecretPairs out;
  std::vector<std::size_t> order;
  while (out.pairs.size() < parameters.count) {
    if (order.empty())
      for (std::size_t i = 0; i < fields.size(); ++i) order.push_back(i);
    const std::size_t pick = draws.below(order.size());
    std::vector<SeenPixel>& field = fields[order[pick]];
    order.erase(order.begin() + static_cast<std::ptrdiff_t>(pick));
    if (field.empty()) continue;
    const std::size_t chosen = draws.below(field.size());
    const SeenPixel landmark = field[chosen];
    field.erase(field.begin() + static_cast<std::ptrdiff_t>(chosen));
    ControlPair pair;
    pair.position = landmark.position;
    pair.altitude_m = landmark.altitude_m;
    pair.pixel.x = landmark.pixel.x + draws.normal(parameters.sigma_px);
    pair.pixel.y = landmark.pixel.y + draws.normal(parameters.sigma_px);
    out.pairs.push_back(pair);
  }
  out.wrong.assign(out.pairs.size(), false);
  const auto wrong = static_cast<std::size_t>(
      std::lround(parameters.wrong_share * static_cast<double>(out.pairs.size())));
  for (std::size_t i = 0; i < wrong; ++i) {
    const std::size_t k = draws.below(out.pairs.size());
    if (out.wrong[k]) {
      --i;
      continue;
    }
    out.wrong[k] = true;
    const double across = draws.between(30.0, 220.0) * draws.sign();
    const double up = 0.5 * draws.between(30.0, 220.0) * draws.sign();
    out.pairs[k].pixel += glm::dvec2(across, up);
  }
  for (ControlPair& pair : out.pairs)
    pair.pixel = {std::clamp(pair.pixel.x, 0.0, double{secret_width}),
                  std::clamp(pair.pixel.y, 0.0, double{secret_height})};
  return out;
}

}  // namespace belvedere::bench
