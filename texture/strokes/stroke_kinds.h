#pragma once

#include <vector>

#include "base/random_streams.h"
#include "texture/strokes/stroke.h"
#include "texture/strokes/stroke_seeds.h"

namespace belvedere {

// The kinds of stroke, one function each: where they grow, how they lie, what they are mixed from. Sizes in units of 0.5 mm. `stream` is
// what places and looks are drawn from. A new kind is one function here and one row in stroke_table.cpp.
std::vector<Stroke> sky_strokes(const StrokeScene& scene, Stream stream);
std::vector<Stroke> wash_strokes(const StrokeScene& scene, Stream stream);
std::vector<Stroke> meadow_strokes(const StrokeScene& scene, Stream stream);
std::vector<Stroke> grass_flecks(const StrokeScene& scene, Stream stream);  // tussocks and flecks of light on pastures and high grass
std::vector<Stroke> scree_strokes(const StrokeScene& scene, Stream stream);
std::vector<Stroke> sand_strokes(const StrokeScene& scene, Stream stream);   // ripples of the wind
std::vector<Stroke> broken_colour(const StrokeScene& scene, Stream stream);  // small dabs every way, warm beside cool
std::vector<Stroke> water_strokes(const StrokeScene& scene, Stream stream);
// Over the base of water (water/stroke_water.cpp): streaks of light where wind ruffles lakes, white water of rivers that fall, and the
// broken line of surf along the sea.
std::vector<Stroke> wind_streaks(const StrokeScene& scene, Stream stream);
std::vector<Stroke> river_foam(const StrokeScene& scene, Stream stream);
std::vector<Stroke> sea_surf(const StrokeScene& scene, Stream stream);
std::vector<Stroke> accent_strokes(const StrokeScene& scene, Stream stream);
// Rock (stroke_rock.cpp): its planes, laid broadly, then dabs, then chips of light and dark; crests, gullies and beds are in the light.
std::vector<Stroke> rock_facets(const StrokeScene& scene, Stream stream);
std::vector<Stroke> rock_dabs(const StrokeScene& scene, Stream stream);
std::vector<Stroke> rock_chips(const StrokeScene& scene, Stream stream);
// Where rock meets what grows (stroke_rock_border.cpp): turf and undergrowth hang over its upper rim and lie on its ledges, rubble runs
// down from its foot, single trees stand on it.
std::vector<Stroke> rock_turf(const StrokeScene& scene, Stream stream);
std::vector<Stroke> rock_drifts(const StrokeScene& scene,
                                Stream stream);  // snow that reaches up into a wall from its foot and hangs over its rim
std::vector<Stroke> rock_rubble(const StrokeScene& scene, Stream stream);
std::vector<Stroke> rock_trees(const StrokeScene& scene, Stream stream);
// Snow and ice (stroke_ice.cpp, stroke_glacier.cpp). Flow lines, moraines, crevasses and edges of glaciers are drawn on top.
std::vector<Stroke> snow_strokes(const StrokeScene& scene, Stream stream);
std::vector<Stroke> glacier_flow_lines(const StrokeScene& scene, Stream stream);
std::vector<Stroke> glacier_moraines(const StrokeScene& scene, Stream stream);
std::vector<Stroke> glacier_crevasses(const StrokeScene& scene, Stream stream);
std::vector<Stroke> glacier_edges(const StrokeScene& scene, Stream stream);
// What stands up (stroke_upright.cpp, stroke_town.cpp).
std::vector<Stroke> forest_trees(const StrokeScene& scene, Stream stream);
std::vector<Stroke> forest_edges(const StrokeScene& scene, Stream stream);  // trees that stand like a wall where the forest ends on meadow
std::vector<Stroke> glade_grass(const StrokeScene& scene, Stream stream);   // over whatever lies in the glades
std::vector<Stroke> scattered_trees(const StrokeScene& scene, Stream stream);
std::vector<Stroke> low_bushes(const StrokeScene& scene, Stream stream);
// What only close views show (stroke_close.cpp): nothing where a unit of the sheet shows more than some metres.
std::vector<Stroke> ground_stones(const StrokeScene& scene, Stream stream);
std::vector<Stroke> grass_tufts(const StrokeScene& scene, Stream stream);
std::vector<Stroke> houses(const StrokeScene& scene, Stream stream);
std::vector<Stroke> churches(const StrokeScene& scene, Stream stream);
std::vector<Stroke> farms(const StrokeScene& scene, Stream stream);

}  // namespace belvedere
