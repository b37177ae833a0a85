#include "tools/cli/labels/located_places.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/text/letters.h"
#include "renderer/labels/label_files.h"
#include "renderer/pipeline/scene_labels.h"
#include "tools/cli/deform_options.h"

namespace belvedere::tools {
namespace {

bool names_a_file(const std::string& text) {
  constexpr std::array extensions = {".csv", ".gpkg", ".geojson", ".json", ".geojsonl", ".ndjson",
                                     ".shp", ".fgb",  ".gpx",     ".osm",  ".pbf"};
  return std::find(extensions.begin(), extensions.end(), lower_extension(text)) != extensions.end();
}

Json json_of(const LabelSheet& sheet, const Label& label) {
  const LabelMark& mark = label.mark;
  Json entry = Json::object()
                   .add("name", Json::text(label.point.name))
                   .add("kind", Json::text(sheet.kind_of(label).name))
                   .add("where", Json::text(label.point.where))
                   .add("place", pair_json(label.point.position))
                   .add("outcome", Json::text(std::string(name_of(mark.state))))
                   .add("visible", Json::boolean(mark.state == MarkState::seen));
  if (label.point.altitude_m) entry.add("altitude_file_m", Json::number(*label.point.altitude_m));
  if (!std::isnan(mark.dem_altitude_m))
    entry.add("altitude_dem_m", Json::number(mark.dem_altitude_m));
  if (mark.state != MarkState::outside_terrain && mark.state != MarkState::behind_eye)
    entry.add("pixel", pair_json(mark.pixel))
        .add("distance_m", Json::number(mark.distance_m))
        .add("in_picture", Json::boolean(mark.state != MarkState::outside_picture));
  if (mark.in_front) entry.add("hiding_place", pair_json(mark.in_front->position));
  if (!label.hidden_by.empty()) entry.add("hidden_by", Json::text(label.hidden_by));
  return entry;
}

}  // namespace

Json pair_json(glm::dvec2 p) { return Json::array({Json::number(p.x), Json::number(p.y)}); }

LocateQuestions sort_questions(const std::vector<std::string>& asked) {
  LocateQuestions questions;
  for (const std::string& text : asked) {
    if (names_a_file(text)) {
      questions.files.push_back(text);
      continue;
    }
    try {
      parse_pair(text, "--locate");
    } catch (const Error& error) {
      throw Error(ErrorKind::usage, "--locate", '"' + text + '"',
                  "E,N: two numbers separated by a comma; or a file of points: .csv, .gpkg, "
                  ".geojson, .json, .geojsonl, .ndjson, .shp, .fgb, .gpx, .osm or .pbf");
    }
    questions.positions.push_back(text);
  }
  return questions;
}

LocatedTable locate_files(const BareView& bare, const std::vector<std::string>& files,
                          Progress& progress) {
  const LabelSheet sheet = locate_points(files, bare, progress);
  LocatedTable table;
  table.csv = places_csv(sheet);
  for (const Label& label : sheet.labels) table.json.add(json_of(sheet, label));
  return table;
}

}  // namespace belvedere::tools
