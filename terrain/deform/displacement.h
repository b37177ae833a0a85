#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "base/grid.h"
#include "base/matrix/matrix.h"

namespace belvedere {

// How far ground is displaced, as seen from the viewer: across the line of sight, positive to the
// right, and upwards after exaggeration.
struct Displacement {
  double lateral_m = 0.0;
  double upward_m = 0.0;
};

// A place whose displacement is known.
struct DisplacedPlace {
  glm::dvec2 position{0.0};  // undeformed, CRS
  Displacement moved;        // within ±1e5
  Displacement noise;        // standard deviation of both, m, > 0
};

// A displacement of the ground that is known at some places and in between as likely as those say
// (kriging). A painter moves some mountains and leaves the rest, so its size differs over the map:
//   cov(x, y) = amp(x) amp(y) k(|x - y| / length),  k(t) = (1 + √3 t) exp(-√3 t) (Matérn 3/2)
//   amp(x)² = still² + Σ w_j m_j² / (0.15 + Σ w_j),  w_j = exp(-|x - x_j|² / (2 reach²))
// m_j² is what place j moves beyond 1.5 times its noise: (lateral² + upward²) / 2 - (1.5 noise)²,
// within 0 … max².
struct DisplacementParameters {
  double length_m = 5000.0;  // over which displacements are alike, > 0
  double reach_m = 2000.0;   // within which a place tells their size, > 0
  double still_m = 25.0;     // their size away from places that moved, > 0
  double max_m = 1500.0;     // the largest size, > 0
  std::vector<DisplacedPlace> places;
};

// amp at a position; `without`: as if that place did not count.
double displacement_size_m(const DisplacementParameters& parameters, glm::dvec2 position,
                           std::optional<std::size_t> without = {});
// cov between the places, without noise.
Matrix displacement_covariance(const DisplacementParameters& parameters);

// A field prepared for evaluation. Immutable and thread-safe.
class DisplacementField {
 public:
  DisplacementField() = default;
  // Throws Error(usage), naming the field (places.0), for values out of range.
  explicit DisplacementField(DisplacementParameters parameters);

  bool is_identity() const { return parameters_.places.empty(); }
  // The expected displacement: 0 far from all places. Of many places from nodes eight to a reach
  // near them and four to a length farther away, within 2e-3 of the largest displacement.
  Displacement at(glm::dvec2 position) const;
  Displacement exactly_at(glm::dvec2 position) const;
  // Its standard deviation, of both parts.
  Displacement deviation(glm::dvec2 position) const;
  const DisplacementParameters& parameters() const { return parameters_; }

 private:
  // Displacements (lateral, upward) at nodes, and between them.
  struct Nodes {
    glm::dvec2 first{0.0};  // CRS
    double step_m = 1.0;
    Grid<glm::dvec2> values;
    std::optional<glm::dvec2> at(glm::dvec2 position) const;  // none outside
  };
  Nodes tabulate(double step_m, double margin_m) const;
  // cov of a position with every place; all zero beyond reach of them.
  std::vector<double> covariance_with(glm::dvec2 position) const;

  DisplacementParameters parameters_;
  std::vector<double> sizes_m_;  // amp at the places
  std::vector<double> lateral_;  // (K + noise²)⁻¹ times the displacements
  std::vector<double> upward_;
  std::optional<Cholesky> lateral_covariance_;  // K + noise²
  std::optional<Cholesky> upward_covariance_;
  Nodes near_, far_;  // empty: computed exactly
};

}  // namespace belvedere
