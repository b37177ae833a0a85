#pragma once

#include <memory>
#include <span>

#include "renderer/trace/camera.h"
#include "terrain/deform/deform.h"

namespace belvedere::bench {

// Lower bound of the cost of tracing: the same scene and packets as Tracer's, with the rays
// prepared for Embree beforehand and its results stored unchanged.
class BareEmbree {
 public:
  explicit BareEmbree(const DeformedSurface& surface);
  ~BareEmbree();

  // Prepares rays for the calls below; their number is rounded down to whole packets of 16.
  void prepare(std::span<const Ray> rays, double reach_m);
  std::size_t packets() const;
  // Traces packets first…last; may be called from several threads for different packets.
  void intersect(std::size_t first, std::size_t last);
  void occluded(std::size_t first, std::size_t last);
  // Number of rays that hit something in the last pass.
  std::size_t count_hits() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace belvedere::bench
