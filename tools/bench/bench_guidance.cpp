#include <fmt/core.h>

#include "renderer/trace/guidance.h"
#include "tools/bench/bench.h"
#include "tools/bench/bench_terrain.h"

namespace belvedere::bench {

std::vector<Measurement> bench_guidance(const Options&);

std::vector<Measurement> bench_guidance(const Options& options) {
  std::vector<Measurement> out;
  for (const int size : options.sizes) {
    const std::string name = fmt::format("{}²", size);
    Dem dem = make_bench_dem(size);
    const DeformedSurface surface = make_bench_surface(dem);
    const Tracer tracer(surface);
    const auto camera = make_camera(bench_view(dem, 2400, 1100));
    // Altitude bands as land cover: borders everywhere, as in a real map.
    LandCover cover;
    cover.classes.transform = dem.transform;
    cover.classes.cells = Grid<LandCoverClass>(size, size);
    for (std::size_t i = 0; i < cover.classes.cells.size(); ++i) {
      const float z = dem.altitude_m[i];
      cover.classes.cells[i] = z < 1700.F   ? LandCoverClass::forest
                               : z < 2300.F ? LandCoverClass::alpine_grass
                                            : LandCoverClass::rock;
    }
    Grid<float> generalized = dem.altitude_m;
    const auto shared_dem = std::make_shared<const Dem>(std::move(dem));
    const auto shared_cover = std::make_shared<const LandCover>(std::move(cover));
    TerrainModel terrain;
    const Cost model = measure([&] {
      terrain = make_terrain_model(shared_dem, std::move(generalized), shared_cover, 1.6);
    });
    out.push_back({name + "/terrain_model",
                   static_cast<double>(surface.vertices_m.size()) / model.cpu_s * 1e-6,
                   "Mcells/CPU s"});
    GuidanceBuffers buffers;
    const std::vector<Cost> trace =
        measure_fastest(options.repeats, {[&] {
                          buffers = trace_guidance(terrain, surface, tracer, *camera, {},
                                                   {0, 0, 2400, 1100}, silent_progress());
                        }});
    out.push_back({name + "/trace_2400x1100", trace[0].cpu_s, "CPU s"});
    out.push_back({name + "/trace_2400x1100_wall", trace[0].wall_s, "s"});
  }
  return out;
}

}  // namespace belvedere::bench
