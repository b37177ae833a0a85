#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "base/guidance_buffers.h"
#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/guide_stack.h"

namespace belvedere {

// An exemplar with everything a composite needs: where buffers meet pictures.
struct PaintedExemplar {
  Exemplar exemplar;        // what synthesis compares
  Grid<glm::vec3> picture;  // encoded sRGB, full depth, without trees and sky strokes
  Grid<glm::vec3> base;     // its base picture, encoded sRGB; empty for a scan
};

// Strokes overlap the borders of classes: rock flecks lie on snow, grass reaches into scree. What counts for copying is whose paint a pixel
// shows, in the exemplar and in the target alike: labels of the painted class, and the base colour of where that paint came from.
struct PaintedClasses {
  Grid<LandCoverClass> land_cover;
  Grid<glm::vec3> base;  // encoded sRGB
};
PaintedClasses find_painted_classes(const Grid<std::uint32_t>& sources, const GuidanceBuffers& guidance, const Grid<glm::vec3>& base);

// Guides for synthesis from buffers, quantized alike for exemplar and target, each to 0…255:
//   altitude     20 m a step from 0 m           tone          0…1
//   distance     log from 500 m to 500 km       shadow        0 in shadow … 1 lit
//   slope        0…90°                          fall_line_x/y -1…1, 0 at 127.5 rounded up
// A channel the buffers lack is left out. Labels are the ids of `land_cover`: the buffers' own or the painted ones; sky is 255, because the
// sky is painted, not copied.
GuideStack make_guide_stack(const GuidanceBuffers& guidance, const Grid<LandCoverClass>& land_cover);

}  // namespace belvedere
