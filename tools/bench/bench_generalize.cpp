#include <fmt/format.h>

#include "terrain/generalize.h"
#include "tools/bench/bench.h"
#include "tools/bench/bench_terrain.h"

namespace belvedere::bench {

std::vector<Measurement> bench_generalize(const Options&);

std::vector<Measurement> bench_generalize(const Options& options) {
  std::vector<Measurement> out;
  GeneralizeParameters parameters;
  parameters.foreground = {1.2F, 1.2F, 1.1F, 1.0F, 1.1F, 0.9F};
  parameters.background = {1.5F, 1.5F, 1.1F, 0.6F, 0.3F, 0.15F};
  parameters.crest = 0.9F;
  for (const int size : options.sizes) {
    const Dem dem = make_bench_dem(size);
    GeneralizeGrids grids;
    grids.foreground_share = Grid<float>(size, size);
    Grid<float>& share = grids.foreground_share;
    for (int y = 0; y < size; ++y) std::fill(share.row(y), share.row(y) + size, static_cast<float>(y) / static_cast<float>(size));
    const std::vector<Cost> cost = measure_fastest(options.repeats, {[&] {
                                                     generalize(dem.altitude_m, {30.0, 30.0}, grids, parameters, silent_progress());
                                                   }});
    const double cells = static_cast<double>(dem.altitude_m.size());
    out.push_back({fmt::format("{}²/generalize", size), cells / cost[0].cpu_s * 1e-6, "Mcells/CPU s"});
    out.push_back({fmt::format("{}²/generalize_wall", size), cells / cost[0].wall_s * 1e-6, "Mcells/s"});
  }
  return out;
}

}  // namespace belvedere::bench
