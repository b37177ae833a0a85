#include <fmt/core.h>

#include "terrain/deform/deform.h"
#include "tools/bench/bench.h"
#include "tools/bench/bench_terrain.h"

namespace belvedere::bench {

std::vector<Measurement> bench_deform(const Options&);

std::vector<Measurement> bench_deform(const Options& options) {
  std::vector<Measurement> out;
  for (const int size : options.sizes) {
    const Dem dem = make_bench_dem(size);
    const double side_m = size * dem.cell_m();
    const glm::dvec2 north = dem.transform.to_crs(0.5 * size, 0.0);
    const glm::dvec2 viewer(north.x, north.y + 0.4 * side_m);
    DeformParameters bent;
    bent.exaggeration = 1.6;
    bent.earth_curvature = true;
    bent.bend.points = {{0.4 * side_m, std::nullopt, 20.0},
                        {0.7 * side_m, std::nullopt, 12.0},
                        {side_m, std::nullopt, 6.0},
                        {1.4 * side_m, std::nullopt, 0.0}};
    // Three handles and three summits, each with a radius of a twentieth of the terrain.
    DeformParameters moved = bent;
    for (int i = 0; i < 3; ++i) {
      const glm::dvec2 position =
          dem.transform.to_crs(size * (0.25 + 0.25 * i), size * (0.3 + 0.2 * i));
      moved.handles.push_back({.centre = position,
                               .rotate_deg = 50.0,
                               .radius_m = 0.125 * side_m,
                               .core_m = 0.06 * side_m});
      moved.summits.push_back(
          {{position.x + 0.1 * side_m, position.y}, 0.125 * side_m, 1.3, 500.0});
    }
    const auto run = [&](const DeformParameters& parameters) {
      deform(dem.altitude_m, dem.transform, viewer, {viewer, 0.0}, parameters);
    };
    const std::vector<Cost> cost =
        measure_fastest(options.repeats, {[&] { run(bent); }, [&] { run(moved); }});
    const double cells = static_cast<double>(dem.altitude_m.size());
    out.push_back({fmt::format("{}²/bend", size), cells / cost[0].cpu_s * 1e-6, "Mcells/CPU s"});
    out.push_back({fmt::format("{}²/bend_handles_summits", size), cells / cost[1].cpu_s * 1e-6,
                   "Mcells/CPU s"});
  }
  return out;
}

}  // namespace belvedere::bench
