#pragma once

#include "renderer/paint/guides.h"
#include "renderer/stages/lit_picture.h"

namespace belvedere {

// The header note of a painting's file that says which of its layers it is, and its value for the one without trees.
inline constexpr const char* exemplar_layer_note = "belvedere:layer";
inline constexpr const char* exemplar_ground_layer = "ground";

// A view painted in strokes alone, and everything its painter knows of every pixel.
struct ExamplePainting {
  GuidanceBuffers guidance;      // with painted_class, painted_from, stroke and ground_from
  Grid<glm::vec3> painting;      // encoded sRGB, edges of depth softened
  Grid<glm::vec3> ground_layer;  // without trees, dwarf pines, houses and breaks of the ice, edges hard: what synthesis copies
};

// Which layers to paint: each costs a painting of its own.
struct ExampleLayers {
  bool painting = true;  // else painting, painted_class, painted_from and stroke stay empty
  bool sky = true;       // else sky keeps the base picture's
};

// picture: of the whole view. The same bits for any number of threads.
ExamplePainting paint_example(const World& world, const Palette& palette, LitPicture picture, const ExampleLayers& layers,
                              Progress& progress);

// Base colour and class of the paint on every pixel, from the pixels it grew from: what residual and labels of an exemplar go by.
PaintedClasses classes_of_paint(const GuidanceBuffers& guidance, const Grid<std::uint32_t>& from);

}  // namespace belvedere
