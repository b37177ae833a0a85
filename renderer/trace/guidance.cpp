#include "renderer/trace/guidance.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/filter.h"
#include "renderer/trace/guidance_ground.h"
#include "renderer/trace/guidance_rays.h"
#include "renderer/trace/silhouette.h"
#include "terrain/shape/derivatives.h"

namespace belvedere {
namespace {

constexpr double same_surface = 0.03;  // depths within 3 % belong together

void check_range(const char* key, double value, double lowest, double highest) {
  if (value >= lowest && value <= highest) return;
  throw Error(ErrorKind::usage, key, fmt::format("{}", value), fmt::format("{} to {}", lowest, highest));
}

void check_parameters(const GuidanceParameters& p) {
  if (p.pixel_samples != 1 && p.pixel_samples != 4 && p.pixel_samples != 9 && p.pixel_samples != 16) {
    throw Error(ErrorKind::usage, "sampling.pixel_samples", fmt::format("{}", p.pixel_samples), "1, 4, 9 or 16");
  }
  check_range("sampling.shadow_rays", p.shadow_rays, 1, 64);
  check_range("sampling.sky_directions", p.sky_directions, 0, 256);
  check_range("sampling.sky_reach_m", p.sky_reach_m, 1, 1e6);
  check_range("shadow bias", p.shadow_bias_m, 0, 100);
  check_range("sun.radius_deg", p.sun_radius_rad, 0, 0.5);
  check_range("length of the sun's direction", glm::length(p.sun_direction), 0.5, 2.0);
  check_range("tile size", p.tile_size, trace_block_px, 4096);
}

// All that a block of pixels is traced with.
struct Tracing {
  const TerrainModel& terrain;
  const DeformedSurface& surface;
  const Tracer& tracer;
  const Camera& camera;
  const GuidanceParameters& parameters;
  std::vector<glm::dvec2> pixel_places;
  std::vector<glm::dvec2> sun_places;
  std::vector<SkyDirection> sky_directions;
};

// What one primary ray of a pixel saw.
struct Seen {
  Hit hit;
  LandCoverClass land_cover = LandCoverClass::sky;
};

LandCoverClass class_at(const TerrainModel& terrain, double column, double row) {
  const glm::dvec2 origin = origin_of(terrain, column, row);
  const glm::dvec2 place = terrain.dem->transform.to_crs(origin.x, origin.y);
  const LandCoverClass found = terrain.land_cover->at(place.x, place.y);
  return found == LandCoverClass::sky ? LandCoverClass::rock : found;
}

// The sample that gives the pixel its values: of the class that most samples saw (ties to the lower id) the one nearest the
// pixel's middle (ties to the first).
std::size_t choose_sample(std::span<const Seen> samples, std::span<const glm::dvec2> places) {
  std::array<int, land_cover_class_count> votes{};
  for (const Seen& seen : samples) ++votes[static_cast<std::size_t>(seen.land_cover)];
  const auto winner = static_cast<LandCoverClass>(std::max_element(votes.begin(), votes.end()) - votes.begin());
  std::size_t best = samples.size();
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double distance = glm::length(places[k] - glm::dvec2(0.5));
    // Places at the same distance differ by rounding only.
    if (samples[k].land_cover == winner && distance < best_distance - 1e-9) {
      best = k;
      best_distance = distance;
    }
  }
  return best;
}

// Ground metres that a pixel is wide at a hit: how far apart the rays through its left and right edge are there.
float footprint(const Camera& camera, glm::dvec2 pixel, double distance_m) {
  const Ray left = camera.ray({pixel.x, pixel.y + 0.5});
  const Ray right = camera.ray({pixel.x + 1.0, pixel.y + 0.5});
  return static_cast<float>(glm::length(right.origin + right.direction * distance_m - left.origin - left.direction * distance_m));
}

GuidanceBuffers make_buffers(int width, int height) {
  GuidanceBuffers b;
  b.depth_m = Grid<float>(width, height, std::numeric_limits<float>::infinity());
  b.position_m = Grid<glm::vec3>(width, height, glm::vec3(0.F));
  b.normal = b.normal_detail = b.normal_smooth = Grid<glm::vec3>(width, height, glm::vec3(0.F, 0.F, 1.F));
  b.land_cover = Grid<LandCoverClass>(width, height, LandCoverClass::sky);
  b.shadow = b.sky_view = Grid<float>(width, height, 1.F);
  b.fall_line = b.grain = Grid<glm::vec2>(width, height, glm::vec2(0.F));
  for (Grid<float>* channel : {&b.altitude_m, &b.coverage, &b.front, &b.slope_deg, &b.aspect_deg, &b.footprint_m, &b.ridge, &b.relief_s_m,
                               &b.relief_m_m, &b.relief_l_m, &b.valley_height_m, &b.rim_m, &b.built}) {
    *channel = Grid<float>(width, height, 0.F);
  }
  return b;
}

// Traces the primary rays of a block. samples[i] belongs to pixel i.
using BlockSamples = std::vector<Seen>;  // pixel_samples for each pixel in turn
void trace_primary(const Tracing& t, glm::ivec2 corner, BlockSamples& samples) {
  const std::size_t per_pixel = t.pixel_places.size();
  samples.assign(trace_block_pixels * per_pixel, Seen{});
  std::array<Ray, trace_block_pixels> rays;
  std::array<Hit, trace_block_pixels> hits;
  for (std::size_t k = 0; k < per_pixel; ++k) {
    for (int i = 0; i < trace_block_pixels; ++i) {
      rays[static_cast<std::size_t>(i)] = t.camera.ray(glm::dvec2(corner + block_pixel(i)) + t.pixel_places[k]);
    }
    t.tracer.intersect(rays, hits);
    for (std::size_t i = 0; i < trace_block_pixels; ++i) {
      Seen& seen = samples[i * per_pixel + k];
      seen.hit = hits[i];
      if (hits[i].found) seen.land_cover = class_at(t.terrain, hits[i].column, hits[i].row);
    }
  }
}

// Traces one block and writes those of its pixels that lie in the region.
void trace_block(const Tracing& t, glm::ivec2 corner, PixelRect region, GuidanceBuffers& out) {
  thread_local BlockSamples samples;
  trace_primary(t, corner, samples);
  const std::size_t per_pixel = t.pixel_places.size();
  BlockSurface block;
  block.corner = corner;
  std::array<std::size_t, trace_block_pixels> chosen{};
  bool any_terrain = false;
  for (int p = 0; p < trace_block_pixels; ++p) {
    const auto i = static_cast<std::size_t>(p);
    const std::span<const Seen> seen = std::span(samples).subspan(i * per_pixel, per_pixel);
    chosen[i] = choose_sample(seen, t.pixel_places);
    const Hit& hit = seen[chosen[i]].hit;
    if (!hit.found) continue;
    any_terrain = true;
    const Ray ray = t.camera.ray(glm::dvec2(corner + block_pixel(p)) + t.pixel_places[chosen[i]]);
    const glm::dvec3 normal = hit.facet_normal();
    block.pixels[i] = {true, hit.distance_m, ray.origin + ray.direction * hit.distance_m + normal * t.parameters.shadow_bias_m, normal};
  }
  BlockValues sun{};
  BlockValues sky{};
  if (any_terrain) {
    if (t.parameters.sun_direction.z > 0.0) {
      sun = trace_sun(t.tracer, block, t.sun_places, t.parameters.sun_direction, t.parameters.sun_radius_rad);
    }
    sky = trace_sky(t.tracer, block, t.sky_directions, t.parameters.sky_reach_m);
  }

  for (int p = 0; p < trace_block_pixels; ++p) {
    const glm::ivec2 pixel = corner + block_pixel(p);
    if (pixel.x < region.x0 || pixel.y < region.y0 || pixel.x >= region.x1 || pixel.y >= region.y1) continue;
    const std::size_t o = out.depth_m.index(pixel.x - region.x0, pixel.y - region.y0);
    const auto i = static_cast<std::size_t>(p);
    const std::span<const Seen> seen = std::span(samples).subspan(i * per_pixel, per_pixel);
    const Seen& winner = seen[chosen[i]];
    int terrain_samples = 0;
    int front_samples = 0;
    for (const Seen& s : seen) {
      terrain_samples += s.hit.found ? 1 : 0;
      const bool together = s.hit.found && std::abs(s.hit.distance_m - winner.hit.distance_m) <= same_surface * winner.hit.distance_m;
      front_samples += (winner.hit.found ? together : !s.hit.found) ? 1 : 0;
    }
    out.coverage[o] = static_cast<float>(terrain_samples) / static_cast<float>(per_pixel);
    out.front[o] = static_cast<float>(front_samples) / static_cast<float>(per_pixel);
    if (!winner.hit.found) continue;
    const GroundValues ground = sample_ground(t.terrain, t.surface, t.camera, winner.hit.column, winner.hit.row);
    out.depth_m[o] = static_cast<float>(winner.hit.distance_m);
    out.position_m[o] = glm::vec3(ground.place - t.surface.origin);
    out.normal[o] = ground.normal;
    out.normal_detail[o] = ground.normal_detail;
    out.normal_smooth[o] = ground.normal_smooth;
    out.altitude_m[o] = static_cast<float>(ground.place.z);
    out.land_cover[o] = winner.land_cover;
    out.shadow[o] = sun[i];
    out.sky_view[o] = sky[i];
    out.slope_deg[o] = ground.slope_deg;
    out.aspect_deg[o] = ground.aspect_deg;
    out.fall_line[o] = ground.fall_line;
    out.footprint_m[o] = footprint(t.camera, glm::dvec2(pixel), winner.hit.distance_m);
    out.ridge[o] = ground.ridge;
    out.relief_s_m[o] = ground.relief_s_m;
    out.relief_m_m[o] = ground.relief_m_m;
    out.relief_l_m[o] = ground.relief_l_m;
    out.valley_height_m[o] = ground.valley_height_m;
    out.rim_m[o] = ground.rim_m;
    out.built[o] = ground.built;
    out.grain[o] = ground.grain;
  }
}

}  // namespace

namespace {

// 1 where the known terrain ends: the border's own posts and the filled voids that reach the border. A void in the middle of known
// terrain is a flaw that filling has mended, no end of the world.
Grid<std::uint8_t> outside(const Dem& dem) {
  const int width = dem.width();
  const int height = dem.height();
  Grid<std::uint8_t> out(width, height, 0);
  std::vector<glm::ivec2> open;
  const auto mark = [&](int x, int y) {
    if (!out.contains(x, y) || out(x, y) != 0) return;
    out(x, y) = 1;
    open.emplace_back(x, y);
  };
  for (int x = 0; x < width; ++x) mark(x, 0), mark(x, height - 1);
  for (int y = 0; y < height; ++y) mark(0, y), mark(width - 1, y);
  if (dem.filled.empty()) return out;
  while (!open.empty()) {
    const glm::ivec2 at = open.back();
    open.pop_back();
    for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
      const glm::ivec2 next = at + step;
      if (dem.filled.contains(next.x, next.y) && dem.filled(next.x, next.y) != 0) mark(next.x, next.y);
    }
  }
  return out;
}

// Distance of every post to the nearest that lies outside.
Grid<float> rim_distance(const Dem& dem) {
  const int width = dem.width();
  const int height = dem.height();
  const Grid<std::int32_t> nearest = nearest_marked(outside(dem));
  Grid<float> distance(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const int at = nearest(x, y);
      const int across = at % width - x;
      const int down = at / width - y;
      distance(x, y) = static_cast<float>(std::hypot(across * dem.transform.cell_x, down * dem.transform.cell_y));
    }
  });
  return distance;
}

}  // namespace

TerrainModel make_terrain_model(std::shared_ptr<const Dem> dem, Grid<float> generalized_m, std::shared_ptr<const LandCover> land_cover,
                                double exaggeration) {
  if (!dem->altitude_m.same_size(generalized_m)) {
    throw Error(ErrorKind::bug, "terrain model",
                fmt::format("a generalized grid of {} × {} cells", generalized_m.width(), generalized_m.height()),
                fmt::format("the DEM's {} × {}", dem->width(), dem->height()));
  }
  TerrainModel model;
  const double cell_m = dem->cell_m();
  const Grid<float>& z = dem->altitude_m;
  model.detail_smooth_m = gaussian_blur(z, 60.0 / cell_m);
  model.shape_smooth_m = gaussian_blur(generalized_m, 120.0 / cell_m);
  model.relief_s_m = relief(z, cell_m, 30.0, 180.0);
  model.relief_m_m = relief(z, cell_m, 30.0, 750.0);
  model.relief_l_m = relief(z, cell_m, 120.0, 1800.0);
  model.valley_height_m = height_above_valley(z, cell_m, 900.0);
  model.rim_m = rim_distance(*dem);
  model.floor_plan = plan_floor(*land_cover, *dem);
  model.dem = std::move(dem);
  model.generalized_m = std::move(generalized_m);
  model.land_cover = std::move(land_cover);
  model.exaggeration = exaggeration;
  return model;
}

GuidanceBuffers trace_guidance(const TerrainModel& terrain, const DeformedSurface& surface, const Tracer& tracer, const Camera& camera,
                               const GuidanceParameters& parameters, PixelRect region, Progress& progress) {
  check_parameters(parameters);
  const glm::ivec2 size = camera.size();
  if (region.x0 < 0 || region.y0 < 0 || region.x1 > size.x || region.y1 > size.y || region.width() < 1 || region.height() < 1) {
    throw Error(ErrorKind::bug, "guidance", fmt::format("pixels {}…{} × {}…{}", region.x0, region.x1, region.y0, region.y1),
                fmt::format("a part of {} × {}", size.x, size.y));
  }
  if (!surface.vertices_m.same_size(terrain.dem->altitude_m)) throw Error(ErrorKind::bug, "guidance", "surface and terrain differ in size");

  const Tracing tracing{terrain,
                        surface,
                        tracer,
                        camera,
                        parameters,
                        pixel_sample_places(parameters.pixel_samples),
                        disc_places(parameters.shadow_rays),
                        sky_directions((parameters.sky_directions + 3) / 4)};
  GuidanceBuffers out = make_buffers(region.width(), region.height());
  out.origin_m = surface.origin;
  progress.begin("trace", static_cast<double>(region.width()) * region.height());
  // Blocks lie at multiples of their size of the whole picture; tiles are whole blocks.
  const int bx0 = region.x0 / trace_block_px;
  const int by0 = region.y0 / trace_block_px;
  const int across = (region.x1 + trace_block_px - 1) / trace_block_px - bx0;
  const int down = (region.y1 + trace_block_px - 1) / trace_block_px - by0;
  parallel_tiles(across, down, std::max(parameters.tile_size / trace_block_px, 1), [&](PixelRect blocks) {
    for (int y = blocks.y0; y < blocks.y1; ++y) {
      for (int x = blocks.x0; x < blocks.x1; ++x) {
        trace_block(tracing, glm::ivec2(bx0 + x, by0 + y) * trace_block_px, region, out);
      }
    }
    progress.advance(static_cast<double>(blocks.width()) * blocks.height() * trace_block_pixels * region.width() * region.height() /
                     (static_cast<double>(across) * down * trace_block_pixels));
  });
  if (parameters.sky_directions > 0) out.sky_view = mean_of_squares(out.sky_view, out.depth_m);
  out.silhouette = find_silhouettes(out.depth_m);
  return out;
}

}  // namespace belvedere
