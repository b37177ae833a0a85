#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "base/grid.h"
#include "base/guidance_buffers.h"

namespace belvedere {

// Minimum trust of a reliable sun.
inline constexpr double min_sun_trust = 0.05;

// The sun that explains the lightness of paint best.
struct SunEstimate {
  double azimuth_deg = 0.0;   // 0…360, clockwise from north
  double altitude_deg = 0.0;  // 18…60
  // Share of the variance of lightness within classes, without altitude and air, that its light
  // explains, 0…1; what the sun of the whole picture explains of it; and the best sun from more
  // than 75° of azimuth away.
  double explained = 0.0, by_whole = 0.0, elsewhere = 0.0;
  std::size_t pixels = 0;  // compared; 0: too few for an estimate

  double trust() const { return explained - elsewhere; }
  bool trusted() const { return pixels > 0 && trust() >= min_sun_trust; }
  // Whether a part of a picture has light of its own.
  bool differs() const { return trusted() && explained - by_whole >= min_sun_trust; }
};

struct PaintingLight {
  SunEstimate whole;
  Grid<SunEstimate> regions;  // of the picture, divided evenly into columns and rows
};

struct PaintingLightParameters {
  double blur_px = 2.0;  // of lightness and normals within a class, ≥ 0: strokes and small errors
                         // of places
  int columns = 4;       // of the grid of regions, ≥ 1
  int rows = 2;
  std::size_t max_pixels = 6000;  // compared in a region, and in the whole picture, ≥ 100
};

// Estimates the sun of a painting (encoded sRGB) from the ground that its guidance says it shows:
// normal, altitude, distance and, where there is one, sky view. Within each label the lightness
// (OKLab) of pixels is a linear function of 1, altitude, ln distance and
//   x = max(0, normal · sun) + share of the sky,
// for suns in steps of 6°; lightness beyond 2.5 standard deviations is clipped. The mean of suns,
// weighted by exp(Δ explained / .004), is the estimate. Pixels of unused_label and of the sky do
// not count. Cast shadow is not modelled: a few degrees of the sun move its edge by its own width.
PaintingLight find_painting_light(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& labels,
                                  const GuidanceBuffers& guidance,
                                  const PaintingLightParameters& parameters = {});

}  // namespace belvedere
