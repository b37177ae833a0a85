#include "terrain/io/gdal/vector_layers.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/core.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "base/error.h"
#include "base/text/archive_kind.h"
#include "base/text/letters.h"
#include "base/text/text_encoding.h"
#include "terrain/io/crs.h"
#include "terrain/io/input_parts.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;

struct VectorFormat {
  std::string_view extension;
  const char* driver;
};
constexpr std::array formats = {
    VectorFormat{".gpkg", "GPKG"},      VectorFormat{".geojson", "GeoJSON"},
    VectorFormat{".json", "GeoJSON"},   VectorFormat{".shp", "ESRI Shapefile"},
    VectorFormat{".fgb", "FlatGeobuf"}, VectorFormat{".gpx", "GPX"},
    VectorFormat{".osm", "OSM"},        VectorFormat{".pbf", "OSM"}};

}  // namespace

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
        std::find(extensions.begin(), extensions.end(), format.extension) != extensions.end())
      driver = format.driver;
  std::error_code ignored;
  const bool exists = fs::is_regular_file(path, ignored);
  if (const std::string archive = exists ? archive_kind(path) : ""; !archive.empty())
    throw Error(ErrorKind::input, path, "is " + archive, unpack_advice);
  if (driver == nullptr) throw Error(ErrorKind::usage, path, found, allowed);
  if (!exists) throw Error(ErrorKind::input, path, "file not found");
  const GdalErrors errors;
  const char* const drivers[] = {driver, nullptr};
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
  Dataset file = open_to_read(path, path, GDAL_OF_VECTOR | GDAL_OF_VERBOSE_ERROR, drivers, errors,
                              options.List());
  if (file == nullptr)
    throw Error(ErrorKind::input, path, errors.say(fmt::format("not a readable {} file", driver)));
  return file;
}

std::string field_text(OGRFeatureH feature, int column, const std::string& path,
                       const std::string& where) {
  if (column < 0 || OGR_F_IsFieldSetAndNotNull(feature, column) == 0) return {};
  std::string text = OGR_F_GetFieldAsString(feature, column);
  if (CPLIsUTF8(text.c_str(), -1) != 0 || lower_extension(path) != ".shp") return text;
  throw Error(ErrorKind::input, where,
              fmt::format("{} is not UTF-8, and the shapefile does not name its encoding",
                          OGR_Fld_GetNameRef(OGR_F_GetFieldDefnRef(feature, column))),
              fmt::format("its key `encoding` in the scene, or a text file {}.cpg beside it, with "
                          "the name of the encoding, such as ISO-8859-1 or windows-1251",
                          fs::path(path).stem().string()));
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

}  // namespace belvedere
