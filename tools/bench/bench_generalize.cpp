#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "base/parallel.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/generalize_view.h"
#include "terrain/generalize/generalize.h"
#include "terrain/io/raster_io.h"
#include "tools/bench/bench.h"
#include "tools/bench/bench_terrain.h"

namespace belvedere::bench {

std::vector<Measurement> bench_generalize(const Options&);

namespace {

// Two global arrays and the sharpening of crests: the usual case.
GeneralizeParameters plain_bands() {
  GeneralizeParameters bands;
  bands.foreground = {1.2F, 1.2F, 1.1F, 1.0F, 1.1F, 0.9F};
  bands.background = {1.5F, 1.5F, 1.1F, 0.6F, 0.3F, 0.15F};
  bands.crest = 0.9F;
  return bands;
}

// All six arrays, none of them 0 or 1, blur and exponent: nothing can be skipped.
GeneralizeParameters full_bands() {
  GeneralizeParameters bands = plain_bands();
  bands.crest = 0.F;
  bands.foreground[3] = 1.05F;
  bands.foreground_ridges = {0.1F, 0.2F, 0.3F, 0.4F, 0.5F, 0.6F};
  bands.foreground_valleys = {0.1F, 0.1F, 0.1F, 0.2F, 0.2F, 0.2F};
  bands.background_ridges = {0.2F, 0.3F, 0.4F, 0.5F, 0.6F, 0.7F};
  bands.background_valleys = {0.2F, 0.2F, 0.2F, 0.3F, 0.3F, 0.3F};
  bands.exponent = 0.7F;
  return bands;
}

// Everything that needs its own grid at once: lakes, slope and slope-foot masks, distance,
// printable detail, crests, six arrays with blur and exponent.
constexpr const char* everything = R"(version = 1
[generalize]
foreground = [1.2, 1.2, 1.1, 1.05, 1.1, 0.9]
background = [1.5, 1.5, 1.1, 0.6, 0.3, 0.15]
foreground_ridges = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]
foreground_valleys = [0.1, 0.1, 0.1, 0.2, 0.2, 0.2]
background_ridges = [0.2, 0.3, 0.4, 0.5, 0.6, 0.7]
background_valleys = [0.2, 0.2, 0.2, 0.3, 0.3, 0.3]
exponent = 0.7
foreground_to_m = 10000
background_from_m = 90000
print_detail_px = 2.5
mask_slope_deg = [3, 10]
automatic_mask = true
crest = 0.9
keep_lakes = true
)";

// Peak bytes per cell above the DEM while a scene with all of that is generalized, from making the
// masks to the result.
double scene_memory(Dem dem, const std::string& more) {
  // The lowest ground below lakes.
  const auto [low, high] = std::minmax_element(dem.altitude_m.begin(), dem.altitude_m.end());
  const float level = *low + 0.15F * (*high - *low);
  for (float& altitude : dem.altitude_m) altitude = std::max(altitude, level);
  const LoadedScene loaded = parse_scene(everything + more, "bench", ".", {});
  View view;
  view.camera = bench_view(dem, 2400, 1100);
  view.viewer_xy = {view.camera.eye.x, view.camera.eye.y};
  const double used_mb = resident_memory_mb();
  reset_peak_memory();
  const Grid<float> result =
      generalize_for_view(loaded, dem, nullptr, view, silent_progress()).altitude_m;
  return (peak_memory_mb() - used_mb) * 1048576.0 / static_cast<double>(result.size());
}

// Processor seconds of `gdaldem hillshade` for the same DEM, or negative where it is not installed.
// It reads and writes files.
double gdaldem_cpu_s(const Dem& dem) {
  if (std::system("command -v gdaldem > /dev/null 2>&1") != 0) return -1.0;
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "belvedere_bench";
  std::filesystem::create_directories(folder);
  const std::string in = (folder / "dem.tif").string();
  write_raster(in, Raster<float>{dem.altitude_m, dem.transform, dem.crs});
  const std::string plain = (folder / "plain.tif").string();
  std::system(("gdal_translate -q '" + in + "' '" + plain + "' > /dev/null 2>&1").c_str());
  const double cpu = measure_child([&] {
                       return std::system(("gdaldem hillshade -q '" + plain + "' '" +
                                           (folder / "out.tif").string() + "' > /dev/null 2>&1")
                                              .c_str());
                     }).cpu_s;
  std::filesystem::remove_all(folder);
  return cpu;
}

}  // namespace

std::vector<Measurement> bench_generalize(const Options& options) {
  std::vector<Measurement> out;
  const GeneralizeParameters plain = plain_bands();
  const GeneralizeParameters full = full_bands();
  for (const int size : options.sizes) {
    const Dem dem = make_bench_dem(size);
    const double cells = static_cast<double>(dem.altitude_m.size());
    const double used_mb = resident_memory_mb();
    GeneralizeGrids grids;
    grids.foreground_share = Grid<float>(size, size);
    Grid<float> mask(size, size);
    for (int y = 0; y < size; ++y) {
      std::fill_n(grids.foreground_share.row(y), size,
                  static_cast<float>(y) / static_cast<float>(size));
      for (int x = 0; x < size; ++x)
        mask(x, y) = std::min(1.F, static_cast<float>(x % 512) / 200.F);
    }
    const auto run = [&](const GeneralizeParameters& bands) {
      generalize(dem.altitude_m, {30.0, 30.0}, grids, bands, silent_progress());
    };
    const std::vector<Cost> cost = measure_fastest(options.repeats, {[&] { run(plain); }});
    grids.mask = std::move(mask);
    reset_peak_memory();
    const std::vector<Cost> all = measure_fastest(options.repeats, {[&] { run(full); },
                                                                    [&] {
                                                                      const ThreadLimit one(1);
                                                                      run(full);
                                                                    },
                                                                    [&] {
                                                                      const ThreadLimit two(2);
                                                                      run(full);
                                                                    }});
    const double peak_mb = peak_memory_mb();
    const auto add = [&](const char* name, double value, const char* unit) {
      out.push_back({fmt::format("{}²/{}", size, name), value, unit});
    };
    add("generalize", cells / cost[0].cpu_s * 1e-6, "Mcells/CPU s");
    add("generalize_wall", cells / cost[0].wall_s * 1e-6, "Mcells/s");
    add("generalize_full", cells / all[0].cpu_s * 1e-6, "Mcells/CPU s");
    add("generalize_full_one_thread", cells / all[1].wall_s * 1e-6, "Mcells/s");
    add("generalize_full_two_threads", cells / all[2].wall_s * 1e-6, "Mcells/s");
    // The foreground share, the mask, the result and intermediate grids.
    add("generalize_full_memory", (peak_mb - used_mb) * 1048576.0 / cells,
        "bytes/cell above the DEM");
    grids = {};
    add("generalize_scene_memory", scene_memory(dem, ""), "bytes/cell above the DEM");
    add("generalize_scene_memory_line_integral", scene_memory(dem, "line_integral = true\n"),
        "bytes/cell above the DEM");
    const double hillshade_cpu_s = gdaldem_cpu_s(dem);
    if (hillshade_cpu_s > 0.0)
      add("gdaldem_hillshade", cells / hillshade_cpu_s * 1e-6, "Mcells/CPU s");
  }
  return out;
}

}  // namespace belvedere::bench
