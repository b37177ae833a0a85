#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "base/cache/cache.h"
#include "base/cache/scratch_folder.h"
#include "base/parallel.h"
#include "renderer/pipeline/pipeline.h"
#include "tools/bench/bench.h"

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

}  // namespace belvedere::bench
