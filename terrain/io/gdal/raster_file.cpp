#include "terrain/io/raster_file.h"

#include <cpl_conv.h>
#include <fmt/core.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <type_traits>
#include <utility>

#include "base/error.h"
#include "base/memory_limit.h"
#include "base/text/text_encoding.h"
#include "terrain/io/crs.h"
#include "terrain/io/gdal/gdal_files.h"
#include "terrain/io/gdal/raster_open.h"
#include "terrain/io/http_access.h"

namespace belvedere {
namespace {

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

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

// The number that a value outside the range of the cells becomes when it is stored in them, one
// range higher or lower: -9999 becomes 55537 in 16 bits without a sign.
std::optional<double> wrapped_value(GDALDataType type, bool with_sign, double value) {
  if (GDALDataTypeIsInteger(type) == 0) return {};
  const double range = std::ldexp(1.0, GDALGetDataTypeSizeBits(type));
  const double lowest = with_sign ? -range / 2.0 : 0.0;
  const double end = lowest + range;
  const double stored = value < lowest ? value + range : value >= end ? value - range : value;
  if (stored == value || stored < lowest || stored >= end) return {};
  return stored;
}

}  // namespace

struct RasterFile::State {
  RasterSource source;
  Dataset dataset;
  GDALRasterBandH band = nullptr;
  std::optional<HeightEncoding> encoding;
  std::array<GDALRasterBandH, 3> colours{};  // with an encoding: red, green, blue
  int width = 0;
  int height = 0;
  CellAffine affine;
  std::string crs;
  std::optional<double> nodata;
  std::optional<double> wrapped_nodata;  // as the cells have it, if their type has no such number
  bool signed_bytes = false;             // GDAL reads them as 0…255
  double scale = 1.0;                    // of the band's numbers to its unit
  double offset = 0.0;
  double vertical_unit_m = 1.0;  // from the file's vertical CRS
  bool has_vertical_crs = false;
  mutable std::set<float> undeclared;  // values without a height that were found
  // Dropped cells by row and column: windows overlap, and each cell counts once.
  mutable std::map<std::pair<int, int>, float> spikes;

  void find_position();
  void find_crs();
  void find_encoding();
  void find_numbers();
  void check_window(const CellWindow& window) const;
  template <class T>
  // In columns × rows cells, if these are fewer than the window's.
  Grid<T> read(GDALRasterBandH from, const CellWindow& window, GDALDataType type, int columns,
               int rows) const;
  // Heights that colours encode, in columns × rows cells, each one of those under it.
  Grid<float> read_decoded(const CellWindow& window, int columns, int rows) const;
  double unit_to_m() const;
  bool is_void(float raw) const;
  Grid<float> read_heights(const CellWindow& window, int columns, int rows) const;
  Grid<float> without_spikes(const CellWindow& window) const;
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

// Reads nodata value, scale and offset of a band of numbers.
void RasterFile::State::find_numbers() {
  int found = 0;
  const double own_nodata = GDALGetRasterNoDataValue(band, &found);
  if (source.nodata)
    nodata = source.nodata;
  else if (found != 0)
    nodata = own_nodata;
  const GDALDataType type = GDALGetRasterDataType(band);
  const char* pixels = GDALGetMetadataItem(band, "PIXELTYPE", "IMAGE_STRUCTURE");
  signed_bytes = type == GDT_Byte && pixels != nullptr && std::string_view(pixels) == "SIGNEDBYTE";
  if (nodata)
    wrapped_nodata = wrapped_value(type, signed_bytes || GDALDataTypeIsSigned(type) != 0, *nodata);
  const double own_scale = GDALGetRasterScale(band, &found);
  if (found != 0 && std::isfinite(own_scale) && own_scale != 0.0) scale = own_scale;
  const double own_offset = GDALGetRasterOffset(band, &found);
  if (found != 0 && std::isfinite(own_offset)) offset = own_offset;
}

void RasterFile::State::find_encoding() {
  encoding = height_encoding(source.encoding);
  if (!encoding)
    throw Error(ErrorKind::usage, source.path, fmt::format("encoding \"{}\"", source.encoding),
                "\"terrarium\" or \"mapbox\"");
  const char* compression = GDALGetMetadataItem(dataset.get(), "COMPRESSION", "IMAGE_STRUCTURE");
  if (compression != nullptr &&
      std::string_view(compression).find("JPEG") != std::string_view::npos)
    throw Error(ErrorKind::input, source.path,
                "its colours are compressed with losses (JPEG), which change heights by hundreds "
                "of metres",
                "the tiles as they were served, or a lossless copy of them");
  for (int i = 0; i < 3; ++i) {
    colours[static_cast<std::size_t>(i)] = source.band + i <= GDALGetRasterCount(dataset.get())
                                               ? GDALGetRasterBand(dataset.get(), source.band + i)
                                               : nullptr;
    GDALRasterBandH colour = colours[static_cast<std::size_t>(i)];
    if (colour == nullptr || GDALGetRasterDataType(colour) != GDT_Byte ||
        GDALGetRasterColorTable(colour) != nullptr)
      throw Error(ErrorKind::input, source.path,
                  fmt::format("does not encode heights as {} does", source.encoding),
                  "three bands of 8 bits: red, green and blue; no palette (gdal_translate -expand "
                  "rgb)");
  }
  nodata = source.nodata;
}

RasterFile::RasterFile(const RasterSource& source) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.source = source;
  const GdalErrors quiet;  // GDAL reads some tags only when it is asked for them
  s.dataset = open_raster(source);
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
  source.encoding.empty() ? s.find_numbers() : s.find_encoding();
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
std::optional<double> RasterFile::wrapped_nodata() const { return state_->wrapped_nodata; }
std::vector<float> RasterFile::undeclared_voids() const {
  return {state_->undeclared.begin(), state_->undeclared.end()};
}

BandMeaning RasterFile::meaning() const {
  const State& s = *state_;
  const GDALColorInterp means = GDALGetRasterColorInterpretation(s.band);
  const bool byte = GDALGetRasterDataType(s.band) == GDT_Byte;
  BandMeaning out;
  if (s.encoding) return out;
  out.palette = means == GCI_PaletteIndex || GDALGetRasterColorTable(s.band) != nullptr;
  out.colour = byte && bands() >= 3 &&
               (means == GCI_RedBand || means == GCI_GreenBand || means == GCI_BlueBand);
  out.bytes = byte && !s.signed_bytes && s.scale == 1.0 && s.offset == 0.0;
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
  if constexpr (std::is_signed_v<T>)
    if (signed_bytes && from == band)
      for (T& cell : cells)
        if (cell > T{127}) cell -= T{256};
  return cells;
}

Grid<float> RasterFile::State::read_decoded(const CellWindow& window, int columns, int rows) const {
  check_memory(source.path, static_cast<double>(columns) * rows * sizeof(float));
  Grid<float> heights(columns, rows);
  // By rows of the file itself: overviews are means of colours, not of heights.
  const auto cell = [](int i, int of, int from) {
    return static_cast<int>((i + 0.5) * static_cast<double>(from) / of);
  };
  const bool whole = columns == window.width && rows == window.height;
  const int at_once = whole ? rows : 1;
  for (int y = 0; y < rows; y += at_once) {
    const CellWindow part{window.x0, window.y0 + cell(y, rows, window.height), window.width,
                          at_once};
    std::array<Grid<std::uint8_t>, 3> parts;
    for (std::size_t i = 0; i < 3; ++i)
      parts[i] = read<std::uint8_t>(colours[i], part, GDT_Byte, part.width, part.height);
    for (int v = 0; v < at_once; ++v)
      for (int x = 0; x < columns; ++x) {
        const int u = cell(x, columns, window.width);
        heights(x, y + v) = encoding->metres(parts[0](u, v), parts[1](u, v), parts[2](u, v));
      }
  }
  return heights;
}

double RasterFile::State::unit_to_m() const {
  if (encoding) return 1.0;
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
  if (wrapped_nodata && raw == static_cast<float>(*wrapped_nodata)) {
    undeclared.insert(raw);
    return true;
  }
  // Black, which tiles have where nothing is known.
  if (encoding && raw == encoding->metres(0, 0, 0)) return true;
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
  const GdalErrors quiet;
  const int flags = GDALGetMaskFlags(band);
  if ((flags & (GMF_ALL_VALID | GMF_NODATA)) != 0) return {};
  return read<std::uint8_t>(GDALGetMaskBand(band), window, GDT_Byte, columns, rows);
}

Grid<float> RasterFile::read_values(const CellWindow& window) const {
  return read_values(window, window.width, window.height);
}

Grid<float> RasterFile::read_values(const CellWindow& window, int width, int height) const {
  const State& s = *state_;
  const bool thinned = width != window.width || height != window.height;
  return s.source.max_spike_m > 0.0 && !thinned ? s.without_spikes(window)
                                                : s.read_heights(window, width, height);
}

Grid<float> RasterFile::State::read_heights(const CellWindow& window, int columns, int rows) const {
  const double unit = unit_to_m();
  Grid<float> values = encoding ? read_decoded(window, columns, rows)
                                : read<float>(band, window, GDT_Float32, columns, rows);
  const Grid<std::uint8_t> mask = read_mask(window, columns, rows);
  const double gain = scale * unit;
  const double shift = offset * unit;
  const bool plain = gain == 1.0 && shift == 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    float& value = values[i];
    if (is_void(value) || (!mask.empty() && mask[i] == 0))
      value = nan_value;
    else if (!plain)
      value = static_cast<float>(value * gain + shift);
    if ((source.lowest_m && value < *source.lowest_m) ||
        (source.highest_m && value > *source.highest_m))
      value = nan_value;
  }
  return values;
}

// Each cell is judged by the cells of the file around it, so that windows agree.
Grid<float> RasterFile::State::without_spikes(const CellWindow& window) const {
  check_window(window);
  CellWindow around{std::max(window.x0 - 1, 0), std::max(window.y0 - 1, 0), 0, 0};
  around.width = std::min(window.x0 + window.width + 1, width) - around.x0;
  around.height = std::min(window.y0 + window.height + 1, height) - around.y0;
  const Grid<float> read = read_heights(around, around.width, around.height);
  Grid<float> out(window.width, window.height);
  const auto limit = static_cast<float>(source.max_spike_m);
  const auto is_spike = [&](int x, int y) {
    if (x == 0 || y == 0 || x + 1 == read.width() || y + 1 == read.height()) return false;
    const float z = read(x, y);
    const float sign = z > read(x - 1, y) ? 1.F : -1.F;
    for (int v = -1; v <= 1; ++v)
      for (int u = -1; u <= 1; ++u)
        if ((u != 0 || v != 0) && !(sign * (z - read(x + u, y + v)) > limit)) return false;
    return true;
  };
  constexpr std::size_t max_counted = 10000;
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      const int u = x + window.x0 - around.x0;
      const int v = y + window.y0 - around.y0;
      out(x, y) = read(u, v);
      if (!is_spike(u, v)) continue;
      if (spikes.size() < max_counted)
        spikes.try_emplace({window.y0 + y, window.x0 + x}, out(x, y));
      out(x, y) = nan_value;
    }
  return out;
}

RasterFile::Spikes RasterFile::spikes() const {
  const auto& found = state_->spikes;
  if (found.empty()) return {};
  const auto& [place, height_m] = *found.begin();
  return {found.size(), found.size() >= 10000, place.second, place.first, height_m};
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

std::uint64_t raster_cache_bytes() {
  register_gdal();
  return static_cast<std::uint64_t>(GDALGetCacheMax64());
}

}  // namespace belvedere
