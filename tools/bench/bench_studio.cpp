#include <fmt/core.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/cache/cache.h"
#include "base/parallel.h"
#include "base/pyramid.h"
#include "base/statistics.h"
#include "renderer/live/live_view.h"
#include "renderer/world/picture_parameters.h"
#include "renderer/world/scene_dem.h"
#include "renderer/world/world.h"
#include "terrain/io/dem_levels.h"
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
    {"handle", "deform.handles", 100.0, 20.0,
     "[{{position=[690000,5249000],radius_m=3000,raise_m={}}}]"},
    {"light", "light.regions", 2000.0, 50.0,
     "[{{position=[690000,5249000],radius_m={},strength=1.3}}]"},
    {"equalizer", "generalize.crest", 0.5, 0.02},
    {"treeline", "land_cover.settings.treeline_m", 1500.0, 10.0},
    {"seed", "seed", 2.0, 1.0},
};
constexpr int steps_per_repeat = 4;

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
  const std::size_t drawn = options.gesture.empty() ? rungs().size() - 1 : 1;
  for (std::size_t i = 0; i < drawn; ++i) {
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
      if (!options.gesture.empty() && options.gesture != gesture.name) continue;
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
      out.push_back({name + "/median", percentile(wall_ms, 0.5), "ms"});
      out.push_back({name + "/95 %", percentile(wall_ms, 0.95), "ms"});
      out.push_back({name + "/median", percentile(cpu_ms, 0.5), "CPU ms"});
      out.push_back(
          {name + "/ratio to bare rays", percentile(cpu_ms, 0.5) / (1e3 * bare.cpu_s), ""});
    }
    out.push_back({rung.name + "/resident", resident_memory_mb(), "MB"});
  }
  return out;
}

std::vector<Measurement> bench_preview(const Options&);

namespace {

struct Ground {
  GuidanceBuffers seen;
  Grid<float> generalized_m;
  int halved = 0;
};

Ground look(LoadedScene loaded, const Run& run) {
  loaded.scene.output.width = 1000;  // the same for all
  loaded.scene.output.height = 450;
  const World world = make_world(loaded, run.progress, run.cache);
  const glm::ivec2 size = world.camera->size();
  GuidanceBuffers seen = trace_forms(world, *world.camera, {0, 0, size.x, size.y}, run);
  return {std::move(seen), world.terrain.generalized_m, world.dem->halved};
}

// Root mean square of the difference in altitude where both see the same ground.
double difference_m(const GuidanceBuffers& a, const GuidanceBuffers& b) {
  constexpr float same_depth = 0.005F;
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < a.depth_m.size(); ++i) {
    if (!std::isfinite(a.depth_m[i]) || !std::isfinite(b.depth_m[i]) || a.depth_m[i] <= 0.F ||
        std::abs(a.depth_m[i] - b.depth_m[i]) > same_depth * a.depth_m[i])
      continue;
    const double d = a.position_m[i].z + a.origin_m.z - b.position_m[i].z - b.origin_m.z;
    sum += d * d;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(sum / count) : std::numeric_limits<double>::quiet_NaN();
}

// The response of the ground to a change of the scene, in the cells of a ground of the given width
// and height.
Grid<float> response(const Ground& without, const Ground& with, const Grid<float>& size) {
  Grid<float> change = with.generalized_m;
  for (std::size_t i = 0; i < change.size(); ++i) change[i] -= without.generalized_m[i];
  for (int level = with.halved - 1; level >= 0; --level)
    change = expand(change, level_cells(size.width(), level), level_cells(size.height(), level));
  return change;
}

}  // namespace

// How far the ground of drafts and of the studio's first pictures is from that of the print, and
// how each slider of the equalizer acts on both.
std::vector<Measurement> bench_preview(const Options& options) {
  std::vector<Measurement> out;
  if (options.scene.empty()) return out;
  const Cache cache({.folder = user_cache_folder()});
  const Run run{.cache = cache};
  const auto scene_with = [&](const std::vector<std::string>& settings) {
    return read_scene(options.scene, {options.data_folders, settings});
  };
  const auto rung_of = [](const LoadedScene& scene) {
    return scene_of_rung(scene, rungs().front());
  };
  const std::vector<std::pair<std::string, std::vector<std::string>>> all_weights = {
      {"own weights", {}},
      {"no generalization",
       {"generalize.foreground=[1,1,1,1,1,1]", "generalize.background=[1,1,1,1,1,1]",
        "generalize.crest=0"}},
      {"weights 1,1,1,1,0,0",
       {"generalize.foreground=[1,1,1,1,0,0]", "generalize.background=[1,1,1,1,0,0]"}}};
  for (const auto& [name, weights] : all_weights) {
    const LoadedScene scene = scene_with(weights);
    const Ground print = look(scene, run);
    out.push_back(
        {name + "/draft", difference_m(print.seen, look(make_draft_scene(scene), run).seen), "m"});
    out.push_back(
        {name + "/first rung", difference_m(print.seen, look(rung_of(scene), run).seen), "m"});
  }
  // Band 1 is the finest; weights begin with the coarsest.
  const int bands = static_cast<int>(scene_with({}).scene.generalize.bands.foreground.size());
  const auto weights_with = [&](int raised) {
    std::vector<std::string> settings;
    for (const char* of : {"foreground", "background"}) {
      std::string list;
      for (int band = bands; band >= 1; --band)
        list += fmt::format("{}{}", list.empty() ? "" : ",", band == raised ? 1.5 : 1.0);
      settings.push_back(fmt::format("generalize.{}=[{}]", of, list));
    }
    settings.push_back("generalize.crest=0");
    return settings;
  };
  const Ground plain = look(scene_with(weights_with(0)), run);
  const Ground preview = look(rung_of(scene_with(weights_with(0))), run);
  const int halvings = preview.halved;
  out.push_back({"level of the first rung", static_cast<double>(halvings), "halvings"});
  for (int band = bands; band > halvings; --band) {
    const LoadedScene raised = scene_with(weights_with(band));
    const Grid<float> a = response(plain, look(raised, run), plain.generalized_m);
    const Grid<float> b = response(preview, look(rung_of(raised), run), plain.generalized_m);
    double aa = 0.0;
    double ab = 0.0;
    double bb = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      aa += static_cast<double>(a[i]) * a[i];
      ab += static_cast<double>(a[i]) * b[i];
      bb += static_cast<double>(b[i]) * b[i];
    }
    out.push_back({fmt::format("b{}/correlation", band), ab / std::sqrt(aa * bb), ""});
    out.push_back({fmt::format("b{}/strength", band), std::sqrt(bb / aa), ""});
  }
  return out;
}

}  // namespace belvedere::bench
