#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/cache/cache.h"
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
    const Cost now = used();
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
  static Cost used() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now().time_since_epoch();
    return {wall.count(), seconds(usage.ru_utime) + seconds(usage.ru_stime)};
  }
  std::map<std::string, Cost> costs_;
  std::string stage_ = "reading the scene";
  Cost before_ = used();
};

}  // namespace

// Where the time of --scene's picture goes, and what a second thread brings to each stage that
// takes over 3 % of it. The first run fills the cache and counts for nothing.
std::vector<Measurement> bench_picture(const Options& options) {
  std::vector<Measurement> out;
  if (options.scene.empty()) return out;
  const Cache cache({.folder = user_cache_folder()});
  const std::string folder =
      (std::filesystem::temp_directory_path() / "belvedere_bench_picture").string();
  const LoadedScene scene = read_scene(options.scene, {options.data_folders, {}});
  const auto costs_with = [&](int threads) {
    StageCosts costs;
    render(scene, folder, {.threads = threads, .progress = costs, .cache = cache},
           {.replace = true});
    costs.end();
    return costs.costs();
  };
  costs_with(2);
  const std::map<std::string, Cost> one = costs_with(1);
  const std::map<std::string, Cost> two = costs_with(2);
  std::filesystem::remove_all(folder);
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
