#include "renderer/trace/relief_sketch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

#include "base/filter.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "renderer/trace/guidance_ground.h"
#include "renderer/trace/guidance_rays.h"

namespace belvedere {
namespace {

constexpr glm::vec3 sky{0.80F, 0.87F, 0.93F};
constexpr glm::vec3 land_shade{0.25F, 0.29F, 0.36F};
constexpr glm::vec3 land_light{0.96F, 0.94F, 0.88F};
constexpr glm::vec3 mark_shade{0.44F, 0.56F, 0.14F};
constexpr glm::vec3 mark_light{0.88F, 0.93F, 0.30F};
constexpr double air_m = 140000.0;  // distance over which the relief pales to two thirds

}  // namespace

Grid<glm::vec3> make_relief_sketch(const Grid<float>& altitude_m, const GeoTransform& transform,
                                   const Grid<std::uint8_t>& marked, const Deformation& deformation,
                                   const Tracer& tracer, const Camera& camera,
                                   glm::dvec3 sun_direction) {
  const std::vector<glm::dvec2> samples = pixel_sample_positions(4);
  const glm::dvec3 sun = glm::normalize(sun_direction);
  const auto colour = [&](const Hit& hit) {
    if (!hit.found) return sky;
    const glm::dvec2 slope = sample_gradient(altitude_m, transform, hit.column, hit.row);
    const glm::dvec2 position = transform.to_crs(hit.column, hit.row);
    const glm::dmat3 shape =
        deformation.shape_jacobian({position, sample_bilinear(altitude_m, hit.column, hit.row)});
    glm::dvec3 normal = glm::normalize(
        glm::cross(shape * glm::dvec3(1.0, 0.0, slope.x), shape * glm::dvec3(0.0, 1.0, slope.y)));
    if (normal.z < 0.0) normal = -normal;
    const auto light =
        static_cast<float>(std::clamp(0.15 + 0.85 * glm::dot(normal, sun), 0.0, 1.0));
    const bool mark =
        !marked.empty() && marked.clamped(static_cast<int>(std::lround(hit.column)),
                                          static_cast<int>(std::lround(hit.row))) != 0;
    const glm::vec3 land =
        mark ? glm::mix(mark_shade, mark_light, light) : glm::mix(land_shade, land_light, light);
    const auto air = static_cast<float>(0.8 * (1.0 - exact::exp(-hit.distance_m / air_m)));
    return glm::mix(land, sky, mark ? 0.5F * air : air);
  };
  Grid<glm::vec3> picture(camera.size().x, camera.size().y);
  parallel_tiles(picture.width(), picture.height(), 32, [&](PixelRect tile) {
    std::array<Ray, 16> rays;
    std::array<Hit, 16> hits;
    const auto count = static_cast<std::size_t>(samples.size());
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        for (std::size_t k = 0; k < count; ++k) rays[k] = camera.ray(glm::dvec2(x, y) + samples[k]);
        tracer.intersect(std::span(rays).first(count), std::span(hits).first(count));
        glm::vec3 sum(0.F);
        for (std::size_t k = 0; k < count; ++k) sum += colour(hits[k]);
        picture(x, y) = sum / static_cast<float>(count);
      }
    }
  });
  return picture;
}

Grid<LandCoverClass> trace_classes(const TerrainModel& terrain, const Tracer& tracer,
                                   const Camera& camera) {
  const glm::ivec2 size = camera.size();
  const glm::dvec2 position = pixel_sample_positions(1).front();
  Grid<LandCoverClass> classes(size.x, size.y, LandCoverClass::sky);
  parallel_rows(size.y, [&](int y) {
    constexpr int bundle = 16;  // rays that the tracer takes at once
    std::array<Ray, bundle> rays;
    std::array<Hit, bundle> hits;
    for (int x0 = 0; x0 < size.x; x0 += bundle) {
      const auto count = static_cast<std::size_t>(std::min(bundle, size.x - x0));
      for (std::size_t i = 0; i < count; ++i)
        rays[i] = camera.ray(glm::dvec2(x0 + static_cast<int>(i), y) + position);
      tracer.intersect(std::span(rays).first(count), std::span(hits).first(count));
      for (std::size_t i = 0; i < count; ++i)
        if (hits[i].found)
          classes(x0 + static_cast<int>(i), y) =
              class_at(ground_of(terrain, hits[i].window), hits[i].column, hits[i].row);
    }
  });
  return classes;
}

}  // namespace belvedere
