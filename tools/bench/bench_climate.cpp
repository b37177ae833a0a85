#include <fmt/core.h>

#include "terrain/climate/radiation.h"
#include "terrain/climate/rain.h"
#include "tools/bench/bench.h"
#include "tools/bench/bench_terrain.h"

namespace belvedere::bench {

std::vector<Measurement> bench_climate(const Options&);

std::vector<Measurement> bench_climate(const Options& options) {
  std::vector<Measurement> out;
  for (const int size : options.sizes) {
    const Dem dem = make_bench_dem(size);
    // At the centre of the Alps, one degree from south to north.
    MapPosition position;
    position.width = position.height = size;
    position.cell_m = {dem.transform.cell_x, dem.transform.cell_y};
    position.latitude_deg = {.at_first = 47.5, .per_column = 0.0, .per_row = -1.0 / size};
    const std::vector<Cost> cost = measure_fastest(
        options.repeats, {[&] { potential_radiation(dem.altitude_m, position, {}); },
                          [&] { upslope_rain(dem.altitude_m, position.cell_m, {}); }});
    const double megacells = static_cast<double>(dem.altitude_m.size()) * 1e-6;
    out.push_back(
        {fmt::format("{}²/radiation_of_a_year", size), cost[0].cpu_s / megacells, "CPU s/Mcell"});
    out.push_back(
        {fmt::format("{}²/upslope_rain", size), cost[1].cpu_s / megacells, "CPU s/Mcell"});
  }
  return out;
}

}  // namespace belvedere::bench
