#pragma once

#include <vector>

#include "texture/strokes/stroke.h"
#include "texture/strokes/stroke_seeds.h"

namespace belvedere {

// The kinds of stroke, one function each: where they grow, how they lie, what they are mixed from. Sizes in units of 0.5 mm, from the
// table Strokes of look/recipe.md. A new kind is one function here and one line in stroke_painter.cpp.
std::vector<Stroke> sky_strokes(const StrokeScene& scene);
std::vector<Stroke> wash_strokes(const StrokeScene& scene);
std::vector<Stroke> meadow_strokes(const StrokeScene& scene);
std::vector<Stroke> grass_flecks(const StrokeScene& scene);  // tussocks and flecks of light on pastures and high grass
std::vector<Stroke> scree_strokes(const StrokeScene& scene);
std::vector<Stroke> broken_colour(const StrokeScene& scene);  // small dabs every way, warm beside cool
std::vector<Stroke> water_strokes(const StrokeScene& scene);
std::vector<Stroke> accent_strokes(const StrokeScene& scene);
// Rock (stroke_rock.cpp): planes, hatching down the wall, beds across it with their lit tops, cracks.
std::vector<Stroke> rock_facets(const StrokeScene& scene);
std::vector<Stroke> rock_hatching(const StrokeScene& scene);
std::vector<Stroke> rock_ledges(const StrokeScene& scene);
std::vector<Stroke> rock_fissures(const StrokeScene& scene);
// Where rock meets what grows (stroke_rock_border.cpp): turf and undergrowth hang over its upper rim and lie on its ledges, rubble runs
// down from its foot, single trees stand on it.
std::vector<Stroke> rock_turf(const StrokeScene& scene);
std::vector<Stroke> rock_drifts(const StrokeScene& scene);  // snow that reaches up into a wall from its foot and hangs over its rim
std::vector<Stroke> rock_rubble(const StrokeScene& scene);
std::vector<Stroke> rock_trees(const StrokeScene& scene);
std::vector<Stroke> rock_snow(const StrokeScene& scene);  // in winter only
// Snow and ice (stroke_ice.cpp, stroke_glacier.cpp). Flow lines, moraines, crevasses and edges of glaciers, and the ribs that are bare
// of snow, are drawn on top.
std::vector<Stroke> snow_strokes(const StrokeScene& scene);
std::vector<Stroke> snow_ribs(const StrokeScene& scene);
std::vector<Stroke> glacier_flow_lines(const StrokeScene& scene);
std::vector<Stroke> glacier_moraines(const StrokeScene& scene);
std::vector<Stroke> glacier_crevasses(const StrokeScene& scene);
std::vector<Stroke> glacier_edges(const StrokeScene& scene);
// What stands up (stroke_upright.cpp, stroke_town.cpp).
std::vector<Stroke> forest_trees(const StrokeScene& scene);
std::vector<Stroke> scattered_trees(const StrokeScene& scene);
std::vector<Stroke> low_bushes(const StrokeScene& scene);
std::vector<Stroke> houses(const StrokeScene& scene);
std::vector<Stroke> farms(const StrokeScene& scene);

}  // namespace belvedere
