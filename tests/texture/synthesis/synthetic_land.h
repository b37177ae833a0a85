#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "base/progress.h"
#include "base/random.h"
#include "tests/grids.h"
#include "texture/synthesis/synthesize.h"

// A land of three classes and its painting, for tests of synthesis.
namespace belvedere::test {

// Smooth noise 0…255 with features of about `scale` pixels.
inline std::uint8_t smooth_noise(std::uint64_t seed, int x, int y, int scale) {
  const int cx = x / scale;
  const int cy = y / scale;
  const auto corner = [&](int i, int j) { return random_uniform(seed, cx + i, cy + j); };
  const double fx = static_cast<double>(x % scale) / scale;
  const double fy = static_cast<double>(y % scale) / scale;
  const double top = corner(0, 0) * (1 - fx) + corner(1, 0) * fx;
  const double bottom = corner(0, 1) * (1 - fx) + corner(1, 1) * fx;
  return static_cast<std::uint8_t>(255.0 * (top * (1 - fy) + bottom * fy));
}

// Guides of a synthetic land: classes 3, 7 and 9 by altitude, altitude and tone.
inline GuideStack land(int width, int height, std::uint64_t seed) {
  GuideStack stack;
  stack.label = Grid<std::uint8_t>(width, height);
  Grid<std::uint8_t> altitude(width, height);
  Grid<std::uint8_t> tone(width, height);
  for (const auto [x, y] : test::cells(width, height)) {
    altitude(x, y) = smooth_noise(seed, x, y, 30);
    tone(x, y) = smooth_noise(seed + 1, x, y, 17);
    stack.label(x, y) = altitude(x, y) < 100 ? 3 : altitude(x, y) < 150 ? 7 : 9;
  }
  stack.guides = {{"altitude", altitude}, {"tone", tone}};
  return stack;
}

// Streaks that differ by class, 0…79.
inline int streak_of(int label, int x, int y, std::uint64_t seed) {
  return static_cast<int>(label == 3   ? random_index(80, seed, x / 5, y)
                          : label == 7 ? random_index(80, seed, x, y / 4)
                                       : random_index(80, seed, x / 2, y / 2));
}

// Its painting: one hue per class, streaks that differ by class, brighter with tone.
inline Exemplar painting(int width, int height, std::uint64_t seed) {
  Exemplar exemplar{.name = "painting " + std::to_string(seed),
                    .picture = Grid<Rgb8>(width, height),
                    .guides = land(width, height, seed)};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int label = exemplar.guides.label(x, y);
      const int streak = streak_of(label, x, y, seed + 2);
      const int bright = streak + exemplar.guides.guides[1].values(x, y) / 3;
      exemplar.picture(x, y) = {static_cast<std::uint8_t>(bright + (label == 9 ? 90 : 0)),
                                static_cast<std::uint8_t>(bright + (label == 7 ? 90 : 0)),
                                static_cast<std::uint8_t>(bright + (label == 3 ? 90 : 0))};
    }
  return exemplar;
}

// Records the notes of synthesis.
struct SynthesisNotes : Progress {
  void begin(std::string_view stage, double total) override {
    EXPECT_EQ(done, announced) << "a stage began before the last was done";
    stages.emplace_back(stage);
    done = 0;
    announced = total;
  }
  void advance(double amount) override { done += amount; }
  void note(std::string_view text) override { notes.emplace_back(text); }
  std::vector<std::string> stages;
  std::vector<std::string> notes;
  double done = 0;
  double announced = 0;
};

inline MatchField run(const std::vector<Exemplar>& exemplars, const GuideStack& target,
                      const SynthesisParameters& parameters = {}) {
  return synthesize(exemplars, target, parameters, silent_progress());
}

inline double mean_guide_error(const MatchField& field, const std::vector<Exemplar>& exemplars,
                               const GuideStack& target, std::size_t guide) {
  double sum = 0;
  for (std::size_t i = 0; i < field.size(); ++i) {
    const Match m = field[i];
    sum +=
        std::abs(static_cast<double>(exemplars[m.exemplar].guides.guides[guide].values(m.x, m.y)) -
                 target.guides[guide].values[i]);
  }
  return sum / static_cast<double>(field.size());
}

inline int max_used(const MatchField& field) {
  std::map<std::tuple<int, int, int>, int> uses;
  int max = 0;
  for (const Match& m : field)
    if (m.exemplar != Match::none) max = std::max(max, ++uses[{m.exemplar, m.x, m.y}]);
  return max;
}

}  // namespace belvedere::test
