#include "renderer/scene/scene_table.h"

namespace belvedere {

std::vector<SceneSection> make_features_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "features",
       .kind = SectionKind::list,
       .meaning = "One block for each vector file, or layer, whose roads, paths, lifts, runs, "
                  "buildings, waters and areas are drawn; see features.md. `belvedere features "
                  "check` reports what becomes of them.",
       .keys =
           {
               {.name = "source",
                .field = AT(features[i].source),
                .meaning = "A .gpkg, .geojson, .shp, .fgb, .gpx, .osm or .osm.pbf file, in any "
                           "coordinate system that it states.",
                .text = TextKind::file,
                .required = true},
               make_vector_crs_key(AT(features[i].file.crs)),
               make_encoding_key(AT(features[i].file.encoding)),
               {.name = "layer",
                .field = AT(features[i].layer),
                .meaning = "The layer of the file. Default: all layers."},
               {.name = "where",
                .field = AT(features[i].where),
                .meaning = "Only features that meet this condition, as in SQL: \"highway = "
                           "'motorway' AND tunnel IS NULL\"."},
               {.name = "kind",
                .field = AT(features[i].kind),
                .meaning = "Kind of the features, a word of the style: motorway, road, path, "
                           "railway, lift, run_easy, building, river, lake … With kind_of, only "
                           "for features whose column has no word of the style."},
               {.name = "kind_of",
                .field = AT(features[i].kind_of),
                .meaning = "The column with the kind of each feature, such as highway, in words of "
                           "the style."},
               {.name = "width_mm",
                .field = AT(features[i].width_mm),
                .range = {0, 50},
                .unit = "mm",
                .meaning = "Width on the sheet in the foreground; 0: the style's."},
               {.name = "width_of",
                .field = AT(features[i].width_of),
                .meaning =
                    "A column with widths in metres: no feature is drawn narrower than that."},
               {.name = "level_of",
                .field = AT(features[i].level_of),
                .meaning = "A column with the altitudes of lakes in metres. Default: the altitude "
                           "of the ground in the lake."},
               {.name = "population_of",
                .field = AT(features[i].population_of),
                .meaning = "A column with the population of towns given as points, from which "
                           "their size is estimated."},
               {.name = "snap_m",
                .field = AT(features[i].snap_m),
                .range = {0, 2000},
                .unit = "m",
                .meaning = "Rivers are moved to the bottom of the valley if it lies within this "
                           "distance; 0: they stay where the file has them."},
               {.name = "keep_inferred",
                .field = AT(features[i].keep_inferred),
                .meaning = "Rivers and villages inferred by rules stay beside those of this file; "
                           "otherwise they are removed everywhere."},
               {.name = "origin",
                .field = AT(features[i].origin),
                .meaning = "Who made the data; shown by check, written to the headers."},
               {.name = "licence", .field = AT(features[i].licence), .meaning = "Their licence."},
               {.name = "get_from",
                .field = AT(features[i].get_from),
                .meaning = "Where to get the file; shown when it is missing."},
               {.name = "optional",
                .field = AT(features[i].optional),
                .meaning =
                    "If its file is missing, leave the block out with a note instead of an error."},
               {.name = "enabled",
                .field = AT(features[i].enabled),
                .meaning = "If false, the block is left out."},
           },
       .count = [](const Scene& s) { return s.features.size(); },
       .resize = [](Scene& s, std::size_t n) { s.features.resize(n); }});
  return sections;
}

}  // namespace belvedere
