#include "renderer/trace/guidance_ground.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/random.h"
#include "terrain/cover/map_cover.h"
#include "terrain/generalize/widen_valleys.h"
#include "terrain/layers/layer_noise.h"

namespace belvedere {
namespace {

constexpr double fall_line_step_m = 60.0;
constexpr double flat_gradient =
    0.002;  // 0.1°: below this, water and noise would give a random direction
constexpr float ridge_scale_m = 10.F;
// Vegetation has ragged borders: they are shifted by noise of two sizes, in cells of its raster.
// Without it near borders are scalloped, one cell per scallop, however smoothly classes are
// interpolated.
constexpr double fray_broad_cells = 0.95;  // deviation of the shift; its noise has patches of …
constexpr double fray_broad_sigma = 1.25;
constexpr double fray_fine_cells = 0.42;
constexpr double fray_fine_sigma = 0.40;
constexpr double fray_reach =
    1.5;  // cells: where the class is constant within this distance, there is no border nearby

bool frays(LandCoverClass id) {
  using enum LandCoverClass;
  return id == forest || id == pasture || id == alpine_grass || id == shrub || id == scree;
}

// Water, ice, walls and buildings keep their outlines.
// A map of exact lines and areas is read at a different position where a widened valley moved them
// (TerrainModel::goes_to): offset by `map_off`.
LandCoverClass class_of(const LandCover& cover, glm::dvec2 position, glm::dvec2 map_off) {
  if (map_off == glm::dvec2(0.0)) return cover.at(position.x, position.y);
  const LandCoverClass known = cover.laid_at(position + map_off);
  return known != LandCoverClass::sky ? known : cover.cell_at(position.x, position.y);
}

LandCoverClass frayed_class(const LandCover& cover, glm::dvec2 position, glm::dvec2 map_off) {
  const LandCoverClass found = class_of(cover, position, map_off);
  if (!frays(found)) return found;
  const double cell = 0.5 * (cover.classes.transform.cell_x + cover.classes.transform.cell_y);
  const double reach = fray_reach * cell;
  bool same = true;
  for (const glm::dvec2 corner :
       {glm::dvec2(1.0, 1.0), glm::dvec2(-1.0, 1.0), glm::dvec2(1.0, -1.0), glm::dvec2(-1.0, -1.0)})
    same = same && class_of(cover, position + reach * corner, map_off) == found;
  if (same) return found;
  const auto noise = [&](std::uint64_t part, double sigma) {
    return gaussian_noise(stream_seed(0, Stream::class_noise, part), position.x, position.y,
                          sigma * cell);
  };
  // One draw per statement.
  const double broad_x = noise(0xF0A0U, fray_broad_sigma);
  const double broad_y = noise(0xF0A1U, fray_broad_sigma);
  const double fine_x = noise(0xF0A2U, fray_fine_sigma);
  const double fine_y = noise(0xF0A3U, fray_fine_sigma);
  const double east =
      std::clamp(fray_broad_cells * broad_x + fray_fine_cells * fine_x, -fray_reach, fray_reach) *
      cell;
  const double north =
      std::clamp(fray_broad_cells * broad_y + fray_fine_cells * fine_y, -fray_reach, fray_reach) *
      cell;
  const LandCoverClass moved = class_of(cover, position + glm::dvec2(east, north), map_off);
  return frays(moved) ? moved : found;
}

// The four posts around a position and their weights, borders replicated.
struct Corners {
  int x0, y0, x1, y1;
  double fx, fy;

  template <class F>
  auto blend(F&& at) const {
    const auto top = at(x0, y0) * (1.0 - fx) + at(x1, y0) * fx;
    const auto low = at(x0, y1) * (1.0 - fx) + at(x1, y1) * fx;
    return top * (1.0 - fy) + low * fy;
  }
};

template <class T>
Corners corners(const Grid<T>& grid, double column, double row) {
  const double x = std::clamp(column, 0.0, static_cast<double>(grid.width() - 1));
  const double y = std::clamp(row, 0.0, static_cast<double>(grid.height() - 1));
  const int x0 = static_cast<int>(x);
  const int y0 = static_cast<int>(y);
  return {x0,     y0,    std::min(x0 + 1, grid.width() - 1), std::min(y0 + 1, grid.height() - 1),
          x - x0, y - y0};
}

float bilinear(const Grid<float>& grid, const Corners& at) {
  return static_cast<float>(
      at.blend([&](int x, int y) { return static_cast<double>(grid(x, y)); }));
}

glm::dvec2 gradient(const Grid<float>& z, const GeoTransform& transform, const Corners& at) {
  return at.blend([&](int x, int y) {
    const int west = std::max(x - 1, 0);
    const int east = std::min(x + 1, z.width() - 1);
    const int north = std::max(y - 1, 0);
    const int south = std::min(y + 1, z.height() - 1);
    const double run_x = std::max(east - west, 1) * transform.cell_x;
    const double run_y = std::max(south - north, 1) * transform.cell_y;
    return glm::dvec2((static_cast<double>(z(east, y)) - z(west, y)) / run_x,
                      (static_cast<double>(z(x, north)) - z(x, south)) / run_y);
  });
}

glm::vec3 upward_normal(glm::dvec2 slope) {
  return glm::vec3(glm::normalize(glm::dvec3(-slope.x, -slope.y, 1.0)));
}

// The slope of the ground for lighting, turned and steepened like its position. A fold's underside
// counts as upper side.
glm::vec3 shape_normal(const glm::dmat3& jacobian, glm::dvec2 slope) {
  const glm::dvec3 normal = glm::cross(jacobian * glm::dvec3(1.0, 0.0, slope.x),
                                       jacobian * glm::dvec3(0.0, 1.0, slope.y));
  return glm::vec3(glm::normalize(normal.z < 0.0 ? -normal : normal));
}

// A position of the smoothed shape in the deformed world: the shape exaggerated, moved as the
// surface's own posts were moved. (The posts themselves would give the fall line of every bump.)
glm::dvec3 smooth_deformed(const TerrainModel& terrain, const DeformedSurface& surface,
                           double column, double row) {
  const GeoTransform& transform = terrain.dem->transform;
  const Corners at = corners(terrain.generalized_m, column, row);
  if (terrain.local)
    return terrain.local->point(
        {transform.to_crs(column, row), bilinear(terrain.shape_smooth_m, at)});
  const glm::dvec3 moved = at.blend([&](int x, int y) {
    const glm::dvec2 post = transform.to_crs(x, y);
    return glm::dvec3(surface.vertices_m(x, y)) + surface.origin -
           glm::dvec3(post,
                      terrain.exaggeration * static_cast<double>(terrain.generalized_m(x, y)));
  });
  const glm::dvec2 position = transform.to_crs(column, row);
  return glm::dvec3(position, terrain.exaggeration *
                                  static_cast<double>(bilinear(terrain.shape_smooth_m, at))) +
         moved;
}

glm::vec2 image_fall_line(const TerrainModel& terrain, const DeformedSurface& surface,
                          const Camera& camera, double column, double row, glm::dvec2 slope) {
  const double steepness = glm::length(slope);
  if (steepness < flat_gradient) return glm::vec2(0.F);
  const glm::dvec2 downhill = -slope / steepness * fall_line_step_m;
  const GeoTransform& transform = terrain.dem->transform;
  const auto from = camera.project(smooth_deformed(terrain, surface, column, row));
  const auto to =
      camera.project(smooth_deformed(terrain, surface, column + downhill.x / transform.cell_x,
                                     row - downhill.y / transform.cell_y));
  if (!from || !to) return glm::vec2(0.F);
  const glm::dvec2 step = *to - *from;
  const double length = glm::length(step);
  return length > 1e-6 ? glm::vec2(step / length) : glm::vec2(0.F);
}

}  // namespace

glm::dvec2 sample_gradient(const Grid<float>& altitude_m, const GeoTransform& transform,
                           double column, double row) {
  return gradient(altitude_m, transform, corners(altitude_m, column, row));
}

glm::dvec2 origin_of(const TerrainModel& terrain, double column, double row) {
  glm::dvec2 origin(column, row);
  if (terrain.came_from.empty()) return origin;
  const Corners at = corners(terrain.generalized_m, column, row);
  return origin + at.blend([&](int x, int y) { return glm::dvec2(terrain.came_from(x, y)); });
}

LandCoverClass class_at(const TerrainModel& terrain, double column, double row) {
  const glm::dvec2 origin = origin_of(terrain, column, row);
  const glm::dvec2 position = terrain.dem->transform.to_crs(origin.x, origin.y);
  glm::dvec2 map_off(0.0);
  if (!terrain.goes_to.empty() &&
      (terrain.land_cover->map != nullptr || terrain.land_cover->inferred != nullptr)) {
    const glm::dvec2 known = origin_cell(terrain.goes_to, {column, row});
    map_off = terrain.dem->transform.to_crs(known.x, known.y) - position;
  }
  const LandCoverClass found = frayed_class(*terrain.land_cover, position, map_off);
  return found == LandCoverClass::sky ? LandCoverClass::rock : found;
}

void sample_ground(const TerrainModel& terrain, const DeformedSurface& surface,
                   const Camera& camera, double column, double row, GuidanceBuffers& out,
                   std::size_t i, double bumps_m) {
  const GeoTransform& transform = terrain.dem->transform;
  const Corners at = corners(terrain.generalized_m, column, row);
  const glm::dvec2 origin = origin_of(terrain, column, row);
  const Corners known = corners(terrain.dem->altitude_m, origin.x, origin.y);
  const glm::dvec3 position(transform.to_crs(column, row),
                            bilinear(terrain.dem->altitude_m, known));
  out.position_m[i] = glm::vec3(position - surface.origin);
  out.altitude_m[i] = static_cast<float>(position.z);

  glm::dvec2 slope_shown = gradient(terrain.generalized_m, transform, at);
  glm::dvec2 slope_detail = gradient(terrain.dem->altitude_m, transform, known);
  if (bumps_m > 0.0 && !terrain.land_cover->relief.bumps.empty()) {
    // The origin of moved ground.
    const glm::dvec2 bumps =
        bump_slope(terrain.land_cover->relief, transform.to_crs(origin.x, origin.y), bumps_m);
    slope_shown += bumps;
    slope_detail += bumps;
  }
  const glm::dvec2 shape = gradient(terrain.shape_smooth_m, transform, at);
  if (terrain.local) {
    const glm::dmat3 jacobian =
        terrain.local->shape_jacobian({glm::dvec2(position), bilinear(terrain.generalized_m, at)});
    out.normal[i] = shape_normal(jacobian, slope_shown);
    out.normal_detail[i] = shape_normal(jacobian, slope_detail * terrain.detail_boost);
    out.normal_smooth[i] = shape_normal(jacobian, shape);
  } else {
    out.normal[i] = upward_normal(slope_shown * terrain.exaggeration);
    out.normal_detail[i] =
        upward_normal(slope_detail * (terrain.exaggeration * terrain.detail_boost));
    out.normal_smooth[i] = upward_normal(shape * terrain.exaggeration);
  }
  out.fall_line[i] = image_fall_line(terrain, surface, camera, column, row, shape);

  const glm::dvec2 slope = gradient(terrain.detail_smooth_m, transform, known);
  out.slope_deg[i] = static_cast<float>(to_degrees(exact::atan(glm::length(slope))));
  // Downhill is opposite to the gradient; flat ground has aspect 0.
  if (slope != glm::dvec2(0.0)) {
    const double aspect = to_degrees(exact::atan2(-slope.x, -slope.y));
    out.aspect_deg[i] = static_cast<float>(aspect < 0.0 ? aspect + 360.0 : aspect);
  }
  out.relief_s_m[i] = bilinear(terrain.relief_s_m, known);
  out.relief_m_m[i] = bilinear(terrain.relief_m_m, known);
  out.relief_l_m[i] = bilinear(terrain.relief_l_m, known);
  out.ridge[i] = out.relief_s_m[i] / (std::abs(out.relief_s_m[i]) + ridge_scale_m);
  out.valley_height_m[i] = bilinear(terrain.valley_height_m, known);
  out.flow[i] = bilinear(terrain.flow, known);
  out.rim_m[i] = bilinear(terrain.rim_m, at);
  if (!terrain.floor_plan.built.empty()) {
    out.built[i] = bilinear(terrain.floor_plan.built, known);
    out.grain[i] = glm::vec2(
        known.blend([&](int x, int y) { return glm::dvec2(terrain.floor_plan.grain(x, y)); }));
  }
}

}  // namespace belvedere
