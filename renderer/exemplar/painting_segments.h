#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <string>
#include <vector>

#include "base/grid.h"
#include "texture/segment/segment.h"

namespace belvedere {

// A painting in pieces, for a mask of its classes to be made of.
struct PaintingSegments {
  Grid<std::uint16_t> pieces;       // of each pixel of the painting; no_piece where it is transparent
  JoinTree tree;                    // of the pieces
  std::size_t groups = 0;           // that were found
  std::vector<std::uint8_t> guess;  // for each node of the tree the class it looks like: a first guess, for a human to mend
};
inline constexpr std::uint16_t no_piece = std::numeric_limits<std::uint16_t>::max();

// `picture` encoded sRGB, `alpha` empty or of its size. Groups of `theta` are nodes of the tree. Error(input), naming `path`, for pictures
// under 32 pixels a side, of one colour, or transparent everywhere.
PaintingSegments segment_painting(const Grid<glm::vec3>& picture, const Grid<float>& alpha, double theta, const std::string& path);

// What a part of a painting is like: means over its pixels.
struct PartLook {
  glm::dvec3 oklab{0.0};
  double height = 0.0;      // 0 at the upper edge … 1 at the lower one
  double upper_edge = 0.0;  // share of the painting's upper edge that it holds
  double across = 0.0;      // mean steps of lightness along rows,
  double down = 0.0;        // and along columns: larger where strokes lie level
  double rough = 1.0;       // both together over the whole painting's: sky is the smoothest that a painting has
};
// Sky is above, smooth, blue or bright; water blue and low or painted level; snow is bright and grey, woods are dark and green or olive,
// and so on: the id of a class for any look.
std::uint8_t guess_class(const PartLook& look);

// The number that a mask has for each pixel: of each group of pieces its class, unused_label for those without.
Grid<std::uint8_t> class_mask(const PaintingSegments& segments, const Partition& groups, const std::vector<std::uint8_t>& classes);
// The guess for each group of a cut through the tree.
std::vector<std::uint8_t> guesses_of(const PaintingSegments& segments, std::size_t count);

}  // namespace belvedere
