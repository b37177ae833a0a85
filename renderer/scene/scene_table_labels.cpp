#include "renderer/scene/scene_table.h"

namespace belvedere {
namespace {

using Field = SceneField (*)(Scene&, std::size_t);
struct FileFields {
  Field file, crs, encoding, origin, licence, get_from, optional, enabled;
};

// The three lists of files share these keys.
SceneSection file_section(std::string_view name, std::string_view meaning, std::string_view file,
                          const FileFields& fields) {
  return {.name = name,
          .kind = SectionKind::list,
          .meaning = meaning,
          .keys = {
              {.name = "file",
               .field = fields.file,
               .meaning = file,
               .text = TextKind::file,
               .required = true},
              make_vector_crs_key(fields.crs),
              make_encoding_key(fields.encoding),
              {.name = "origin",
               .field = fields.origin,
               .meaning = "Who made the data; written to the headers, and named in the margin."},
              {.name = "licence", .field = fields.licence, .meaning = "Their licence."},
              {.name = "get_from",
               .field = fields.get_from,
               .meaning = "Where to get the file; shown when it is missing."},
              {.name = "optional",
               .field = fields.optional,
               .meaning = "If the file is missing, leave it out with a note instead of an error."},
              {.name = "enabled",
               .field = fields.enabled,
               .meaning = "If false, the block is left out."},
          }};
}

}  // namespace

std::vector<SceneSection> make_labels_sections() {
  std::vector<SceneSection> sections;
  sections.push_back(
      {.name = "labels",
       .meaning =
           "Names on the picture; see labels.md. If there are any, `belvedere render` also writes "
           "labels.svg, labels.csv and labels.geojson. They change no pixel of the panorama.",
       .keys = {
           {.name = "style",
            .field = AT(labels.style),
            .meaning = "Style of the names: a built-in name or a .toml file.",
            .text = TextKind::built_in,
            .choices_from = "labels"},
           {.name = "in_picture",
            .field = AT(labels.in_picture),
            .meaning = "Also writes panorama_names, a second picture in the formats of "
                       "output.formats, with the names drawn in."},
           {.name = "summits",
            .field = AT(labels.summits),
            .range = {0, 10000},
            .meaning = "Number of the most prominent visible summits of the DEM that are labelled "
                       "with their altitudes, apart from those that files name."},
           {.name = "min_prominence_m",
            .field = AT(labels.min_prominence_m),
            .range = {1, 9000},
            .unit = "m",
            .meaning = "Prominence from which a point of the DEM counts as a summit: its height "
                       "above the highest pass to higher ground."},
       }});
  sections.push_back(file_section(
      "labels.points", "One block for each file of points with names.",
      "A .csv, .gpkg, .geojson, .shp, .fgb, .gpx, .osm or .pbf file with columns name, kind, rank "
      "(1 … 9) and ele.",
      {AT(labels.points[i].file), AT(labels.points[i].source.crs),
       AT(labels.points[i].source.encoding), AT(labels.points[i].origin),
       AT(labels.points[i].licence), AT(labels.points[i].get_from), AT(labels.points[i].optional),
       AT(labels.points[i].enabled)}));
  sections.back().count = [](const Scene& s) { return s.labels.points.size(); };
  sections.back().resize = [](Scene& s, std::size_t n) { s.labels.points.resize(n); };
  sections.push_back(file_section(
      "labels.shapes",
      "One block for each file of lines and areas whose names are curved along them: valleys, "
      "lakes, rivers, glaciers.",
      "A .gpkg, .geojson, .shp or .fgb file with columns name, kind and rank.",
      {AT(labels.shapes[i].file), AT(labels.shapes[i].source.crs),
       AT(labels.shapes[i].source.encoding), AT(labels.shapes[i].origin),
       AT(labels.shapes[i].licence), AT(labels.shapes[i].get_from), AT(labels.shapes[i].optional),
       AT(labels.shapes[i].enabled)}));
  sections.back().count = [](const Scene& s) { return s.labels.shapes.size(); };
  sections.back().resize = [](Scene& s, std::size_t n) { s.labels.shapes.resize(n); };
  sections.push_back(file_section(
      "labels.tracks",
      "One block for each file of ways that are drawn over the picture, hidden parts dashed.",
      "A .gpx, .gpkg, .geojson, .shp or .fgb file.",
      {AT(labels.tracks[i].file), AT(labels.tracks[i].source.crs),
       AT(labels.tracks[i].source.encoding), AT(labels.tracks[i].origin),
       AT(labels.tracks[i].licence), AT(labels.tracks[i].get_from), AT(labels.tracks[i].optional),
       AT(labels.tracks[i].enabled)}));
  sections.back().count = [](const Scene& s) { return s.labels.tracks.size(); };
  sections.back().resize = [](Scene& s, std::size_t n) { s.labels.tracks.resize(n); };
  sections.push_back(
      {.name = "labels.by_hand",
       .kind = SectionKind::list,
       .meaning = "One block for each name that is moved, hidden or changed by hand; the others "
                  "make room. The studio writes these blocks.",
       .keys =
           {
               {.name = "name",
                .field = AT(labels.by_hand[i].name),
                .meaning = "The name, as in its file.",
                .required = true},
               {.name = "dx_mm",
                .field = AT(labels.by_hand[i].dx_mm),
                .range = {-1000, 1000},
                .unit = "mm",
                .meaning = "From its mark to the centre of the foot of the name, to the right on "
                           "the sheet; of a name along a line its shift. Without dx_mm and dy_mm "
                           "the program places it."},
               {.name = "dy_mm",
                .field = AT(labels.by_hand[i].dy_mm),
                .range = {-1000, 1000},
                .unit = "mm",
                .meaning = "The same downwards; negative above the mark."},
               {.name = "hidden",
                .field = AT(labels.by_hand[i].hidden),
                .meaning = "Leaves the name and its mark out."},
               {.name = "rank",
                .field = AT(labels.by_hand[i].rank),
                .range = {1, 9},
                .meaning = "Its rank, 1 the most important. Default: as in its file."},
               {.name = "kind",
                .field = AT(labels.by_hand[i].kind),
                .meaning = "Its kind, a word of the style. Default: as in its file."},
           },
       .count = [](const Scene& s) { return s.labels.by_hand.size(); },
       .resize = [](Scene& s, std::size_t n) { s.labels.by_hand.resize(n); }});
  sections.push_back(
      {.name = "margin",
       .kind = SectionKind::optional,
       .meaning = "Paper around a second picture, with title and legend: around panorama_names if "
                  "`labels.in_picture` asks for it, else panorama_margin, without names. The "
                  "panorama itself is unchanged. Colours and type come from the style in [labels].",
       .keys =
           {
               {.name = "title",
                .field = AT(margin->title),
                .meaning = "Its title. Default: the scene's."},
               {.name = "subtitle",
                .field = AT(margin->subtitle),
                .meaning = "A line below the title."},
               {.name = "frame_mm",
                .field = AT(margin->frame_mm),
                .range = {0, 500},
                .unit = "mm",
                .meaning = "Width of the paper on every side of the picture; the strip with title "
                           "and legend is below."},
               {.name = "legend",
                .field = AT(margin->legend),
                .meaning = "Legend of the classes of ground and the kinds of features in the "
                           "picture, in its colours."},
               {.name = "scale_bars",
                .field = AT(margin->scale_bars),
                .meaning = "Scale bars: metres across the picture at two distances, near and far."},
               {.name = "directions",
                .field = AT(margin->directions),
                .meaning = "Compass: directions of north, the view and the sun."},
               {.name = "sources",
                .field = AT(margin->sources),
                .meaning = "Origin and licence of the scene's data."},
           },
       .count = [](const Scene& s) { return s.margin ? std::size_t{1} : std::size_t{0}; },
       .resize =
           [](Scene& s, std::size_t n) {
             s.margin.reset();
             if (n > 0) s.margin.emplace();
           }});
  return sections;
}

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
