#include "terrain/deform/undeform.h"

#include <cmath>

namespace belvedere {

std::optional<glm::dvec3> undeform(const Deformation& deformation, glm::dvec3 deformed) {
  const DeformParameters& p = deformation.parameters();
  // Exaggeration and bend depend on the position after the handles.
  const glm::dvec2 from = glm::dvec2(deformed) - deformation.viewer_xy();
  const double distance_m = std::sqrt(from.x * from.x + from.y * from.y);
  const double moved_z = p.exaggeration_base_m +
                         (deformed.z + deformation.drop_m(distance_m) - p.exaggeration_base_m) /
                             deformation.exaggeration(distance_m);
  if (p.summits.empty() && !deformation.moves_in_plan())
    return glm::dvec3(deformed.x, deformed.y, moved_z);
  const std::optional<glm::dvec2> position = deformation.source_of(glm::dvec2(deformed));
  if (!position) return std::nullopt;
  // The height added by handles, field and summits now depends only on the altitude and grows with
  // it: secant method.
  const auto error = [&](double z) {
    return deformation.rearranged({position->x, position->y, z}).z - moved_z;
  };
  double z = moved_z;
  double off = error(z);
  double next = z - off;
  constexpr int rounds = 24;
  constexpr double close_m = 1e-3;
  for (int round = 0; round < rounds && std::abs(off) >= close_m; ++round) {
    const double next_off = error(next);
    const double slope = next_off - off;
    const double step = std::abs(slope) > 1e-12 ? next_off * (next - z) / slope : next_off;
    z = next;
    off = next_off;
    next = z - step;
  }
  return glm::dvec3(*position, z);
}

}  // namespace belvedere
