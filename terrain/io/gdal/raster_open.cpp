#include "terrain/io/gdal/raster_open.h"

#include <cpl_conv.h>
#include <cpl_minixml.h>
#include <cpl_string.h>
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/text/missing_file.h"
#include "base/text/text_encoding.h"
#include "terrain/io/http_access.h"
#include "terrain/io/raster_file.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;

// Formats that describe one raster and nothing else. A VRT can refer to any file or address, so it
// is only accepted with the extension .vrt, and each of its sources is first checked by the same
// rules.
constexpr const char* drivers[] = {"GTiff", "AAIGrid", "SRTMHGT", "HFA",  "ENVI", "EHdr",  "netCDF",
                                   "PNG",   "USGSDEM", "DTED",    "GSAG", "GSBG", "GS7BG", "GPKG"};
// Text of x, y and z has no signature: only by these extensions.
constexpr std::string_view text_grids[] = {".xyz", ".txt", ".csv", ".dat"};
constexpr const char* driver_names =
    "GeoTIFF, ESRI ASCII grid, SRTM .hgt, Erdas Imagine, ENVI, EHdr .bil, netCDF, PNG, USGS DEM, "
    "DTED, Surfer grid, GeoPackage, a grid of x, y, z in text named .xyz, or VRT named .vrt";

std::string advice_to_convert(const std::string& path, const std::string& format) {
  const std::string name = fs::path(path).filename().string();
  if (format == "HDF4" || format == "HDF5")
    return fmt::format(
        "the raster of heights as GeoTIFF: `gdalinfo {0}` lists the rasters, "
        "`gdal_translate {1}:\"{0}\"://NAME heights.tif` converts one",
        name, format);
  return fmt::format("`gdal_translate {} heights.tif` converts it; readable are {}", name,
                     driver_names);
}

CPLStringList allowed_for(const std::string& path) {
  CPLStringList allowed;
  for (const char* driver : drivers) allowed.AddString(driver);
  const std::string extension = lower_extension(path);
  if (std::find(std::begin(text_grids), std::end(text_grids), extension) != std::end(text_grids))
    allowed.AddString("XYZ");
  if (extension == ".vrt") allowed.AddString("VRT");
  return allowed;
}

}  // namespace

void make_strict() {
  register_gdal();
  CPLSetThreadLocalConfigOption("GTIFF_IGNORE_READ_ERRORS", "NO");
  CPLSetThreadLocalConfigOption("RAW_CHECK_FILE_SIZE", "YES");
  CPLSetThreadLocalConfigOption("GDAL_NUM_THREADS", "1");
  CPLSetThreadLocalConfigOption("GDAL_VRT_ENABLE_PYTHON", "NO");
  CPLSetThreadLocalConfigOption("GDAL_NETCDF_VERIFY_DIMS", "STRICT");
  set_http_of_thread();
}

namespace {

Dataset open_checked(const std::string& path, int nesting);

// Every file that a VRT refers to, by element: it must exist and be readable. GDAL would read a
// missing one as nodata.
void check_vrt_node(const CPLXMLNode* node, const std::string& path, int nesting) {
  for (; node != nullptr; node = node->psNext) {
    if (node->eType != CXT_Element) continue;
    const std::string_view name = node->pszValue;
    if (name == "PixelFunctionCode" || name == "PixelFunctionLanguage") {
      throw Error(ErrorKind::input, path, "the VRT contains program code",
                  "VRTs that only refer to rasters");
    }
    if (name == "SourceFilename" || name == "SourceDataset") {
      const bool relative = std::string_view(CPLGetXMLValue(node, "relativeToVRT", "0")) == "1";
      const fs::path file = CPLGetXMLValue(node, nullptr, "");
      try {
        const std::string address = address_from_gdal(file.string());
        const bool beside = relative && address.empty();
        const std::string from = !address.empty() ? address
                                 : beside         ? (fs::path(path).parent_path() / file).string()
                                                  : file.string();
        open_checked(from, nesting + 1);
        // The VRT would open it itself, and write beside it.
        if (is_database_in_use(from))
          throw Error(ErrorKind::input, from, "is a database in WAL mode or with unsaved changes",
                      "the GeoPackage itself as a source, instead of the VRT");
      } catch (const Error& error) {
        throw Error(error.kind(), path,
                    fmt::format("its source \"{}\": {}", error.where(), error.found()),
                    error.allowed());
      }
    }
    check_vrt_node(node->psChild, path, nesting);
  }
}

void check_vrt(const std::string& path, int nesting) {
  constexpr std::uintmax_t max_bytes = 64U << 20;
  if (nesting > 8) throw Error(ErrorKind::input, path, "VRTs are nested more than 8 levels deep");
  if (fs::file_size(path) > max_bytes)
    throw Error(ErrorKind::limit, path, "VRT larger than 64 MiB");
  const GdalErrors errors;
  const std::unique_ptr<CPLXMLNode, decltype(&CPLDestroyXMLNode)> root(
      CPLParseXMLFile(path.c_str()), &CPLDestroyXMLNode);
  if (!root) throw Error(ErrorKind::input, path, errors.say("not a valid VRT"));
  check_vrt_node(root.get(), path, nesting);
}

// A raster on a server. VRTs are not accepted, because they may refer to anything.
Dataset open_address(const std::string& address) {
  check_address(address);
  if (!http_allowed())
    throw Error(ErrorKind::input, address, "network access is not enabled",
                "--allow-http, or a local copy of the file");
  make_strict();
  // Only the file itself: no listing of its folder, no sidecar files.
  const CPLConfigOptionSetter alone("GDAL_DISABLE_READDIR_ON_OPEN", "EMPTY_DIR", false);
  CPLStringList allowed;
  for (const char* driver : drivers) allowed.AddString(driver);
  const GdalErrors errors;
  Dataset dataset = open_to_read(address_to_gdal(address), address,
                                 GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR, allowed.List(), errors);
  if (!dataset)
    throw Error(ErrorKind::input, address,
                explain_http(errors.say("the server response is not a readable raster")),
                driver_names);
  return dataset;
}

// A GeoTIFF whose bytes come from a StreamFile; it has no sidecar files.
Dataset open_stream(const std::string& path) {
  make_strict();
  const CPLConfigOptionSetter alone("GDAL_DISABLE_READDIR_ON_OPEN", "EMPTY_DIR", false);
  CPLStringList allowed;
  allowed.AddString("GTiff");
  const GdalErrors errors;
  Dataset dataset =
      open_to_read(path, path, GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR, allowed.List(), errors);
  if (!dataset) throw Error(ErrorKind::input, path, errors.say("not a readable raster"), "GeoTIFF");
  return dataset;
}

Dataset open_checked(const std::string& path, int nesting) {
  if (is_address(path)) return open_address(path);
  if (is_stream(path)) return open_stream(path);
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) throw missing_file(path, driver_names);
  make_strict();
  if (lower_extension(path) == ".vrt") check_vrt(path, nesting);
  const CPLStringList allowed = allowed_for(path);
  const GdalErrors errors;
  Dataset dataset =
      open_to_read(path, path, GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR, allowed.List(), errors);
  if (dataset) return dataset;
  if (const std::string archive = archive_kind(path); !archive.empty())
    throw Error(ErrorKind::input, path, "is " + archive, unpack_advice);
  if (lower_extension(path) == ".hgt")
    throw Error(
        ErrorKind::input, path,
        errors.say("its name does not give the position of the tile, or the file is truncated"),
        "the name of the tile's south-west corner, such as N47E011.hgt");
  // Identification reads only the first bytes and opens nothing else.
  GDALDriverH looks_like = nullptr;
  {
    const GdalErrors quiet;
    looks_like = GDALIdentifyDriverEx(path.c_str(), GDAL_OF_RASTER, nullptr, nullptr);
  }
  const std::string format = looks_like != nullptr ? GDALGetDriverShortName(looks_like) : "";
  if (!format.empty() && allowed.FindString(format.c_str()) < 0) {
    throw Error(ErrorKind::input, path,
                fmt::format("{} files with this name are not allowed", format),
                advice_to_convert(path, format));
  }
  if (format == "XYZ")
    throw Error(ErrorKind::input, path, errors.say("is not a regular grid of x, y, z"),
                fmt::format("all points of a grid, row by row; scattered points are gridded by "
                            "`gdal_grid -zfield z -oo X_POSSIBLE_NAMES=x -oo Y_POSSIBLE_NAMES=y "
                            "{} heights.tif`, with a first line x,y,z",
                            fs::path(path).filename().string()));
  throw Error(ErrorKind::input, path, errors.say("not a readable raster"), driver_names);
}

// One of several rasters of a file.
struct Part {
  std::string name;     // as the user writes it; the number of a page of a TIFF
  std::string address;  // GDAL's: "NETCDF:"dem.nc":elevation", "GTIFF_DIR:2:dem.tif"
};
constexpr std::string_view page_address = "GTIFF_DIR:";

std::vector<Part> parts_of(GDALDatasetH file) {
  const CPLStringList items(GDALGetMetadata(file, "SUBDATASETS"), FALSE);
  std::vector<Part> parts;
  for (int i = 0; i < items.Count(); ++i) {
    const std::string_view item = items[i];
    const std::size_t equals = item.find('=');
    if (equals == std::string_view::npos || !item.substr(0, equals).ends_with("_NAME")) continue;
    const std::string_view address = item.substr(equals + 1);
    const std::string_view name = address.starts_with(page_address)
                                      ? address.substr(page_address.size())
                                      : address.substr(address.rfind(':') + 1);
    parts.push_back({std::string(name.substr(0, name.find(':'))), std::string(address)});
  }
  return parts;
}

std::string names_of(const std::vector<Part>& parts) {
  std::vector<std::string> names;
  for (const Part& part : parts) names.push_back(part.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

Dataset open_part(const Part& part, const std::string& path, const Dataset& file) {
  CPLStringList allowed;
  for (const char* driver : drivers) allowed.AddString(driver);
  const GdalErrors errors;
  Dataset dataset = open_to_read(part.address, path, GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR,
                                 allowed.List(), errors, nullptr, file);
  if (dataset && GDALGetRasterCount(dataset.get()) != 0) return dataset;
  throw Error(ErrorKind::input, path,
              errors.say(fmt::format("\"{}\" is not a readable raster", part.name)));
}

// Pages of a TIFF are one raster in several sizes, or several rasters: the largest, if it is one.
Dataset open_largest_page(const std::vector<Part>& pages, const std::string& path,
                          const Dataset& file) {
  Dataset largest;
  std::vector<std::string> names;
  double cells = 0.0;
  std::string size;
  for (const Part& page : pages) {
    Dataset opened = open_part(page, path, file);
    const int width = GDALGetRasterXSize(opened.get());
    const int height = GDALGetRasterYSize(opened.get());
    const double its = static_cast<double>(width) * height;
    if (its < cells) continue;
    if (its > cells) names.clear();
    names.push_back(page.name);
    cells = its;
    size = fmt::format("{} × {}", width, height);
    largest = std::move(opened);
  }
  if (names.size() == 1) return largest;
  throw Error(ErrorKind::input, path,
              fmt::format("has several pages, and {} are of the largest size, {} cells: {}",
                          names.size(), size, fmt::join(names, ", ")),
              fmt::format("the number of one of them: `variable = \"{}\"`", names.front()));
}

}  // namespace

Dataset open_raster(const RasterSource& source) {
  Dataset file = open_checked(source.path, 0);
  const std::vector<Part> parts = parts_of(file.get());
  if (source.variable.empty()) {
    if (!parts.empty() && parts.front().address.starts_with(page_address))
      return open_largest_page(parts, source.path, file);
    if (GDALGetRasterCount(file.get()) != 0) return file;
    if (parts.empty()) throw Error(ErrorKind::input, source.path, "contains no raster");
    throw Error(ErrorKind::input, source.path,
                fmt::format("contains {} rasters: {}", parts.size(), names_of(parts)),
                fmt::format("the name of one of them: `variable = \"{}\"`", parts[0].name));
  }
  for (const Part& part : parts)
    if (part.name == source.variable) return open_part(part, source.path, file);
  // A netCDF file with one variable is opened as that variable; only the band has its name.
  GDALRasterBandH band = GDALGetRasterBand(file.get(), 1);
  const char* own = GDALGetMetadataItem(band, "NETCDF_VARNAME", nullptr);
  if (own != nullptr && own == source.variable) return file;
  throw Error(ErrorKind::input, source.path,
              fmt::format("has no raster named \"{}\"", source.variable),
              !parts.empty()   ? names_of(parts)
              : own != nullptr ? std::string(own)
                               : "its only raster, without `variable`");
}

namespace {

void gather_parts(const std::string& path, int nesting, std::set<std::string>& parts) {
  if (!parts.insert(path).second || is_address(path)) return;
  const Dataset dataset = open_checked(path, nesting);
  const GdalErrors errors;
  for (std::string& change : database_changes(path)) parts.insert(std::move(change));
  const auto& copy = dataset.get_deleter().copy;
  const CPLStringList files(GDALGetFileList(dataset.get()));
  for (int i = 0; i < files.Count(); ++i) {
    if (copy != nullptr && std::string_view(files[i]).starts_with(copy->path())) continue;
    const std::string address = address_from_gdal(files[i]);
    const std::string part = address.empty() ? files[i] : address;
    // Sources of a VRT are files of their own; x.vrt.ovr and the like belong to it.
    if (lower_extension(path) == ".vrt" && !part.starts_with(path) && !parts.contains(part))
      gather_parts(part, nesting + 1, parts);
    else
      parts.insert(part);
  }
}

}  // namespace

std::vector<std::string> raster_parts(const std::string& path) {
  std::set<std::string> parts;
  gather_parts(path, 0, parts);
  parts.erase(path);
  std::vector<std::string> all = {path};
  all.insert(all.end(), parts.begin(), parts.end());
  return all;
}

}  // namespace belvedere
