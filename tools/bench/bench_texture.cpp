#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/noise.h"
#include "base/parallel.h"
#include "texture/statistical/learn_texture.h"
#include "texture/statistical/make_texture.h"
#include "tools/bench/bench.h"

namespace belvedere::bench {

std::vector<Measurement> bench_texture(const Options&);

namespace {

constexpr int crop_px = 192;
constexpr int made_px = 512;
constexpr int large_px = 2048;  // of which memory is reported: margins count little

// Greens with strokes of two sizes, like a crop of a meadow.
Grid<Rgb8> meadow_crop() {
  Grid<Rgb8> out(crop_px, crop_px);
  const auto level = [](double value) {
    return static_cast<std::uint8_t>(std::clamp(value + .5, 0.0, 255.0));
  };
  for (int y = 0; y < crop_px; ++y)
    for (int x = 0; x < crop_px; ++x) {
      const double wide = gaussian_noise(7, x, y, 6.0, 3.0);
      const double fine = gaussian_noise(8, x, y, 1.2, .8);
      out(x, y) = {level(90.0 + 16.0 * wide + 9.0 * fine), level(130.0 + 14.0 * wide + 11.0 * fine),
                   level(60.0 + 8.0 * wide)};
    }
  return out;
}

}  // namespace

std::vector<Measurement> bench_texture(const Options& options) {
  const Grid<Rgb8> crop = meadow_crop();
  CliqueModel model;
  const std::vector<Cost> learnt =
      measure_fastest(options.repeats, {[&] { model = learn_texture(crop, {}, {}).model; }});
  std::vector<Measurement> out = {{"learn/cpu", learnt[0].cpu_s, "s for 192²"},
                                  {"learn/types", static_cast<double>(model.cliques.size()), ""}};
  model.polish = true;
  const auto make = [&](int threads, int sweeps) {
    return [&model, threads, sweeps] {
      const ThreadLimit limit(threads);
      make_texture(model, made_px, made_px, {.sweeps = sweeps});
    };
  };
  const std::vector<Cost> costs =
      measure_fastest(options.repeats, {make(1, 0), make(2, 0), make(1, TextureParameters{}.sweeps),
                                        make(2, TextureParameters{}.sweeps)});
  const double mpx = static_cast<double>(made_px) * made_px / 1e6;
  out.push_back({"flow/cpu", costs[0].cpu_s / mpx, "s/Mpx"});
  out.push_back({"flow/two threads", costs[0].wall_s / costs[1].wall_s,
                 "times one, where two processors are free"});
  out.push_back({"flow/two threads cpu", costs[1].cpu_s / costs[0].cpu_s, "of one thread's"});
  out.push_back({"polish/cpu", (costs[2].cpu_s - costs[0].cpu_s) / mpx, "s/Mpx"});
  out.push_back({"flow and polish/two threads", costs[2].wall_s / costs[3].wall_s, "times one"});
  out.push_back(
      {"flow and polish/two threads cpu", costs[3].cpu_s / costs[2].cpu_s, "of one thread's"});
  const double before = resident_memory_mb();
  reset_peak_memory();
  make_texture(model, large_px, large_px, {.rounds = 1, .sweeps = 1});
  out.push_back(
      {"memory", (peak_memory_mb() - before) * 1048576.0 / large_px / large_px, "bytes/px"});
  return out;
}

}  // namespace belvedere::bench
