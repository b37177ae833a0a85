#include <fmt/core.h>
#include <ogr_api.h>

#include <cmath>
#include <memory>

#include "base/error.h"
#include "terrain/io/crs.h"
#include "terrain/io/gdal/vector_layers.h"
#include "terrain/io/points.h"

namespace belvedere {
namespace {

constexpr const char* usual_layer = "towns";  // preferred if there are several

bool may_hold_points(OGRLayerH layer) {
  const OGRwkbGeometryType type = wkbFlatten(OGR_L_GetGeomType(layer));
  return type == wkbPoint || type == wkbMultiPoint || type == wkbUnknown;
}

OGRLayerH choose_layer(GDALDatasetH file, const std::string& path) {
  std::vector<OGRLayerH> layers;
  std::string names;
  for (int i = 0; i < GDALDatasetGetLayerCount(file); ++i) {
    OGRLayerH layer = GDALDatasetGetLayer(file, i);
    if (layer == nullptr || !may_hold_points(layer)) continue;
    if (std::string(OGR_L_GetName(layer)) == usual_layer) return layer;
    layers.push_back(layer);
    names += (names.empty() ? "" : ", ") + std::string(OGR_L_GetName(layer));
  }
  if (layers.empty()) throw Error(ErrorKind::input, path, "has no point layer", "a point layer");
  if (layers.size() > 1)
    throw Error(ErrorKind::input, path,
                fmt::format("has {} point layers: {}", layers.size(), names),
                fmt::format("one point layer, or one named \"{}\"", usual_layer));
  return layers.front();
}

glm::dvec2 position_of(OGRFeatureH feature, const std::string& where) {
  OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
  if (geometry != nullptr && wkbFlatten(OGR_G_GetGeometryType(geometry)) == wkbMultiPoint &&
      OGR_G_GetGeometryCount(geometry) == 1)
    geometry = OGR_G_GetGeometryRef(geometry, 0);
  const bool point = geometry != nullptr &&
                     wkbFlatten(OGR_G_GetGeometryType(geometry)) == wkbPoint &&
                     OGR_G_IsEmpty(geometry) == 0;
  const glm::dvec2 position =
      point ? glm::dvec2(OGR_G_GetX(geometry, 0), OGR_G_GetY(geometry, 0)) : glm::dvec2(NAN);
  if (!std::isfinite(position.x) || !std::isfinite(position.y))
    throw Error(ErrorKind::input, where, "not a point", "point features");
  return position;
}

}  // namespace

PointTable read_point_layer(const VectorSource& source, const std::string& crs) {
  const std::string& path = source.path;
  const Dataset file =
      open_vector_layers(source, {".gpkg", ".geojson", ".shp", ".fgb"}, "not a point table",
                         ".csv, .gpkg, .geojson, .json, .geojsonl, .ndjson, .shp or .fgb");
  OGRLayerH layer = choose_layer(file.get(), path);
  const std::string own_crs = layer_crs(layer, source);
  if (own_crs.empty() != crs.empty())
    throw Error(
        ErrorKind::input, path,
        own_crs.empty() ? "its layer has no CRS" : "its layer has a CRS and the terrain has none",
        own_crs.empty() ? missing_crs_advice : "a .csv file with columns east and north");

  PointTable table{.file = path, .columns = {}, .points = {}};
  OGRFeatureDefnH fields = OGR_L_GetLayerDefn(layer);
  const int count = OGR_FD_GetFieldCount(fields);
  for (int i = 0; i < count; ++i)
    table.columns.emplace_back(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(fields, i)));
  std::vector<glm::dvec2> positions;
  const GdalErrors errors;
  OGR_L_ResetReading(layer);
  while (true) {
    const VectorFeature feature(OGR_L_GetNextFeature(layer), &OGR_F_Destroy);
    if (feature == nullptr) break;
    constexpr std::size_t max_points = 100000;
    if (positions.size() == max_points)
      throw Error(ErrorKind::limit, path, fmt::format("more than {} points", max_points));
    PointTable::Point& point = table.points.emplace_back();
    point.where = fmt::format("{}, feature {}", path, OGR_F_GetFID(feature.get()));
    positions.push_back(position_of(feature.get(), point.where));
    for (int i = 0; i < count; ++i)
      point.values.push_back(field_text(feature.get(), i, path, point.where));
  }
  if (errors.failed())
    throw Error(ErrorKind::input, path, errors.say("cannot read the whole file"));
  if (!positions.empty())
    require_degrees(positions, own_crs, crs, source, table.points.front().where);
  if (!crs.empty()) PointTransform(own_crs, crs).apply(positions);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!std::isfinite(positions[i].x))
      throw Error(ErrorKind::input, table.points[i].where,
                  "the position is outside the valid area of " + describe_crs(crs));
    table.points[i].position = positions[i];
  }
  return table;
}

}  // namespace belvedere
