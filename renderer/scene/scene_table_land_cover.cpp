#include "renderer/scene/scene_table.h"
#include "terrain/cover/towns.h"

namespace belvedere {

std::vector<SceneSection> make_land_cover_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "land_cover",
       .meaning =
           "Land cover: from rasters with a legend, or else by rules from the terrain itself.",
       .keys = {
           {.name = "refine",
            .field = AT(land_cover.refine),
            .meaning = "Subdivides raster classes: glacier = \"rock\" turns the raster's rock into "
                       "glacier where the rules find a glacier."},
           {.name = "legend",
            .field = AT(land_cover.legend),
            .meaning = "Classes of the raster's codes: a built-in legend or a .toml or .csv file. "
                       "Required if there is a source.",
            .text = TextKind::built_in,
            .choices_from = "legends"},
           {.name = "rules",
            .field = AT(land_cover.rules),
            .meaning = "Rules that classify the ground by altitude, slope and exposure if there is "
                       "no source: a built-in name or a .toml file.",
            .text = TextKind::built_in,
            .choices_from = "layers"},
           {.name = "layers",
            .field = AT(land_cover.layers),
            .meaning = "Surface layers that classify the ground, instead of rules: a .layers.toml "
                       "file, written by hand or fitted to a picture; see layers.md.",
            .text = TextKind::file},
           {.name = "colours",
            .field = AT(land_cover.colours),
            .meaning = "Source of the ground's colours. palette: the ramps of each class. layers, "
                       "image, texture: the colours of the surface layers, of an image from above, "
                       "or of a composite texture, in the palette's light and at its mean "
                       "lightness. Water is unchanged.",
            .text = TextKind::choice,
            .choices = {"palette", "layers", "image", "texture"}},
           {.name = "colour_image",
            .field = AT(land_cover.colour_image),
            .meaning = "The image from above for colours = \"image\", such as a satellite image: a "
                       "georeferenced raster of red, green and blue, 8 bits each. Where it has no "
                       "data the palette's colours apply.",
            .text = TextKind::file},
           {.name = "texture",
            .field = AT(land_cover.texture),
            .meaning = "The composite for colours = \"texture\", learnt by `belvedere composite "
                       "learn` from an image from above with a mask of classes: each class is "
                       "painted by its texture, without repetition. Classes that it lacks take the "
                       "palette's colours.",
            .text = TextKind::file},
           {.name = "texture_m",
            .field = AT(land_cover.texture_m),
            .range = {0, 1000},
            .unit = "m",
            .meaning = "Side of the texture's pixels on the ground, as that of the image it was "
                       "learnt from. 0: a cell of the DEM."},
           {.name = "colour_share",
            .field = AT(land_cover.colour_share),
            .range = {0, 1},
            .meaning = "Weight of the colours of layers, image or texture against the palette's."},
           {.name = "bumps",
            .field = AT(land_cover.bumps),
            .range = {0, 20},
            .meaning = "With colours = \"layers\": factor on the height of bumps from the layers' "
                       "roughness. They are shaded if they are longer than a pixel. 0: none."},
           {.name = "lake_beds",
            .field = AT(land_cover.lake_beds),
            .meaning = "With colours = \"layers\": lakes are transparent near their shores, down "
                       "to synthetic beds in the layers' colours. Not in winter."},
           {.name = "unknown",
            .field = AT(land_cover.unknown),
            .meaning = "Class of codes that the legend lacks; otherwise they are an error."},
           {.name = "nodata",
            .field = AT(land_cover.nodata),
            .meaning =
                "Class where the raster has no data. Default: that of the nearest cell with data."},
           {.name = "smallest_patch_m2",
            .field = AT(land_cover.patches.smallest_m2),
            .range = {0, 1e10},
            .unit = "m²",
            .meaning = "Smaller patches of a class are replaced by their surroundings; 0: off. "
                       "`belvedere check` reports the change of each class."},
           {.name = "keep_patches",
            .field = AT(land_cover.patches.keep),
            .meaning = "Classes whose small patches matter: they stay, and grow by up to three "
                       "cells until they are large enough to be visible."},
           {.name = "towns_file",
            .field = AT(land_cover.towns_file),
            .meaning = "Known towns, besides those of [[land_cover.towns]]: a .csv file or a layer "
                       "of points (.gpkg, .geojson, .shp, .fgb) with columns name, radius_m or "
                       "population; see class_rules.md.",
            .text = TextKind::file},
           make_vector_crs_key(AT(land_cover.towns_source.crs), "towns_crs"),
           make_encoding_key(AT(land_cover.towns_source.encoding), "towns_encoding"),
           {.name = "rock",
            .field = AT(land_cover.rock),
            .meaning = "How rock is drawn. limestone: towers and buttresses, pale. granite (also "
                       "gneiss): slabs and cracks, grey. sandstone: walls and benches in "
                       "continuous beds, red. volcanic: ribs with much debris between, brown.",
            .text = TextKind::choice,
            .choices = {"limestone", "granite", "sandstone", "volcanic"}},
           {.name = "sea",
            .field = AT(land_cover.sea),
            .meaning = "auto finds the sea: level ground at about 0 m that reaches the edge of the "
                       "data or a hole in it, also if noisy. none: there is no sea.",
            .text = TextKind::choice,
            .choices = {"auto", "none"}},
           {.name = "sea_level_m",
            .field = AT(land_cover.sea_level_m),
            .range = {-500, 9000},
            .unit = "m",
            .meaning = "Altitude of the sea, for data that include its bed or have another datum: "
                       "all ground below it that is connected with the edge of the data is sea. "
                       "Default: the level is detected."},
           {.name = "settings",
            .field = AT(land_cover.settings),
            .range = {-1e9, 1e9},
            .meaning = "Parameters of the rules or layers by name, such as the altitude of the "
                       "treeline; their file lists them."},
           {.name = "erode",
            .field = AT(land_cover.erode),
            .range = {0, 40},
            .meaning = "Classes that retreat, in steps of 50 m on the ground: snow = 2 melts a "
                       "border of about 100 m. Surrounding classes replace them, along ragged "
                       "borders; shores and the edges of settlements do not change.",
            .choices = ground_class_names()},
       }});
  sections.push_back(
      {.name = "land_cover.sources",
       .kind = SectionKind::list,
       .meaning =
           "One block for each land-cover raster. Where several overlap, the first one wins.",
       .keys = make_source_keys(false),
       .count = [](const Scene& s) { return s.land_cover.sources.size(); },
       .resize = [](Scene& s, std::size_t n) { s.land_cover.sources.resize(n); }});
  sections.push_back({.name = "land_cover.towns",
                      .kind = SectionKind::list,
                      .meaning = "One block for each known town. Rules put a town there and keep "
                                 "inferred villages away from it.",
                      .keys =
                          {
                              {.name = "name",
                               .field = AT(land_cover.towns[i].name),
                               .meaning = "Name for messages."},
                              {.name = "position",
                               .field = AT(land_cover.towns[i].position),
                               .range = {-largest_m, largest_m},
                               .unit = "m",
                               .meaning = "Its centre, [E, N] in the scene's CRS."},
                              {.name = "position_lonlat",
                               .field = AT(land_cover.towns[i].position_lonlat),
                               .unit = "°",
                               .meaning = "Its centre, [longitude, latitude]; instead of position.",
                               .lonlat = true},
                              {.name = "radius_m",
                               .field = AT(land_cover.towns[i].radius_m),
                               .range = {0, largest_town_radius_m, true},
                               .unit = "m",
                               .meaning = "Radius of a circle with the area of the built-up land.",
                               .required = true},
                          },
                      .count = [](const Scene& s) { return s.land_cover.towns.size(); },
                      .resize = [](Scene& s, std::size_t n) { s.land_cover.towns.resize(n); }});
  sections.push_back(
      {.name = "season",
       .meaning = "Time of the year: which ground is under snow, and how far autumn has "
                  "progressed, by the climate of the place.",
       .keys = {{.name = "date",
                 .field = AT(season.date),
                 .meaning = "Month and day, \"10-05\". Rules lay the snow of that day; the palette "
                            "\"summer\" turns to \"autumn\" from the heights down. Default: only "
                            "snow that lasts through summer, and the palette unchanged.",
                 .text = TextKind::date},
                {.name = "frozen_lakes",
                 .field = AT(season.frozen_lakes),
                 .meaning = "Whether lakes are frozen with a winter palette. auto: if the mean of "
                            "the coldest month is below -3 °C at the lake's altitude, by the "
                            "climate of the place. Rivers and the sea stay open.",
                 .text = TextKind::choice,
                 .choices = {"auto", "always", "never"}}}});
  sections.push_back(
      {.name = "water",
       .meaning = "How lakes, rivers and the sea are painted; see water.md.",
       .keys = {
           {.name = "mirror",
            .field = AT(water.mirror),
            .meaning = "Reflections in water: traced follows the reflected ray through the drawn "
                       "world; column takes the far shore from the same column of the picture, as "
                       "drafts do; none has no reflections.",
            .text = TextKind::choice,
            .choices = {"traced", "column", "none"}},
           {.name = "mirror_share",
            .field = AT(water.mirror_share),
            .range = {0, 2},
            .meaning = "Strength of traced reflections. 1 is as in paintings: stronger than in "
                       "nature where water is seen from above."},
           {.name = "wind",
            .field = AT(water.wind),
            .range = {0, 2},
            .meaning = "Amount of wind on the water: patches that reflect the sky instead of the "
                       "shore, and streaks of light."},
           {.name = "beds",
            .field = AT(water.beds),
            .meaning = "Lakes are pale over shallows and deepen from turquoise to blue, over beds "
                       "inferred from their banks. Not in winter."},
           {.name = "surf_mm",
            .field = AT(water.surf_mm),
            .range = {0, 3},
            .unit = "mm",
            .meaning =
                "Width, on the sheet, of the broken line of surf along the sea's shores. 0: none."},
           {.name = "foam",
            .field = AT(water.foam),
            .meaning = "Steep reaches of rivers are white."}}});
  return sections;
}

std::vector<SceneSection> make_climate_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "climate",
       .meaning = "Temperature and precipitation by position and altitude: from stations, else "
                  "from rasters, else from built-in values for the place; see climate.md. "
                  "`belvedere check` reports which was used and how certain it is.",
       .keys = {
           {.name = "stations",
            .field = AT(climate.stations),
            .meaning =
                "Weather stations: a table (.csv, .gpkg, .geojson …) with positions, altitude_m, "
                "t_1 … t_12 or t_year in °C, rain_mm; or a history of the climate (.nc).",
            .text = TextKind::file},
           {.name = "temperature",
            .field = AT(climate.temperature),
            .meaning = "Raster of 12 bands: means of January … December, in °C or kelvin "
                       "(WorldClim, CHELSA).",
            .text = TextKind::file,
            .raster = true},
           {.name = "temperature_factor",
            .field = AT(climate.temperature_factor),
            .range = {0.001, 1000},
            .meaning = "°C or kelvin per unit of that raster: 0.1 where it holds tenths."},
           {.name = "rain",
            .field = AT(climate.rain),
            .meaning = "Raster of precipitation (rain and snow), mm: 12 bands of months, or one "
                       "band of the year.",
            .text = TextKind::file,
            .raster = true},
           {.name = "rain_factor",
            .field = AT(climate.rain_factor),
            .range = {0.05, 20},
            .meaning = "Factor on the rain of any source: 0.5 for ground half as wet, with more "
                       "steppe and less forest."},
           {.name = "sheltered",
            .field = AT(climate.sheltered),
            .range = {0, 1},
            .meaning = "1 for ground behind ranges or far from the sea that the built-in table of "
                       "dry places does not know: rain and evaporation are those of the dry places "
                       "around."},
           {.name = "warmer_k",
            .field = AT(climate.warmer_k),
            .range = {-30, 30},
            .unit = "K",
            .meaning =
                "Another time: all months are warmer by this than the sources say. Treeline, "
                "snow and ice follow, unless land_cover.settings has their altitudes. -6: "
                "an ice age."},
           {.name = "wetter",
            .field = AT(climate.wetter),
            .range = {-0.95, 10},
            .meaning = "Another time: share of precipitation that falls in addition; -0.3 is a "
                       "third less."},
           {.name = "clearings",
            .field = AT(climate.clearings),
            .range = {-1, 1},
            .meaning = "Another time: 1 turns most forest on gentle slopes to pasture, -1 lets "
                       "forest grow over the pastures. The rules' setting of that name has "
                       "precedence."},
           {.name = "sunshine",
            .field = AT(climate.sunshine),
            .range = {0, 1},
            .meaning = "Share of the day in which the sun shines, of all months or of January … "
                       "December: in cloudy country sunny and shaded slopes differ less. Default: "
                       "1, a clear sky."},
           {.name = "lapse_k_per_km",
            .field = AT(climate.lapse_k_per_km),
            .range = {-5, 12},
            .unit = "K/km",
            .meaning = "Decrease of temperature per km of altitude, in all months. Default: from "
                       "stations, raster or place."},
           {.name = "wind_from_deg",
            .field = AT(climate.wind_from_deg),
            .range = {0, 360},
            .unit = "°",
            .meaning = "Direction that rain-bearing wind comes from, clockwise from north: that "
                       "side of mountains gets more precipitation, the other less. Default: the "
                       "usual direction at the latitude, on maps of 40 km or more and where the "
                       "stations give precipitation."},
           {.name = "latitude_deg",
            .field = AT(climate.latitude_deg),
            .range = {-90, 90},
            .unit = "°",
            .meaning = "Latitude of a terrain that has no coordinate system or is synthetic."},
       }});
  return sections;
}

}  // namespace belvedere
