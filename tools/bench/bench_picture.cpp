#include <algorithm>
#include <fmt/core.h>
#include <map>
#include <string>
#include <vector>

#include "base/cache/cache.h"
#include "base/files/output_file.h"
#include "base/parallel.h"
#include "renderer/paint/picture_filter.h"
#include "renderer/paint/ribs.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/rock/crest_shift.h"
#include "renderer/rock/rock_relief.h"
#include "renderer/trace/guidance.h"
#include "tools/bench/bench.h"
#include "tools/bench/bench_terrain.h"

namespace belvedere::bench {

std::vector<Measurement> bench_picture(const Options&);

namespace {

// What each stage costs that a job reports: the time from its beginning to the next one's.
class StageCosts : public Progress {
 public:
  void begin(std::string_view stage, double) override {
    end();
    stage_ = stage;
  }
  void end() {
    const Cost now = spent();
    if (!stage_.empty()) {
      Cost& cost = costs_[stage_];
      cost.wall_s += now.wall_s - before_.wall_s;
      cost.cpu_s += now.cpu_s - before_.cpu_s;
    }
    before_ = now;
    stage_.clear();
  }
  const std::map<std::string, Cost>& costs() const { return costs_; }

 private:
  std::map<std::string, Cost> costs_;
  std::string stage_ = "reading the scene";
  Cost before_ = spent();
};

}  // namespace

// Where the time of --scene's picture goes, and what a second thread brings to each stage that
// takes over 3 % of it. The first run fills the cache and counts for nothing.
std::vector<Measurement> bench_picture(const Options& options) {
  std::vector<Measurement> out;
  if (options.scene.empty()) return out;
  const Cache cache({.folder = user_cache_folder()});
  const ScratchFolder folder;
  const LoadedScene scene = read_scene(options.scene, {options.data_folders, {}});
  const auto costs_with = [&](int threads) {
    StageCosts costs;
    render(scene, folder.path(), {.threads = threads, .progress = costs, .cache = cache},
           {.replace = true});
    costs.end();
    return costs.costs();
  };
  costs_with(2);
  const std::map<std::string, Cost> one = costs_with(1);
  const std::map<std::string, Cost> two = costs_with(2);
  Cost all_one;
  Cost all_two;
  for (const auto& [stage, cost] : one) all_one.wall_s += cost.wall_s;
  for (const auto& [stage, cost] : two) {
    all_two.wall_s += cost.wall_s;
    all_two.cpu_s += cost.cpu_s;
  }
  out.push_back({"all", all_two.cpu_s, "CPU s"});
  out.push_back({"all/two threads", all_one.wall_s / all_two.wall_s, "times as fast"});
  for (const auto& [stage, cost] : one) {
    const auto found = two.find(stage);
    if (found == two.end() || cost.wall_s < 0.03 * all_one.wall_s) continue;
    out.push_back({stage, found->second.cpu_s, "CPU s"});
    out.push_back({stage + "/share", 100.0 * cost.wall_s / all_one.wall_s, "% of one thread"});
    out.push_back({stage + "/two threads", cost.wall_s / found->second.wall_s, "times as fast"});
  }
  return out;
}

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
