#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "base/grid.h"

namespace belvedere {

// Cast shadow of a painting of which only picture (encoded sRGB) and labels are known, as the guide
// of that name: 0 in shadow … 1 lit. Structures larger than strokes (sigma stroke_px) of a label
// are split into two groups, dark and light (Otsu's threshold on lightness and blueness in OKLab);
// the dark group is shadow if it is clearly darker and bluer than the light one, otherwise the
// whole label is lit: deep green forest is dark, not shaded. Texels of unused_label are lit.
Grid<float> find_shadow(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& labels,
                        double stroke_px);

// The lit share, 0…1, of the ground around each texel: `shadow` averaged over a fortieth of the
// picture's width (sigma), over texels of any label but unused_label. The place of a cast shadow on
// the ground of a registered painting is not known to its own width, its share of a region is.
Grid<float> shadow_share(const Grid<float>& shadow, const Grid<std::uint8_t>& labels);

// Value from which a texel counts as sunlit.
inline constexpr float lit_from = 0.5F;

}  // namespace belvedere
