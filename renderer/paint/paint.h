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

}  // namespace belvedere
