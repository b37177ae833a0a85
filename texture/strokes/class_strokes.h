#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/land_cover_class.h"
#include "base/random.h"
#include "texture/strokes/brush.h"
#include "texture/strokes/stroke_seeds.h"

namespace belvedere {

// Hues of small dabs, warm and cool.
enum class DabHue : std::uint8_t { none, earth, leaves, ice };

// Brushwork of a class. Lengths and widths in units of 0.5 mm of the sheet.
struct ClassStrokes {
  float wash_length;      // 0: no wash, all its strokes are of special kinds
  float wash_width;       // at the start of the stroke
  float wash_wander_rad;  // deviation of the direction
  float meadow_length;    // of strokes of grass; 0: no grass
  DabHue dabs;
};

// A row for each land-cover class, in the order of their table.
struct ClassStrokesRow {
  LandCoverClass id;
  ClassStrokes strokes;
};
inline constexpr auto class_strokes_table = [] {
  using enum LandCoverClass;
  return std::to_array<ClassStrokesRow>({
      {sky,
       {.wash_length = 0.0F,
        .wash_width = 0.0F,
        .wash_wander_rad = 0.00F,
        .meadow_length = 0.0F,
        .dabs = DabHue::none}},
      {water,
       {.wash_length = 0.0F,
        .wash_width = 0.0F,
        .wash_wander_rad = 0.00F,
        .meadow_length = 0.0F,
        .dabs = DabHue::none}},
      {valley_floor,
       {.wash_length = 10.0F,
        .wash_width = 5.2F,
        .wash_wander_rad = 0.15F,
        .meadow_length = 9.0F,
        .dabs = DabHue::earth}},
      {settlement,
       {.wash_length = 10.0F,
        .wash_width = 5.2F,
        .wash_wander_rad = 0.15F,
        .meadow_length = 0.0F,
        .dabs = DabHue::none}},
      {forest,
       {.wash_length = 8.0F,
        .wash_width = 4.0F,
        .wash_wander_rad = 0.20F,
        .meadow_length = 0.0F,
        .dabs = DabHue::leaves}},
      {alpine_grass,
       {.wash_length = 10.0F,
        .wash_width = 5.2F,
        .wash_wander_rad = 0.30F,
        .meadow_length = 7.6F,
        .dabs = DabHue::earth}},
      {scree,
       {.wash_length = 10.0F,
        .wash_width = 5.2F,
        .wash_wander_rad = 0.20F,
        .meadow_length = 0.0F,
        .dabs = DabHue::earth}},
      {rock,
       {.wash_length = 0.0F,
        .wash_width = 0.0F,
        .wash_wander_rad = 0.00F,
        .meadow_length = 0.0F,
        .dabs = DabHue::none}},
      {snow,
       {.wash_length = 20.0F,
        .wash_width = 5.2F,
        .wash_wander_rad = 0.08F,
        .meadow_length = 0.0F,
        .dabs = DabHue::ice}},
      {glacier,
       {.wash_length = 20.0F,
        .wash_width = 5.2F,
        .wash_wander_rad = 0.08F,
        .meadow_length = 0.0F,
        .dabs = DabHue::ice}},
      {pasture,
       {.wash_length = 10.0F,
        .wash_width = 5.2F,
        .wash_wander_rad = 0.30F,
        .meadow_length = 8.0F,
        .dabs = DabHue::earth}},
      {shrub,
       {.wash_length = 10.0F,
        .wash_width = 5.2F,
        .wash_wander_rad = 0.30F,
        .meadow_length = 8.0F,
        .dabs = DabHue::leaves}},
      {sand,
       {.wash_length = 14.0F,
        .wash_width = 5.2F,
        .wash_wander_rad = 0.10F,
        .meadow_length = 0.0F,
        .dabs = DabHue::earth}},
  });
}();
static_assert(class_strokes_table.size() == land_cover_table.size());
static_assert(std::equal(class_strokes_table.begin(), class_strokes_table.end(),
                         land_cover_table.begin(),
                         [](const ClassStrokesRow& row, const LandCoverClassInfo& info) {
                           return row.id == info.id;
                         }));

constexpr const ClassStrokes& strokes_of(LandCoverClass id) {
  return class_strokes_table[static_cast<std::size_t>(id)].strokes;
}

// The kinds of stroke, one function each: their position, direction and colours. Sizes in units of
// 0.5 mm. `stream` is the source of random numbers. A new kind is one function here and one row in
// stroke_table.cpp.
std::vector<Stroke> sky_strokes(const StrokeScene& scene, Stream stream);
std::vector<Stroke> wash_strokes(const StrokeScene& scene, Stream stream);
std::vector<Stroke> meadow_strokes(const StrokeScene& scene, Stream stream);
std::vector<Stroke> grass_flecks(
    const StrokeScene& scene,
    Stream stream);  // tussocks and flecks of light on pastures and high grass
std::vector<Stroke> scree_strokes(const StrokeScene& scene, Stream stream);
std::vector<Stroke> sand_strokes(const StrokeScene& scene, Stream stream);  // wind ripples
std::vector<Stroke> broken_colour(
    const StrokeScene& scene,
    Stream stream);  // small dabs in all directions, warm next to cool
std::vector<Stroke> water_strokes(const StrokeScene& scene, Stream stream);
// Over the base of water (water/stroke_water.cpp): streaks of light where wind ruffles lakes, white
// water of steep rivers, and the broken line of surf along the sea.
std::vector<Stroke> wind_streaks(const StrokeScene& scene, Stream stream);
std::vector<Stroke> river_foam(const StrokeScene& scene, Stream stream);
std::vector<Stroke> sea_surf(const StrokeScene& scene, Stream stream);
std::vector<Stroke> accent_strokes(const StrokeScene& scene, Stream stream);
// Rock (stroke_rock.cpp): broad strokes on its planes, then dabs, then chips of light and dark;
// crests, gullies and beds come from the light.
std::vector<Stroke> rock_facets(const StrokeScene& scene, Stream stream);
std::vector<Stroke> rock_dabs(const StrokeScene& scene, Stream stream);
std::vector<Stroke> rock_chips(const StrokeScene& scene, Stream stream);
// Where rock meets vegetation (stroke_rock_border.cpp): turf and undergrowth overhang its upper
// edge and lie on its ledges, rubble runs down from its foot, single trees stand on it.
std::vector<Stroke> rock_turf(const StrokeScene& scene, Stream stream);
std::vector<Stroke> rock_drifts(
    const StrokeScene& scene,
    Stream stream);  // snow that extends into a wall from its foot and overhangs its edge
std::vector<Stroke> rock_rubble(const StrokeScene& scene, Stream stream);
std::vector<Stroke> rock_trees(const StrokeScene& scene, Stream stream);
// Snow and ice (ice/). Flow lines, moraines, crevasses and edges of
// glaciers are drawn on top.
std::vector<Stroke> snow_strokes(const StrokeScene& scene, Stream stream);
std::vector<Stroke> glacier_flow_lines(const StrokeScene& scene, Stream stream);
std::vector<Stroke> glacier_moraines(const StrokeScene& scene, Stream stream);
std::vector<Stroke> glacier_crevasses(const StrokeScene& scene, Stream stream);
std::vector<Stroke> glacier_edges(const StrokeScene& scene, Stream stream);
// Standing objects (stroke_upright.cpp, stroke_town.cpp).
std::vector<Stroke> forest_trees(const StrokeScene& scene, Stream stream);
std::vector<Stroke> forest_edges(
    const StrokeScene& scene,
    Stream stream);  // trees that form a wall where the forest ends at a meadow
std::vector<Stroke> glade_grass(const StrokeScene& scene,
                                Stream stream);  // over the other paint of glades
std::vector<Stroke> scattered_trees(const StrokeScene& scene, Stream stream);
std::vector<Stroke> low_bushes(const StrokeScene& scene, Stream stream);
// Only in close views (stroke_close.cpp): nothing where a unit of the sheet covers more than some
// metres.
std::vector<Stroke> ground_stones(const StrokeScene& scene, Stream stream);
std::vector<Stroke> grass_tufts(const StrokeScene& scene, Stream stream);
std::vector<Stroke> houses(const StrokeScene& scene, Stream stream);
std::vector<Stroke> churches(const StrokeScene& scene, Stream stream);
std::vector<Stroke> farms(const StrokeScene& scene, Stream stream);

}  // namespace belvedere
