#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace belvedere {

// A piece of ground that is moved, rotated about the vertical, scaled or raised, with everything on
// it.
struct DeformHandle {
  glm::dvec2 centre{0.0};   // undeformed position, CRS
  glm::dvec2 move_m{0.0};   // east, north
  double rotate_deg = 0.0;  // clockwise seen from above, -170…170
  double scale = 1.0;       // in plan, 0.2…5
  double raise_m = 0.0;     // before exaggeration, ±5000
  double radius_m = 0.0;    // limit of its effect; 0: unbounded, the whole plane follows
  double core_m =
      0.0;  // up to this distance from the centre the ground moves rigidly; less than radius_m
  // A pin fixes only its centre; the ground around it rotates with the other handles (the point
  // handle of Schaefer 2006). Its core, rotation and scale are ignored.
  bool pin = false;
};

// Handles combined by moving least squares (Schaefer, McPhail & Warren 2006, rigid form) with
// compact support.
// At a position v, handle i has weight w_i = s / (1 - s), s falling from 1 at the core's edge to 0
// at the radius by the quintic smoothstep. Fixed ground has weight 1 against all of them. v is
// moved by the similarity A that minimizes Σ w_i (|A p_i - q_i|² + r_i² |M - M_i|²) + Σ w_i / Σ w ·
// (|A p_i - p_i|² + r_i² |M - 1|²): p_i → q_i the centres, r_i the radii, M_i the handles'
// rotations, M that of A. Its rotation is Schaefer's closed form, its scale the weighted geometric
// mean of the handles' scales (the least-squares scale would shrink the ground between a rotated
// mountain and fixed ground); likewise the rotations M_i and 1 enter by the mean of their angles,
// so that large rotations fade evenly. The transform is exact in a core, identity from the radius
// on, and twice continuously differentiable everywhere. A single rotated handle shears the ring
// between, which preserves areas and cannot fold; one moved by more than (radius - core) / 1.9
// folds the ground ahead of it. Handles without a radius have weights that grow with 1 / (distance
// from the core)², and no ground is fixed: they carry the plane with them, exactly if they all
// agree.
class HandleField {
 public:
  HandleField() = default;
  // Throws Error(usage), naming the field (handles.0), for a core that is not within its radius,
  // overlapping cores, and values that are not finite.
  explicit HandleField(std::vector<DeformHandle> handles);

  struct Moved {
    glm::dvec2 position;
    double raise_m;
  };
  Moved move(glm::dvec2 position) const;
  // Nothing moves: move() returns every position unchanged.
  bool is_identity() const { return handles_.empty(); }
  // A rectangle outside which nothing moves: lower and upper corner.
  glm::dvec2 lowest() const { return lowest_; }
  glm::dvec2 highest() const { return highest_; }
  const std::vector<DeformHandle>& handles() const { return given_; }

 private:
  struct Handle {
    glm::dvec2 centre;
    glm::dvec2 image;
    glm::dvec2 turn;   // complex number of the rotation, times the scale
    double angle;      // of it, counter-clockwise, rad
    double log_scale;  // of its length
    double raise_m;
    double radius_m;
    double core_m;
    bool pin;
    bool still;  // it moves nothing, but holds its ground
  };
  static Moved carry(const Handle& handle, glm::dvec2 position);

  std::vector<DeformHandle> given_;
  std::vector<Handle> handles_;  // empty if none of them moves anything
  glm::dvec2 lowest_{0.0};
  glm::dvec2 highest_{0.0};
};

}  // namespace belvedere
