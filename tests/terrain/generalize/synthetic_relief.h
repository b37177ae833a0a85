#pragma once

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/random.h"
#include "terrain/generalize/generalize.h"
#include "terrain/io/dem.h"
#include "tests/grids.h"
#include "tests/paths.h"

// Terrain for tests of generalization.
namespace belvedere::test {

using Weights = std::vector<float>;
inline constexpr double cell_m = 30.0;

// Sharp ridges of two directions on a slope, with noise.
inline Grid<float> alpine(int width, int height, double relief_m = 1000.0) {
  return grid_of(width, height, [relief_m](int x, int y) {
    const double ridge =
        0.7 * std::abs(std::sin(x / 23.0)) + 0.3 * std::abs(std::sin((x + 2 * y) / 17.0));
    return 900.0 + relief_m * ridge + 2.0 * y + 40.0 * random_uniform(8, x, y);
  });
}

// Altitudes of a file of the real data; empty if it is missing.
inline std::optional<Grid<float>> real_ground(const std::string& name) {
  const std::string file = data_folder() + "/" + name;
  if (!std::filesystem::exists(file)) return std::nullopt;
  DemParameters parameters;
  parameters.sources.emplace_back().path = file;
  return read_dem(parameters, silent_progress()).altitude_m;
}

inline GeneralizeParameters everywhere(const Weights& global, const Weights& ridges = {},
                                       const Weights& valleys = {}) {
  GeneralizeParameters p;
  p.foreground = p.background = global;
  p.foreground_ridges = p.background_ridges = ridges;
  p.foreground_valleys = p.background_valleys = valleys;
  return p;
}

inline Grid<float> run(const Grid<float>& terrain, const GeneralizeParameters& parameters,
                       const GeneralizeGrids& grids = {}) {
  return generalize(terrain, {cell_m, cell_m}, grids, parameters, silent_progress());
}

}  // namespace belvedere::test
