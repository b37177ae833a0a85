#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "base/progress.h"
#include "base/random.h"
#include "renderer/trace/guidance.h"
#include "tests/grids.h"

// Ground as functions of position, and its guidance, for tests with a known answer.
namespace belvedere::test {

constexpr double cell = 30.0;

// A synthetic world: altitude and land cover as functions of metres east and south of the first
// post.
struct SyntheticWorld {
  TerrainModel terrain;
  DeformedSurface surface;
  std::unique_ptr<Tracer> tracer;
  DeformParameters deform_parameters;
  glm::dvec2 viewer{0.0};
};

template <class Altitude, class Cover>
SyntheticWorld make_world(int width, int height, Altitude&& altitude, Cover&& cover,
                          DeformParameters deform_parameters = {},
                          glm::dvec2 viewer = {652000.0, 5330000.0}) {
  Raster<float> raster;
  raster.transform = {650000.0, 5320000.0, cell, cell};
  raster.cells = Grid<float>(width, height);
  LandCover land_cover;
  land_cover.classes.transform = raster.transform;
  land_cover.classes.cells = Grid<LandCoverClass>(width, height);
  for (const auto [x, y] : test::cells(width, height)) {
    raster.cells(x, y) = static_cast<float>(altitude(x * cell, y * cell));
    land_cover.classes.cells(x, y) = cover(x * cell, y * cell);
  }
  SyntheticWorld world;
  Dem dem = make_dem(std::move(raster));
  Grid<float> generalized = dem.altitude_m;
  world.deform_parameters = deform_parameters;
  world.viewer = viewer;
  world.surface = deform(generalized, dem.transform, viewer, {viewer, 0.0}, deform_parameters);
  world.terrain = make_terrain_model(
      std::make_shared<const Dem>(std::move(dem)), std::move(generalized),
      std::make_shared<const LandCover>(std::move(land_cover)), deform_parameters.exaggeration);
  world.tracer = std::make_unique<Tracer>(world.surface);
  return world;
}

inline LandCoverClass all_meadow(double, double) { return LandCoverClass::alpine_grass; }

inline double rough(double x, double y) {
  double sum = 0.0;
  for (int octave = 0; octave < 4; ++octave) {
    const double wave = 3000.0 / (1 << octave);
    const auto ix = static_cast<std::int64_t>(std::floor(x / wave));
    const auto iy = static_cast<std::int64_t>(std::floor(y / wave));
    const double fx = x / wave - static_cast<double>(ix);
    const double fy = y / wave - static_cast<double>(iy);
    const auto at = [&](int i, int j) { return random_uniform(5 + octave, ix + i, iy + j); };
    sum += ((at(0, 0) * (1 - fx) + at(1, 0) * fx) * (1 - fy) +
            (at(0, 1) * (1 - fx) + at(1, 1) * fx) * fy) *
           wave * 0.5;
  }
  return sum;
}

// Looks south from 3 km north of the terrain's northern edge.
inline CameraParameters southward(int width, int height, double pitch_deg = -20.0) {
  return {.width = width,
          .height = height,
          .eye = {653000.0, 5323000.0, 3500.0},
          .azimuth_deg = 180.0,
          .pitch_deg = pitch_deg};
}

inline GuidanceBuffers trace(const SyntheticWorld& world, const Camera& camera,
                             const GuidanceParameters& parameters = {}) {
  return trace_guidance(world.terrain, world.surface, *world.tracer, camera, parameters,
                        {0, 0, camera.size().x, camera.size().y}, silent_progress());
}

inline SyntheticWorld rough_world() {
  DeformParameters d;
  d.exaggeration = 1.6;
  d.bend = {60000.0, 9000.0, 8000.0, 1e-5};
  return make_world(220, 260, rough,
                    [](double x, double y) {
                      return rough(x + 9000.0, y) > 1400.0 ? LandCoverClass::forest
                                                           : LandCoverClass::rock;
                    },
                    d, {653000.0, 5323000.0});
}

}  // namespace belvedere::test
