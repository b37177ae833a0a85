#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/guidance_buffers.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {

// The table of guides that steer synthesis. Stacks, the scene's `synthesis.weights` and the
// documentation are made from it.
struct GuideKind {
  std::string_view name;     // in scenes and messages
  std::string_view meaning;  // and how it maps to 0…255
  GuidanceMember channel;    // a picture without this channel lacks the guide
  float (*share)(const GuidanceBuffers&,
                 std::size_t) = nullptr;  // value of pixel i as 0…1, clamped; never called for sky
  double weight = 1.0;                    // default where a scene gives none, 0…100; 0 is off
};
// In the order of the stack: of guides with equal weight the first takes precedence.
std::span<const GuideKind> guide_kinds();
std::vector<std::string> guide_names();
// Guide and weight, in the form of SceneSynthesis::weights.
std::vector<std::pair<std::string, double>> default_guide_weights();

// Strokes overlap the borders of classes: rock flecks lie on snow, grass reaches into scree. For
// copying, the painted class counts, in the exemplar and in the target: labels of the class whose
// paint a pixel shows, and the base colour of that paint's origin; within a class the pixel's own
// base, as far as strokes carry their colour.
struct PaintedClasses {
  Grid<LandCoverClass> land_cover;
  Grid<glm::vec3> base;  // encoded sRGB
};
PaintedClasses find_painted_classes(const Grid<std::uint32_t>& sources,
                                    const GuidanceBuffers& guidance, const Grid<glm::vec3>& base);

// Guides for synthesis from buffers, quantized the same way for exemplar and target, each to 0…255
// (0 in the sky). Needs depths. Scanned paintings lack most channels: a guide whose channel is
// missing is left out, and synthesis reports it. Labels are the ids of `land_cover`: the buffers'
// own or the painted ones; sky is 255, because the sky is painted, not copied.
GuideStack make_guide_stack(const GuidanceBuffers& guidance,
                            const Grid<LandCoverClass>& land_cover);

}  // namespace belvedere
