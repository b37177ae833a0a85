#include "renderer/trace/sketch/class_view.h"

#include <algorithm>
#include <array>
#include <span>

#include "base/parallel.h"
#include "renderer/trace/guidance_ground.h"
#include "renderer/trace/guidance_rays.h"

namespace belvedere {

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
