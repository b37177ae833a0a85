#pragma once

#include <vector>

#include "base/guidance_buffers.h"
#include "base/image.h"
#include "texture/strokes/brush.h"
#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/match_field.h"

namespace belvedere {

// An exemplar with everything a composite needs: where buffers meet pictures.
struct PaintedExemplar {
  Exemplar exemplar;        // what synthesis compares
  Grid<glm::vec3> picture;  // encoded sRGB, full depth, without trees and sky strokes
  Grid<glm::vec3> base;     // its base picture, encoded sRGB; empty for a scan
};

// What rock takes of the base picture's difference: all, so that of a texel's own planes nothing is left but the strokes on them.
inline constexpr double rock_residual = 1.0;
// Snow and ice take all of it as well, and of the texel what its strokes add to its base, no channel by more than this: a fleck of what
// lay beside the snow that it was copied from is no dirt on other snow.
inline constexpr float snow_strokes_most = 0.07F;

// paint = texel + residual · (base_target - base_exemplar), in encoded sRGB (why: docs/architecture.md), cut to 0…1. residual 0…1; where
// `shown` (empty: nowhere) is rock, rock_residual; where it is snow or ice, base_target + (texel - base_exemplar), held softly.
// Air lies over paint as it lies over the base: out = base_target + (1 - haze) · (paint - base_target); target_haze empty: no air.
// Pixels without a match, sky among them, take the target's base; exemplars without a base (scans) give their texel as it is. Error(input)
// for matches outside of the exemplars.
Grid<glm::vec3> transfer_residual(const MatchField& matches, const std::vector<PaintedExemplar>& exemplars,
                                  const Grid<glm::vec3>& target_base, const Grid<float>& target_haze, double residual,
                                  const Grid<LandCoverClass>& shown = {});

// What a texture model made of a picture's pixels, and its own light, which the residual takes away: as an exemplar's texel and base, at
// the pixel itself. Only where `made` is not 0. All of the picture's size.
struct ModelPaint {
  Grid<std::uint8_t> made;
  Grid<glm::vec3> texel;  // encoded sRGB
  Grid<glm::vec3> base;
};
// The same law for paint of a model: the pixels of `picture` (transfer_residual's) where it was made.
void lay_model_paint(Grid<glm::vec3>& picture, const ModelPaint& paint, const Grid<glm::vec3>& target_base, const Grid<float>& target_haze,
                     double residual, const Grid<LandCoverClass>& shown);

// Paint as it would look where the base is a middle grey: of a texel that is copied for a class, what transfer_residual lays over any
// place. Its base is null where nobody knows it. Not cut to 0…1.
inline constexpr float even_grey = 0.5F;
glm::vec3 in_even_light(glm::vec3 texel, const glm::vec3* its_base, double residual, LandCoverClass shown);
// Such paint where `made` is not 0, laid over a picture in the light and air of the place.
struct KnitPaint {
  Grid<std::uint8_t> made;
  Grid<glm::vec3> even;
};
void lay_even_paint(Grid<glm::vec3>& picture, const KnitPaint& paint, const Grid<glm::vec3>& target_base, const Grid<float>& target_haze,
                    double residual, const Grid<LandCoverClass>& shown);

// Borders of classes as strokes leave them. A texel is of one class, and a picture of texels alone is torn like paper where classes meet.
// Where in `draft` two classes share a pixel, the other one's paint is mixed in by its share, in the colour of the place its stroke grew
// from: that of `copied` where this shows the same class, else that of `base` (the target's, of no hand). Pixels of one class alone stay as
// they are, bit for bit. All in encoded sRGB, where paint mixes; `shown` is the class of each pixel of `copied`.
Grid<glm::vec3> mix_borders(const Grid<glm::vec3>& copied, const Painting& draft, const Grid<LandCoverClass>& shown,
                            const Grid<LandCoverClass>& land_cover, const Grid<glm::vec3>& base);

// Softens depth edges and the skyline. A pixel of which only the part `front` shows the surface it was painted for gets the rest from those
// of its eight neighbours that lie on another surface (depth differs by more than 3 %, or one is sky), in linear light, as an eye or lens
// would mix them. Pixels with front 1, or with no other surface around, stay as they are. `picture` encoded sRGB. Needs depth_m and
// front.
Grid<glm::vec3> blend_edges(const Grid<glm::vec3>& picture, const GuidanceBuffers& guidance);
// Rows that blend_edges looks at above and below, for pictures made in bands.
inline constexpr int blend_margin_px = 1;

// Encoded sRGB to scene-linear and back (exact piecewise curve of IEC 61966-2-1, continued below 0 and beyond 1).
Image decode_srgb(const Grid<glm::vec3>& encoded);
Grid<glm::vec3> encode_srgb(const Image& linear);

}  // namespace belvedere
