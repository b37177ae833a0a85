#pragma once

#include <cstddef>
#include <glm/vec3.hpp>

#include "base/grid.h"
#include "renderer/register/registered_view.h"

namespace belvedere {

// What a registration says of each pixel of a painting, at any size; NaN where it shows sky.
struct RegisteredGround {
  Grid<float> altitude_m;
  Grid<float> distance_m;  // from the eye
  Grid<float> sigma_px;    // how far the place may be off in one direction: standard deviation, in
                           // pixels of the painting, without that of the view
  std::size_t folded = 0;  // folded_facets() of the view, where that is asked for
  Grid<glm::dvec2> position = {};  // CRS
  Grid<glm::vec3> normal = {};     // of the exaggerated ground, where handles moved it
};

// Of all pixels of a view, without folded facets.
RegisteredGround trace_registered(const RegisteredView& view);
// Facets of the ground in the picture that the registration turns over.
std::size_t folded_facets(const RegisteredView& view);

// The largest of 20, 50, 100, 200, 500 m that gives some ten contours or more.
double contour_step_m(const Grid<float>& altitude_m);

// The painting with lines over it: contours of altitude in black, every fifth in white, the
// terrain's skyline in red, its other silhouettes in yellow. All of the same size.
Grid<glm::vec3> contours_over(const Grid<glm::vec3>& painting, const RegisteredGround& ground,
                              double step_m);

// From pale, trusted, to dark red at limit_px and beyond; sky is blue.
Grid<glm::vec3> trust_picture(const Grid<float>& sigma_px, double limit_px);

}  // namespace belvedere
