#pragma once

#include "renderer/paint/guides.h"
#include "renderer/stages/lit_picture.h"

namespace belvedere {

// The header note in a painting's file that names its layer, and its value for the layer without
// trees.
inline constexpr const char* exemplar_layer_note = "belvedere:layer";
inline constexpr const char* exemplar_ground_layer = "ground";

// A view painted entirely in strokes, with full guidance for every pixel.
struct ExamplePainting {
  GuidanceBuffers guidance;      // with painted_class, painted_from, stroke and ground_from
  Grid<glm::vec3> painting;      // encoded sRGB, edges of depth softened
  Grid<glm::vec3> ground_layer;  // without trees, dwarf pines, houses and ice breaks, with hard
                                 // edges: what synthesis copies
};

// The layers to paint: each costs a painting of its own.
struct ExampleLayers {
  bool painting = true;  // otherwise painting, painted_class, painted_from and stroke stay empty
  bool sky = true;       // otherwise the sky keeps the base picture's
};

// picture: of the whole view. The same bits for any number of threads.
ExamplePainting paint_example(const World& world, const Palette& palette, LitPicture picture,
                              const ExampleLayers& layers, Progress& progress);

// Base colour and class of the paint on every pixel, from the pixels where its strokes begin: used
// for the residual and labels of an exemplar.
PaintedClasses classes_of_paint(const GuidanceBuffers& guidance, const Grid<std::uint32_t>& from);

}  // namespace belvedere
