#include "renderer/exemplar/example_painting.h"

#include <utility>

#include "renderer/paint/composite.h"
#include "texture/strokes/stroke_painter.h"

namespace belvedere {

ExamplePainting paint_example(const World& world, const Palette& palette, LitPicture picture,
                              const ExampleLayers& layers, Progress& progress) {
  const StrokeParameters strokes = to_stroke_parameters(world, palette);
  const SheetWindow whole{.to_copy_from = true};
  ExamplePainting example;
  Painting ground_layer = paint_strokes(
      picture.base.colour, picture.guidance, picture.base,
      {.sky = layers.sky, .ground = true, .accents = true, .breaks = false, .upright = false},
      strokes, progress, whole);
  example.ground_layer = std::move(ground_layer.picture);
  picture.guidance.ground_from = std::move(ground_layer.sources);
  if (layers.painting) {
    Painting painting = paint_strokes(picture.base.colour, picture.guidance, picture.base,
                                      {.sky = layers.sky}, strokes, progress, whole);
    example.painting = blend_edges(painting.picture, picture.guidance);
    picture.guidance.painted_class = picture.guidance.land_cover;
    for (std::size_t i = 0; i < painting.sources.size(); ++i)
      picture.guidance.painted_class[i] = picture.guidance.land_cover[painting.sources[i]];
    picture.guidance.painted_from = std::move(painting.sources);
    picture.guidance.stroke = std::move(painting.strokes);
  }
  example.guidance = std::move(picture.guidance);
  return example;
}

PaintedClasses classes_of_paint(const GuidanceBuffers& guidance, const Grid<std::uint32_t>& from) {
  return find_painted_classes(from, guidance, encode_srgb(guidance.base));
}

}  // namespace belvedere
