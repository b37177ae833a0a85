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
#include "base/guidance_channels.h"
#include "texture/synthesis/guide_stack.h"

namespace belvedere {

// The one table of what steers synthesis: stacks, the scene's `synthesis.weights` and its documentation take the guides from it.
struct GuideKind {
  std::string_view name;                                          // in scenes and messages
  std::string_view meaning;                                       // and how it becomes 0…255
  GuidanceMember channel;                                         // a picture that lacks it has not this guide
  float (*share)(const GuidanceBuffers&, std::size_t) = nullptr;  // the value of pixel i as 0…1, cut off beyond; never asked of sky
  double weight = 1.0;                                            // where a scene says nothing, 0…100; 0 is off
};
// In the order of the stack: among guides of one weight the first counts first.
std::span<const GuideKind> guide_kinds();
std::vector<std::string> guide_names();
// Guide and weight, as SceneSynthesis::weights has them.
std::vector<std::pair<std::string, double>> default_guide_weights();

// Strokes overlap the borders of classes: rock flecks lie on snow, grass reaches into scree. What counts for copying is whose paint a pixel
// shows, in the exemplar and in the target alike: labels of the painted class, and the base colour of where that paint came from; within a
// class the pixel's own, as far as strokes carry their colour.
struct PaintedClasses {
  Grid<LandCoverClass> land_cover;
  Grid<glm::vec3> base;  // encoded sRGB
};
PaintedClasses find_painted_classes(const Grid<std::uint32_t>& sources, const GuidanceBuffers& guidance, const Grid<glm::vec3>& base);

// Guides for synthesis from buffers, quantized alike for exemplar and target, each to 0…255 (0 in the sky). Needs depths. Scanned paintings
// lack most channels: a guide whose channel is absent is left out, and synthesis says so. Labels are the ids of `land_cover`: the buffers'
// own or the painted ones; sky is 255, because the sky is painted, not copied.
GuideStack make_guide_stack(const GuidanceBuffers& guidance, const Grid<LandCoverClass>& land_cover);

}  // namespace belvedere
