#include <fmt/core.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "base/cache/cache.h"
#include "base/error.h"
#include "base/files/output_file.h"
#include "base/parallel.h"
#include "renderer/paint/picture_filter.h"
#include "renderer/paint/ribs.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/rock/rock_ground.h"
#include "renderer/rock/rock_relief.h"
#include "renderer/trace/guidance.h"
#include "renderer/trace/tracer.h"
#include "tools/bench/bare_embree.h"
#include "tools/bench/bench.h"
#include "tools/bench/bench_terrain.h"

namespace belvedere::bench {

std::vector<Measurement> bench_trace(const Options&);

namespace {

constexpr std::size_t task_packets = 64;  // 1024 rays a task

// f(first, last) over packets of 16 rays.
template <class F>
void for_packets(std::size_t packets, F&& f) {
  parallel_ranges(packets, task_packets, f);
}

struct Race {
  const char* name;
  std::vector<Ray> rays;  // a multiple of 16
  double reach_m;
  bool nearest;  // intersect, else occluded
};

void run_race(const Race& race, const Tracer& tracer, BareEmbree& bare, const std::string& size,
              int repeats, std::vector<Measurement>& out) {
  std::vector<Hit> hits(race.nearest ? race.rays.size() : 0);
  std::vector<std::uint8_t> blocked(race.nearest ? 0 : race.rays.size());
  bare.prepare(race.rays, race.reach_m);
  const std::size_t packets = bare.packets();
  const auto ours = [&] {
    for_packets(packets, [&](std::size_t first, std::size_t last) {
      const std::span rays = std::span(race.rays).subspan(first * 16, (last - first) * 16);
      if (race.nearest) {
        tracer.intersect(rays, std::span(hits).subspan(first * 16, rays.size()));
      } else {
        tracer.occluded(rays, race.reach_m, std::span(blocked).subspan(first * 16, rays.size()));
      }
    });
  };
  const auto theirs = [&] {
    for_packets(packets, [&](std::size_t first, std::size_t last) {
      if (race.nearest) {
        bare.intersect(first, last);
      } else {
        bare.occluded(first, last);
      }
    });
  };
  const std::vector<Cost> costs = measure_fastest(repeats, {ours, theirs});
  // Both must have done the same work; a ray that grazes an edge may differ.
  std::size_t found = 0;
  for (const Hit& hit : hits) found += hit.found ? 1 : 0;
  for (const std::uint8_t b : blocked) found += b;
  const auto difference =
      std::abs(static_cast<double>(found) - static_cast<double>(bare.count_hits()));
  if (difference > 1e-4 * static_cast<double>(race.rays.size())) {
    throw Error(ErrorKind::bug, "bench trace",
                fmt::format("{}: {} hits against {}", race.name, found, bare.count_hits()));
  }
  const double count = static_cast<double>(race.rays.size());
  out.push_back({fmt::format("{}/{}_rays", size, race.name), count * 1e-6, "Mrays"});
  out.push_back(
      {fmt::format("{}/{}", size, race.name), count / costs[0].cpu_s * 1e-6, "Mrays/CPU s"});
  out.push_back(
      {fmt::format("{}/{}_wall", size, race.name), count / costs[0].wall_s * 1e-6, "Mrays/s"});
  out.push_back({fmt::format("{}/{}_bare_embree", size, race.name), count / costs[1].cpu_s * 1e-6,
                 "Mrays/CPU s"});
  out.push_back({fmt::format("{}/{}_ratio", size, race.name), costs[1].cpu_s / costs[0].cpu_s,
                 "of bare Embree"});
}

// Secondary rays from the hits, in whole packets of one direction.
std::vector<Ray> rays_from(const std::vector<Ray>& primary, const std::vector<Hit>& hits,
                           glm::dvec3 direction) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (!hits[i].found) continue;
    rays.push_back({primary[i].origin + primary[i].direction * hits[i].distance_m +
                        0.05 * hits[i].facet_normal(),
                    glm::normalize(direction)});
  }
  rays.resize(rays.size() / 16 * 16);
  return rays;
}

}  // namespace

std::vector<Measurement> bench_trace(const Options& options) {
  std::vector<Measurement> out;
  for (const int size : options.sizes) {
    const std::string name = fmt::format("{}²", size);
    const Dem dem = make_bench_dem(size);
    const DeformedSurface surface = make_bench_surface(dem);
    const double cells = static_cast<double>(dem.altitude_m.size());
    std::unique_ptr<Tracer> tracer;
    const Cost build = measure([&] { tracer = std::make_unique<Tracer>(surface); });
    out.push_back({name + "/build", cells / build.cpu_s * 1e-6, "Mcells/CPU s"});
    out.push_back({name + "/build_wall", build.wall_s, "s"});
    out.push_back(
        {name + "/structure", static_cast<double>(tracer->memory_bytes()) / cells, "bytes/cell"});
    BareEmbree bare(surface);

    const auto camera = make_camera(bench_view(dem, 1600, 800));
    Race primary{"primary", bundle_rays(*camera), 1e9, true};
    std::vector<Hit> hits(primary.rays.size());
    tracer->intersect(primary.rays, hits);
    run_race(primary, *tracer, bare, name, options.repeats, out);
    run_race({"shadow", rays_from(primary.rays, hits, {-0.612, 0.612, 0.5}), 1e9, false}, *tracer,
             bare, name, options.repeats, out);
    // Four directions of the sky, from near the zenith to low.
    std::vector<Ray> sky;
    for (int k = 0; k < 4; ++k) {
      const double u = (k + 0.5) / 4.0;
      const double turn = 2.0 * std::numbers::pi * 0.618 * k;
      const std::vector<Ray> some = rays_from(
          primary.rays, hits,
          {std::cos(turn) * std::sqrt(u), std::sin(turn) * std::sqrt(u), std::sqrt(1.0 - u)});
      sky.insert(sky.end(), some.begin(), some.end());
    }
    run_race({"sky", std::move(sky), 12000.0, false}, *tracer, bare, name, options.repeats, out);
  }
  return out;
}

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

std::vector<Measurement> bench_picture(const Options&);

namespace {

// Measures the cost of each stage that a job reports: the time from its beginning to the next
// one's.
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
