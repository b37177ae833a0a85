#include <cpl_string.h>
#include <fmt/core.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/files/output_file.h"
#include "base/text/text_encoding.h"
#include "terrain/io/gdal/gdal_files.h"
#include "terrain/io/raster_file.h"
#include "terrain/io/raster_io.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;

// The value of voids: see write_raster. Text has no NaN that all readers accept.
float choose_void(const Grid<float>& cells, std::optional<double> nodata, bool ascii) {
  constexpr float usual = -9999.0F;
  if (!nodata) return usual;
  if (std::isnan(*nodata)) return ascii ? usual : std::numeric_limits<float>::quiet_NaN();
  if (!(std::abs(*nodata) <= static_cast<double>(std::numeric_limits<float>::max()))) return usual;
  const float given = static_cast<float>(*nodata);
  return std::find(cells.begin(), cells.end(), given) == cells.end() ? given : usual;
}

// Cells as written to a file.
Grid<float> with_written_voids(const Grid<float>& cells, float written_void) {
  Grid<float> out = cells;
  for (float& value : out)
    if (!std::isfinite(value)) value = written_void;
  return out;
}

template <class T>
void write_geotiff(const std::string& path, const Raster<T>& raster, const Grid<T>& cells,
                   double void_value) {
  constexpr bool bytes = sizeof(T) == 1;
  constexpr GDALDataType type = bytes ? GDT_Byte : GDT_Float32;
  CPLStringList options;
  for (const char* option :
       {"TILED=YES", "COMPRESS=DEFLATE", bytes ? "PREDICTOR=2" : "PREDICTOR=3", "ZLEVEL=1",
        "BIGTIFF=IF_SAFER", "NUM_THREADS=1"})  // level 6: 2 % smaller
    options.AddString(option);
  const GdalErrors errors;
  const auto check = [&](bool good) {
    if (!good || errors.failed())
      throw Error(ErrorKind::output, path, errors.say("cannot write the file"));
  };
  Dataset dataset(GDALCreate(GDALGetDriverByName("GTiff"), path.c_str(), cells.width(),
                             cells.height(), 1, type, options.List()));
  check(dataset != nullptr);
  const GeoTransform& t = raster.transform;
  double affine[6] = {t.origin_x, t.cell_x, 0.0, t.origin_y, 0.0, -t.cell_y};
  check(GDALSetGeoTransform(dataset.get(), affine) == CE_None);
  if (!raster.crs.empty()) {
    OGRSpatialReference crs;
    check(crs.SetFromUserInput(raster.crs.c_str()) == OGRERR_NONE);
    check(GDALSetSpatialRef(dataset.get(), &crs) == CE_None);
  }
  GDALRasterBandH band = GDALGetRasterBand(dataset.get(), 1);
  check(GDALSetRasterNoDataValue(band, void_value) == CE_None);
  // The library takes a non-const pointer for reading and writing; this only reads.
  check(GDALRasterIO(band, GF_Write, 0, 0, cells.width(), cells.height(),
                     const_cast<T*>(cells.data()), cells.width(), cells.height(), type, 0,
                     0) == CE_None);
  GDALFlushCache(dataset.get());
  dataset.reset();
  check(true);
}

// Written directly, because shortest round-trip numbers keep every bit of a float and are
// independent of the locale.
void write_ascii(const std::string& path, const Raster<float>& raster, const Grid<float>& cells,
                 float void_value) {
  const GeoTransform& t = raster.transform;
  if (std::abs(t.cell_x - t.cell_y) > 1e-9 * t.cell_x) {
    throw Error(ErrorKind::output, path,
                fmt::format("ESRI ASCII does not support cells of {} × {}", t.cell_x, t.cell_y),
                "square cells, or .tif");
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "wb"),
                                                             &std::fclose);
  if (!file) throw Error(ErrorKind::output, path, "cannot create the file");
  std::string text =
      fmt::format("ncols {}\nnrows {}\nxllcorner {}\nyllcorner {}\ncellsize {}\nNODATA_value {}\n",
                  cells.width(), cells.height(), t.origin_x, t.origin_y - t.cell_y * cells.height(),
                  t.cell_x, void_value);
  bool good = true;
  for (int y = 0; y < cells.height(); ++y) {
    const float* row = cells.row(y);
    for (int x = 0; x < cells.width(); ++x)
      fmt::format_to(std::back_inserter(text), "{}{}", x == 0 ? "" : " ", row[x]);
    text += '\n';
    good = good && std::fwrite(text.data(), 1, text.size(), file.get()) == text.size();
    text.clear();
  }
  if (!good || std::fflush(file.get()) != 0)
    throw Error(ErrorKind::output, path, "cannot write the file; check free disk space");
}

// The CRS next to an ASCII grid, in the dialect that its readers use.
void write_prj(const std::string& path, const std::string& crs) {
  OGRSpatialReference reference;
  char* text = nullptr;
  const char* const options[] = {"FORMAT=WKT1_ESRI", nullptr};
  const GdalErrors errors;
  const bool good = reference.SetFromUserInput(crs.c_str()) == OGRERR_NONE &&
                    reference.exportToWkt(&text, options) == OGRERR_NONE;
  const std::string wkt = text != nullptr ? text : "";
  CPLFree(text);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
      good ? std::fopen(path.c_str(), "wb") : nullptr, &std::fclose);
  if (!file || std::fwrite(wkt.data(), 1, wkt.size(), file.get()) != wkt.size() ||
      std::fflush(file.get()) != 0) {
    throw Error(ErrorKind::output, path, errors.say("cannot write the file"));
  }
}

// Reads the written file back: a full disk is not always reported.
template <class T>
void check_written(const std::string& path, const Grid<T>& cells, T void_value) {
  try {
    RasterSource source;
    source.path = path;
    source.crs = "EPSG:3857";  // arbitrary: positions are not used
    const RasterFile file(source);
    if (file.width() != cells.width() || file.height() != cells.height())
      throw Error(ErrorKind::output, path, "has a different size");
    constexpr int strip = 256;
    for (int y0 = 0; y0 < cells.height(); y0 += strip) {
      const int rows = std::min(strip, cells.height() - y0);
      const Grid<float> back = file.read_values({0, y0, cells.width(), rows});
      for (int y = 0; y < rows; ++y)
        for (int x = 0; x < cells.width(); ++x) {
          const T expected = cells(x, y0 + y);
          const bool hole = expected == void_value || expected != expected;  // NaN
          if (back(x, y) != static_cast<float>(expected) && !(hole && std::isnan(back(x, y))))
            throw Error(ErrorKind::output, path, "has different values");
        }
    }
  } catch (const Error& error) {
    throw Error(ErrorKind::output, path, "the file was not written correctly: " + error.found());
  }
}

// write() makes the temporary files; either all of them are renamed, or none.
template <class Write>
void write_and_rename(const std::string& path, const std::vector<OutputFile*>& files,
                      Write&& write) {
  try {
    write();
    for (OutputFile* file : files) file->prepare();
    for (OutputFile* file : files) file->commit();
  } catch (const Error& error) {
    throw Error(ErrorKind::output, path, error.found(), error.allowed());
  }
}

}  // namespace

std::vector<std::string> raster_files(const std::string& path) {
  if (lower_extension(path) != ".asc") return {path};
  return {path, fs::path(path).replace_extension(".prj").string()};
}

void write_raster(const std::string& path, const Raster<float>& raster,
                  std::optional<double> nodata) {
  const std::string extension = lower_extension(path);
  const bool ascii = extension == ".asc";
  if (!ascii && extension != ".tif" && extension != ".tiff")
    throw Error(ErrorKind::output, path, "unknown file extension", ".tif, .tiff or .asc");
  if (raster.cells.empty()) throw Error(ErrorKind::output, path, "no cells to write");
  const float written_void = choose_void(raster.cells, nodata, ascii);
  const Grid<float> cells = with_written_voids(raster.cells, written_void);
  register_gdal();
  OutputFile file(path);
  std::optional<OutputFile> prj;
  std::vector<OutputFile*> files{&file};
  if (ascii && !raster.crs.empty()) files.push_back(&prj.emplace(raster_files(path).back()));
  write_and_rename(path, files, [&] {
    const std::string& part = file.temporary();
    ascii ? write_ascii(part, raster, cells, written_void)
          : write_geotiff(part, raster, cells, static_cast<double>(written_void));
    if (prj) write_prj(prj->temporary(), raster.crs);
    check_written(part, cells, written_void);
  });
}

void write_raster(const std::string& path, const Raster<std::uint8_t>& raster) {
  const std::string extension = lower_extension(path);
  if (extension != ".tif" && extension != ".tiff")
    throw Error(ErrorKind::output, path, "unknown file extension", ".tif or .tiff");
  if (raster.cells.empty()) throw Error(ErrorKind::output, path, "no cells to write");
  register_gdal();
  OutputFile file(path);
  write_and_rename(path, {&file}, [&] {
    write_geotiff(file.temporary(), raster, raster.cells, 0.0);
    check_written(file.temporary(), raster.cells, std::uint8_t{0});
  });
}

}  // namespace belvedere
