#include "texture/strokes/stroke_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "texture/strokes/stroke_kinds.h"

namespace belvedere {
namespace {

constexpr StrokeKind kinds[] = {
    {.name = "sky", .layer = &StrokeLayers::sky, .stream = Stream::sky, .grow = sky_strokes, .alone = true},
    {.name = "wash", .layer = &StrokeLayers::ground, .stream = Stream::wash, .grow = wash_strokes, .alone = true},
    // Everything over the wash is one list, far to near, so that a near range covers a far one whatever it is made of.
    {.name = "forest trees", .layer = &StrokeLayers::upright, .stream = Stream::forest_trees, .grow = forest_trees},
    {.name = "forest edges", .layer = &StrokeLayers::upright, .stream = Stream::forest_edges, .grow = forest_edges},
    {.name = "glade grass", .layer = &StrokeLayers::upright, .stream = Stream::glade_grass, .grow = glade_grass},
    {.name = "meadow", .layer = &StrokeLayers::ground, .stream = Stream::meadow, .grow = meadow_strokes},
    {.name = "scattered trees", .layer = &StrokeLayers::upright, .stream = Stream::scattered_trees, .grow = scattered_trees},
    {.name = "low bushes", .layer = &StrokeLayers::upright, .stream = Stream::low_bushes, .grow = low_bushes},
    {.name = "rock trees", .layer = &StrokeLayers::upright, .stream = Stream::rock_trees, .grow = rock_trees},
    {.name = "grass flecks", .layer = &StrokeLayers::upright, .stream = Stream::grass_flecks, .grow = grass_flecks},
    {.name = "rock facets", .layer = &StrokeLayers::ground, .stream = Stream::rock_facets, .grow = rock_facets},
    {.name = "rock hatching", .layer = &StrokeLayers::ground, .stream = Stream::rock_hatching, .grow = rock_hatching},
    // Texels keep a wall's colours and lose its lines, which are longer than what is copied in one piece.
    {.name = "rock ledges", .layer = &StrokeLayers::ground, .stream = Stream::rock_ledges, .grow = rock_ledges, .over_copied = true},
    {.name = "rock fissures", .layer = &StrokeLayers::ground, .stream = Stream::rock_fissures, .grow = rock_fissures, .over_copied = true},
    {.name = "rock snow", .layer = &StrokeLayers::ground, .stream = Stream::rock_snow, .grow = rock_snow},
    {.name = "rock rubble", .layer = &StrokeLayers::ground, .stream = Stream::rock_rubble, .grow = rock_rubble},
    {.name = "rock turf", .layer = &StrokeLayers::ground, .stream = Stream::rock_turf, .grow = rock_turf},
    {.name = "rock drifts", .layer = &StrokeLayers::ground, .stream = Stream::rock_drifts, .grow = rock_drifts},
    {.name = "scree", .layer = &StrokeLayers::ground, .stream = Stream::scree, .grow = scree_strokes},
    {.name = "sand", .layer = &StrokeLayers::ground, .stream = Stream::sand, .grow = sand_strokes},
    {.name = "snow", .layer = &StrokeLayers::ground, .stream = Stream::snow, .grow = snow_strokes},
    {.name = "broken colour", .layer = &StrokeLayers::ground, .stream = Stream::broken_colour, .grow = broken_colour},
    {.name = "water", .layer = &StrokeLayers::ground, .stream = Stream::water, .grow = water_strokes},
    // It lies where it must, which no copied texel knows: painted over copied ground, and left out of what is copied from.
    {.name = "snow ribs", .layer = &StrokeLayers::breaks, .stream = Stream::snow_ribs, .grow = snow_ribs},
    {.name = "glacier flow lines", .layer = &StrokeLayers::breaks, .stream = Stream::glacier_flow_lines, .grow = glacier_flow_lines},
    {.name = "glacier edges", .layer = &StrokeLayers::breaks, .stream = Stream::glacier_edges, .grow = glacier_edges},
    {.name = "glacier moraines", .layer = &StrokeLayers::breaks, .stream = Stream::glacier_moraines, .grow = glacier_moraines},
    {.name = "glacier crevasses", .layer = &StrokeLayers::breaks, .stream = Stream::glacier_crevasses, .grow = glacier_crevasses},
    {.name = "houses", .layer = &StrokeLayers::upright, .stream = Stream::houses, .grow = houses},
    {.name = "churches", .layer = &StrokeLayers::upright, .stream = Stream::churches, .grow = churches},
    {.name = "farms", .layer = &StrokeLayers::upright, .stream = Stream::farms, .grow = farms},
    {.name = "accents", .layer = &StrokeLayers::accents, .stream = Stream::accents, .grow = accent_strokes},
};

}  // namespace

std::span<const StrokeKind> stroke_kinds() { return kinds; }

const StrokeKind& find_stroke_kind(std::string_view name) {
  const auto* const found = std::find_if(std::begin(kinds), std::end(kinds), [&](const StrokeKind& kind) { return kind.name == name; });
  if (found == std::end(kinds)) throw Error(ErrorKind::bug, "strokes", fmt::format("there is no kind of stroke called \"{}\"", name));
  return *found;
}

bool is_painted(const StrokeKind& kind, const StrokeLayers& layers) { return layers.*kind.layer || (kind.over_copied && layers.breaks); }

}  // namespace belvedere
