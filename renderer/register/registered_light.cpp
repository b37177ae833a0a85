#include "renderer/register/registered_light.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/statistics.h"
#include "renderer/world/picture_parameters.h"
#include "renderer/world/world.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {
namespace {

constexpr double blur_share = 2.0 / 1200.0;  // of the width, find_painting_light's blur
constexpr double other_light_deg = 25.0;
constexpr double blend_share = 0.25;  // of a region's width on the map

double bearing_from(glm::dvec2 eye, glm::dvec2 at) {
  const double bearing = to_degrees(exact::atan2(at.x - eye.x, at.y - eye.y));
  return bearing < 0.0 ? bearing + 360.0 : bearing;
}

// The points farthest in each of sixteen directions: corners of a convex outline, counterclockwise.
std::vector<glm::dvec2> convex_outline(const std::vector<glm::dvec2>& points) {
  constexpr int directions = 16;
  std::vector<glm::dvec2> out;
  for (int k = 0; k < directions; ++k) {
    const exact::Turn turn = exact::turn(to_radians(360.0 * k / directions));
    const auto along = [&](glm::dvec2 p) { return turn.cosine * p.x + turn.sine * p.y; };
    const glm::dvec2 farthest =
        *std::max_element(points.begin(), points.end(),
                          [&](glm::dvec2 a, glm::dvec2 b) { return along(a) < along(b); });
    const glm::dvec2 corner = glm::round(farthest);
    if (out.empty() || (corner != out.back() && corner != out.front())) out.push_back(corner);
  }
  return out;
}

// The ground of some pixels without the nearest and the farthest twentieth of it.
std::vector<glm::dvec2> outline_of(const std::vector<std::size_t>& pixels,
                                   const GuidanceBuffers& guidance) {
  constexpr double left_out = 0.05;
  constexpr std::size_t min_pixels = 50;
  if (pixels.size() < min_pixels) return {};
  std::vector<float> distances;
  for (const std::size_t i : pixels) distances.push_back(guidance.depth_m[i]);
  const float near = value_at_share(distances, left_out);
  const float far = value_at_share(distances, 1.0 - left_out);
  std::vector<glm::dvec2> points;
  for (const std::size_t i : pixels)
    if (guidance.depth_m[i] >= near && guidance.depth_m[i] <= far)
      points.push_back(glm::dvec2(guidance.position_m[i]) + glm::dvec2(guidance.origin_m));
  return convex_outline(points);
}

double width_of(const std::vector<glm::dvec2>& outline) {
  double area = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 a = outline[i] - outline[0],
                     b = outline[(i + 1) % outline.size()] - outline[0];
    area += 0.5 * (a.x * b.y - a.y * b.x);
  }
  return std::sqrt(std::abs(area));
}

}  // namespace

GuidanceBuffers trace_registered_guidance(const LoadedScene& loaded, std::shared_ptr<const Dem> dem,
                                          glm::ivec2 size_px, const Run& run) {
  LoadedScene sized = loaded;
  sized.scene.output.width = size_px.x;
  sized.scene.output.height = size_px.y;
  const World world = make_world(sized, run.progress, run.cache, {.dem = std::move(dem)});
  return trace_view(world, view_of(world), {0, 0, size_px.x, size_px.y}, run);
}

RegisteredLight find_registered_light(const Grid<glm::vec3>& painting,
                                      const GuidanceBuffers& guidance, glm::dvec2 eye) {
  Grid<std::uint8_t> labels(painting.width(), painting.height(), unused_label);
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (!guidance.is_sky(i)) labels[i] = static_cast<std::uint8_t>(guidance.land_cover[i]);
  PaintingLightParameters parameters;
  parameters.blur_px = blur_share * painting.width();
  const PaintingLight found = find_painting_light(painting, labels, guidance, parameters);
  RegisteredLight out{found.whole, 0.0,
                      Grid<RegisteredRegion>(parameters.columns, parameters.rows)};
  Grid<std::vector<std::size_t>> pixels(parameters.columns, parameters.rows);
  std::vector<std::size_t> all;
  for (int y = 0; y < labels.height(); ++y)
    for (int x = 0; x < labels.width(); ++x) {
      const std::size_t i = labels.index(x, y);
      if (labels[i] == unused_label) continue;
      pixels(x * parameters.columns / labels.width(), y * parameters.rows / labels.height())
          .push_back(i);
      all.push_back(i);
    }
  const auto bearing_of = [&](const std::vector<std::size_t>& of) {
    glm::dvec2 mean(0.0);
    for (const std::size_t i : of)
      mean += (glm::dvec2(guidance.position_m[i]) + glm::dvec2(guidance.origin_m)) /
              static_cast<double>(of.size());
    return bearing_from(eye, mean);
  };
  out.bearing_deg = bearing_of(all);
  for (std::size_t k = 0; k < pixels.size(); ++k)
    out.regions[k] = {found.regions[k], bearing_of(pixels[k]), outline_of(pixels[k], guidance)};
  return out;
}

std::vector<RegisteredRegion> regions_of_other_light(const RegisteredLight& light) {
  std::vector<RegisteredRegion> out;
  for (const RegisteredRegion& region : light.regions)
    if (region.sun.differs() && region.outline.size() >= 3 &&
        std::abs(std::remainder(region.sun.azimuth_deg - light.sun.azimuth_deg, 360.0)) >
            other_light_deg)
      out.push_back(region);
  return out;
}

void light_scene(const RegisteredLight& light, Scene& scene) {
  if (!light.sun.trusted()) return;
  scene.sun.azimuth_deg = std::round(light.sun.azimuth_deg);
  scene.sun.altitude_deg = std::round(light.sun.altitude_deg);
  for (const RegisteredRegion& region : regions_of_other_light(light)) {
    SceneLightRegion& added = scene.light_regions.emplace_back();
    added.name = fmt::format("part {} of the painting", scene.light_regions.size());
    added.points = region.outline;
    added.azimuth_deg = std::round(region.sun.azimuth_deg);
    added.altitude_deg = std::round(region.sun.altitude_deg);
    added.blend_m = std::round(blend_share * width_of(region.outline));
  }
}

}  // namespace belvedere
