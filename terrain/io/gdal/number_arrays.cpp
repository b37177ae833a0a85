#include "terrain/io/raster_file.h"

#include <fmt/core.h>
#include <gdal.h>

#include <filesystem>
#include <limits>
#include <memory>

#include "base/error.h"
#include "base/memory_limit.h"
#include "base/text/missing_file.h"
#include "terrain/io/gdal/gdal_files.h"

namespace belvedere {
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
