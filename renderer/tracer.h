#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>

#include "renderer/camera.h"
#include "terrain/deform.h"

namespace belvedere {

// Where a ray met the terrain. Only the facet is Embree's answer; distance and place are computed from its posts in double, so
// they are the same on every instruction set.
struct Hit {
  bool found = false;
  double distance_m = 0.0;       // along the unit direction
  double column = 0.0;           // fractional vertex of the grid: place before deformation
  double row = 0.0;
  glm::dvec3 facet_normal{0.0};  // unit, upward, of the deformed facet
};

// Owns the acceleration structure over a deformed surface. tracer.cpp is the only file that knows Embree. Immutable once made, all
// calls are safe from any thread.
class Tracer {
 public:
  // Throws Error(limit) where memory would not suffice.
  explicit Tracer(const DeformedSurface& surface);
  ~Tracer();
  Tracer(Tracer&&) noexcept;

  // Rays in the deformed world (not relative to the surface's origin). Coherent bundles are fastest: 16 neighbouring rays.
  void intersect(std::span<const Ray> rays, std::span<Hit> hits) const;
  // Whether something stands in the way within [0, reach_m]. `blocked` gets 1 or 0 per ray.
  void occluded(std::span<const Ray> rays, double reach_m, std::span<std::uint8_t> blocked) const;

  // "Embree 3.13.5, AVX2": for provenance.
  std::string description() const;
  std::size_t memory_bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace belvedere
