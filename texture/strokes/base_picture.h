#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "base/grid.h"
#include "base/pixel_rect.h"

namespace belvedere {

// The base of strokes. All images in encoded sRGB 0…1, because paint mixes there; same size as the
// guidance.
struct BasePicture {
  Grid<glm::vec3> colour;    // base picture at the pixel's tone
  Grid<glm::vec3> darker;    // … at tone - .17
  Grid<glm::vec3> lighter;   // … at tone + .17
  Grid<float> accent;        // -1 hollow … +1 edge: position of accents
  Grid<float> tree_density;  // 0…1: trees in forest, dwarf pines on alpine grass and shrubland
  Grid<float> haze;          // 0…1
};

// Forest with a smaller tree_density is a glade: grass without trees.
inline constexpr float glade_density = 0.08F;

struct StrokeParameters {
  double pixels_per_unit = 1.0;  // a unit is 0.5 mm of the sheet: 1 at 2400 px on 1.2 m; 0.1…50
  bool winter = false;
  double sun_side = 1.0;  // -1: light from the left of the picture … +1: from the right
  // The same at a map position, where light varies with position; null: sun_side everywhere.
  std::function<float(glm::dvec2 position_m)> local_side = nullptr;
  std::uint64_t seed = 1;
  std::vector<glm::vec3> leaves;  // colours of leafy trees in full light, of bare twigs in winter,
                                  // encoded sRGB; none: only the ground's
  double leaf_share = 0.0;        // how far leafy trees take them, 0…1
  glm::vec3 larch{0.0F};          // the same of larches
  double larch_share = 0.0;       // 0: no larches
  double treeline_m = 1820.0;     // altitude where forest ends: reference for the belts of trees
  double wind = 0.0;              // 0…2: streaks of light on open water
  double surf_units = 0.0;     // width of the line of surf at the sea's shores, units, 0 (none)…6
  bool foam = false;           // white water where rivers are steep
  double sea_level_m = 0.0;    // water near this altitude is the sea
  double frozen_from_m = 1e9;  // altitude from which lakes are frozen
};

struct IcePlan;
struct Stroke;

// Mapped ground that strokes must respect: roads are clear of trees, houses stand at their
// positions.
struct MappedGround {
  Grid<std::uint8_t> cleared;   // of the buffers' pixels: 1 where nothing may stand
  std::vector<Stroke> besides;  // strokes of mapped objects, in depth order with all vegetation
  Grid<float> overhead_m;  // distance from the eye of an overhead object (a rope), infinite where
                           // there is none; empty: nowhere
};

// The part of the sheet that the buffers contain. Positions of strokes are sheet positions, px, so
// that a window shows the same as the whole; pixels are counted from the window's corner.
struct SheetWindow {
  glm::ivec2 origin_px{0};       // position of the buffers' first pixel on the sheet
  glm::ivec2 sheet_px{0};        // width and height of the sheet; 0: the buffers contain all of it
  PixelRect asked{};             // requested pixels of the buffers, others may stay unpainted;
                                 // empty: all
  const IcePlan* ice = nullptr;  // ice of the whole sheet; null: derived from the buffers,
                                 // which must then contain all of it
  bool waters_known =
      false;  // a map gives rivers: they are narrow, and the paint of their banks is kept off them
  bool to_copy_from = false;  // Painting::sources records the actual strokes, also within a class
                              // and on water; otherwise a pixel counts as the source of paint of
                              // its own class, and water as that of overhanging paint: rivers stay
                              // whole
  bool recorded = true;       // whether the origin of paint is wanted: Painting::sources, under,
                              // under_share, strokes; otherwise they stay empty
  const Grid<glm::vec3>* ground = nullptr;  // of the buffers' pixels: colours of the bare ground,
                                            // encoded sRGB, that strokes of its own class stay
                                            // near; null: they keep their own
  const Grid<float>* veil =
      nullptr;  // of the buffers' pixels: share of mist in front, 0…1; null: none
  const MappedGround* mapped =
      nullptr;  // null: nothing is mapped, and standing objects are not recorded
};

}  // namespace belvedere
