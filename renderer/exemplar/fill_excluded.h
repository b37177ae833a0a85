#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "base/grid.h"
#include "base/progress.h"

namespace belvedere {

// Paint for the excluded areas of a painting (lettering, figures, frames): where `excluded` is not
// 0, paint is synthesized class by class, by models of the paint of that class around it
// (texture/statistical: make_texture.h), so that copying finds complete paint there. Excluded
// pixels without a class (unused_label) get that of the nearest pixel that has one. Where there is
// too little paint of a class to learn from they become unused_label and stay unchanged. Nothing
// else changes.
struct FilledPaint {
  Grid<glm::vec3> picture;    // encoded sRGB
  Grid<std::uint8_t> labels;  // class ids
  std::size_t filled = 0;
  std::size_t left = 0;  // excluded pixels that stay unused
};
FilledPaint fill_excluded(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& labels,
                          const Grid<std::uint8_t>& excluded,
                          Progress& progress = silent_progress());

// A picture (encoded sRGB) without what is marked (not 0), where the kinds of ground are not known.
// Around each group of marked pixels the ground is split into a few segments (segment.h), whose
// borders continue under the mark; each is filled by fill_excluded with its own texture. Its tone,
// what changes more slowly than the mark is wide, is taken off before, continued under the mark
// from what lies beside it, and put on again. `counts`: 0 excludes pixels from the surroundings.
// Too little of these (min_crop_px squared) leave their mark as it was: `left`. Nothing else
// changes; `labels` are empty.
FilledPaint remove_marked(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& counts,
                          const Grid<std::uint8_t>& marked, Progress& progress = silent_progress());

// The direction of strokes in a painting of which only picture (encoded sRGB) and labels are known,
// as the fall line of guidance: unit, x right, y down, never upwards; 0 where strokes are
// horizontal (within 15°), as on flat ground, or have no direction. From the structure tensor of
// lightness over about three stroke widths; borders of labels are excluded.
Grid<glm::vec2> find_stroke_direction(const Grid<glm::vec3>& picture,
                                      const Grid<std::uint8_t>& labels, double stroke_px);

}  // namespace belvedere
