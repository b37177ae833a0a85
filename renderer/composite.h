#pragma once

#include <vector>

#include "renderer/base/guidance_buffers.h"
#include "renderer/base/image.h"
#include "renderer/paint.h"
#include "texture/match_field.h"

namespace belvedere {

// out = texel + residual · (base_target - base_exemplar), in encoded sRGB (look/recipe.md, From an exemplar). Sky and unmatched
// pixels take the target's base.
Grid<glm::vec3> transfer_residual(const MatchField& matches, const std::vector<PaintedExemplar>& exemplars,
                                  const Grid<glm::vec3>& target_base, double residual);

// Softens depth edges and the skyline by coverage: a pixel is mixed with its neighbours on the other surface by `front` and `coverage`.
Grid<glm::vec3> blend_edges(const Grid<glm::vec3>& picture, const GuidanceBuffers& guidance);

// Encoded sRGB to scene-linear and back (exact piecewise sRGB curve).
Image decode_srgb(const Grid<glm::vec3>& encoded);
Grid<glm::vec3> encode_srgb(const Image& linear);

}  // namespace belvedere
