#include <fmt/core.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/cache/cache.h"
#include "base/pyramid.h"
#include "renderer/live/rungs.h"
#include "renderer/world/coarse_ground_scene.h"
#include "renderer/world/picture_parameters.h"
#include "renderer/world/world.h"
#include "terrain/io/dem_levels.h"
#include "tools/bench/bench.h"

namespace belvedere::bench {

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

// What a change of the scene changes, in the cells of a ground of the given width and height.
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
