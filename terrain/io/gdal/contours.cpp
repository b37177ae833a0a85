#include <cpl_string.h>
#include <fmt/core.h>
#include <gdal.h>
#include <gdal_alg.h>
#include <ogr_api.h>
#include <ogr_spatialref.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <new>
#include <vector>

#include "base/error.h"
#include "base/files/output_file.h"
#include "base/grid.h"
#include "base/memory_limit.h"
#include "base/text/missing_file.h"
#include "base/text/text_encoding.h"
#include "terrain/io/gdal/gdal_files.h"
#include "terrain/io/raster_file.h"
#include "terrain/io/raster_io.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;

constexpr float void_m = -32768.F;  // GDAL skips it
const char* const altitude_field = "altitude_m";

const char* driver_for(const fs::path& path) {
  const std::string extension = lower_extension(path.string());
  if (extension == ".gpkg") return "GPKG";
  if (extension == ".geojson" || extension == ".json") return "GeoJSON";
  if (extension == ".shp") return "ESRI Shapefile";
  throw Error(ErrorKind::output, path.string(), "unknown file extension",
              ".gpkg, .geojson or .shp");
}

// Number of lines and their length, of a written layer.
ContourSummary measure(OGRLayerH layer) {
  ContourSummary summary;
  OGR_L_ResetReading(layer);
  while (OGRFeatureH feature = OGR_L_GetNextFeature(layer)) {
    if (OGRGeometryH line = OGR_F_GetGeometryRef(feature)) summary.length += OGR_G_Length(line);
    ++summary.lines;
    OGR_F_Destroy(feature);
  }
  return summary;
}

ContourSummary write_lines(const std::string& path, const char* driver, const Raster<float>& raster,
                           const ContourParameters& parameters) {
  const GdalErrors errors;
  const auto check = [&](bool good) {
    if (!good || errors.failed())
      throw Error(ErrorKind::output, path, errors.say("cannot write the file"));
  };
  OGRSpatialReference crs;
  if (!raster.crs.empty()) check(crs.SetFromUserInput(raster.crs.c_str()) == OGRERR_NONE);

  Grid<float> cells = raster.cells;
  for (float& z : cells)
    if (!std::isfinite(z)) z = void_m;
  const Dataset memory(GDALCreate(GDALGetDriverByName("MEM"), "", cells.width(), cells.height(), 0,
                                  GDT_Float32, nullptr));
  check(memory != nullptr);
  char pointer[64] = {};
  pointer[CPLPrintPointer(pointer, cells.data(), sizeof pointer - 1)] = 0;
  CPLStringList band_options;
  band_options.SetNameValue("DATAPOINTER", pointer);
  check(GDALAddBand(memory.get(), GDT_Float32, band_options.List()) == CE_None);
  const GeoTransform& t = raster.transform;
  double affine[6] = {t.origin_x, t.cell_x, 0.0, t.origin_y, 0.0, -t.cell_y};
  check(GDALSetGeoTransform(memory.get(), affine) == CE_None);

  Dataset file(
      GDALCreate(GDALGetDriverByName(driver), path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  check(file != nullptr);
  OGRLayerH layer = GDALDatasetCreateLayer(
      file.get(), "contours", raster.crs.empty() ? nullptr : &crs, wkbLineString, nullptr);
  check(layer != nullptr);
  for (const auto& [name, type] :
       {std::pair{"id", OFTInteger}, std::pair{altitude_field, OFTReal}}) {
    const std::unique_ptr<void, void (*)(OGRFieldDefnH)> field(OGR_Fld_Create(name, type),
                                                               &OGR_Fld_Destroy);
    check(OGR_L_CreateField(layer, field.get(), TRUE) == OGRERR_NONE);
  }
  CPLStringList options;
  options.SetNameValue("LEVEL_INTERVAL", fmt::format("{}", parameters.interval_m).c_str());
  options.SetNameValue("LEVEL_BASE", fmt::format("{}", parameters.base_m).c_str());
  options.SetNameValue("NODATA", fmt::format("{}", void_m).c_str());
  options.SetNameValue("ID_FIELD", "0");
  options.SetNameValue("ELEV_FIELD", "1");
  // One transaction; otherwise a database file would be synced to disk line by line.
  const bool transaction = GDALDatasetTestCapability(file.get(), ODsCTransactions) != 0;
  if (transaction) check(GDALDatasetStartTransaction(file.get(), FALSE) == OGRERR_NONE);
  check(GDALContourGenerateEx(GDALGetRasterBand(memory.get(), 1), layer, options.List(), nullptr,
                              nullptr) == CE_None);
  if (transaction) check(GDALDatasetCommitTransaction(file.get()) == OGRERR_NONE);
  file.reset();
  check(true);

  // Reads the written file back.
  file.reset(
      GDALOpenEx(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, nullptr, nullptr));
  check(file != nullptr && GDALDatasetGetLayerCount(file.get()) == 1);
  const ContourSummary summary = measure(GDALDatasetGetLayer(file.get(), 0));
  check(true);
  return summary;
}

}  // namespace

std::vector<std::string> contour_files(const std::string& path) {
  if (lower_extension(path) != ".shp") return {path};
  std::vector<std::string> out;
  for (const char* extension : {".shp", ".shx", ".dbf", ".prj", ".cpg"})
    out.push_back(fs::path(path).replace_extension(extension).string());
  return out;
}

ContourSummary write_contours(const std::string& path, const Raster<float>& raster,
                              const ContourParameters& parameters) {
  if (!(parameters.interval_m > 0.0) || !std::isfinite(parameters.interval_m)) {
    throw Error(ErrorKind::usage, "contour interval", fmt::format("{}", parameters.interval_m),
                "metres, more than 0");
  }
  const fs::path target(path);
  const char* driver = driver_for(target);
  if (raster.cells.empty()) throw Error(ErrorKind::output, path, "no cells to write");
  register_gdal();
  // A shapefile is several files: all are made in a folder of their own, then moved.
  std::string folder = (target.parent_path() / ".belvedere-XXXXXX").string();
  try {
    if (::mkdtemp(folder.data()) == nullptr)
      throw Error(ErrorKind::output, path, "cannot create a folder beside it");
    const ContourSummary summary =
        write_lines((fs::path(folder) / target.filename()).string(), driver, raster, parameters);
    std::vector<std::unique_ptr<OutputFile>> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
      files.push_back(
          std::make_unique<OutputFile>((target.parent_path() / entry.path().filename()).string()));
      fs::rename(entry.path(), files.back()->temporary());
    }
    for (const auto& file : files) file->prepare();
    for (const auto& file : files) file->commit();
    fs::remove_all(folder);
    return summary;
  } catch (const std::exception& exception) {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    if (dynamic_cast<const std::bad_alloc*>(&exception) != nullptr) throw;
    const auto* error = dynamic_cast<const Error*>(&exception);
    throw Error(ErrorKind::output, path, error != nullptr ? error->found() : exception.what(),
                error != nullptr ? error->allowed() : "");
  }
}

namespace {

using Group = std::unique_ptr<GDALGroupHS, decltype(&GDALGroupRelease)>;
using Array = std::unique_ptr<GDALMDArrayHS, decltype(&GDALMDArrayRelease)>;
using NumberType = std::unique_ptr<GDALExtendedDataTypeHS, decltype(&GDALExtendedDataTypeRelease)>;

void read_shape(GDALMDArrayH array, NumberArray& out) {
  std::size_t count = 0;
  GDALDimensionH* dimensions = GDALMDArrayGetDimensions(array, &count);
  for (std::size_t i = 0; i < count; ++i) {
    out.dimensions.emplace_back(GDALDimensionGetName(dimensions[i]));
    out.sizes.push_back(static_cast<std::size_t>(GDALDimensionGetSize(dimensions[i])));
  }
  GDALReleaseDimensions(dimensions, count);
}

NumberArray read_array(GDALMDArrayH array, const std::string& path, const std::string& name) {
  NumberArray out;
  out.name = name;
  read_shape(array, out);
  const char* unit = GDALMDArrayGetUnit(array);
  out.unit = unit != nullptr ? unit : "";
  double cells = 1.0;
  for (const std::size_t size : out.sizes) cells *= static_cast<double>(size);
  check_memory(fmt::format("{}, {}", path, name), cells * sizeof(double));
  out.values.resize(static_cast<std::size_t>(cells));
  if (out.values.empty()) return out;
  const GdalErrors errors;
  const NumberType number(GDALExtendedDataTypeCreate(GDT_Float64), &GDALExtendedDataTypeRelease);
  const std::vector<GUInt64> start(out.sizes.size(), 0);
  if (GDALMDArrayRead(array, start.data(), out.sizes.data(), nullptr, nullptr, number.get(),
                      out.values.data(), out.values.data(),
                      out.values.size() * sizeof(double)) == 0)
    throw Error(ErrorKind::input, path, errors.say(fmt::format("cannot read {}", name)));
  int has = 0;
  const double nodata = GDALMDArrayGetNoDataValueAsDouble(array, &has);
  if (has != 0)
    for (double& value : out.values)
      if (value == nodata) value = std::numeric_limits<double>::quiet_NaN();
  int has_scale = 0;
  int has_offset = 0;
  const double scale = GDALMDArrayGetScale(array, &has_scale);
  const double offset = GDALMDArrayGetOffset(array, &has_offset);
  if (has_scale != 0 || has_offset != 0)
    for (double& value : out.values)
      value = value * (has_scale != 0 ? scale : 1.0) + (has_offset != 0 ? offset : 0.0);
  return out;
}

}  // namespace

std::vector<std::optional<NumberArray>> read_number_arrays(const std::string& path,
                                                           const std::vector<std::string>& names) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) throw missing_file(path, "a netCDF file");
  const GdalErrors errors;
  // Only the intended driver: a harmless-looking file must not make GDAL open others.
  const char* const allowed[] = {"netCDF", nullptr};
  const Dataset file =
      open_to_read(path, path, GDAL_OF_MULTIDIM_RASTER | GDAL_OF_VERBOSE_ERROR, allowed, errors);
  if (!file) throw Error(ErrorKind::input, path, errors.say("not a netCDF file"));
  const Group root(GDALDatasetGetRootGroup(file.get()), &GDALGroupRelease);
  if (!root) throw Error(ErrorKind::input, path, errors.say("has no arrays"));
  std::vector<std::optional<NumberArray>> arrays;
  for (const std::string& name : names) {
    const GdalErrors quiet;
    const Array array(GDALGroupOpenMDArray(root.get(), name.c_str(), nullptr), &GDALMDArrayRelease);
    arrays.push_back(array ? std::optional(read_array(array.get(), path, name)) : std::nullopt);
  }
  return arrays;
}

}  // namespace belvedere
