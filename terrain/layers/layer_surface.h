#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "base/pixel_rect.h"
#include "terrain/cover/layer_inputs.h"
#include "terrain/layers/layer_coverage.h"

namespace belvedere {

// Coefficients whose cubic B-spline interpolates the values at the cells' centres (evaluated by
// sample_bspline): smooth to the second derivative, without facets, and peaks keep their height.
// The impulse response of the recursive prefilter, √3 (√3 - 2)^|k|, is truncated below a float's
// last bit, so that a coefficient depends only on 16 cells around it; borders replicated.
Grid<float> spline_coefficients(const Grid<float>& values);

// Radius in cells that a coefficient depends on.
inline constexpr int spline_reach = 16;

// A piece of ground with its layers.
struct LayerSurface {
  Grid<float> altitude_m;  // with the layers' bumps
  Grid<glm::vec3> normal;  // of that, unit length; x east, y north, z up
  Grid<glm::vec3> colour;  // sRGB as encoded, 0…255
};

// At `factor` × `factor` positions per cell of the DEM: `cells` is a rectangle of that finer
// raster, which starts where the DEM does. Altitudes between cells are interpolated by spline;
// finer detail comes from the layers' noise. Any rectangle has the bits of the whole.
LayerSurface layer_surface(const LayerProgram& program, const LayerGround& ground, int factor,
                           const PixelRect& cells, std::uint64_t seed);

}  // namespace belvedere
