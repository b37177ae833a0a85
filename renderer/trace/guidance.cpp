#include "renderer/trace/guidance.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "base/error.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "renderer/trace/guidance_ground.h"

namespace belvedere {
namespace {

constexpr double strength_per_log = 14.0;
constexpr double surely_less =
    1.0 - 1e-9;  // of ratios: with any rounding, the difference of their logarithms is below 0

// 0 is sky; also outside the picture, where nothing can be predicted.
double inverse_depth(const Grid<float>& depth_m, int x, int y) {
  if (!depth_m.contains(x, y)) return 0.0;
  const double depth = depth_m(x, y);
  return std::isfinite(depth) && depth > 0.0 ? 1.0 / depth : 0.0;
}

// Depth ratio from `here` to the next pixel, predicted by a plane through `before` and `here`, ≥ 1;
// 1 without a plane.
double foretold_from_near(double before, double here) {
  if (before <= here) return 1.0;  // rising towards the viewer, or nothing there
  const double next = 2.0 * here - before;
  // A plane that vanishes before the next pixel explains any depth there.
  return next > 0.0 ? here / next : std::numeric_limits<double>::infinity();
}

// The same from the far side: a plane through `there` and `beyond` continued to the near pixel.
double foretold_from_far(double there, double beyond) {
  if (beyond <= 0.0 || beyond >= there) return 1.0;
  return (2.0 * there - beyond) / there;
}

}  // namespace

Grid<float> find_silhouettes(const Grid<float>& depth_m) {
  struct Step {
    int x;
    int y;
  };
  constexpr std::array<Step, 4> steps{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  Grid<float> silhouette(depth_m.width(), depth_m.height());
  parallel_rows(depth_m.height(), [&](int y) {
    for (int x = 0; x < depth_m.width(); ++x) {
      const double here = inverse_depth(depth_m, x, y);
      if (here <= 0.0) continue;
      double strongest = 0.0;
      for (const auto& [dx, dy] : steps) {
        if (!depth_m.contains(x + dx, y + dy)) continue;
        const double there = inverse_depth(depth_m, x + dx, y + dy);
        if (there >= here) continue;
        if (there <= 0.0) {
          strongest = 1.0;
          continue;
        }
        const double jump = here / there;
        const double near = foretold_from_near(inverse_depth(depth_m, x - dx, y - dy), here);
        const double far = foretold_from_far(there, inverse_depth(depth_m, x + 2 * dx, y + 2 * dy));
        // Logarithms take most of the time: they are skipped where a plane predicts more than there
        // is.
        if (jump < std::max(near, far) * surely_less) continue;
        const double foretold = std::max(exact::log(near), exact::log(far));
        strongest = std::max(strongest, strength_per_log * (exact::log(jump) - foretold));
      }
      silhouette(x, y) = static_cast<float>(std::clamp(strongest, 0.0, 1.0));
    }
  });
  return silhouette;
}

namespace {

constexpr double depth_tolerance = 0.03;  // depths within 3 % are one surface

void check_range(const char* key, double value, double lowest, double highest) {
  if (value >= lowest && value <= highest) return;
  throw Error(ErrorKind::usage, key, fmt::format("{}", value),
              fmt::format("{} to {}", lowest, highest));
}

void check_parameters(const GuidanceParameters& p) {
  if (p.sampling.pixel_samples != 1 && p.sampling.pixel_samples != 4 &&
      p.sampling.pixel_samples != 9 && p.sampling.pixel_samples != 16) {
    throw Error(ErrorKind::usage, "pixel_samples", fmt::format("{}", p.sampling.pixel_samples),
                "1, 4, 9 or 16");
  }
  check_range("shadow_rays", p.sampling.shadow_rays, 1, 64);
  check_range("sky_directions", p.sampling.sky_directions, 0, 256);
  check_range("sky_reach_m", p.sampling.sky_reach_m, 1, 1e6);
  check_range("shadow bias", p.shadow_bias_m, 0, 100);
  check_range("sun_radius_rad", p.sun_radius_rad, 0, 0.5);
  check_range("length of the sun's direction", glm::length(p.sun_direction), 0.5, 2.0);
  check_range("tile size", p.tile_size, trace_block_px, 4096);
}

// Everything needed to trace a block of pixels.
struct Tracing {
  const TerrainModel& terrain;
  const DeformedSurface& surface;
  const Tracer& tracer;
  const Camera& camera;
  const GuidanceParameters& parameters;
  std::vector<glm::dvec2> pixel_positions;
  std::vector<glm::dvec2> sun_places;
  std::vector<SkyDirection> sky_directions;
  bool classes = true;  // false: the class of what is seen is not looked up, if it decides nothing
};

// The result of one primary ray of a pixel.
struct Seen {
  Hit hit;
  LandCoverClass land_cover = LandCoverClass::sky;
};

// The sample that gives the pixel its values: of the class hit by most samples (ties: the lower id)
// the one nearest the pixel's centre (ties: the first).
std::size_t choose_sample(std::span<const Seen> samples, std::span<const glm::dvec2> positions) {
  std::array<int, land_cover_class_count> votes{};
  for (const Seen& seen : samples) ++votes[static_cast<std::size_t>(seen.land_cover)];
  const auto winner =
      static_cast<LandCoverClass>(std::max_element(votes.begin(), votes.end()) - votes.begin());
  std::size_t best = samples.size();
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double distance = glm::length(positions[k] - glm::dvec2(0.5));
    // Positions at the same distance differ by rounding only.
    if (samples[k].land_cover == winner && distance < best_distance - 1e-9) {
      best = k;
      best_distance = distance;
    }
  }
  return best;
}

// Width of a pixel in ground metres at a hit: the distance there between the rays through its left
// and right edge.
float footprint(const Camera& camera, glm::dvec2 pixel, double distance_m) {
  const Ray left = camera.ray({pixel.x, pixel.y + 0.5});
  const Ray right = camera.ray({pixel.x + 1.0, pixel.y + 0.5});
  return static_cast<float>(glm::length(right.origin + right.direction * distance_m - left.origin -
                                        left.direction * distance_m));
}

// Size of the ground in a pixel, as the root of its area: at grazing angles it is longer than wide.
// Limited to about five times the width: flatter ground is seen as a line.
double ground_width_m(const Hit& hit, const Ray& ray, float footprint_m) {
  constexpr double flattest = 0.04;
  const double facing = std::abs(glm::dot(glm::normalize(ray.direction), hit.facet_normal()));
  return static_cast<double>(footprint_m) / std::sqrt(std::max(facing, flattest));
}

GuidanceBuffers make_buffers(int width, int height) {
  GuidanceBuffers buffers;
  // All threads take part in first writing new memory.
  const std::span<const GuidanceChannel> channels = guidance_channels();
  parallel_ranges(channels.size(), std::size_t{1}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i)
      if (channels[i].maker == ChannelMaker::trace)
        fill_channel(buffers, channels[i], width, height, channels[i].sky);
  });
  return buffers;
}

// The sample nearest a pixel's centre; of several the first.
std::size_t central_sample(std::span<const glm::dvec2> positions) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < positions.size(); ++k)
    if (glm::length(positions[k] - glm::dvec2(0.5)) <
        glm::length(positions[best] - glm::dvec2(0.5)) - 1e-9)
      best = k;
  return best;
}

// A ray through each of some pixels, traced together.
void trace_pixels(const Tracing& t, std::span<const glm::ivec2> pixels, glm::dvec2 within,
                  std::span<Seen> seen) {
  std::array<Ray, trace_block_pixels> rays;
  std::array<Hit, trace_block_pixels> hits;
  const std::size_t count = pixels.size();
  for (std::size_t i = 0; i < count; ++i) rays[i] = t.camera.ray(glm::dvec2(pixels[i]) + within);
  t.tracer.intersect(std::span(rays).first(count), std::span(hits).first(count));
  for (std::size_t i = 0; i < count; ++i) {
    seen[i] = {hits[i], LandCoverClass::sky};
    if (hits[i].found && t.classes)
      seen[i].land_cover =
          class_at(ground_of(t.terrain, hits[i].window), hits[i].column, hits[i].row);
  }
}

// The pixels of a block and those around it, by what their central rays see.
class BlockSight {
 public:
  static constexpr int side = trace_block_px + 2;

  void set(glm::ivec2 at, const Seen& seen) {
    const std::size_t i = place(at);
    depth_m_[i] = seen.hit.found ? static_cast<float>(seen.hit.distance_m) : -1.F;
    land_cover_[i] = seen.land_cover;
  }
  // Whether a pixel and the eight around it see one class and one surface: then its further rays
  // would see the same.
  bool is_even(glm::ivec2 at) const {
    constexpr float same_depth = 0.02F;
    const std::size_t own = place(at);
    const float tolerance = same_depth * std::abs(depth_m_[own]);
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const std::size_t other = place(at + glm::ivec2(x, y));
        if (land_cover_[other] != land_cover_[own] ||
            std::abs(depth_m_[other] - depth_m_[own]) > tolerance)
          return false;
      }
    return true;
  }

 private:
  static std::size_t place(glm::ivec2 at) {  // from -1 to trace_block_px
    return static_cast<std::size_t>((at.y + 1) * side + at.x + 1);
  }
  std::array<float, side * side> depth_m_{};
  std::array<LandCoverClass, side * side> land_cover_{};
};

// The pixels around a block.
const std::vector<glm::ivec2>& pixels_around_block() {
  static const std::vector<glm::ivec2> all = [] {
    std::vector<glm::ivec2> pixels;
    for (int i = -1; i <= trace_block_px; ++i) {
      pixels.push_back({i, -1});
      pixels.push_back({i, trace_block_px});
    }
    for (int i = 0; i < trace_block_px; ++i) {
      pixels.push_back({-1, i});
      pixels.push_back({trace_block_px, i});
    }
    return pixels;
  }();
  return all;
}

// Traces the primary rays of a block. samples[i] belongs to pixel i. One ray a pixel first; the
// others only where that one and those of the pixels around it do not see the same. What is traced
// together depends on the block alone.
using BlockSamples = std::vector<Seen>;  // pixel_samples for each pixel in turn
void trace_primary(const Tracing& t, glm::ivec2 corner, BlockSamples& samples) {
  const std::size_t per_pixel = t.pixel_positions.size();
  const std::size_t central = central_sample(t.pixel_positions);
  samples.assign(trace_block_pixels * per_pixel, Seen{});
  std::array<glm::ivec2, trace_block_pixels> pixels;
  std::array<Seen, trace_block_pixels> seen;
  for (int i = 0; i < trace_block_pixels; ++i)
    pixels[static_cast<std::size_t>(i)] = corner + block_pixel(i);
  trace_pixels(t, pixels, t.pixel_positions[central], seen);
  if (per_pixel == 1) {
    std::copy(seen.begin(), seen.end(), samples.begin());
    return;
  }
  BlockSight sight;
  for (int i = 0; i < trace_block_pixels; ++i)
    sight.set(block_pixel(i), seen[static_cast<std::size_t>(i)]);
  const std::vector<glm::ivec2>& around = pixels_around_block();
  std::array<glm::ivec2, trace_block_pixels> outside;
  std::array<Seen, trace_block_pixels> seen_outside;
  for (std::size_t i = 0; i < around.size(); ++i) outside[i] = corner + around[i];
  trace_pixels(t, std::span(outside).first(around.size()), t.pixel_positions[central],
               seen_outside);
  for (std::size_t i = 0; i < around.size(); ++i) sight.set(around[i], seen_outside[i]);

  std::array<std::size_t, trace_block_pixels> open;
  std::size_t count = 0;
  for (int p = 0; p < trace_block_pixels; ++p) {
    const auto i = static_cast<std::size_t>(p);
    std::fill_n(samples.begin() + static_cast<std::ptrdiff_t>(i * per_pixel), per_pixel, seen[i]);
    if (sight.is_even(block_pixel(p))) continue;
    pixels[count] = corner + block_pixel(p);
    open[count++] = i;
  }
  for (std::size_t k = 0; k < per_pixel && count > 0; ++k) {
    if (k == central) continue;
    trace_pixels(t, std::span(pixels).first(count), t.pixel_positions[k], seen);
    for (std::size_t i = 0; i < count; ++i) samples[open[i] * per_pixel + k] = seen[i];
  }
}

// The sun of each pixel of a block; false where all have the picture's.
bool local_suns(const Tracing& t, const BlockSamples& samples,
                const std::array<std::size_t, trace_block_pixels>& chosen,
                std::array<glm::dvec3, trace_block_pixels>& suns) {
  suns.fill(t.parameters.sun_direction);
  if (!t.parameters.light_field || !t.parameters.light_field->turns_sun()) return false;
  bool turned = false;
  for (std::size_t i = 0; i < trace_block_pixels; ++i) {
    const Hit& hit = samples[i * t.pixel_positions.size() + chosen[i]].hit;
    if (!hit.found) continue;
    suns[i] = t.parameters.light_field
                  ->at(ground_of(t.terrain, hit.window).dem->transform.to_crs(hit.column, hit.row))
                  .sun;
    turned = turned || suns[i] != t.parameters.sun_direction;
  }
  return turned;
}

// What the primary rays of a block see.
struct BlockSeen {
  BlockSamples samples;
  std::array<std::size_t, trace_block_pixels> chosen{};  // of the samples of each pixel
  BlockSurface block;
  bool any_terrain = false;
};

// One per thread, so that tracing allocates nothing.
BlockSeen& see_block(const Tracing& t, glm::ivec2 corner) {
  thread_local BlockSeen seen_block;
  auto& [samples, chosen, block, any_terrain] = seen_block;
  trace_primary(t, corner, samples);
  const std::size_t per_pixel = t.pixel_positions.size();
  block = {};
  block.corner = corner;
  any_terrain = false;
  for (int p = 0; p < trace_block_pixels; ++p) {
    const auto i = static_cast<std::size_t>(p);
    const std::span<const Seen> seen = std::span(samples).subspan(i * per_pixel, per_pixel);
    chosen[i] = choose_sample(seen, t.pixel_positions);
    const Hit& hit = seen[chosen[i]].hit;
    if (!hit.found) continue;
    any_terrain = true;
    const Ray ray =
        t.camera.ray(glm::dvec2(corner + block_pixel(p)) + t.pixel_positions[chosen[i]]);
    const glm::dvec3 normal = hit.facet_normal();
    block.pixels[i] = {
        true, hit.distance_m,
        ray.origin + ray.direction * hit.distance_m + normal * t.parameters.shadow_bias_m, normal};
  }
  return seen_block;
}

// 1 where the pixels of a block see all of the sun, 0 in its shadow and where there is no terrain.
BlockValues sun_of(const Tracing& t, const BlockSeen& of) {
  if (!of.any_terrain || t.parameters.sun_direction.z <= 0.0) return {};
  std::array<glm::dvec3, trace_block_pixels> own;
  const bool turned = local_suns(t, of.samples, of.chosen, own);
  return trace_sun(
      t.tracer, of.block, t.sun_places,
      turned ? std::span<const glm::dvec3>(own) : std::span(&t.parameters.sun_direction, 1),
      t.parameters.sun_radius_rad);
}

bool is_in(PixelRect region, glm::ivec2 pixel) {
  return pixel.x >= region.x0 && pixel.y >= region.y0 && pixel.x < region.x1 && pixel.y < region.y1;
}

// Traces one block and writes its pixels inside the region.
void trace_block(const Tracing& t, glm::ivec2 corner, PixelRect region, GuidanceBuffers& out) {
  const BlockSeen& of = see_block(t, corner);
  const auto& [samples, chosen, block, any_terrain] = of;
  const std::size_t per_pixel = t.pixel_positions.size();
  const BlockValues sun = sun_of(t, of);
  BlockValues sky{};
  if (any_terrain)
    sky = trace_sky(t.tracer, block, t.sky_directions, t.parameters.sampling.sky_reach_m);

  for (int p = 0; p < trace_block_pixels; ++p) {
    const glm::ivec2 pixel = corner + block_pixel(p);
    if (!is_in(region, pixel)) continue;
    const std::size_t o = out.depth_m.index(pixel.x - region.x0, pixel.y - region.y0);
    const auto i = static_cast<std::size_t>(p);
    const std::span<const Seen> seen = std::span(samples).subspan(i * per_pixel, per_pixel);
    const Seen& winner = seen[chosen[i]];
    int terrain_samples = 0;
    int front_samples = 0;
    for (const Seen& s : seen) {
      terrain_samples += s.hit.found ? 1 : 0;
      const bool together = s.hit.found && std::abs(s.hit.distance_m - winner.hit.distance_m) <=
                                               depth_tolerance * winner.hit.distance_m;
      front_samples += (winner.hit.found ? together : !s.hit.found) ? 1 : 0;
    }
    out.coverage[o] = static_cast<float>(terrain_samples) / static_cast<float>(per_pixel);
    out.front[o] = static_cast<float>(front_samples) / static_cast<float>(per_pixel);
    if (!winner.hit.found) continue;
    out.depth_m[o] = static_cast<float>(winner.hit.distance_m);
    out.land_cover[o] = winner.land_cover;
    out.shadow[o] = sun[i];
    out.sky_view[o] = sky[i];
    out.footprint_m[o] = footprint(t.camera, glm::dvec2(pixel), winner.hit.distance_m);
    // Water is level.
    const bool bumpy = winner.land_cover != LandCoverClass::water;
    const Ray ray = t.camera.ray(glm::dvec2(pixel) + t.pixel_positions[chosen[i]]);
    sample_ground(ground_of(t.terrain, winner.hit.window), t.surface, t.camera, winner.hit.column,
                  winner.hit.row, out, o,
                  bumpy ? ground_width_m(winner.hit, ray, out.footprint_m[o]) : 0.0);
  }
}

}  // namespace

namespace {

// Calls trace(tracing, corner) for every block of a rectangle.
template <class TraceBlock>
void for_blocks(const TerrainModel& terrain, const DeformedSurface& surface, const Tracer& tracer,
                const Camera& camera, const GuidanceParameters& parameters, PixelRect region,
                bool classes, Progress& progress, const TraceBlock& trace) {
  check_parameters(parameters);
  const glm::ivec2 size = camera.size();
  if (region.x0 < 0 || region.y0 < 0 || region.x1 > size.x || region.y1 > size.y ||
      region.width() < 1 || region.height() < 1) {
    throw Error(ErrorKind::bug, "guidance",
                fmt::format("pixels {}…{} × {}…{}", region.x0, region.x1, region.y0, region.y1),
                fmt::format("a part of {} × {}", size.x, size.y));
  }
  if (!surface.vertices_m.same_size(terrain.dem->altitude_m))
    throw Error(ErrorKind::bug, "guidance", "surface and terrain differ in size");
  if (surface.windows.size() != terrain.windows.size())
    throw Error(ErrorKind::bug, "guidance", "surface and terrain differ in windows");
  // Posts of windows belong to their own grids: only the deformation itself can tell where a
  // position moved.
  for (const TerrainWindow& window : terrain.windows)
    if (!window.ground.local)
      throw Error(ErrorKind::bug, "guidance", "a window of the terrain has no deformation");

  const Tracing tracing{terrain,
                        surface,
                        tracer,
                        camera,
                        parameters,
                        pixel_sample_positions(parameters.sampling.pixel_samples),
                        disc_positions(parameters.sampling.shadow_rays),
                        sky_directions((parameters.sampling.sky_directions + 3) / 4),
                        classes};
  progress.begin("trace", static_cast<double>(region.width()) * region.height());
  // Blocks are at multiples of their size in the whole picture; tiles are whole blocks.
  const int bx0 = region.x0 / trace_block_px;
  const int by0 = region.y0 / trace_block_px;
  const int across = (region.x1 + trace_block_px - 1) / trace_block_px - bx0;
  const int down = (region.y1 + trace_block_px - 1) / trace_block_px - by0;
  parallel_tiles(across, down, std::max(parameters.tile_size / trace_block_px, 1),
                 [&](PixelRect blocks) {
                   for (int y = blocks.y0; y < blocks.y1; ++y)
                     for (int x = blocks.x0; x < blocks.x1; ++x)
                       trace(tracing, glm::ivec2(bx0 + x, by0 + y) * trace_block_px);
                   progress.advance(static_cast<double>(blocks.width()) * blocks.height() *
                                    trace_block_pixels * region.width() * region.height() /
                                    (static_cast<double>(across) * down * trace_block_pixels));
                 });
}

}  // namespace

GuidanceBuffers trace_guidance(const TerrainModel& terrain, const DeformedSurface& surface,
                               const Tracer& tracer, const Camera& camera,
                               const GuidanceParameters& parameters, PixelRect region,
                               Progress& progress) {
  GuidanceBuffers out = make_buffers(std::max(region.width(), 0), std::max(region.height(), 0));
  out.origin_m = surface.origin;
  for_blocks(terrain, surface, tracer, camera, parameters, region, true, progress,
             [&](const Tracing& t, glm::ivec2 corner) { trace_block(t, corner, region, out); });
  if (parameters.sampling.sky_directions > 0)
    out.sky_view = mean_of_squares(out.sky_view, out.depth_m);
  out.silhouette = find_silhouettes(out.depth_m);
  return out;
}

Grid<float> trace_shadows(const TerrainModel& terrain, const DeformedSurface& surface,
                          const Tracer& tracer, const Camera& camera,
                          const GuidanceParameters& parameters, PixelRect region,
                          Progress& progress) {
  const GuidanceChannel& shadow = channel_of(&GuidanceBuffers::shadow);
  GuidanceBuffers out;
  fill_channel(out, shadow, std::max(region.width(), 0), std::max(region.height(), 0), shadow.sky);
  // Of several rays a pixel, classes choose the one that counts.
  const bool classes = parameters.sampling.pixel_samples > 1;
  for_blocks(terrain, surface, tracer, camera, parameters, region, classes, progress,
             [&](const Tracing& t, glm::ivec2 corner) {
               const BlockSeen& of = see_block(t, corner);
               const BlockValues sun = sun_of(t, of);
               for (int p = 0; p < trace_block_pixels; ++p) {
                 const glm::ivec2 pixel = corner + block_pixel(p);
                 const auto i = static_cast<std::size_t>(p);
                 if (is_in(region, pixel) && of.block.pixels[i].terrain)
                   out.shadow(pixel.x - region.x0, pixel.y - region.y0) = sun[i];
               }
             });
  return out.shadow;
}

}  // namespace belvedere
