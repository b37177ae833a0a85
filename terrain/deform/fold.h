#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "terrain/deform/deform.h"

namespace belvedere {

// A facet of the surface (see renderer/trace/tracer.h: the cell's north-western or south-eastern triangle) that handles turned over in
// plan: its posts no longer run the same way round, or lie in a line. There the ground covers itself.
struct Fold {
  int column = 0;  // of the cell's north-western post
  int row = 0;
  bool south_east = false;
  glm::dvec2 place{0.0};  // undeformed middle of the facet, CRS
  glm::dvec2 moved{0.0};  // where it lies in the deformed world
};

// All of them, by rows. Without handles there is none, as all else moves points up and down only.
std::vector<Fold> find_folds(const Grid<float>& altitude_m, const GeoTransform& transform, const Deformation& deformation);

// What a message says of them, by the handle whose edge (core or radius) is nearest.
struct FoldSummary {
  std::size_t handle = 0;  // index in DeformParameters::handles
  std::size_t facets = 0;
  glm::dvec2 middle{0.0};  // the fold that is nearest to the mean of them all, undeformed place
};
std::vector<FoldSummary> summarize_folds(const std::vector<Fold>& folds, const std::vector<DeformHandle>& handles);

}  // namespace belvedere
