#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "renderer/trace/camera.h"
#include "terrain/deform/deform.h"

namespace belvedere::bench {

// The least that tracing can cost: the same scene and packets as Tracer's, the rays laid out for Embree beforehand, what it
// answers stored as it comes.
class BareEmbree {
 public:
  explicit BareEmbree(const DeformedSurface& surface);
  ~BareEmbree();

  // Lays out rays for the calls below; their number is rounded down to whole packets of 16.
  void prepare(std::span<const Ray> rays, double reach_m);
  std::size_t packets() const;
  // Traces packets first…last; callable from several threads for different packets.
  void intersect(std::size_t first, std::size_t last);
  void occluded(std::size_t first, std::size_t last);
  // How many of the rays hit something in the last pass.
  std::size_t count_hits() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace belvedere::bench
