#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "texture/segment/segment.h"

namespace belvedere {

// The map at the places that the pixels of a painting show: grids of one size, which may be smaller
// than the painting.
struct PlaceClasses {
  Grid<std::uint8_t> labels;  // class ids, sky included; unused_label: nothing is known
  Grid<float> altitude_m;     // of the ground; not read in the sky
};
// The places of a painting by its guidance.
PlaceClasses places_of(const GuidanceBuffers& guidance);

// The class of each pixel of a painting (encoded sRGB), by what the map says of places near by and
// by the colour of the paint. Expectation maximization: every class has a histogram of colours
// (OKLab), which the pixels fill by their probabilities; those follow from the histograms and from
// what the map says: its labels within a few pixels (registrations are no better), the shares of
// classes at that altitude, and a little of each class of the ground. A class that the map does
// not show is not found. Water and settlement, which are narrower than the errors of places, stay
// as on the map.
Grid<std::uint8_t> classes_by_paint(const Grid<glm::vec3>& painting, const PlaceClasses& places);

// Appearance of a part of a painting: means over its pixels.
struct PartLook {
  glm::dvec3 oklab{0.0};
  double height = 0.0;      // 0 at the upper edge … 1 at the lower one
  double upper_edge = 0.0;  // share of the painting's upper edge
  double across = 0.0;      // mean steps of lightness along rows,
  double down = 0.0;        // and along columns: larger where strokes are horizontal
  double rough = 1.0;  // both together relative to the whole painting's: sky is the smoothest part
                       // of a painting
};

// A painting divided into pieces, to make a mask of its classes.
struct PaintingSegments {
  Grid<std::uint16_t> pieces;  // per pixel of the painting; no_piece where it is transparent
  JoinTree tree;               // of the pieces
  std::size_t groups = 0;      // number of groups found
  // Of each node of the tree: its look, its pixels in the reduced picture, and the class inferred
  // from the look: a first estimate, for the user to correct.
  std::vector<PartLook> looks;
  std::vector<double> pixels;
  std::vector<std::uint8_t> inferred;
};
inline constexpr std::uint16_t no_piece = std::numeric_limits<std::uint16_t>::max();

// `picture` encoded sRGB, `alpha` empty or of its size. Groups of `theta` are nodes of the tree.
// Error(input) that names `path`, for pictures under 32 pixels on a side, of one colour, or
// transparent everywhere.
PaintingSegments segment_painting(const Grid<glm::vec3>& picture, const Grid<float>& alpha,
                                  double theta, const std::string& path);

// Infers a class id from the appearance: sky is above, smooth, blue or bright; water is blue and
// low or painted horizontally; snow is bright and grey, forest is dark and green or olive, and so
// on.
std::uint8_t infer_class(const PartLook& look);

// The mask value of each pixel: the class of its group of pieces, unused_label for those without.
Grid<std::uint8_t> class_mask(const PaintingSegments& segments, const Partition& groups,
                              const std::vector<std::uint8_t>& classes);

}  // namespace belvedere
