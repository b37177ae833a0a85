#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/math.h"
#include "base/parallel.h"
#include "base/random.h"
#include "texture/synthesis/synthesize.h"
#include "tools/bench/bench.h"

namespace belvedere::bench {

std::vector<Measurement> bench_synthesis(const Options&);

namespace {

// Smooth noise in 0…1: lattice values `cell` pixels apart, blended by 3t² - 2t³.
double smooth_noise(std::uint64_t seed, int x, int y, int cell) {
  const int i = x / cell;
  const int j = y / cell;
  const double u = smoothstep(static_cast<double>(x % cell) / cell);
  const double v = smoothstep(static_cast<double>(y % cell) / cell);
  const double top = random_uniform(seed, i, j) * (1.0 - u) + random_uniform(seed, i + 1, j) * u;
  const double bottom =
      random_uniform(seed, i, j + 1) * (1.0 - u) + random_uniform(seed, i + 1, j + 1) * u;
  return top * (1.0 - v) + bottom * v;
}

std::uint8_t to_byte(double value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0.0, 1.0) * 255.0 + 0.5);
}

constexpr const char* guide_names[] = {"tone",  "altitude",    "distance",   "shadow",
                                       "slope", "fall_line_x", "fall_line_y"};

// Guides like those of a rendered view: altitude in broad shapes, distance up the picture, slope
// and fall line from altitude's gradient, tone by light from the upper left, shadow where it is
// darkest. Classes are bands of altitude with ragged borders.
GuideStack make_guides(int size, std::uint64_t seed) {
  GuideStack stack;
  stack.label = Grid<std::uint8_t>(size, size);
  for (const char* name : guide_names)
    stack.guides.push_back({name, Grid<std::uint8_t>(size, size)});
  const auto altitude = [&](int x, int y) {
    return 0.5 * smooth_noise(seed, x, y, 257) + 0.35 * smooth_noise(seed + 1, x, y, 83) +
           0.15 * smooth_noise(seed + 2, x, y, 29);
  };
  parallel_rows(size, [&](int y) {
    for (int x = 0; x < size; ++x) {
      const double h = altitude(x, y);
      const double gx = 60.0 * (altitude(x + 1, y) - h);
      const double gy = 60.0 * (altitude(x, y + 1) - h);
      const double steepness = std::hypot(gx, gy);
      const double tone = 0.55 + 0.6 * (gx + gy) + 0.08 * (smooth_noise(seed + 3, x, y, 7) - 0.5);
      const double along = steepness > 0.0 ? 0.5 / steepness : 0.0;
      const double values[] = {tone,
                               h,
                               1.0 - static_cast<double>(y) / size,
                               tone < 0.35 ? 1.0 : 0.0,
                               steepness,
                               0.5 + along * gx,
                               0.5 + along * gy};
      for (std::size_t g = 0; g < stack.guides.size(); ++g)
        stack.guides[g].values(x, y) = to_byte(values[g]);
      const double ragged = h + 0.06 * (smooth_noise(seed + 4, x, y, 9) - 0.5);
      stack.label(x, y) = ragged < 0.38 ? 1 : ragged < 0.48 ? 2 : ragged < 0.58 ? 3 : 4;
    }
  });
  return stack;
}

// A picture that follows its guides, with strokes a few texels wide and the grain of paper.
Exemplar make_exemplar(int size) {
  Exemplar exemplar;
  exemplar.name = "synthetic painting";
  exemplar.guides = make_guides(size, 11);
  exemplar.picture = Grid<Rgb8>(size, size);
  static constexpr double colours[4][3] = {
      {0.25, 0.4, 0.2}, {0.55, 0.6, 0.3}, {0.6, 0.52, 0.45}, {0.92, 0.94, 0.98}};
  parallel_rows(size, [&](int y) {
    for (int x = 0; x < size; ++x) {
      const double* colour = colours[exemplar.guides.label(x, y) - 1];
      const double light = 0.5 + 0.5 * exemplar.guides.guides[0].values(x, y) / 255.0;
      const double stroke = 0.3 * (smooth_noise(21, x + y, 4 * y, 6) - 0.5);
      for (std::size_t c = 0; c < 3; ++c) {
        const double grain = 0.06 * (random_uniform(22, x, y, c) - 0.5);
        exemplar.picture(x, y)[c] = to_byte(colour[c] * light + stroke + grain);
      }
    }
  });
  return exemplar;
}

}  // namespace

// A picture of `size`² from a painting of the same size; times are per million pixels of output.
// The digest (of the match field) shows whether a change of speed has changed the result.
std::vector<Measurement> bench_synthesis(const Options& options) {
  std::vector<Measurement> out;
  for (const int size : options.sizes) {
    if (size > 2048) continue;  // seconds per pixel stay the same, minutes would not
    const Exemplar exemplar = make_exemplar(size);
    const GuideStack target = make_guides(size, 12);
    const double megapixels = 1e-6 * static_cast<double>(size) * static_cast<double>(size);
    SynthesisParameters one;
    for (const char* name : guide_names)
      one.weights.emplace_back(name, std::string_view(name) == "altitude" ? 1.0 : 0.0);
    SynthesisParameters seven;
    seven.weights = {{"tone", 3.0},  {"altitude", 1.0},    {"distance", 0.3},   {"shadow", 0.3},
                     {"slope", 0.3}, {"fall_line_x", 0.2}, {"fall_line_y", 0.2}};
    for (const auto& [name, of] : {std::pair{"one_guide", one}, std::pair{"seven_guides", seven}}) {
      const auto& parameters = of;  // clang 14 captures no name of a structured binding
      MatchField field;
      reset_peak_memory();
      const Cost cost = measure_fastest(
          options.repeats,
          {[&] { field = synthesize({exemplar}, target, parameters, silent_progress()); }})[0];
      const double peak = peak_memory_mb();
      const std::string prefix = fmt::format("{}²/{}", size, name);
      out.push_back({prefix, cost.cpu_s / megapixels, "CPU s/Mpixel"});
      out.push_back({prefix + "_wall", cost.wall_s / megapixels, "s/Mpixel"});
      out.push_back({prefix + "_peak_memory", peak, "MB, inputs included"});
      std::uint64_t digest = 0;
      for (const Match& m : field) {
        digest = mix_bits(digest ^ (static_cast<std::uint64_t>(m.exemplar) << 32 |
                                    static_cast<std::uint64_t>(m.x) << 16 | m.y));
      }
      out.push_back({prefix + "_digest", static_cast<double>(digest % 100000), "of 100000"});
    }
  }
  return out;
}

}  // namespace belvedere::bench
