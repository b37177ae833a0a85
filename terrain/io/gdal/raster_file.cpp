#include "terrain/io/raster_file.h"

#include <cpl_conv.h>
#include <cpl_minixml.h>
#include <cpl_string.h>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <string_view>

#include "base/error.h"
#include "base/memory_limit.h"
#include "base/text/archive_kind.h"
#include "base/text/letters.h"
#include "terrain/io/crs.h"
#include "terrain/io/gdal/gdal_files.h"
#include "terrain/io/http_access.h"
#include "terrain/io/raster_parts.h"
#include "terrain/io/stream_file.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

// Formats that describe one raster and nothing else. A VRT can refer to any file or address, so it
// is only accepted with the extension .vrt, and each of its sources is first checked by the same
// rules.
constexpr const char* drivers[] = {"GTiff", "AAIGrid", "SRTMHGT", "HFA",  "ENVI", "EHdr",  "netCDF",
                                   "PNG",   "USGSDEM", "DTED",    "GSAG", "GSBG", "GS7BG", "GPKG"};
constexpr const char* driver_names =
    "GeoTIFF, ESRI ASCII grid, SRTM .hgt, Erdas Imagine, ENVI, EHdr .bil, netCDF, PNG, USGS DEM, "
    "DTED, Surfer grid, GeoPackage, or VRT named .vrt";

// Settings of this thread that make reads strict: damaged blocks and short raw files are errors; no
// threads of its own.
void make_strict() {
  register_gdal();
  CPLSetThreadLocalConfigOption("GTIFF_IGNORE_READ_ERRORS", "NO");
  CPLSetThreadLocalConfigOption("RAW_CHECK_FILE_SIZE", "YES");
  CPLSetThreadLocalConfigOption("GDAL_NUM_THREADS", "1");
  CPLSetThreadLocalConfigOption("GDAL_VRT_ENABLE_PYTHON", "NO");
  CPLSetThreadLocalConfigOption("GDAL_NETCDF_VERIFY_DIMS", "STRICT");
  set_http_of_thread();
}

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
        open_checked(!address.empty() ? address
                     : beside         ? (fs::path(path).parent_path() / file).string()
                                      : file.string(),
                     nesting + 1);
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
  Dataset dataset(GDALOpenEx(address_to_gdal(address).c_str(),
                             GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                             allowed.List(), nullptr, nullptr));
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
  Dataset dataset(GDALOpenEx(path.c_str(),
                             GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                             allowed.List(), nullptr, nullptr));
  if (!dataset) throw Error(ErrorKind::input, path, errors.say("not a readable raster"), "GeoTIFF");
  return dataset;
}

Dataset open_checked(const std::string& path, int nesting) {
  if (is_address(path)) return open_address(path);
  if (is_stream(path)) return open_stream(path);
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored))
    throw Error(ErrorKind::input, path, "file not found", driver_names);
  make_strict();
  const bool vrt = lower_extension(path) == ".vrt";
  if (vrt) check_vrt(path, nesting);
  CPLStringList allowed;
  for (const char* driver : drivers) allowed.AddString(driver);
  if (vrt) allowed.AddString("VRT");
  const GdalErrors errors;
  Dataset dataset(GDALOpenEx(path.c_str(),
                             GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                             allowed.List(), nullptr, nullptr));
  if (dataset) return dataset;
  if (const std::string archive = archive_kind(path); !archive.empty())
    throw Error(ErrorKind::input, path, "is " + archive, unpack_advice);
  if (lower_extension(path) == ".hgt")
    throw Error(ErrorKind::input, path,
                errors.say("an .hgt file says its position by its name alone, and this is no such "
                           "name, or the file is not whole"),
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
                fmt::format("{} files with this name are not allowed", format), driver_names);
  }
  throw Error(ErrorKind::input, path, errors.say("not a readable raster"), driver_names);
}

// A file of several rasters (netCDF, GeoPackage; GDAL's subdatasets) is refused with their names.
void refuse_several(GDALDatasetH file, const std::string& path) {
  if (GDALGetRasterCount(file) != 0) return;
  const CPLStringList parts(GDALGetMetadata(file, "SUBDATASETS"), FALSE);
  std::vector<std::string> names;
  for (int i = 0; i < parts.Count(); ++i) {
    const std::string_view part = parts[i];
    const std::size_t equals = part.find('=');
    if (equals == std::string_view::npos || !part.substr(0, equals).ends_with("_NAME")) continue;
    names.emplace_back(part.substr(part.rfind(':') + 1));
  }
  if (names.empty()) throw Error(ErrorKind::input, path, "contains no raster");
  throw Error(ErrorKind::input, path,
              fmt::format("contains {} rasters: {}", names.size(), fmt::join(names, ", ")),
              "a file with one raster; extract the one with heights, as with gdal_translate");
}

// Metres per unit by a unit's name; 0 if unknown.
double metres_per_unit(std::string_view unit) {
  const std::string name = lower_case(std::string(unit));
  const auto is = [&name](std::initializer_list<const char*> words) {
    return std::any_of(words.begin(), words.end(),
                       [&name](const char* word) { return name == word; });
  };
  if (is({"", "m", "metre", "metres", "meter", "meters", "mtr"})) return 1.0;
  if (is({"ft", "foot", "feet", "international foot", "foot_intl"})) return 0.3048;
  if (is({"us-ft", "ftus", "us survey foot", "us survey feet", "foot_us", "us_survey_foot",
          "us foot", "survey foot"}))
    return 1200.0 / 3937.0;
  if (is({"cm", "centimetre", "centimeter", "centimetres", "centimeters"})) return 0.01;
  if (is({"dm", "decimetre", "decimeter", "decimetres", "decimeters"})) return 0.1;
  if (is({"km", "kilometre", "kilometer"})) return 1000.0;
  return 0.0;
}

}  // namespace

struct RasterFile::State {
  RasterSource source;
  Dataset dataset;
  GDALRasterBandH band = nullptr;
  int width = 0;
  int height = 0;
  CellAffine affine;
  std::string crs;
  std::optional<double> nodata;
  double scale = 1.0;  // of the band's numbers to its unit
  double offset = 0.0;
  double vertical_unit_m = 1.0;  // from the file's vertical CRS
  bool has_vertical_crs = false;
  mutable std::set<float> undeclared;  // values without a height that were found

  void find_position();
  void find_crs();
  void check_window(const CellWindow& window) const;
  template <class T>
  // In columns × rows cells, if these are fewer than the window's.
  Grid<T> read(GDALRasterBandH from, const CellWindow& window, GDALDataType type, int columns,
               int rows) const;
  double unit_to_m() const;
  bool is_void(float raw) const;
  // 0 where the file's own mask hides a cell; empty if it has none besides nodata.
  Grid<std::uint8_t> read_mask(const CellWindow& window, int columns, int rows) const;
};

void RasterFile::State::find_position() {
  double t[6] = {};
  const GdalErrors errors;
  if (GDALGetGeoTransform(dataset.get(), t) != CE_None) {
    const bool points = GDALGetGCPCount(dataset.get()) > 0;
    throw Error(ErrorKind::input, source.path,
                points ? "has only control points" : "has no georeference",
                "a georeferenced raster (rectified, or with a world file next to it)");
  }
  affine = {t[0], t[1], t[2], t[3], t[4], t[5]};
  const double area = std::abs(affine.determinant());
  if (!(area > 1e-18) || !std::isfinite(area) || !std::isfinite(t[0]) || !std::isfinite(t[3])) {
    throw Error(ErrorKind::input, source.path,
                "has an invalid georeference: cells without an area");
  }
}

void RasterFile::State::find_crs() {
  if (!source.crs.empty()) crs = normalize_crs(source.crs);
  const auto* own = static_cast<const OGRSpatialReference*>(GDALGetSpatialRef(dataset.get()));
  if (own == nullptr) return;
  has_vertical_crs = own->IsCompound() != 0;
  if (has_vertical_crs) vertical_unit_m = own->GetTargetLinearUnits("COMPD_CS|VERT_CS");
  if (!(vertical_unit_m > 0.0)) vertical_unit_m = 1.0;
  if (!crs.empty()) return;
  // A local system ("Unknown") gives no information.
  if (own->IsGeographic() == 0 && own->IsProjected() == 0) return;
  char* text = nullptr;
  const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
  const GdalErrors errors;
  own->exportToWkt(&text, options);
  const std::string wkt = text != nullptr ? text : "";
  CPLFree(text);
  try {
    crs = normalize_crs(wkt);
  } catch (const Error& error) {
    throw Error(ErrorKind::input, source.path,
                "has an unusable coordinate system: " + error.found(),
                "set the source's key `crs`");
  }
}

RasterFile::RasterFile(const RasterSource& source) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.source = source;
  s.dataset = open_checked(source.path, 0);
  refuse_several(s.dataset.get(), source.path);
  s.width = GDALGetRasterXSize(s.dataset.get());
  s.height = GDALGetRasterYSize(s.dataset.get());
  const int count = GDALGetRasterCount(s.dataset.get());
  if (source.band < 1 || source.band > count) {
    throw Error(ErrorKind::input, source.path, fmt::format("has no band {}", source.band),
                fmt::format("bands 1…{}", count));
  }
  s.band = GDALGetRasterBand(s.dataset.get(), source.band);
  if (GDALDataTypeIsComplex(GDALGetRasterDataType(s.band)) != 0)
    throw Error(ErrorKind::input, source.path, "contains complex numbers");
  s.find_position();
  s.find_crs();
  int found = 0;
  const double own_nodata = GDALGetRasterNoDataValue(s.band, &found);
  if (source.nodata)
    s.nodata = source.nodata;
  else if (found != 0)
    s.nodata = own_nodata;
  const double scale = GDALGetRasterScale(s.band, &found);
  if (found != 0 && std::isfinite(scale) && scale != 0.0) s.scale = scale;
  const double offset = GDALGetRasterOffset(s.band, &found);
  if (found != 0 && std::isfinite(offset)) s.offset = offset;
}

RasterFile::~RasterFile() = default;
RasterFile::RasterFile(RasterFile&&) noexcept = default;
RasterFile& RasterFile::operator=(RasterFile&&) noexcept = default;

const RasterSource& RasterFile::source() const { return state_->source; }
int RasterFile::width() const { return state_->width; }
int RasterFile::height() const { return state_->height; }
int RasterFile::bands() const { return GDALGetRasterCount(state_->dataset.get()); }
const CellAffine& RasterFile::affine() const { return state_->affine; }
const std::string& RasterFile::crs() const { return state_->crs; }
std::optional<double> RasterFile::nodata() const { return state_->nodata; }
std::vector<float> RasterFile::undeclared_voids() const {
  return {state_->undeclared.begin(), state_->undeclared.end()};
}

BandMeaning RasterFile::meaning() const {
  const State& s = *state_;
  const GDALColorInterp means = GDALGetRasterColorInterpretation(s.band);
  const bool byte = GDALGetRasterDataType(s.band) == GDT_Byte;
  BandMeaning out;
  out.palette = means == GCI_PaletteIndex || GDALGetRasterColorTable(s.band) != nullptr;
  out.colour = byte && bands() >= 3 &&
               (means == GCI_RedBand || means == GCI_GreenBand || means == GCI_BlueBand);
  out.bytes = byte && s.scale == 1.0 && s.offset == 0.0;
  out.name = lower_case(GDALGetColorInterpretationName(means));
  return out;
}

double RasterFile::undeclared_foot_m() const {
  const State& s = *state_;
  if (s.source.unit_to_m != 0.0 || s.has_vertical_crs || s.crs.empty() ||
      *GDALGetRasterUnitType(s.band) != '\0')
    return 0.0;
  OGRSpatialReference map;
  const GdalErrors errors;
  if (map.SetFromUserInput(s.crs.c_str()) != OGRERR_NONE || map.IsProjected() == 0) return 0.0;
  const double unit = map.GetLinearUnits();
  return std::abs(unit - 0.3048) < 1e-4 ? (std::abs(unit - 0.3048) < 1e-9 ? 0.3048 : unit) : 0.0;
}

std::string RasterFile::driver() const {
  return GDALGetDriverShortName(GDALGetDatasetDriver(state_->dataset.get()));
}

const std::string& RasterFile::required_crs() const {
  if (!state_->crs.empty()) return state_->crs;
  throw Error(ErrorKind::input, state_->source.path, "has no coordinate system",
              "set the source's key `crs`, such as crs = \"EPSG:32632\"");
}

void RasterFile::State::check_window(const CellWindow& window) const {
  const bool inside = window.x0 >= 0 && window.y0 >= 0 && window.width > 0 && window.height > 0 &&
                      window.x0 <= width - window.width && window.y0 <= height - window.height;
  if (!inside) throw Error(ErrorKind::bug, source.path, "the window is outside the raster");
}

template <class T>
Grid<T> RasterFile::State::read(GDALRasterBandH from, const CellWindow& window, GDALDataType type,
                                int columns, int rows) const {
  check_window(window);
  check_memory(source.path, static_cast<double>(columns) * rows * sizeof(T));
  Grid<T> cells(columns, rows);
  make_strict();
  const GdalErrors errors;
  const CPLErr result = GDALRasterIO(from, GF_Read, window.x0, window.y0, window.width,
                                     window.height, cells.data(), columns, rows, type, 0, 0);
  // Some drivers report a failure and still return success.
  if (result != CE_None || errors.failed()) {
    const bool remote = is_address(source.path);
    throw Error(ErrorKind::input, source.path,
                explain_http(errors.say(remote ? "cannot read the whole file from its server"
                                               : "the file is damaged or truncated")));
  }
  return cells;
}

double RasterFile::State::unit_to_m() const {
  if (source.unit_to_m != 0.0) {
    if (source.unit_to_m > 0.0 && std::isfinite(source.unit_to_m)) return source.unit_to_m;
    throw Error(ErrorKind::usage, source.path, fmt::format("{} metres per unit", source.unit_to_m),
                "more than 0");
  }
  const std::string unit = GDALGetRasterUnitType(band);
  if (unit.empty()) return vertical_unit_m;
  const double metres = metres_per_unit(unit);
  if (metres > 0.0) return metres;
  throw Error(ErrorKind::input, source.path, fmt::format("the unit of its values is \"{}\"", unit),
              "a unit of length; set the source's key `unit`");
}

bool RasterFile::State::is_void(float raw) const {
  if (!std::isfinite(raw) || std::abs(raw) >= 1e30F) return true;
  // Compared as floats: a declared -3.4028234663852886e38 or -9999.9 was also rounded in the cells.
  if (nodata && raw == static_cast<float>(*nodata)) return true;
  if (raw == -32768.0F || (!nodata && raw == -9999.0F)) return true;
  // Numbers that programs write for an unknown height, and that no ground has.
  constexpr float known[] = {-32767.0F, 32767.0F, 65535.0F, -99999.0F, -999999.0F, 99999.0F};
  const bool is_known = std::find(std::begin(known), std::end(known), raw) != std::end(known);
  if (!is_known || (nodata && std::abs(raw) < 65535.0F)) return false;
  undeclared.insert(raw);
  return true;
}

Grid<std::uint8_t> RasterFile::State::read_mask(const CellWindow& window, int columns,
                                                int rows) const {
  const int flags = GDALGetMaskFlags(band);
  if ((flags & (GMF_ALL_VALID | GMF_NODATA)) != 0) return {};
  return read<std::uint8_t>(GDALGetMaskBand(band), window, GDT_Byte, columns, rows);
}

Grid<float> RasterFile::read_values(const CellWindow& window) const {
  return read_values(window, window.width, window.height);
}

Grid<float> RasterFile::read_values(const CellWindow& window, int width, int height) const {
  const State& s = *state_;
  const double unit = s.unit_to_m();
  Grid<float> values = s.read<float>(s.band, window, GDT_Float32, width, height);
  const Grid<std::uint8_t> mask = s.read_mask(window, width, height);
  const double gain = s.scale * unit;
  const double shift = s.offset * unit;
  const bool plain = gain == 1.0 && shift == 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    float& value = values[i];
    if (s.is_void(value) || (!mask.empty() && mask[i] == 0))
      value = nan_value;
    else if (!plain)
      value = static_cast<float>(value * gain + shift);
    if ((s.source.lowest_m && value < *s.source.lowest_m) ||
        (s.source.highest_m && value > *s.source.highest_m))
      value = nan_value;
  }
  return values;
}

Grid<std::int32_t> RasterFile::read_codes(const CellWindow& window) const {
  const State& s = *state_;
  const Grid<float> raw = s.read<float>(s.band, window, GDT_Float32, window.width, window.height);
  Grid<std::int32_t> codes =
      s.read<std::int32_t>(s.band, window, GDT_Int32, window.width, window.height);
  const Grid<std::uint8_t> mask = s.read_mask(window, window.width, window.height);
  for (std::size_t i = 0; i < codes.size(); ++i)
    if (s.is_void(raw[i]) || (!mask.empty() && mask[i] == 0) || codes[i] < 0) codes[i] = -1;
  return codes;
}

namespace {

void gather_parts(const std::string& path, int nesting, std::set<std::string>& parts) {
  if (!parts.insert(path).second || is_address(path)) return;
  const Dataset dataset = open_checked(path, nesting);
  const GdalErrors errors;
  const CPLStringList files(GDALGetFileList(dataset.get()));
  for (int i = 0; i < files.Count(); ++i) {
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

std::uint64_t raster_cache_bytes() {
  register_gdal();
  return static_cast<std::uint64_t>(GDALGetCacheMax64());
}

}  // namespace belvedere
