#include <cpl_conv.h>
#include <fmt/format.h>
#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>

#include "base/error.h"
#include "terrain/io/crs.h"
#include "terrain/io/gdal/gdal_files.h"
#include "terrain/io/points.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;

using Feature = std::unique_ptr<void, void (*)(OGRFeatureH)>;

struct VectorFormat {
  const char* ending;
  const char* driver;
};
constexpr std::array formats = {VectorFormat{".gpkg", "GPKG"}, VectorFormat{".geojson", "GeoJSON"}, VectorFormat{".json", "GeoJSON"},
                                VectorFormat{".shp", "ESRI Shapefile"}, VectorFormat{".fgb", "FlatGeobuf"}};

constexpr const char* usual_layer = "towns";  // of several

// Only the driver that the ending names: a file that looks harmless must not send GDAL to others.
Dataset open_layers(const std::string& path) {
  const std::string ending = lower_ending(path);
  const char* driver = nullptr;
  for (const VectorFormat& format : formats)
    if (ending == format.ending) driver = format.driver;
  if (driver == nullptr) throw Error(ErrorKind::usage, path, "is no table of points", ".csv, .gpkg, .geojson, .json, .shp or .fgb");
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) throw Error(ErrorKind::input, path, "there is no such file");
  register_gdal();
  const GdalErrors errors;
  const char* const allowed[] = {driver, nullptr};
  Dataset file(GDALOpenEx(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, allowed, nullptr, nullptr));
  if (file == nullptr) throw Error(ErrorKind::input, path, errors.say(fmt::format("cannot be read as {}", driver)));
  return file;
}

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
  if (layers.empty()) throw Error(ErrorKind::input, path, "no layer of points", "a layer of points");
  if (layers.size() > 1)
    throw Error(ErrorKind::input, path, fmt::format("{} layers of points: {}", layers.size(), names),
                fmt::format("one, or one that is named \"{}\"", usual_layer));
  return layers.front();
}

// WKT; empty where the layer has none.
std::string layer_crs(OGRLayerH layer, const std::string& path) {
  OGRSpatialReferenceH reference = OGR_L_GetSpatialRef(layer);
  if (reference == nullptr) return {};
  const GdalErrors errors;
  char* text = nullptr;
  const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
  const OGRErr result = OSRExportToWktEx(reference, &text, options);
  const std::string wkt = text != nullptr ? text : "";
  CPLFree(text);
  if (result != OGRERR_NONE) throw Error(ErrorKind::input, path, errors.say("its CRS cannot be read"));
  return wkt;
}

glm::dvec2 place_of(OGRFeatureH feature, const std::string& where) {
  OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
  if (geometry != nullptr && wkbFlatten(OGR_G_GetGeometryType(geometry)) == wkbMultiPoint && OGR_G_GetGeometryCount(geometry) == 1)
    geometry = OGR_G_GetGeometryRef(geometry, 0);
  const bool point = geometry != nullptr && wkbFlatten(OGR_G_GetGeometryType(geometry)) == wkbPoint && OGR_G_IsEmpty(geometry) == 0;
  const glm::dvec2 place = point ? glm::dvec2(OGR_G_GetX(geometry, 0), OGR_G_GetY(geometry, 0)) : glm::dvec2(NAN);
  if (!std::isfinite(place.x) || !std::isfinite(place.y)) throw Error(ErrorKind::input, where, "is no point", "a point each");
  return place;
}

}  // namespace

PointTable read_point_layer(const std::string& path, const std::string& crs) {
  const Dataset file = open_layers(path);
  OGRLayerH layer = choose_layer(file.get(), path);
  const std::string own_crs = layer_crs(layer, path);
  if (own_crs.empty() != crs.empty())
    throw Error(ErrorKind::input, path, own_crs.empty() ? "its layer has no CRS" : "its layer has a CRS and the terrain has none",
                own_crs.empty() ? "a layer that says its CRS" : "a .csv file with columns east and north");

  PointTable table{.file = path, .columns = {}, .points = {}};
  OGRFeatureDefnH fields = OGR_L_GetLayerDefn(layer);
  const int count = OGR_FD_GetFieldCount(fields);
  for (int i = 0; i < count; ++i) table.columns.emplace_back(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(fields, i)));
  std::vector<glm::dvec2> places;
  const GdalErrors errors;
  OGR_L_ResetReading(layer);
  while (true) {
    const Feature feature(OGR_L_GetNextFeature(layer), &OGR_F_Destroy);
    if (feature == nullptr) break;
    constexpr std::size_t most_points = 100000;
    if (places.size() == most_points) throw Error(ErrorKind::limit, path, fmt::format("more than {} points", most_points));
    PointTable::Point& point = table.points.emplace_back();
    point.where = fmt::format("{}, feature {}", path, OGR_F_GetFID(feature.get()));
    places.push_back(place_of(feature.get(), point.where));
    for (int i = 0; i < count; ++i)
      point.values.emplace_back(OGR_F_IsFieldSetAndNotNull(feature.get(), i) != 0 ? OGR_F_GetFieldAsString(feature.get(), i) : "");
  }
  if (errors.failed()) throw Error(ErrorKind::input, path, errors.say("cannot be read to its end"));
  if (!crs.empty()) PointTransform(own_crs, crs).apply(places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!std::isfinite(places[i].x)) throw Error(ErrorKind::input, table.points[i].where, "the place lies outside of " + describe_crs(crs));
    table.points[i].place = places[i];
  }
  return table;
}

}  // namespace belvedere
