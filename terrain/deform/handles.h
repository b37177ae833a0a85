#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace belvedere {

// A piece of ground that is moved, turned about the vertical, scaled or raised, with all that lies on it.
struct DeformHandle {
  glm::dvec2 center{0.0};   // undeformed place, CRS
  glm::dvec2 move_m{0.0};   // east, north
  double rotate_deg = 0.0;  // clockwise seen from above, -170…170
  double scale = 1.0;       // in plan, 0.2…5
  double raise_m = 0.0;     // before exaggeration, ±5000
  double radius_m = 0.0;    // where its effect ends; 0: nowhere, the whole plane follows
  double core_m = 0.0;      // up to this distance from the centre the ground moves as one rigid piece; less than radius_m
  // A pin holds only its centre; the ground around it turns with the other handles (the point handle of Schaefer 2006). Its core,
  // rotation and scale do not count.
  bool pin = false;
};

// Handles brought together by moving least squares (Schaefer, McPhail & Warren 2006, rigid form) with compact support.
//
// At a place v, handle i has weight w_i = s / (1 - s), s falling from 1 at the core's edge to 0 at the radius by the quintic
// smoothstep, and against all of them, with weight 1, stands the ground that would stay. The similarity A that leaves least of
//   Σ w_i (|A p_i - q_i|² + r_i² |M - M_i|²) + Σ w_i / Σ w · (|A p_i - p_i|² + r_i² |M - 1|²)
// moves v: p_i → q_i the centres, r_i the radii, M_i the handles' rotations, M that of A. Its rotation is Schaefer's closed form, its scale
// the weighted geometric mean of the handles' scales (their least-squares scale would shrink what lies between a turned mountain and
// still ground); likewise the rotations M_i and 1 enter by the mean of their angles, so that large turns fade evenly. So the transform is
// exact in a core, identity from the radius on, and twice continuously differentiable between and across both. One turned handle twists the
// belt between, which keeps areas and so folds nothing; one moved by more than (radius - core) / 1.9 folds the ground before it. Handles
// without a radius have weights that grow with 1 / (distance from the core)², and no ground stays: they carry the plane with them, exactly
// so where they all say the same.
class HandleField {
 public:
  HandleField() = default;
  // Throws Error(usage), naming the field (handles.0), for a core that is not within its radius, cores that overlap, and values that are
  // not finite.
  explicit HandleField(std::vector<DeformHandle> handles);

  struct Moved {
    glm::dvec2 place;
    double raise_m;
  };
  Moved move(glm::dvec2 place) const;
  // Nothing moves: move() returns every place as it is.
  bool is_identity() const { return handles_.empty(); }
  // A rectangle outside which nothing moves: lowest and highest corner.
  glm::dvec2 lowest() const { return lowest_; }
  glm::dvec2 highest() const { return highest_; }
  const std::vector<DeformHandle>& handles() const { return given_; }

 private:
  struct Handle {
    glm::dvec2 center;
    glm::dvec2 image;
    glm::dvec2 turn;   // complex number of the rotation, times the scale
    double angle;      // of it, counter-clockwise, rad
    double log_scale;  // of its length
    double raise_m;
    double radius_m;
    double core_m;
    bool pin;
    bool still;  // it moves nothing, but holds
  };
  static Moved carry(const Handle& handle, glm::dvec2 place);

  std::vector<DeformHandle> given_;
  std::vector<Handle> handles_;  // empty where none of them moves anything
  glm::dvec2 lowest_{0.0};
  glm::dvec2 highest_{0.0};
};

}  // namespace belvedere
