#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "terrain/deform/deform.h"

namespace belvedere {

// A facet of the surface (see renderer/trace/tracer.h: the cell's north-western or south-eastern
// triangle) that handles fold over in plan: its orientation is reversed or its posts are collinear.
// There the ground covers itself.
struct Fold {
  int column = 0;  // of the cell's north-western post
  int row = 0;
  bool south_east = false;
  glm::dvec2 position{0.0};  // undeformed centre of the facet, CRS
  glm::dvec2 moved{0.0};     // its position in the deformed world
};

// All of them, by rows. Without handles there are none, as all other steps move points only up and
// down.
std::vector<Fold> find_folds(const Grid<float>& altitude_m, const GeoTransform& transform,
                             const Deformation& deformation);

// Summary for messages, by the handle whose edge (core or radius) is nearest.
struct FoldSummary {
  std::size_t handle = 0;  // index in DeformParameters::handles
  std::size_t facets = 0;
  glm::dvec2 centre{0.0};  // undeformed position of the fold nearest to the mean of them all
};
std::vector<FoldSummary> summarize_folds(const std::vector<Fold>& folds,
                                         const std::vector<DeformHandle>& handles);

}  // namespace belvedere
