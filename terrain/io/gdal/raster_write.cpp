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
#include <optional>
#include <vector>

#include "base/error.h"
#include "base/files/output_file.h"
#include "base/random.h"
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

namespace {

// Hash of the bytes of a band in order, eight at a time.
std::uint64_t hash_on(std::uint64_t h, const std::uint8_t* bytes, std::size_t count) {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < count; ++i) {
    word = word << 8U | bytes[i];
    if (i % 8 == 7) h = mix_bits(h ^ word);
  }
  return mix_bits(h ^ word);
}

}  // namespace

struct ByteRasterRows::State {
  std::string path;
  std::optional<OutputFile> file;
  int width = 0, height = 0;
  int next_row = 0;
  std::vector<std::uint64_t> hashes;
  Dataset dataset;
  bool prepared = false;

  [[noreturn]] void fail(const std::string& reason) const {
    throw Error(ErrorKind::output, path, reason);
  }
  void check(bool good, const GdalErrors& errors) const {
    if (!good || errors.failed()) fail(errors.say("cannot write the file"));
  }
};

ByteRasterRows::ByteRasterRows(const std::string& path, const ByteRasterLayout& layout)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.path = path;
  s.width = layout.frame.width;
  s.height = layout.frame.height;
  const std::string extension = lower_extension(path);
  if (extension != ".tif" && extension != ".tiff")
    throw Error(ErrorKind::output, path, "unknown file extension", ".tif or .tiff");
  if (layout.bands.empty() || s.width < 1 || s.height < 1)
    throw Error(ErrorKind::bug, path, "no cells to write");
  register_gdal();
  s.file.emplace(path);
  s.hashes.assign(layout.bands.size(), 0);
  CPLStringList options;
  for (const char* option : {"TILED=YES", "COMPRESS=DEFLATE", "PREDICTOR=2", "BIGTIFF=IF_SAFER",
                             "NUM_THREADS=1", "INTERLEAVE=BAND"})
    options.AddString(option);
  options.AddString(layout.is_colour ? "PHOTOMETRIC=RGB" : "PHOTOMETRIC=MINISBLACK");
  const GdalErrors errors;
  s.dataset.reset(GDALCreate(GDALGetDriverByName("GTiff"), s.file->temporary().c_str(), s.width,
                             s.height, static_cast<int>(layout.bands.size()), GDT_Byte,
                             options.List()));
  s.check(s.dataset != nullptr, errors);
  const GeoTransform& t = layout.frame.transform;
  double affine[6] = {t.origin_x, t.cell_x, 0.0, t.origin_y, 0.0, -t.cell_y};
  s.check(GDALSetGeoTransform(s.dataset.get(), affine) == CE_None, errors);
  if (!layout.frame.crs.empty()) {
    OGRSpatialReference crs;
    s.check(crs.SetFromUserInput(layout.frame.crs.c_str()) == OGRERR_NONE, errors);
    s.check(GDALSetSpatialRef(s.dataset.get(), &crs) == CE_None, errors);
  }
  for (std::size_t i = 0; i < layout.bands.size(); ++i) {
    const ByteRasterLayout::Band& band = layout.bands[i];
    GDALRasterBandH h = GDALGetRasterBand(s.dataset.get(), static_cast<int>(i) + 1);
    if (!layout.is_colour) GDALSetDescription(h, band.name.c_str());
    if (band.scale != 1.0) s.check(GDALSetRasterScale(h, band.scale) == CE_None, errors);
    if (layout.zero_is_void) s.check(GDALSetRasterNoDataValue(h, 0.0) == CE_None, errors);
    if (layout.codes.empty()) continue;
    const std::unique_ptr<void, void (*)(void*)> table(GDALCreateColorTable(GPI_RGB),
                                                       [](void* c) { GDALDestroyColorTable(c); });
    for (const ByteRasterLayout::Code& code : layout.codes) {
      const GDALColorEntry colour{static_cast<short>(code.rgb >> 16U & 255U),
                                  static_cast<short>(code.rgb >> 8U & 255U),
                                  static_cast<short>(code.rgb & 255U), 255};
      GDALSetColorEntry(table.get(), code.code, &colour);
    }
    s.check(GDALSetRasterColorTable(h, table.get()) == CE_None, errors);
    // Category names would need a sidecar file; metadata are stored in the file.
    CPLStringList metadata;
    for (const ByteRasterLayout::Code& code : layout.codes)
      metadata.AddNameValue(fmt::format("class_{}", code.code).c_str(), code.name.c_str());
    s.check(GDALSetMetadata(h, metadata.List(), nullptr) == CE_None, errors);
  }
}

ByteRasterRows::~ByteRasterRows() = default;

void ByteRasterRows::write(int y0, const std::vector<Grid<std::uint8_t>>& bands) {
  State& s = *state_;
  if (y0 != s.next_row || bands.size() != s.hashes.size())
    throw Error(ErrorKind::bug, s.path, "rows out of order");
  const GdalErrors errors;
  for (std::size_t i = 0; i < bands.size(); ++i) {
    const Grid<std::uint8_t>& cells = bands[i];
    if (cells.width() != s.width || y0 + cells.height() > s.height)
      throw Error(ErrorKind::bug, s.path, "rows differ in size");
    for (int y = 0; y < cells.height(); ++y)
      s.hashes[i] = hash_on(s.hashes[i], cells.row(y), static_cast<std::size_t>(s.width));
    // The library takes a non-const pointer for reading and writing; this only reads.
    s.check(GDALRasterIO(GDALGetRasterBand(s.dataset.get(), static_cast<int>(i) + 1), GF_Write, 0,
                         y0, cells.width(), cells.height(), const_cast<std::uint8_t*>(cells.data()),
                         cells.width(), cells.height(), GDT_Byte, 0, 0) == CE_None,
            errors);
  }
  s.next_row = y0 + bands[0].height();
}

void ByteRasterRows::prepare() {
  State& s = *state_;
  if (s.prepared) return;
  if (s.next_row != s.height) throw Error(ErrorKind::bug, s.path, "missing rows");
  const GdalErrors errors;
  GDALFlushCache(s.dataset.get());
  s.dataset.reset();
  s.check(true, errors);
  // Reads the written file back: a full disk is not always reported.
  const Dataset back(GDALOpen(s.file->temporary().c_str(), GA_ReadOnly));
  s.check(back != nullptr, errors);
  std::vector<std::uint8_t> rows;
  for (std::size_t i = 0; i < s.hashes.size(); ++i) {
    std::uint64_t h = 0;
    for (int y0 = 0; y0 < s.height; y0 += 256) {
      const int count = std::min(256, s.height - y0);
      rows.resize(static_cast<std::size_t>(s.width) * static_cast<std::size_t>(count));
      s.check(GDALRasterIO(GDALGetRasterBand(back.get(), static_cast<int>(i) + 1), GF_Read, 0, y0,
                           s.width, count, rows.data(), s.width, count, GDT_Byte, 0, 0) == CE_None,
              errors);
      for (int y = 0; y < count; ++y)
        h = hash_on(h,
                    rows.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(s.width),
                    static_cast<std::size_t>(s.width));
    }
    if (h != s.hashes[i]) s.fail("the file was not written correctly; check free disk space");
  }
  s.file->prepare();
  s.prepared = true;
}

void ByteRasterRows::commit() {
  State& s = *state_;
  prepare();
  s.file->commit();
}

}  // namespace belvedere
