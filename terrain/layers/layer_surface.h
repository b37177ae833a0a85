#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "base/pixel_rect.h"
#include "terrain/cover/layer_inputs.h"
#include "terrain/layers/layer_coverage.h"

namespace belvedere {

// Coefficients whose cubic B-spline passes through the values at the cells' centres (sample_bspline reads it): smooth to the second
// derivative, without facets, and peaks keep their height. The recursive prefilter's answer, √3 (√3 - 2)^|k|, cut off where it is below a
// float's last bit, so that a coefficient hangs on 16 cells around it alone; borders replicated.
Grid<float> spline_coefficients(const Grid<float>& values);

// How far a coefficient looks, cells.
inline constexpr int spline_reach = 16;

// A piece of ground with its layers on it.
struct LayerSurface {
  Grid<float> altitude_m;  // with the layers' bumps
  Grid<glm::vec3> normal;  // of that, unit length; x east, y north, z up
  Grid<glm::vec3> colour;  // sRGB as encoded, 0…255
};

// At `factor` × `factor` places a cell of the DEM: `cells` is a rectangle of that finer raster, which begins where the DEM does. Altitudes
// between cells are of the spline through them; what lies finer comes from the layers' noise. Any rectangle has the bits of the whole.
LayerSurface layer_surface(const LayerProgram& program, const LayerGround& ground, int factor, const PixelRect& cells, std::uint64_t seed);

}  // namespace belvedere
