#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "terrain/io/crs.h"
#include "terrain/io/gdal/vector_layers.h"
#include "terrain/io/lines.h"

namespace belvedere {
namespace {

constexpr std::size_t most_places = 1000000;

// Appends a line's parts; other geometries are none.
void add_lines(OGRGeometryH geometry, const std::string& name, const std::string& where, std::vector<MapLine>& lines) {
  if (geometry == nullptr) return;
  const OGRwkbGeometryType type = wkbFlatten(OGR_G_GetGeometryType(geometry));
  if (type == wkbMultiLineString || type == wkbGeometryCollection) {
    for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i) add_lines(OGR_G_GetGeometryRef(geometry, i), name, where, lines);
    return;
  }
  if (type != wkbLineString) return;
  MapLine line{name, where, {}};
  for (int i = 0; i < OGR_G_GetPointCount(geometry); ++i) {
    const glm::dvec2 place{OGR_G_GetX(geometry, i), OGR_G_GetY(geometry, i)};
    if (!std::isfinite(place.x) || !std::isfinite(place.y)) throw Error(ErrorKind::input, where, "has a place that is no number");
    line.places.push_back(place);
  }
  if (line.places.size() > 1) lines.push_back(std::move(line));
}

void read_layer(OGRLayerH layer, const std::string& path, const std::string& crs, std::vector<MapLine>& all) {
  std::vector<MapLine> lines;
  const int name = OGR_FD_GetFieldIndex(OGR_L_GetLayerDefn(layer), "name");
  std::size_t places = 0;
  OGR_L_ResetReading(layer);
  while (true) {
    const VectorFeature feature(OGR_L_GetNextFeature(layer), &OGR_F_Destroy);
    if (feature == nullptr) break;
    const bool named = name >= 0 && OGR_F_IsFieldSetAndNotNull(feature.get(), name) != 0;
    const std::size_t before = lines.size();
    add_lines(OGR_F_GetGeometryRef(feature.get()), named ? OGR_F_GetFieldAsString(feature.get(), name) : "",
              fmt::format("{}, feature {}", path, OGR_F_GetFID(feature.get())), lines);
    for (std::size_t i = before; i < lines.size(); ++i) places += lines[i].places.size();
    if (places > most_places) throw Error(ErrorKind::limit, path, fmt::format("lines of more than {} places", most_places));
  }
  if (lines.empty()) return;
  const std::string own_crs = layer_crs(layer, path);
  if (own_crs.empty()) throw Error(ErrorKind::input, path, "its layer has no CRS", "a layer that says its CRS");
  const PointTransform transform(own_crs, crs);
  for (MapLine& line : lines) {
    transform.apply(line.places);
    for (const glm::dvec2 place : line.places)
      if (!std::isfinite(place.x)) throw Error(ErrorKind::input, line.where, "a place lies outside of " + describe_crs(crs));
    all.push_back(std::move(line));
  }
}

}  // namespace

std::vector<MapLine> read_lines(const std::string& path, const std::string& crs) {
  if (crs.empty()) throw Error(ErrorKind::usage, path, "the terrain has no CRS", "terrain that says its CRS");
  const std::string allowed = ".gpx, .gpkg, .geojson, .json, .shp or .fgb";
  const Dataset file = open_vector_layers(path, {".gpx", ".gpkg", ".geojson", ".json", ".shp", ".fgb"}, "is no file of lines", allowed);
  const GdalErrors errors;
  std::vector<MapLine> lines;
  for (int i = 0; i < GDALDatasetGetLayerCount(file.get()); ++i)
    if (OGRLayerH layer = GDALDatasetGetLayer(file.get(), i); layer != nullptr) read_layer(layer, path, crs, lines);
  if (errors.failed()) throw Error(ErrorKind::input, path, errors.say("cannot be read to its end"));
  if (lines.empty()) throw Error(ErrorKind::input, path, "no line in it", "tracks, routes or lines");
  return lines;
}

}  // namespace belvedere
