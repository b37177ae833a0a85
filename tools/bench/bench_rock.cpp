#include <fmt/core.h>

#include "renderer/paint/picture_filter.h"
#include "renderer/paint/ribs.h"
#include "renderer/rock/crest_shift.h"
#include "renderer/rock/rock_relief.h"
#include "renderer/trace/guidance.h"
#include "tools/bench/bench.h"
#include "tools/bench/bench_terrain.h"

namespace belvedere::bench {

std::vector<Measurement> bench_rock(const Options&);

std::vector<Measurement> bench_rock(const Options& options) {
  constexpr int width = 1200;
  constexpr int height = 550;
  Dem dem = make_bench_dem(1024);
  const DeformedSurface surface = make_bench_surface(dem);
  const Tracer tracer(surface);
  const auto camera = make_camera(bench_view(dem, width, height));
  // Only rock: the cost of a rock wall without meadow.
  LandCover cover;
  cover.classes.transform = dem.transform;
  cover.classes.cells =
      Grid<LandCoverClass>(dem.altitude_m.width(), dem.altitude_m.height(), LandCoverClass::rock);
  Grid<float> generalized = dem.altitude_m;
  const auto shared_dem = std::make_shared<const Dem>(std::move(dem));
  const TerrainModel terrain = make_terrain_model(
      shared_dem, std::move(generalized), std::make_shared<const LandCover>(std::move(cover)), 1.6);
  const GuidanceBuffers seen = trace_guidance(terrain, surface, tracer, *camera, {},
                                              PixelRect{0, 0, width, height}, silent_progress());
  std::size_t ground = 0;
  for (std::size_t i = 0; i < seen.depth_m.size(); ++i) ground += seen.is_sky(i) ? 0U : 1U;
  const double megapixels = static_cast<double>(ground) * 1e-6;

  const Grid<std::uint8_t> marked(width, height, std::uint8_t{1});

  std::vector<Measurement> out;
  for (const int scale : {1, 4}) {
    RockParameters parameters;
    parameters.kind = &find_rock_kind("limestone");
    parameters.light.pixels_per_unit = scale;
    const GuidanceBuffers thin = thin_out({seen, 1, {0, 0}}, scale);
    const WideView far{thin, scale, {0, 0}};
    const std::vector<Cost> cost = measure_fastest(
        options.repeats, {[&] {
                            make_rock_relief(seen, far, parameters, {0, 0}, silent_progress());
                          },
                          [&] {
                            shift_crests(seen, far, parameters, {0, 0}, {0, 0, width, height});
                          },
                          [&] { blur_on_surface(seen.sky_view, seen.depth_m, 4.0 * scale); },
                          [&] {
                            integrate_along_fall_line(seen, far, marked, 1, {0, 0}, scale);
                          }});
    const std::string name = fmt::format("{}_a_unit/", scale);
    out.push_back({name + "relief_of_rock", cost[0].cpu_s / megapixels, "CPU s/Mpixel"});
    out.push_back({name + "crests", cost[1].cpu_s / megapixels, "CPU s/Mpixel"});
    out.push_back(
        {name + "blur_on_surface", cost[2].cpu_s / (width * height * 1e-6), "CPU s/Mpixel"});
    out.push_back({name + "ribs", cost[3].cpu_s / (width * height * 1e-6), "CPU s/Mpixel"});
  }
  return out;
}

}  // namespace belvedere::bench
