#include "texture/strokes/stroke_table.h"

#include "texture/strokes/class_strokes.h"

namespace belvedere {
namespace {

// Reach of strokes: the longest and widest of a kind, as drawn in its own file, and the distance
// that its seeds read. A brush wobbles by slightly more than half its width. The flow of ice and
// the ends of lines on it come from the sheet's plan and do not count here.
constexpr double half_width = 0.54;
constexpr StrokeReach around(double painted, double seen_beyond = 0.0) {
  return {painted, painted + seen_beyond};
}
constexpr StrokeReach level(double longest, double widest, double seen_beyond = 0.0) {
  return around(0.52 * longest + half_width * widest, seen_beyond);
}
// Worst case of lay_line down the slope: fall lines perpendicular to each other at every point, and
// the line bends by the maximum draw of 3.47 deviations; from .91 of its length at .05 rad to 1.23
// at .3 rad. `aside` is the offset of its centre from the seed.
constexpr StrokeReach downhill(double longest, double widest, double wobble_rad,
                               double aside = 0.0) {
  return around((0.85 + 1.25 * wobble_rad) * longest + half_width * widest + aside);
}

constexpr StrokeKind kinds[] = {
    {.name = "sky",
     .layer = &StrokeLayers::sky,
     .stream = Stream::sky,
     .grow = sky_strokes,
     .reach = level(66.0, 11.0, 22.0),
     .alone = true},
    {.name = "wash",
     .layer = &StrokeLayers::ground,
     .stream = Stream::wash,
     .grow = wash_strokes,
     .reach = downhill(26.0, 6.8, 0.2),
     .alone = true},
    // Everything over the wash is one list, far to near, so that a near range covers a far one
    // whatever its kinds.
    {.name = "forest trees",
     .layer = &StrokeLayers::upright,
     .stream = Stream::forest_trees,
     .grow = forest_trees,
     .reach = around(17.0, 21.0)},
    {.name = "forest edges",
     .layer = &StrokeLayers::upright,
     .stream = Stream::forest_edges,
     .grow = forest_edges,
     .reach = around(17.0, 5.6)},
    {.name = "glade grass",
     .layer = &StrokeLayers::upright,
     .stream = Stream::glade_grass,
     .grow = glade_grass,
     .reach = downhill(9.0, 2.8, 0.2)},
    {.name = "meadow",
     .layer = &StrokeLayers::ground,
     .stream = Stream::meadow,
     .grow = meadow_strokes,
     .reach = downhill(12.6, 3.4, 0.2)},
    {.name = "scattered trees",
     .layer = &StrokeLayers::upright,
     .stream = Stream::scattered_trees,
     .grow = scattered_trees,
     .reach = around(10.0, 17.2 + 7.0)},
    {.name = "low bushes",
     .layer = &StrokeLayers::upright,
     .stream = Stream::low_bushes,
     .grow = low_bushes,
     .reach = around(7.0)},
    {.name = "rock trees",
     .layer = &StrokeLayers::upright,
     .stream = Stream::rock_trees,
     .grow = rock_trees,
     .reach = around(9.0 + 11.0, 4.0)},
    {.name = "grass flecks",
     .layer = &StrokeLayers::upright,
     .stream = Stream::grass_flecks,
     .grow = grass_flecks,
     .reach = downhill(4.2, 2.2, 0.2)},
    {.name = "rock facets",
     .layer = &StrokeLayers::ground,
     .stream = Stream::rock_facets,
     .grow = rock_facets,
     .reach = downhill(16.0, 5.7, 0.05)},
    {.name = "rock dabs",
     .layer = &StrokeLayers::ground,
     .stream = Stream::rock_dabs,
     .grow = rock_dabs,
     .reach = downhill(8.4, 3.0, 0.05)},
    {.name = "rock chips",
     .layer = &StrokeLayers::ground,
     .stream = Stream::rock_chips,
     .grow = rock_chips,
     .reach = downhill(5.0, 1.7, 0.05)},
    {.name = "rock rubble",
     .layer = &StrokeLayers::ground,
     .stream = Stream::rock_rubble,
     .grow = rock_rubble,
     .reach = downhill(18.0, 2.8, 0.2, 7.6)},
    {.name = "rock turf",
     .layer = &StrokeLayers::ground,
     .stream = Stream::rock_turf,
     .grow = rock_turf,
     .reach = downhill(8.0, 2.0, 0.3, 16.0)},
    {.name = "rock drifts",
     .layer = &StrokeLayers::ground,
     .stream = Stream::rock_drifts,
     .grow = rock_drifts,
     .reach = downhill(13.0, 4.2, 0.25, 4.2)},
    {.name = "scree",
     .layer = &StrokeLayers::ground,
     .stream = Stream::scree,
     .grow = scree_strokes,
     .reach = downhill(5.5, 2.2, 0.1)},
    {.name = "sand",
     .layer = &StrokeLayers::ground,
     .stream = Stream::sand,
     .grow = sand_strokes,
     .reach = downhill(9.0, 1.6, 0.05, 1.3)},
    {.name = "snow",
     .layer = &StrokeLayers::ground,
     .stream = Stream::snow,
     .grow = snow_strokes,
     .reach = around(37.9),
     .on_ice = true},
    {.name = "broken colour",
     .layer = &StrokeLayers::ground,
     .stream = Stream::broken_colour,
     .grow = broken_colour,
     .reach = downhill(4.6, 1.7, 0.3)},
    {.name = "water",
     .layer = &StrokeLayers::ground,
     .stream = Stream::water,
     .grow = water_strokes,
     .reach = level(26.0, 3.2)},
    {.name = "wind streaks",
     .layer = &StrokeLayers::breaks,
     .stream = Stream::wind_streaks,
     .grow = wind_streaks,
     .reach = level(31.2, 1.4, 4.5),
     .wet = true},
    {.name = "river foam",
     .layer = &StrokeLayers::breaks,
     .stream = Stream::river_foam,
     .grow = river_foam,
     .reach = around(5.3, 13.0),
     .wet = true},
    {.name = "sea surf",
     .layer = &StrokeLayers::breaks,
     .stream = Stream::sea_surf,
     .grow = sea_surf,
     .reach = around(2.1 + 0.8 * 6.0, 1.1 * 6.0 + 0.5),
     .wet = true},
    // Their positions are given, which a copied texel cannot reproduce: painted over copied ground,
    // and left out of exemplars.
    {.name = "glacier flow lines",
     .layer = &StrokeLayers::breaks,
     .stream = Stream::glacier_flow_lines,
     .grow = glacier_flow_lines,
     .reach = around(14.0 + 3.6),
     .on_ice = true},
    {.name = "glacier edges",
     .layer = &StrokeLayers::breaks,
     .stream = Stream::glacier_edges,
     .grow = glacier_edges,
     .reach = around(16.1, 20.0),
     .on_ice = true},
    {.name = "glacier moraines",
     .layer = &StrokeLayers::breaks,
     .stream = Stream::glacier_moraines,
     .grow = glacier_moraines,
     // Bands of four positions 4 units apart, 11 units wide on each side.
     .reach = around(12.0 + 12.0),
     .on_ice = true},
    {.name = "glacier crevasses",
     .layer = &StrokeLayers::breaks,
     .stream = Stream::glacier_crevasses,
     .grow = glacier_crevasses,
     .reach = around(27.0, 16.0),
     .on_ice = true},
    // Up to about 9 units large, and up to half a spacing from their seeds, whose neighbours give
    // the density of ground.
    {.name = "stones",
     .layer = &StrokeLayers::upright,
     .stream = Stream::ground_stones,
     .grow = ground_stones,
     .reach = around(9.0, 17.0)},
    {.name = "tufts",
     .layer = &StrokeLayers::upright,
     .stream = Stream::grass_tufts,
     .grow = grass_tufts,
     .reach = around(15.0, 4.0)},
    {.name = "houses",
     .layer = &StrokeLayers::upright,
     .stream = Stream::houses,
     .grow = houses,
     .reach = around(8.0, 8.0 + 5.6),
     .built = true},
    {.name = "churches",
     .layer = &StrokeLayers::upright,
     .stream = Stream::churches,
     .grow = churches,
     .reach = around(11.0, 16.0 + 2.0),
     .built = true},
    {.name = "farms",
     .layer = &StrokeLayers::upright,
     .stream = Stream::farms,
     .grow = farms,
     .reach = around(5.0, 4.7),
     .built = true},
    {.name = "accents",
     .layer = &StrokeLayers::accents,
     .stream = Stream::accents,
     .grow = accent_strokes,
     .reach = downhill(11.0, 2.2, 0.1)},
};

}  // namespace

std::span<const StrokeKind> stroke_kinds() { return kinds; }

bool is_painted(const StrokeKind& kind, const StrokeLayers& layers) { return layers.*kind.layer; }

PaintPart part_of(const StrokeKind& kind) {
  if (kind.layer == &StrokeLayers::sky) return PaintPart::sky;
  if (kind.layer == &StrokeLayers::accents) return PaintPart::accents;
  if (kind.layer == &StrokeLayers::upright)
    return kind.built ? PaintPart::houses : PaintPart::trees;
  if (kind.wet) return PaintPart::ground;
  return kind.layer == &StrokeLayers::breaks || kind.on_ice ? PaintPart::ice : PaintPart::ground;
}

}  // namespace belvedere
