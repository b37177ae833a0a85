#include "texture/strokes/stroke_painter.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/guidance_channels.h"
#include "texture/strokes/brush.h"
#include "texture/strokes/stroke_table.h"

namespace belvedere {
namespace {

void check_sizes(const Grid<glm::vec3>& canvas, const GuidanceBuffers& guidance, const BasePicture& base) {
  using B = GuidanceBuffers;
  require_channels(guidance,
                   {&B::depth_m, &B::position_m, &B::land_cover, &B::tone, &B::fall_line, &B::slope_deg, &B::footprint_m, &B::relief_s_m,
                    &B::built, &B::grain},
                   "strokes");
  const bool same = canvas.same_size(guidance.depth_m) && canvas.same_size(base.colour) && canvas.same_size(base.darker) &&
                    canvas.same_size(base.lighter) && canvas.same_size(base.accent) && canvas.same_size(base.tree_density) &&
                    canvas.same_size(base.haze);
  if (!same) throw Error(ErrorKind::bug, "paint_strokes", "canvas, guidance and base picture differ in size");
}

}  // namespace

Painting paint_strokes(Grid<glm::vec3> canvas, const GuidanceBuffers& guidance, const BasePicture& base, const StrokeLayers& layers,
                       const StrokeParameters& parameters, Progress& progress) {
  check_sizes(canvas, guidance, base);
  Painting painting = begin_painting(std::move(canvas));
  const StrokeScene scene{guidance, base, parameters};
  const auto paint = [&](std::vector<Stroke> strokes) {
    // In the far, air evens out what loads of paint differ by.
    for (Stroke& stroke : strokes) stroke.load *= 1.F - 0.8F * std::clamp(base.haze[stroke.source], 0.F, 1.F);
    if (!strokes.empty()) paint_in_order(painting, guidance, std::move(strokes), parameters.pixels_per_unit, progress);
  };

  std::vector<Stroke> body;
  for (const StrokeKind& kind : stroke_kinds()) {
    if (!is_painted(kind, layers)) continue;
    std::vector<Stroke> strokes = kind.grow(scene, kind.stream);
    if (kind.alone)
      paint(std::move(strokes));
    else
      body.insert(body.end(), strokes.begin(), strokes.end());
  }
  paint(std::move(body));
  return painting;
}

}  // namespace belvedere
