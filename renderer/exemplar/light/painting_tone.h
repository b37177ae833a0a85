#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "base/grid.h"

namespace belvedere {

// The light of a painting of which only picture (encoded sRGB) and labels are known, 0…1: lightness
// (OKLab) of structures larger than strokes (sigma stroke_px, never across a border of labels),
// ranked within each label and mapped to the distribution of tone in a target (quartiles .43 .64
// .86: docs/synthesis.md, Paintings from paper). A label with much less contrast than the others
// (.35 of their interquartile range) shows one light only, such as one in shade as a whole: it gets
// their scale, and the light of its neighbours at its borders, or tone .64 if it has none. A
// painting of flat colours has tone .64; texels of unused_label have 0.
Grid<float> estimate_tone(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& labels,
                          double stroke_px);

// The light of a painting of known ground: `modelled` is the tone of that ground in the painting's
// sun, which errs where the ground is not exactly where the painting shows it, and where the
// painter placed his light otherwise; the lightness of the paint within each label, without what
// altitude and ln distance explain, errs as strokes do. Both on one scale for all labels, each to
// one half as far as they agree; otherwise as estimate_tone. The less is known of the place of a
// pixel (deviation_px, uncertain_places.h; empty: all), the less the model counts.
Grid<float> combine_tone(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& labels,
                         double stroke_px, const Grid<float>& modelled,
                         const Grid<float>& altitude_m, const Grid<float>& depth_m,
                         const Grid<float>& deviation_px = {});

// A tone on one scale for all labels, brought to the distribution of tone in a target as a whole
// (quartiles as above): the light and shade of a painting against the sun serve a target with the
// sun behind the viewer, and a label in shade stays in shade.
Grid<float> spread_tone(Grid<float> tone, const Grid<std::uint8_t>& labels);

// Cast shadow of a painting, as the painter shows it, from picture (encoded sRGB) and labels alone,
// as the guide of that name: 0 in shadow … 1 lit. In each label, blurred by a quarter of stroke_px
// (sigma), shadow is what is dark, blue and little green for the range of its paint; if it is not
// clearly darker and bluer than the rest, the whole label is lit: deep green forest is dark, not
// shaded. Texels of unused_label are lit. Beside pictures of the program whose shadows are known,
// F1 is .52 … .80: slopes that the sun grazes are painted as dark as shadow.
Grid<float> find_shadow(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& labels,
                        double stroke_px);

// Height above the valley floor, m, of a painting of which only the labels are known: 0 on water,
// valley floor and settlement, 60 where 8 % of the ground near by (Gaussian, 3/800 of the width) is
// such ground, at most 600. Empty without such ground. Beside pictures of the program, F1 of ground
// under 60 m is .57 … .75.
Grid<float> find_valley_height(const Grid<std::uint8_t>& labels);

// Value from which a texel counts as sunlit.
inline constexpr float lit_from = 0.5F;

}  // namespace belvedere
