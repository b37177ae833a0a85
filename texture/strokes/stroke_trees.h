#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

#include "texture/strokes/stroke_seeds.h"

namespace belvedere {

// Position and size of a tree, px.
struct Tree {
  glm::vec2 foot;
  float width;
  float height;
};

// How it is painted.
struct TreeTone {
  float lighter = 0.F;  // shifts the tone of the whole tree, in the steps of StrokeScene::colour
  float rim = 0.F;      // 0…1: unobstructed towards the sun, so its light side shines
  float edge = 0.F;  // 0…1: in front of open ground, so its dark body has a hard edge and it casts
                     // a shadow there
  float calm = 0.F;  // 0…1: blends into the forest, as trees do in calm areas
};

// One tree appended to `out`: the shadow away from the sun, its dark body, its light side. A spruce
// is pointed, a leafy tree has a round crown with yellow dots, bare and violet in winter. A larch
// is a light, thin spruce of the palette's colour, gold in autumn; a stone pine is dark and blunt.
// Upright in the picture whatever the slope.
void plant_spruce(const StrokeScene& scene, const Tree& tree, std::size_t i, const TreeTone& tone,
                  StrokeSeed& seed, std::vector<Stroke>& out);
void plant_larch(const StrokeScene& scene, const Tree& tree, std::size_t i, const TreeTone& tone,
                 StrokeSeed& seed, std::vector<Stroke>& out);
void plant_stone_pine(const StrokeScene& scene, const Tree& tree, std::size_t i,
                      const TreeTone& tone, StrokeSeed& seed, std::vector<Stroke>& out);
void plant_leafy(const StrokeScene& scene, const Tree& tree, std::size_t i, const TreeTone& tone,
                 StrokeSeed& seed, std::vector<Stroke>& out);

}  // namespace belvedere
