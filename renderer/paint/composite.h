#pragma once

#include <vector>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "texture/strokes/brush.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {

// An exemplar with everything a composite needs.
struct PaintedExemplar {
  Exemplar exemplar;        // compared by synthesis
  Grid<glm::vec3> picture;  // encoded sRGB, full depth, without trees and sky strokes
  Grid<glm::vec3> base;     // its base picture, encoded sRGB; empty for a scan
};

// Share of the difference of two base pictures that is added to a texel, 0…1: of its colour and of
// its lightness. A texel that keeps a part of its own ground's lightness makes a picture darker or
// lighter where painting and palette differ, so paintings take all of it.
struct Residual {
  double colour = 0.75;
  double lightness = 0.75;
  Residual(double both) : colour(both), lightness(both) {}
  Residual(double of_colour, double of_lightness) : colour(of_colour), lightness(of_lightness) {}
  glm::vec3 of(glm::vec3 difference) const {
    const float grey = 0.2126F * difference.x + 0.7152F * difference.y + 0.0722F * difference.z;
    return static_cast<float>(colour) * difference + static_cast<float>(lightness - colour) * grey;
  }
};

// Rock takes the whole difference of the base pictures, so that only the strokes of a texel remain,
// not its own planes.
inline constexpr double rock_residual = 1.0;
// Snow and ice also take the whole difference. The strokes that a texel adds to its base are
// limited to this per channel: a fleck of whatever lay next to the snow it was copied from would
// look like dirt on other snow.
inline constexpr float snow_strokes_max = 0.07F;

// paint = texel + residual of (base_target - base_exemplar), in encoded sRGB (reasons:
// docs/architecture.md), clamped to 0…1. residual 0…1; where `shown` (empty: nowhere) is rock,
// rock_residual; where it is snow or ice, base_target + (texel - base_exemplar), softly limited.
// Air lies over paint as it lies over the base: out = base_target + (1 - haze) · (paint -
// base_target); target_haze empty: no air. Pixels without a match, including the sky, take the
// target's base; exemplars without a base (scans) give their texel unchanged. Error(input) for
// matches outside the exemplars.
Grid<glm::vec3> transfer_residual(const MatchField& matches,
                                  const std::vector<PaintedExemplar>& exemplars,
                                  const Grid<glm::vec3>& target_base,
                                  const Grid<float>& target_haze, const Residual& residual,
                                  const Grid<LandCoverClass>& shown = {});

// Paint that a texture model made for pixels of a picture, and the model's own light, which the
// residual removes. Like an exemplar's texel and base, but at the pixel itself. Valid only where
// `made` is not 0. All of the picture's size.
struct ModelPaint {
  Grid<std::uint8_t> made;
  Grid<glm::vec3> texel;  // encoded sRGB
  Grid<glm::vec3> base;
};
// The same formula for the paint of a model, on the pixels of `picture` (from transfer_residual)
// where it was made.
void lay_model_paint(Grid<glm::vec3>& picture, const ModelPaint& paint,
                     const Grid<glm::vec3>& target_base, const Grid<float>& target_haze,
                     const Residual& residual, const Grid<LandCoverClass>& shown);

// Paint as it would look on a middle grey base: what transfer_residual lays over any position for a
// texel of a class. The base is null where it is unknown. Not clamped to 0…1.
inline constexpr float even_grey = 0.5F;
glm::vec3 in_even_light(glm::vec3 texel, const glm::vec3* its_base, const Residual& residual,
                        LandCoverClass shown);
// Such paint where `made` is not 0, laid over a picture in the light and air of the position.
struct SeamPaint {
  Grid<std::uint8_t> made;
  Grid<glm::vec3> even;
};
void lay_even_paint(Grid<glm::vec3>& picture, const SeamPaint& paint,
                    const Grid<glm::vec3>& target_base, const Grid<float>& target_haze,
                    const Residual& residual, const Grid<LandCoverClass>& shown);

// Borders of classes as strokes leave them. A texel is of one class, so a picture of texels alone
// looks torn where classes meet. Where two classes share a pixel in `draft`, the paint of the other
// class is mixed in by its share, in the colour of the position its stroke grew from: that of
// `copied` where this shows the same class, else that of `base` (the target's, without strokes).
// Pixels of one class stay unchanged, bit for bit. All in encoded sRGB, where paint mixes; `shown`
// is the class of each pixel of `copied`.
Grid<glm::vec3> mix_borders(const Grid<glm::vec3>& copied, const Painting& draft,
                            const Grid<LandCoverClass>& shown,
                            const Grid<LandCoverClass>& land_cover, const Grid<glm::vec3>& base);

// Softens depth edges and the skyline. Where only the share `front` of a pixel shows the surface it
// was painted for, the rest comes from those of its eight neighbours that lie on another surface
// (depth differs by more than 3 %, or one is sky), in linear light. Pixels with front 1, or without
// another surface around, stay unchanged. `picture` encoded sRGB. Needs depth_m and front.
Grid<glm::vec3> blend_edges(const Grid<glm::vec3>& picture, const GuidanceBuffers& guidance);
// Rows that blend_edges reads above and below, for pictures made in bands.
inline constexpr int blend_margin_px = 1;

// Encoded sRGB to scene-linear and back (exact piecewise curve of IEC 61966-2-1, continued below 0
// and beyond 1).
Image decode_srgb(const Grid<glm::vec3>& encoded);
Grid<glm::vec3> encode_srgb(const Image& linear);

}  // namespace belvedere
