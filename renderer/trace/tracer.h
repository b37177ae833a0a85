#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "renderer/trace/camera.h"
#include "renderer/trace/traced_part.h"
#include "terrain/deform/deform.h"

namespace belvedere {

struct TracerParameters {
  // Embree's vector instructions: "any", the widest of this machine, or one of instruction_sets(),
  // pinned for pictures that must be the same on several machines. See description().
  std::string instruction_set = "any";
  int tile_cells =
      64;  // cells on a side of the grids passed to Embree, 1…1024; changes speed and memory only
};

// Owns the acceleration structure over a deformed surface. tracer.cpp is the only file that uses
// Embree. Immutable; all calls are safe from any thread.
//
// Facets: vertices (x, y) of the surface are posts; the cell between posts (x, y) and (x+1, y+1) is
// two triangles, (x, y) (x+1, y) (x, y+1) and (x+1, y+1) (x, y+1) (x+1, y), so the diagonal runs
// from the north-east to the south-west post. Cells replaced by a finer window are left out;
// SurfaceWindow describes how both meet.
class Tracer {
 public:
  // Reads the surface's posts while tracing: the surface must outlive the tracer and stay
  // unchanged. Throws Error(limit) where memory would not suffice or the machine lacks the
  // instruction set, Error(bug) for fewer than 2 × 2 posts.
  explicit Tracer(const DeformedSurface& surface, const TracerParameters& parameters = {});
  explicit Tracer(const DeformedSurface&&, const TracerParameters& = {}) = delete;
  ~Tracer();
  Tracer(Tracer&&) noexcept;
  Tracer& operator=(Tracer&&) noexcept;

  // Rays in the deformed world (not relative to the surface's origin). Every 16 rays are a bundle;
  // bundles of neighbouring rays are fastest. Facets are hit from both sides. A ray with a NaN
  // misses.
  void intersect(std::span<const Ray> rays, std::span<Hit> hits) const;
  // Whether a ray is blocked within [0, reach_m]. `blocked` gets 1 or 0 per ray; a ray with a NaN
  // is free.
  void occluded(std::span<const Ray> rays, double reach_m, std::span<std::uint8_t> blocked) const;

  // "Embree 3.13.5, AVX2", followed by "pinned" where the parameters fix it: for provenance.
  std::string description() const;
  // Memory of Embree's structure, without the posts.
  std::size_t memory_bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace belvedere
