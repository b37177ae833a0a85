#include "renderer/scene/scene_table.h"

namespace belvedere {

std::vector<SceneSection> make_features_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "features",
       .kind = SectionKind::list,
       .meaning = "One block for each vector file, or layer, whose roads, ways, lifts, runs, buildings, waters and areas come into the "
                  "picture; see features.md. `belvedere features check` says what becomes of them.",
       .keys =
           {
               {.name = "source",
                .field = AT(features[i].source),
                .meaning = "A .gpkg, .geojson, .shp, .fgb, .gpx, .osm or .osm.pbf file, in any coordinate system that it states.",
                .text = TextKind::file,
                .required = true},
               {.name = "layer",
                .field = AT(features[i].layer),
                .meaning = "The layer of the file; without it all of its layers are read."},
               {.name = "where",
                .field = AT(features[i].where),
                .meaning = "Only features of which this is true, as in SQL: \"highway = 'motorway' AND tunnel IS NULL\"."},
               {.name = "kind",
                .field = AT(features[i].kind),
                .meaning = "What they are, a word of the style: motorway, road, path, railway, lift, run_easy, building, river, lake … "
                           "With kind_of only those whose column says nothing that the style knows."},
               {.name = "kind_of",
                .field = AT(features[i].kind_of),
                .meaning = "The column that says what each is, such as highway, in words of the style."},
               {.name = "width_mm",
                .field = AT(features[i].width_mm),
                .range = {0, 50},
                .unit = "mm",
                .meaning = "Width on the sheet in the foreground instead of the style's; 0: the style's."},
               {.name = "width_of",
                .field = AT(features[i].width_of),
                .meaning = "A column with widths in metres: none is drawn narrower than it is."},
               {.name = "level_of",
                .field = AT(features[i].level_of),
                .meaning = "A column with the altitudes of lakes in metres; without it a lake is as high as the ground in it."},
               {.name = "people_of",
                .field = AT(features[i].people_of),
                .meaning = "A column with the inhabitants of towns that are points: how large they are."},
               {.name = "snap_m",
                .field = AT(features[i].snap_m),
                .range = {0, 2000},
                .unit = "m",
                .meaning = "Rivers are moved to the bottom of the valley where it lies so near; 0: they stay where the file has them."},
               {.name = "keep_guesses",
                .field = AT(features[i].keep_guesses),
                .meaning = "Rivers and villages that the rules guess stay beside those of this file, instead of giving way everywhere."},
               {.name = "origin", .field = AT(features[i].origin), .meaning = "Who made the data; shown by check, kept in the headers."},
               {.name = "licence", .field = AT(features[i].licence), .meaning = "Their licence."},
               {.name = "get_from", .field = AT(features[i].get_from), .meaning = "Where to get the file; shown when it is missing."},
               {.name = "optional",
                .field = AT(features[i].optional),
                .meaning = "Leave the block out with a note where its file is missing, instead of an error."},
           },
       .count = [](const Scene& s) { return s.features.size(); },
       .resize = [](Scene& s, std::size_t n) { s.features.resize(n); }});
  return sections;
}

}  // namespace belvedere
