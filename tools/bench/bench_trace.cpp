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
#include "renderer/pipeline/pipeline.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/tracer.h"
#include "terrain/deform/deform.h"
#include "terrain/io/dem.h"
#include "terrain/synthetic/synthetic.h"
#include "tools/bench/bare_embree.h"
#include "tools/bench/bench.h"

namespace belvedere::bench {

std::vector<Measurement> bench_trace(const Options&);

namespace {

// Ridged noise of size × size cells of 30 m.
Dem make_bench_dem(int size) {
  SyntheticParameters parameters;
  parameters.width = size;
  parameters.height = size;
  return make_ridged_noise(parameters);
}

// That terrain undeformed, exaggerated 1.6 times, vertices relative to its centre.
DeformedSurface make_bench_surface(const Dem& dem) {
  const glm::dvec2 centre = dem.transform.to_crs(0.5 * dem.width(), 0.5 * dem.height());
  DeformParameters parameters;
  parameters.exaggeration = 1.6;
  return deform(dem.altitude_m, dem.transform, centre, {centre, 0.0}, parameters);
}

// A view of the whole terrain from beyond its northern rim; its size is a multiple of 4.
CameraParameters bench_view(const Dem& dem, int width, int height) {
  const double side_m = dem.width() * dem.cell_m();
  const glm::dvec2 north = dem.transform.to_crs(0.5 * dem.width(), 0.0);
  CameraParameters parameters;
  parameters.width = width;
  parameters.height = height;
  parameters.eye = {north.x, north.y + 0.4 * side_m, 6000.0 + 0.25 * side_m};
  parameters.azimuth_deg = 180.0;
  parameters.pitch_deg = -22.0;
  parameters.field_of_view_deg = 50.0;
  return parameters;
}

// The rays of a view, each 16 a bundle of 4 × 4 pixels.
std::vector<Ray> bundle_rays(const Camera& camera) {
  std::vector<Ray> rays;
  for (int y = 0; y < camera.size().y; y += 4) {
    for (int x = 0; x < camera.size().x; x += 4) {
      for (int k = 0; k < 16; ++k) rays.push_back(camera.ray({x + k % 4 + 0.5, y + k / 4 + 0.5}));
    }
  }
  return rays;
}

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

}  // namespace belvedere::bench
