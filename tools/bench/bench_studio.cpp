#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "base/parallel.h"
#include "renderer/live/live_view.h"
#include "renderer/world/world.h"
#include "tools/bench/bare_embree.h"
#include "tools/bench/bench.h"

namespace belvedere::bench {

std::vector<Measurement> bench_studio(const Options&);

namespace {

// A change of the scene as somebody composing makes it, in small steps: `{}` is replaced.
struct Gesture {
  const char* name;
  const char* key;
  double from;
  double step;
  const char* value = "{}";
};
constexpr Gesture gestures[] = {
    {"camera", "camera.tilt_deg", 1.1, 0.1},
    {"sun", "sun.azimuth_deg", 300.0, 2.0},
    {"air", "air.scale_m", 50000.0, 1000.0},
    {"viewer", "camera.position", 692000.0, 100.0, "[{}, 5302000]"},
    {"exaggeration", "deform.exaggeration", 1.4, 0.02},
    {"bend", "deform.bend.crest_m", 82000.0, 500.0},
    {"equalizer", "generalize.crest", 0.5, 0.02},
    {"treeline", "land_cover.settings.treeline_m", 1500.0, 10.0},
    {"seed", "seed", 2.0, 1.0},
};
constexpr int steps_per_repeat = 4;

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

// The bound: primary rays of the picture of a rung, prepared and without anything done with them.
Cost bare_rays(const LoadedScene& scene, const Rung& rung, int repeats) {
  const LoadedScene drawn = scene_of_rung(scene, rung);
  const World world = make_world(drawn, silent_progress());
  std::vector<Ray> rays;
  const glm::ivec2 size = world.camera->size();
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) rays.push_back(world.camera->ray({x + 0.5, y + 0.5}));
  BareEmbree bare(*world.surface);
  constexpr double anywhere_m = 1e9;
  bare.prepare(rays, anywhere_m);
  return measure_fastest(repeats, {[&] {
                           constexpr std::size_t packets_per_task = 64;
                           parallel_ranges<std::size_t>(bare.packets(), packets_per_task,
                                                        [&](std::size_t first, std::size_t last) {
                                                          bare.intersect(first, last);
                                                        });
                         }})[0];
}

}  // namespace

// Times from a change to the picture, of each rung of the ladder but the last, which is the time of
// `render`.
std::vector<Measurement> bench_studio(const Options& options) {
  std::vector<Measurement> out;
  if (options.scene.empty()) return out;
  const Cache cache({.folder = user_cache_folder()});
  const Run run{.cache = cache};
  LiveView view;
  const auto scene_with = [&](const std::string& setting) {
    return read_scene(options.scene, {options.data_folders, {setting}});
  };
  for (std::size_t i = 0; i + 1 < rungs().size(); ++i) {
    const Rung& rung = rungs()[i];
    const Cost first = measure([&] { view.paint(scene_with("seed=1"), rung, run); });
    out.push_back({rung.name + "/first", first.wall_s * 1e3, "ms"});
    out.push_back({rung.name + "/first", first.cpu_s * 1e3, "CPU ms"});
    const Cost bare = bare_rays(scene_with("seed=1"), rung, options.repeats);
    out.push_back({rung.name + "/bare primary rays", bare.cpu_s * 1e3, "CPU ms"});
    if (i >= 2) {
      const Cost again = measure([&] { view.paint(scene_with("sun.azimuth_deg=300"), rung, run); });
      out.push_back({rung.name + "/sun", again.wall_s * 1e3, "ms"});
      out.push_back({rung.name + "/sun", again.cpu_s * 1e3, "CPU ms"});
      out.push_back({rung.name + "/resident", resident_memory_mb(), "MB"});
      continue;
    }
    for (const Gesture& gesture : gestures) {
      std::vector<double> wall_ms;
      std::vector<double> cpu_ms;
      for (int step = 0; step < steps_per_repeat * options.repeats; ++step) {
        const LoadedScene scene = scene_with(fmt::format(
            "{}={}", gesture.key,
            fmt::format(fmt::runtime(gesture.value), gesture.from + step * gesture.step)));
        const Cost cost = measure([&] { view.paint(scene, rung, run); });
        wall_ms.push_back(cost.wall_s * 1e3);
        cpu_ms.push_back(cost.cpu_s * 1e3);
      }
      const std::string name = fmt::format("{}/{}", rung.name, gesture.name);
      out.push_back({name + "/median", quantile(wall_ms, 0.5), "ms"});
      out.push_back({name + "/95 %", quantile(wall_ms, 0.95), "ms"});
      out.push_back({name + "/median", quantile(cpu_ms, 0.5), "CPU ms"});
    }
    out.push_back({rung.name + "/resident", resident_memory_mb(), "MB"});
  }
  return out;
}

}  // namespace belvedere::bench
