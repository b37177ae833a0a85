#include "renderer/scene/scene_table.h"
#include "terrain/cover/towns.h"

namespace belvedere {
namespace {

std::vector<std::string> class_names() {
  std::vector<std::string> names;
  for (const LandCoverClassInfo& info : land_cover_classes())
    if (info.id != LandCoverClass::sky) names.emplace_back(info.name);
  return names;
}

}  // namespace

std::vector<SceneSection> make_land_cover_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "land_cover",
       .meaning = "What the ground is: from rasters with a legend, or, where there are none, by rules from the terrain itself.",
       .keys = {
           {.name = "refine",
            .field = AT(land_cover.refine),
            .meaning = "What a raster does not tell apart: glacier = \"rock\" makes glacier of what the raster calls rock where the rules "
                       "see a glacier."},
           {.name = "legend",
            .field = AT(land_cover.legend),
            .meaning = "What the raster's codes mean: a built-in legend or a .toml or .csv file. Needed where there is a source.",
            .text = TextKind::built_in,
            .choices_from = "legends"},
           {.name = "rules",
            .field = AT(land_cover.rules),
            .meaning =
                "Rules that tell the classes from altitude, slope and exposure where there is no source: a built-in name or a .toml file.",
            .text = TextKind::built_in,
            .choices_from = "layers"},
           {.name = "layers",
            .field = AT(land_cover.layers),
            .meaning = "Surface layers that say what the ground is, instead of rules: a .layers.toml file, written by hand or fitted to a "
                       "picture; see layers.md.",
            .text = TextKind::file},
           {.name = "colours",
            .field = AT(land_cover.colours),
            .meaning = "Where the ground's colours come from: palette paints each class by its ramps; layers and image take what the "
                       "surface layers, or a picture from above, have at each place, and paint them in the palette's light and at its mean "
                       "lightness. Water stays as it is.",
            .text = TextKind::choice,
            .choices = {"palette", "layers", "image"}},
           {.name = "colour_image",
            .field = AT(land_cover.colour_image),
            .meaning = "The picture from above for colours = \"image\", such as one from a satellite: a raster of red, green and blue, "
                       "8 bits each, that says where it lies. Where it has nothing the palette's colours stay.",
            .text = TextKind::file},
           {.name = "colour_share",
            .field = AT(land_cover.colour_share),
            .range = {0, 1},
            .meaning = "How far the palette's colours go over to those of layers or image."},
           {.name = "bumps",
            .field = AT(land_cover.bumps),
            .range = {0, 20},
            .meaning = "With colours = \"layers\": how high the bumps are that the layers' roughness gives the ground, of what their file "
                       "says; the light falls on them where they are longer than a pixel. 0: none."},
           {.name = "lake_beds",
            .field = AT(land_cover.lake_beds),
            .meaning = "With colours = \"layers\": lakes are seen through near their shores, down to made-up beds in the layers' "
                       "colours. Not in winter."},
           {.name = "unknown",
            .field = AT(land_cover.unknown),
            .meaning = "Class of codes that the legend lacks; without it they are an error."},
           {.name = "nodata",
            .field = AT(land_cover.nodata),
            .meaning = "Class where the raster has nothing; without it that of the nearest known cell."},
           {.name = "smallest_patch_m2",
            .field = AT(land_cover.patches.smallest_m2),
            .range = {0, 1e10},
            .unit = "m²",
            .meaning = "Smaller patches of a class go to what lies around them; 0 leaves them. `belvedere check` says what became of each "
                       "class."},
           {.name = "keep_patches",
            .field = AT(land_cover.patches.keep),
            .meaning =
                "Classes whose small patches matter: they stay, and grow by up to three cells until they are large enough to be seen."},
           {.name = "towns_file",
            .field = AT(land_cover.towns_file),
            .meaning =
                "Towns that are known, besides those of [[land_cover.towns]]: a .csv file or a layer of points (.gpkg, .geojson, .shp, "
                ".fgb) with columns name, radius_m or population; see class_rules.md.",
            .text = TextKind::file},
           {.name = "rock",
            .field = AT(land_cover.rock),
            .meaning = "What rock is drawn as. limestone: towers and buttresses, pale. granite (also gneiss): slabs and cracks, grey. "
                       "sandstone: walls and benches in beds that run through, red. volcanic: ribs with much debris between, brown.",
            .text = TextKind::choice,
            .choices = {"limestone", "granite", "sandstone", "volcanic"}},
           {.name = "sea",
            .field = AT(land_cover.sea),
            .meaning = "auto finds the sea: level ground at about 0 m that reaches the edge of the data or a hole in it, also under noise. "
                       "none: there is no sea.",
            .text = TextKind::choice,
            .choices = {"auto", "none"}},
           {.name = "sea_level_m",
            .field = AT(land_cover.sea_level_m),
            .range = {-500, 9000},
            .unit = "m",
            .meaning = "Where the sea stands, for data that know its bed or count from elsewhere: all ground below that is connected with "
                       "the edge of the data is sea. Without it the level is found."},
           {.name = "settings",
            .field = AT(land_cover.settings),
            .range = {-1e9, 1e9},
            .meaning = "Parameters of the rules or layers by name, such as the altitude of the treeline; their file lists them."},
           {.name = "erode",
            .field = AT(land_cover.erode),
            .range = {0, 40},
            .meaning =
                "Classes that draw back, by steps of 50 m on the ground: snow = 2 melts a border of some 100 m. What lies around takes "
                "their place, along ragged borders; shores and the edges of settlements stay.",
            .choices = class_names()},
       }});
  sections.push_back({.name = "land_cover.sources",
                      .kind = SectionKind::list,
                      .meaning = "One block for each land-cover raster. Where several overlap, the first one wins.",
                      .keys = make_source_keys(false),
                      .count = [](const Scene& s) { return s.land_cover.sources.size(); },
                      .resize = [](Scene& s, std::size_t n) { s.land_cover.sources.resize(n); }});
  sections.push_back(
      {.name = "land_cover.towns",
       .kind = SectionKind::list,
       .meaning =
           "One block for each town that is known. Rules give it its place and keep villages that they find themselves away from it.",
       .keys =
           {
               {.name = "name", .field = AT(land_cover.towns[i].name), .meaning = "For messages."},
               {.name = "position",
                .field = AT(land_cover.towns[i].position),
                .range = {-largest_m, largest_m},
                .unit = "m",
                .meaning = "Its middle, [E, N] in the scene's CRS."},
               {.name = "position_lonlat",
                .field = AT(land_cover.towns[i].position_lonlat),
                .unit = "°",
                .meaning = "Its middle, [longitude, latitude]; instead of position.",
                .lonlat = true},
               {.name = "radius_m",
                .field = AT(land_cover.towns[i].radius_m),
                .range = {0, largest_town_radius_m, true},
                .unit = "m",
                .meaning = "Radius of a circle as large as the built-up area.",
                .required = true},
           },
       .count = [](const Scene& s) { return s.land_cover.towns.size(); },
       .resize = [](Scene& s, std::size_t n) { s.land_cover.towns.resize(n); }});
  sections.push_back(
      {.name = "season",
       .meaning = "The time of the year: which ground lies under snow, and how far autumn has come, by the climate of the place.",
       .keys = {{.name = "date",
                 .field = AT(season.date),
                 .meaning = "Month and day, \"10-05\". Rules lay the snow that lies on that day; the palette \"summer\" turns "
                            "to \"autumn\" from the heights down. Without it snow that lasts the summer, and the palette "
                            "as it is.",
                 .text = TextKind::date},
                {.name = "frozen_lakes",
                 .field = AT(season.frozen_lakes),
                 .meaning = "Whether lakes are ice where the palette is one of winter. auto: where the mean of the coldest month is below "
                            "-3 °C at the lake's altitude, by the climate of the place. Rivers and the sea stay open.",
                 .text = TextKind::choice,
                 .choices = {"auto", "always", "never"}}}});
  sections.push_back(
      {.name = "water",
       .meaning = "How lakes, rivers and the sea are painted; see water.md.",
       .keys = {{.name = "mirror",
                 .field = AT(water.mirror),
                 .meaning = "What water mirrors: traced follows the mirrored ray through the drawn world; column takes the far shore from "
                            "the same column of the picture, as drafts do; none mirrors nothing.",
                 .text = TextKind::choice,
                 .choices = {"traced", "column", "none"}},
                {.name = "mirror_share",
                 .field = AT(water.mirror_share),
                 .range = {0, 2},
                 .meaning = "How strong the traced image is. 1 is the painter's: stronger than nature's where water is seen from above."},
                {.name = "wind",
                 .field = AT(water.wind),
                 .range = {0, 2},
                 .meaning = "How much wind ruffles the water: patches that show the sky instead of the shore, and streaks of light."},
                {.name = "beds",
                 .field = AT(water.beds),
                 .meaning = "Lakes are pale over their shallows and deepen from turquoise to blue, over beds made up from their banks. Not "
                            "in winter."},
                {.name = "surf_mm",
                 .field = AT(water.surf_mm),
                 .range = {0, 3},
                 .unit = "mm",
                 .meaning = "Width, on the sheet, of the broken line of surf along the sea's shores. 0: none."},
                {.name = "foam", .field = AT(water.foam), .meaning = "Where rivers fall steeply they are white."}}});
  return sections;
}

}  // namespace belvedere
