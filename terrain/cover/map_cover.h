#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "base/land_cover_class.h"

namespace belvedere {

// An area of a map that is of one class.
struct CoverArea {
  // Outlines and holes alike, m in the scene's CRS, each closed by itself: what an odd number of them encloses belongs to the area, also
  // where they cross themselves.
  std::vector<std::vector<glm::dvec2>> rings;
  LandCoverClass painted_as = LandCoverClass::water;
  double rank = 0.0;   // the larger lies over the smaller, of equal ones the later
  bool still = false;  // a lake: level water
};

// A river with its width.
struct CoverCourse {
  std::vector<glm::dvec2> places;   // m in the scene's CRS
  std::vector<float> half_width_m;  // at each of them, linear between
  LandCoverClass painted_as = LandCoverClass::water;
  double rank = 0.0;
  int kind = 0;  // of whoever made it: nothing here asks for it
};

// Areas and rivers of a map, asked for the class at a place: exact outlines, whatever cells the ground has. Answers within `low` … `high`
// and nowhere else; what lies outside costs nothing.
class MapCover {
 public:
  MapCover(const std::vector<CoverArea>& areas, std::vector<CoverCourse> courses, glm::dvec2 low, glm::dvec2 high);

  // The class on top; sky where the map has nothing.
  LandCoverClass at(glm::dvec2 place) const;
  // Whether what lies on top there is a lake.
  bool is_still(glm::dvec2 place) const;
  // As they were given.
  const std::vector<CoverCourse>& courses() const { return courses_; }
  // For reports: bytes held.
  std::size_t bytes() const;

 private:
  struct Shape {
    LandCoverClass painted_as;
    bool still;
    bool is_course;
  };
  struct Edge {
    glm::dvec2 from, to;
    float half_from, half_to;  // of courses
  };
  // What a shape has in a box: one of its edges, or that the box's own place lies in it.
  struct Piece {
    std::uint32_t shape;
    std::uint32_t edge;  // own_place: no edge
  };
  struct Filler;
  static constexpr std::uint32_t own_place = 0xFFFFFFFFU;
  static constexpr std::int32_t none = -1;

  std::int32_t find(glm::dvec2 place) const;
  glm::dvec2 place_of(int column, int row) const;

  std::vector<CoverCourse> courses_;
  glm::dvec2 low_, high_;
  double box_m_ = 1.0;
  int columns_ = 0, rows_ = 0;
  std::vector<Shape> shapes_;  // the lowest first
  std::vector<Edge> edges_;
  std::vector<std::int32_t> full_;    // of a box: the topmost area that covers it, none
  std::vector<std::uint32_t> first_;  // of a box: its first piece; one more at the end
  std::vector<Piece> pieces_;         // by box, then by rising shape
};

}  // namespace belvedere
