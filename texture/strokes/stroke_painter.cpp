#include "texture/strokes/stroke_painter.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/error.h"
#include "texture/strokes/brush.h"
#include "texture/strokes/stroke_kinds.h"

namespace belvedere {
namespace {

void append(std::vector<Stroke>& all, std::vector<Stroke> more) { all.insert(all.end(), more.begin(), more.end()); }

void check_sizes(const Grid<glm::vec3>& canvas, const GuidanceBuffers& guidance, const PaintGround& ground) {
  const bool same = canvas.same_size(guidance.depth_m) && canvas.same_size(guidance.land_cover) && canvas.same_size(guidance.fall_line) &&
                    canvas.same_size(guidance.tone) && canvas.same_size(guidance.position_m) && canvas.same_size(ground.colour) &&
                    canvas.same_size(ground.darker) && canvas.same_size(ground.lighter) && canvas.same_size(ground.accent) &&
                    canvas.same_size(ground.tree_density) && canvas.same_size(ground.haze);
  if (!same) throw Error(ErrorKind::bug, "paint_strokes", "canvas, guidance and ground differ in size");
}

}  // namespace

Painting paint_strokes(Grid<glm::vec3> canvas, const GuidanceBuffers& guidance, const PaintGround& ground, const StrokeLayers& layers,
                       const StrokeParameters& parameters, Progress& progress) {
  check_sizes(canvas, guidance, ground);
  Painting painting = begin_painting(std::move(canvas));
  const StrokeScene scene{guidance, ground, parameters};
  const auto paint = [&](std::vector<Stroke> strokes) {
    // In the far, air evens out what loads of paint differ by.
    for (Stroke& stroke : strokes) stroke.load *= 1.F - 0.8F * std::clamp(ground.haze[stroke.source], 0.F, 1.F);
    if (!strokes.empty()) paint_in_order(painting, guidance, std::move(strokes), parameters.pixels_per_unit, progress);
  };

  if (layers.sky) paint(sky_strokes(scene));
  if (layers.ground) paint(wash_strokes(scene));

  // Everything over the wash is one list, far to near, so that a near range covers a far one whatever it is made of.
  std::vector<Stroke> body;
  if (layers.upright) append(body, forest_trees(scene));
  if (layers.ground) append(body, meadow_strokes(scene));
  if (layers.upright) {
    append(body, scattered_trees(scene));
    append(body, low_bushes(scene));
    append(body, rock_trees(scene));
    append(body, grass_flecks(scene));
  }
  if (layers.ground) {
    append(body, rock_facets(scene));
    append(body, rock_hatching(scene));
    append(body, rock_ledges(scene));
    append(body, rock_fissures(scene));
    append(body, rock_snow(scene));
    append(body, rock_rubble(scene));
    append(body, rock_turf(scene));
    append(body, rock_drifts(scene));
    append(body, scree_strokes(scene));
    append(body, snow_strokes(scene));
    append(body, broken_colour(scene));
    append(body, water_strokes(scene));
  }
  if (layers.breaks) {
    // It lies where it must, which no copied texel knows: painted over copied ground, and left out of what is copied from.
    append(body, snow_ribs(scene));
    append(body, glacier_flow_lines(scene));
    append(body, glacier_edges(scene));
    append(body, glacier_moraines(scene));
    append(body, glacier_crevasses(scene));
    // Texels keep a wall's colours and lose its lines, which are longer than what is copied in one piece.
    if (!layers.ground) {
      append(body, rock_ledges(scene));
      append(body, rock_fissures(scene));
    }
  }
  if (layers.upright) {
    append(body, houses(scene));
    append(body, farms(scene));
  }
  if (layers.accents) append(body, accent_strokes(scene));
  paint(std::move(body));
  return painting;
}

}  // namespace belvedere
