#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "terrain/deform/deform.h"

namespace belvedere {

// A facet of the surface (see renderer/trace/tracer.h: the cell's north-western or south-eastern
// triangle) that handles or the field fold over in plan: its orientation is reversed or its posts
// are collinear. There the ground covers itself.
struct Fold {
  int column = 0;  // of the cell's north-western post
  int row = 0;
  bool south_east = false;
  glm::dvec2 position{0.0};  // undeformed centre of the facet, CRS
  glm::dvec2 moved{0.0};     // its position in the deformed world
};

// All of them, by rows. Without handles and field there are none, as all other steps move points
// only up and down.
std::vector<Fold> find_folds(const Grid<float>& altitude_m, const GeoTransform& transform,
                             const Deformation& deformation);

// Summary for messages, by the handle within whose radius they lie, the one whose centre is nearest
// in radii; all others are of the field, if there is one.
struct FoldSummary {
  std::optional<std::size_t> handle;  // index in DeformParameters::handles; none: of the field
  std::size_t facets = 0;
  glm::dvec2 centre{0.0};  // undeformed position of the fold nearest to the mean of them all
};
std::vector<FoldSummary> summarize_folds(const std::vector<Fold>& folds,
                                         const DeformParameters& deform);

}  // namespace belvedere
