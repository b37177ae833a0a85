#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "base/land_cover_class.h"

namespace belvedere {

// An area of a map with one class.
struct CoverArea {
  // Outlines and holes, m in the scene's CRS, each closed: the area is what they enclose an odd
  // number of times, also where they cross themselves.
  std::vector<std::vector<glm::dvec2>> rings;
  LandCoverClass painted_as = LandCoverClass::water;
  double rank = 0.0;   // the larger is on top, of equal ones the later
  bool still = false;  // a lake: level water
};

// A river with its width.
struct CoverRiver {
  std::vector<glm::dvec2> positions;  // m in the scene's CRS
  std::vector<float> half_width_m;    // at each of them, linear between
  LandCoverClass painted_as = LandCoverClass::water;
  double rank = 0.0;
  int kind = 0;  // for the caller; not used here
};

// Areas and rivers of a map, queried for the class at a position: exact outlines, independent of
// the cells of the ground. Answers only within `low` … `high`; shapes outside are dropped.
class MapCover {
 public:
  MapCover(const std::vector<CoverArea>& areas, std::vector<CoverRiver> centrelines, glm::dvec2 low,
           glm::dvec2 high);

  // The class on top; sky where the map has nothing.
  LandCoverClass at(glm::dvec2 position) const;
  // Whether the topmost area there is a lake; rivers, whose width may depend on the view, do not
  // count.
  bool is_still(glm::dvec2 position) const;
  // The shapes as given.
  const std::vector<CoverRiver>& centrelines() const { return centrelines_; }
  // For reports: bytes used.
  std::size_t bytes() const;

 private:
  struct Shape {
    LandCoverClass painted_as;
    bool still;
    bool is_river_line;
  };
  struct Edge {
    glm::dvec2 from, to;
    float half_from, half_to;  // half widths of rivers
  };
  // The part of a shape in a box: one of its edges, or the fact that it covers the box's reference
  // point.
  struct Piece {
    std::uint32_t shape;
    std::uint32_t edge;  // own_position: no edge
  };
  struct Filler;
  static constexpr std::uint32_t own_position = 0xFFFFFFFFU;
  static constexpr std::int32_t none = -1;

  std::int32_t find(glm::dvec2 position, bool areas_alone = false) const;
  glm::dvec2 position_of(int column, int row) const;

  std::vector<CoverRiver> centrelines_;
  glm::dvec2 low_, high_;
  double box_m_ = 1.0;
  int columns_ = 0, rows_ = 0;
  std::vector<Shape> shapes_;  // the lowest first
  std::vector<Edge> edges_;
  std::vector<std::int32_t> full_;    // of a box: the topmost area that covers it, or none
  std::vector<std::uint32_t> first_;  // of a box: its first piece; one more at the end
  std::vector<Piece> pieces_;         // by box, then by rising shape
};

}  // namespace belvedere
