#include "renderer/paint/water/water_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/error.h"
#include "base/filter.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "renderer/trace/guidance_ground.h"
#include "renderer/trace/guidance_rays.h"

namespace belvedere {
namespace {

// Radius around the nearest shore for the bank's slope: the cells next to a lake are often as level
// as the lake.
constexpr int bank_cells = 6;

// Metres between a cell and one of an index.
double way_m(const Dem& dem, int x, int y, std::int32_t to) {
  return exact::hypot((to % dem.width() - x) * dem.transform.cell_x,
                      (to / dem.width() - y) * dem.transform.cell_y);
}

// Rise over run of the land around a cell of the shore.
double bank_slope(const Dem& dem, const Grid<std::uint8_t>& water,
                  const Grid<std::int32_t>& nearest_water, std::int32_t shore,
                  const WaterBedParameters& p) {
  const double half_cell_m = 0.5 * dem.cell_m();
  const int x0 = shore % dem.width();
  const int y0 = shore / dem.width();
  double rise = 0.0;
  double run = 0.0;
  for (int y = y0 - bank_cells; y <= y0 + bank_cells; ++y)
    for (int x = x0 - bank_cells; x <= x0 + bank_cells; ++x) {
      if (!water.contains(x, y) || water(x, y) != 0) continue;
      const std::int32_t from = nearest_water(x, y);
      if (from < 0) continue;
      rise += static_cast<double>(dem.altitude_m(x, y)) -
              static_cast<double>(dem.altitude_m[static_cast<std::size_t>(from)]);
      run += way_m(dem, x, y, from) - half_cell_m;
    }
  return run > 0.0 ? std::clamp(rise / run, p.flattest_bank, p.steepest_bank) : p.flattest_bank;
}

}  // namespace

WaterBeds make_water_beds(const Grid<std::uint8_t>& water, const Dem& dem,
                          const WaterBedParameters& p) {
  if (!water.same_size(dem.altitude_m))
    throw Error(ErrorKind::bug, "beds of water", "the mask and the DEM differ in size");
  const int width = dem.width();
  const int height = dem.height();
  const double half_cell_m = 0.5 * dem.cell_m();
  Grid<std::uint8_t> land(width, height);
  for (std::size_t i = 0; i < land.size(); ++i) land[i] = water[i] == 0 ? 1 : 0;
  const Grid<std::int32_t> nearest_land = nearest_marked(land);
  const Grid<std::int32_t> nearest_water = nearest_marked(water);

  WaterBeds beds{Grid<float>(width, height, 0.0F), Grid<float>(width, height, 0.0F)};
  // Broad water is a lake, and so is water within half a river's width of it.
  const double broad_m = std::max(0.5 * p.river_width_m, 2.0 * half_cell_m);
  Grid<std::uint8_t> broad(width, height, 0);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      if (water(x, y) == 0) continue;
      const std::int32_t shore = nearest_land(x, y);
      if (shore < 0) {  // water everywhere
        broad(x, y) = 1;
        beds.depth_m(x, y) = static_cast<float>(p.deepest_m);
        continue;
      }
      const double off_m = std::max(way_m(dem, x, y, shore) - half_cell_m, 0.0);
      broad(x, y) = off_m >= broad_m ? 1 : 0;
      const double slope = bank_slope(dem, water, nearest_water, shore, p);
      beds.depth_m(x, y) =
          static_cast<float>(p.deepest_m * (1.0 - exact::exp(-slope * off_m / p.deepest_m)));
    }
  });
  const Grid<std::int32_t> nearest_broad = nearest_marked(broad);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const std::int32_t centre = nearest_broad(x, y);
      if (water(x, y) == 0 || centre < 0) continue;
      const double beyond_m = way_m(dem, x, y, centre) - broad_m - half_cell_m;
      beds.lake(x, y) = static_cast<float>(1.0 - smoothstep(0.0, p.river_width_m, beyond_m));
    }
  });
  return beds;
}

WaterGround::Place WaterGround::at(glm::dvec2 position_m) const {
  const glm::dvec2 seen = terrain->dem->transform.to_cell(position_m.x, position_m.y);
  const glm::dvec2 cell = origin_of(*terrain, seen.x, seen.y);
  return {sample_bilinear(beds.depth_m, cell.x, cell.y),
          sample_bilinear(beds.lake, cell.x, cell.y)};
}

std::shared_ptr<const WaterGround> find_water_ground(const TerrainModel& terrain) {
  const Raster<LandCoverClass>& classes = terrain.land_cover->classes;
  if (std::find(classes.cells.begin(), classes.cells.end(), LandCoverClass::water) ==
      classes.cells.end())
    return nullptr;
  const Dem& dem = *terrain.dem;
  Grid<std::uint8_t> water(dem.width(), dem.height(), 0);
  parallel_rows(dem.height(), [&](int y) {
    for (int x = 0; x < dem.width(); ++x) {
      const glm::dvec2 position = dem.transform.to_crs(x, y);
      const glm::dvec2 cell = classes.transform.to_cell(position.x, position.y);
      const LandCoverClass id = classes.cells.clamped(static_cast<int>(std::lround(cell.x)),
                                                      static_cast<int>(std::lround(cell.y)));
      water(x, y) = id == LandCoverClass::water ? 1 : 0;
    }
  });
  WaterGround ground;
  ground.terrain = &terrain;
  ground.beds = make_water_beds(water, dem);
  return std::make_shared<const WaterGround>(std::move(ground));
}

namespace {

constexpr double normal_step_m =
    20.0;  // between the positions whose deformed neighbours give the tilt of the water

struct MirrorTracing {
  const TerrainModel& terrain;
  const Deformation& deformation;
  const Tracer& tracer;
  const Camera& camera;
  const MirrorParameters& parameters;
};

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr Ray no_ray{glm::dvec3(nan), glm::dvec3(nan)};

// Undeformed position of a hit, at the altitude drawn there.
glm::dvec3 position_of(const TerrainModel& ground, const Hit& hit) {
  return {ground.dem->transform.to_crs(hit.column, hit.row),
          static_cast<double>(sample_bilinear(ground.generalized_m, hit.column, hit.row))};
}

glm::vec3 light_normal(const TerrainModel& ground, const Hit& hit) {
  const glm::dvec2 slope =
      sample_gradient(ground.shape_smooth_m, ground.dem->transform, hit.column, hit.row);
  if (!ground.local)
    return glm::vec3(glm::normalize(glm::dvec3(-slope * ground.exaggeration, 1.0)));
  const glm::dmat3 jacobian = ground.local->shape_jacobian(position_of(ground, hit));
  const glm::dvec3 normal = glm::cross(jacobian * glm::dvec3(1.0, 0.0, slope.x),
                                       jacobian * glm::dvec3(0.0, 1.0, slope.y));
  return glm::vec3(glm::normalize(normal.z < 0.0 ? -normal : normal));
}

// Every pixel of a block is traced, so that a ray has the same neighbours in its bundle whatever
// region is requested.
void trace_block(const MirrorTracing& t, glm::ivec2 corner, PixelRect region, MirrorSight& out) {
  std::array<Ray, trace_block_pixels> rays;
  std::array<Hit, trace_block_pixels> waters;
  for (int p = 0; p < trace_block_pixels; ++p)
    rays[static_cast<std::size_t>(p)] =
        t.camera.ray(glm::dvec2(corner + block_pixel(p)) + glm::dvec2(0.5));
  t.tracer.intersect(rays, waters);

  std::array<double, trace_block_pixels> cosine{};
  std::array<Ray, trace_block_pixels> mirrored;
  std::array<Hit, trace_block_pixels> hits;
  for (std::size_t p = 0; p < trace_block_pixels; ++p) {
    mirrored[p] = no_ray;
    const Hit& water = waters[p];
    if (!water.found) continue;
    const TerrainModel& ground = ground_of(t.terrain, water.window);
    if (class_at(ground, water.column, water.row) != LandCoverClass::water) continue;
    const glm::dvec3 normal = water_normal(t.deformation, position_of(ground, water));
    const double facing = -glm::dot(rays[p].direction, normal);
    if (!(facing > 0.0)) continue;
    cosine[p] = facing;
    mirrored[p] = {
        rays[p].origin + rays[p].direction * water.distance_m + normal * t.parameters.bias_m,
        rays[p].direction + 2.0 * facing * normal};
  }
  t.tracer.intersect(mirrored, hits);

  std::array<Ray, trace_block_pixels> to_sun;
  std::array<std::uint8_t, trace_block_pixels> blocked{};
  for (std::size_t p = 0; p < trace_block_pixels; ++p) {
    to_sun[p] = no_ray;
    if (!hits[p].found) continue;
    const glm::dvec3 from = mirrored[p].origin + mirrored[p].direction * hits[p].distance_m;
    to_sun[p] = {from + hits[p].facet_normal() * t.parameters.bias_m, t.parameters.sun_direction};
  }
  const bool sun_is_up = t.parameters.sun_direction.z > 0.0;
  if (sun_is_up) t.tracer.occluded(to_sun, 1e9, blocked);

  for (int k = 0; k < trace_block_pixels; ++k) {
    const auto p = static_cast<std::size_t>(k);
    const glm::ivec2 pixel = corner + block_pixel(k);
    if (pixel.x < region.x0 || pixel.y < region.y0 || pixel.x >= region.x1 ||
        pixel.y >= region.y1 || !(cosine[p] > 0.0))
      continue;
    const std::size_t o = out.cosine.index(pixel.x - region.x0, pixel.y - region.y0);
    out.cosine[o] = static_cast<float>(cosine[p]);
    out.distance_m[o] = static_cast<float>(waters[p].distance_m);
    out.rise[o] = static_cast<float>(mirrored[p].direction.z);
    const Hit& hit = hits[p];
    if (!hit.found) continue;
    const TerrainModel& ground = ground_of(t.terrain, hit.window);
    const LandCoverClass id = class_at(ground, hit.column, hit.row);
    if (id == LandCoverClass::water)
      continue;  // the same water, where its cells are not quite level: reflects the sky
    out.path_m[o] = static_cast<float>(hit.distance_m);
    out.land_cover[o] = id;
    out.altitude_m[o] = sample_bilinear(ground.dem->altitude_m, hit.column, hit.row);
    out.normal[o] = light_normal(ground, hit);
    out.shadow[o] = sun_is_up && blocked[p] == 0 ? 1.0F : 0.0F;
  }
}

}  // namespace

glm::dvec3 water_normal(const Deformation& deformation, glm::dvec3 position) {
  const auto moved = [&](double east, double north) {
    return deformation.point(position + glm::dvec3(east, north, 0.0));
  };
  const glm::dvec3 normal = glm::cross(moved(normal_step_m, 0.0) - moved(-normal_step_m, 0.0),
                                       moved(0.0, normal_step_m) - moved(0.0, -normal_step_m));
  return glm::normalize(normal.z < 0.0 ? -normal : normal);
}

MirrorSight trace_mirror(const TerrainModel& terrain, const DeformedSurface& surface,
                         const Deformation& deformation, const Tracer& tracer, const Camera& camera,
                         const MirrorParameters& parameters, const Grid<std::uint8_t>& wanted,
                         PixelRect region) {
  const int width = region.width();
  const int height = region.height();
  if (wanted.width() != width || wanted.height() != height)
    throw Error(ErrorKind::bug, "mirrored rays", "mask and region differ in size");
  if (surface.windows.size() != terrain.windows.size())
    throw Error(ErrorKind::bug, "mirrored rays", "surface and terrain differ in windows");
  MirrorSight out;
  out.cosine = out.distance_m = out.rise = out.altitude_m = out.shadow =
      Grid<float>(width, height, 0.0F);
  out.path_m = Grid<float>(width, height, std::numeric_limits<float>::infinity());
  out.land_cover = Grid<LandCoverClass>(width, height, LandCoverClass::sky);
  out.normal = Grid<glm::vec3>(width, height, glm::vec3(0.0F, 0.0F, 1.0F));
  MirrorParameters checked = parameters;
  checked.sun_direction = glm::normalize(parameters.sun_direction);
  const MirrorTracing tracing{terrain, deformation, tracer, camera, checked};
  const int bx0 = region.x0 / trace_block_px;
  const int by0 = region.y0 / trace_block_px;
  const int across = (region.x1 + trace_block_px - 1) / trace_block_px - bx0;
  const int down = (region.y1 + trace_block_px - 1) / trace_block_px - by0;
  parallel_tiles(
      across, down, std::max(parameters.tile_size / trace_block_px, 1), [&](PixelRect blocks) {
        for (int y = blocks.y0; y < blocks.y1; ++y)
          for (int x = blocks.x0; x < blocks.x1; ++x) {
            const glm::ivec2 corner = glm::ivec2(bx0 + x, by0 + y) * trace_block_px;
            const PixelRect held =
                moved(intersection(region, {corner.x, corner.y, corner.x + trace_block_px,
                                            corner.y + trace_block_px}),
                      -region.x0, -region.y0);
            bool any = false;
            for (int v = held.y0; v < held.y1 && !any; ++v)
              for (int u = held.x0; u < held.x1 && !any; ++u) any = wanted(u, v) != 0;
            if (any) trace_block(tracing, corner, region, out);
          }
      });
  return out;
}

}  // namespace belvedere
