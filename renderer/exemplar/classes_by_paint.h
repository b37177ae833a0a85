#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "base/grid.h"
#include "base/guidance_buffers.h"

namespace belvedere {

// What the map says of the places that the pixels of a painting show: grids of one size, which may
// be smaller than the painting.
struct PlaceClasses {
  Grid<std::uint8_t> labels;  // class ids, sky included; unused_label: nothing is known
  Grid<float> altitude_m;     // of the ground; not read in the sky
};
// Those of a painting's guidance.
PlaceClasses places_of(const GuidanceBuffers& guidance);

// The class of each pixel of a painting (encoded sRGB), by what the map says of places near by and
// by the colour of the paint. Expectation maximization: every class has a histogram of colours
// (OKLab), which the pixels fill by their probabilities; those follow from the histograms and from
// what the map says: its labels within a few pixels (registrations are no better), the shares of
// classes at that altitude, and a little of each class of the ground. A class that the map does
// not show is not found. Water and settlement, which are narrower than the errors of places, stay
// as on the map.
Grid<std::uint8_t> classes_by_paint(const Grid<glm::vec3>& painting, const PlaceClasses& places);

}  // namespace belvedere
