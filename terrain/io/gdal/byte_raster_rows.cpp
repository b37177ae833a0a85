#include "terrain/io/byte_raster_rows.h"

#include <cpl_string.h>
#include <fmt/core.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/files/output_file.h"
#include "base/random.h"
#include "base/text/text_encoding.h"
#include "terrain/io/gdal/gdal_files.h"

namespace belvedere {

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
