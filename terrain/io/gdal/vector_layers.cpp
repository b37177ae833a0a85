#include "terrain/io/gdal/vector_layers.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "base/text/missing_file.h"
#include "base/text/text_encoding.h"
#include "terrain/io/crs.h"
#include "terrain/io/points.h"
#include "terrain/io/raster_file.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;

struct VectorFormat {
  std::string_view extension;
  const char* driver;  // of a GeoJSON, whatever its extension: also that of one object a line
};
constexpr std::string_view json_driver = "GeoJSON";
constexpr std::array formats = {VectorFormat{".gpkg", "GPKG"},
                                VectorFormat{".geojson", "GeoJSON"},
                                VectorFormat{".json", "GeoJSON"},
                                VectorFormat{".geojsonl", "GeoJSON"},
                                VectorFormat{".geojsons", "GeoJSON"},
                                VectorFormat{".ndjson", "GeoJSON"},
                                VectorFormat{".shp", "ESRI Shapefile"},
                                VectorFormat{".fgb", "FlatGeobuf"},
                                VectorFormat{".gpx", "GPX"},
                                VectorFormat{".osm", "OSM"},
                                VectorFormat{".pbf", "OSM"}};

// The first bytes decide: the rest is checked where texts are read.
std::string first_bytes_of(const std::string& path, std::size_t bytes) {
  std::string text(bytes, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

// Refuses a text file that is not UTF-8, naming line, column and byte if the file is short enough
// to be read once more.
void require_utf8_file(const std::string& path) {
  constexpr std::size_t max_bytes = std::size_t{256} << 20;
  std::error_code ignored;
  if (fs::file_size(path, ignored) > max_bytes) return;
  require_utf8(first_bytes_of(path, max_bytes), path, {}, ErrorKind::input);
}

constexpr const char* allowed_geojson =
    "one GeoJSON object, or one a line, as `jq -c '.features[]? // .' FILE > FILE.geojsonl` writes "
    "several";

// Systems that positions may be in: of the terrain, and Web Mercator, where they then lie near its
// area.
std::vector<std::string> likely_systems(glm::dvec2 position, const std::string& crs) {
  constexpr double web_mercator_m = 20037508.35;  // half of the equator
  std::vector<std::string> found;
  if (crs.empty() || crs_traits(crs).geographic) return found;
  if (doubt_of_place(crs, position).empty()) found.push_back(describe_crs(crs));
  if (std::abs(position.x) > web_mercator_m || std::abs(position.y) > web_mercator_m) return found;
  const glm::dvec2 there = PointTransform("EPSG:3857", crs).apply(position);
  if (std::isfinite(there.x) && std::isfinite(there.y) && doubt_of_place(crs, there).empty() &&
      found != std::vector<std::string>{"EPSG:3857"})
    found.emplace_back("EPSG:3857");
  return found;
}

}  // namespace

void require_degrees(const std::vector<glm::dvec2>& positions, const std::string& own_crs,
                     const std::string& crs, const VectorSource& source, const std::string& where) {
  if (own_crs.empty() || !crs_traits(own_crs).geographic) return;
  const auto too_large = [](glm::dvec2 at) {
    constexpr double full_turn = 360.0;
    return std::abs(at.x) > full_turn || std::abs(at.y) > full_turn;
  };
  const auto first = std::find_if(positions.begin(), positions.end(), too_large);
  const auto count = std::count_if(first, positions.end(), too_large);
  if (2 * count <= static_cast<std::ptrdiff_t>(positions.size())) return;
  const std::vector<std::string> likely = likely_systems(*first, crs);
  const std::string system = likely.empty() ? "EPSG:3857" : likely.front();
  const std::string file = fs::path(source.path).filename().string();
  throw Error(
      ErrorKind::input, where,
      fmt::format(
          "these are metres, not degrees: ({:.10g}, {:.10g}) is no longitude and latitude, "
          "and the file {}{}",
          first->x, first->y,
          lower_extension(file).find("json") == std::string::npos
              ? "says " + describe_crs(own_crs)
              : "names no other coordinate system",
          likely.empty() ? "" : fmt::format("; they may be in {}", fmt::join(likely, " or "))),
      fmt::format("the file's coordinate system: its key `crs` in the scene, for instance crs = "
                  "\"{}\", or a file in degrees, made by `ogr2ogr -s_srs {} -t_srs EPSG:4326 "
                  "degrees.geojson {}`",
                  system, system, file));
}

std::vector<std::string> vector_parts(const std::string& path) {
  std::vector<std::string> parts = {path};
  if (lower_extension(path) == ".shp")
    for (const char* extension : {".dbf", ".shx", ".prj", ".cpg"}) {
      std::error_code ignored;
      const std::string part = fs::path(path).replace_extension(extension).string();
      if (fs::is_regular_file(part, ignored)) parts.push_back(part);
    }
  for (std::string& change : database_changes(path)) parts.push_back(std::move(change));
  return parts;
}

Dataset open_vector_layers(const VectorSource& source,
                           const std::vector<std::string_view>& extensions,
                           const std::string& found, const std::string& allowed) {
  const std::string& path = source.path;
  const std::string extension = lower_extension(path);
  const char* driver = nullptr;
  for (const VectorFormat& format : formats)
    if (extension == format.extension &&
        std::find(extensions.begin(), extensions.end(),
                  format.driver == json_driver ? ".geojson" : format.extension) != extensions.end())
      driver = format.driver;
  std::error_code ignored;
  const bool exists = fs::is_regular_file(path, ignored);
  if (const std::string archive = exists ? archive_kind(path) : ""; !archive.empty())
    throw Error(ErrorKind::input, path, "is " + archive, unpack_advice);
  if (driver == nullptr) throw Error(ErrorKind::usage, path, found, allowed);
  if (!exists) throw missing_file(path, allowed);
  const GdalErrors errors;
  const bool json = driver == json_driver;
  const char* const drivers[] = {driver, json ? "GeoJSONSeq" : nullptr, nullptr};
  // GDAL would read only the first of several lines behind a byte order mark.
  std::string address = path;
  if (json) {
    const std::string head = first_bytes_of(path, 4096);
    refuse_wide_text(head, path, {}, ErrorKind::input);
    if (head.starts_with("\xef\xbb\xbf")) address = "/vsisubfile/3," + path;
  }
  CPLStringList options;
  if (!source.encoding.empty()) {
    check_text_encoding(source.encoding, path);
    if (extension != ".shp")
      throw Error(ErrorKind::usage, path,
                  fmt::format("has the encoding {}, but {} files are always UTF-8", source.encoding,
                              driver),
                  "`encoding` for .shp and .csv files only");
    options.SetNameValue("ENCODING", source.encoding.c_str());
  }
  Dataset file = open_to_read(address, path, GDAL_OF_VECTOR | GDAL_OF_VERBOSE_ERROR, drivers,
                              errors, options.List());
  if (file == nullptr)
    throw Error(ErrorKind::input, path, errors.say(fmt::format("not a readable {} file", driver)),
                json ? allowed_geojson : "");
  return file;
}

std::string field_text(OGRFeatureH feature, int column, const std::string& path,
                       const std::string& where) {
  if (column < 0 || OGR_F_IsFieldSetAndNotNull(feature, column) == 0) return {};
  std::string text = OGR_F_GetFieldAsString(feature, column);
  if (CPLIsUTF8(text.c_str(), -1) != 0) return text;
  const bool shapefile = lower_extension(path) == ".shp";
  if (lower_extension(path).find("json") != std::string::npos) require_utf8_file(path);
  const std::string name = OGR_Fld_GetNameRef(OGR_F_GetFieldDefnRef(feature, column));
  throw Error(ErrorKind::input, where,
              shapefile ? name + " is not UTF-8, and the shapefile does not name its encoding"
                        : name + " is not UTF-8",
              shapefile ? fmt::format("its key `encoding` in the scene, or a text file {}.cpg "
                                      "beside it, with the name of the encoding, such as "
                                      "ISO-8859-1 or windows-1251",
                                      fs::path(path).stem().string())
                        : "a file whose texts are saved as UTF-8");
}

std::string layer_crs(OGRLayerH layer, const VectorSource& source) {
  if (!source.crs.empty()) return normalize_crs(source.crs);
  const std::string& path = source.path;
  OGRSpatialReferenceH reference = OGR_L_GetSpatialRef(layer);
  if (reference == nullptr) return {};
  const GdalErrors errors;
  char* text = nullptr;
  const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
  const OGRErr result = OSRExportToWktEx(reference, &text, options);
  const std::string wkt = text != nullptr ? text : "";
  CPLFree(text);
  if (result != OGRERR_NONE) throw Error(ErrorKind::input, path, errors.say("cannot read its CRS"));
  return wkt;
}

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
