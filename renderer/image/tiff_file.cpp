#include "renderer/image/tiff_file.h"

// The one file that knows libtiff (and libdeflate, which compresses its tiles on all threads). See image_io.h for why not OpenImageIO.
#include <libdeflate.h>
#include <tiffio.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <memory>

#include "base/error.h"
#include "base/parallel.h"
#include "renderer/image/image_file_parts.h"
#include "renderer/image/output_file.h"

namespace belvedere {
namespace {

constexpr int tile_size = 256;  // pixels; 384 KiB a tile, small enough for viewers, large enough to compress
constexpr std::size_t row_values = std::size_t{3} * tile_size;
constexpr std::size_t tile_values = row_values * tile_size;
constexpr int compression_level = 6;

struct CloseTiff {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using Tiff = std::unique_ptr<TIFF, CloseTiff>;

// The library calls these instead of printing; `user` is the std::string that keeps the first message.
int keep_message(TIFF*, void* user, const char*, const char* format, va_list arguments) {
  char text[512];
  std::vsnprintf(text, sizeof text, format, arguments);
  auto& kept = *static_cast<std::string*>(user);
  if (kept.empty()) kept = text;
  return 1;
}
int ignore_message(TIFF*, void*, const char*, const char*, va_list) { return 1; }

Tiff open_tiff(const std::string& path, const char* mode, std::string& message) {
  const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(), TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_message, &message);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignore_message, nullptr);
  return Tiff(TIFFOpenExt(path.c_str(), mode, options.get()));
}

// Horizontal differencing of RGB within a tile (TIFF 6.0, section 14), in place; arithmetic modulo 2^16.
void difference(std::uint16_t* row) {
  for (int i = 3 * tile_size - 1; i >= 3; --i) row[i] = static_cast<std::uint16_t>(row[i] - row[i - 3]);
}

// One row of tiles, compressed; the same bytes whatever the number of threads. `band` has tile_size full rows.
std::vector<std::vector<std::uint8_t>> compress_tiles(const std::vector<std::uint16_t>& band, int across) {
  std::vector<std::vector<std::uint8_t>> out(static_cast<std::size_t>(across));
  parallel_rows(across, [&](int t) {
    std::vector<std::uint16_t> tile(tile_values);
    for (std::size_t y = 0; y < tile_size; ++y) {
      const std::uint16_t* from = band.data() + (y * static_cast<std::size_t>(across) + static_cast<std::size_t>(t)) * row_values;
      std::copy(from, from + row_values, tile.begin() + static_cast<std::ptrdiff_t>(y * row_values));
      difference(tile.data() + y * row_values);
    }
    const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
        libdeflate_alloc_compressor(compression_level), libdeflate_free_compressor);
    if (compressor == nullptr) throw std::bad_alloc();
    std::vector<std::uint8_t>& packed = out[static_cast<std::size_t>(t)];
    packed.resize(libdeflate_zlib_compress_bound(compressor.get(), tile.size() * 2));
    packed.resize(libdeflate_zlib_compress(compressor.get(), tile.data(), tile.size() * 2, packed.data(), packed.size()));
  });
  return out;
}

bool set_fields(TIFF* tiff, const Grid<glm::vec3>& encoded, const PictureFileOptions& options) {
  bool ok = TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(encoded.width())) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(encoded.height())) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_TILEWIDTH, static_cast<std::uint32_t>(tile_size)) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_TILELENGTH, static_cast<std::uint32_t>(tile_size)) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 16) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 3) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_SOFTWARE, "Belvedere " BELVEDERE_VERSION) != 0;
  if (options.dots_per_inch > 0.0) {
    ok &= TIFFSetField(tiff, TIFFTAG_RESOLUTIONUNIT, RESUNIT_INCH) != 0;
    ok &= TIFFSetField(tiff, TIFFTAG_XRESOLUTION, options.dots_per_inch) != 0;
    ok &= TIFFSetField(tiff, TIFFTAG_YRESOLUTION, options.dots_per_inch) != 0;
  }
  if (!options.icc_profile.empty()) {
    const auto size = static_cast<std::uint32_t>(options.icc_profile.size());
    ok &= TIFFSetField(tiff, TIFFTAG_ICCPROFILE, size, options.icc_profile.data()) != 0;
  }
  const std::string notes = image_io::join_notes(options.notes);
  if (!notes.empty()) ok &= TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, notes.c_str()) != 0;
  return ok;
}

void read_back(const OutputFile& output, const Grid<glm::vec3>& encoded, int across) {
  std::string message;
  const Tiff tiff = open_tiff(output.temporary(), "r", message);
  if (tiff == nullptr) output.fail(message);
  std::vector<std::uint16_t> expected;
  for (int y = 0; y < encoded.height(); y += tile_size) {
    image_io::quantize_rows(encoded, y, std::min(y + tile_size, encoded.height()), across * tile_size, expected);
    expected.resize(static_cast<std::size_t>(across) * tile_values);
    std::vector<std::uint16_t> tile(tile_values);
    for (int t = 0; t < across; ++t) {
      const auto bytes = static_cast<tmsize_t>(tile.size() * 2);
      const ttile_t number = TIFFComputeTile(tiff.get(), static_cast<std::uint32_t>(t * tile_size), static_cast<std::uint32_t>(y), 0, 0);
      bool same = TIFFReadEncodedTile(tiff.get(), number, tile.data(), bytes) == bytes;
      for (std::size_t r = 0; same && r < tile_size; ++r) {
        const std::size_t at = (r * static_cast<std::size_t>(across) + static_cast<std::size_t>(t)) * row_values;
        same =
            std::equal(expected.begin() + static_cast<std::ptrdiff_t>(at), expected.begin() + static_cast<std::ptrdiff_t>(at + row_values),
                       tile.begin() + static_cast<std::ptrdiff_t>(r * row_values));
      }
      if (!same) output.fail(message.empty() ? "it reads otherwise than it was written" : message);
    }
  }
}

}  // namespace

void write_tiff16(const std::string& path, const Grid<glm::vec3>& encoded, const PictureFileOptions& options) {
  if (encoded.empty()) throw Error(ErrorKind::bug, path, "a picture without pixels");
  OutputFile output(path);
  const int across = (encoded.width() + tile_size - 1) / tile_size;
  const bool big = static_cast<std::uint64_t>(encoded.size()) * 6 >= options.big_tiff_from_bytes;
  std::string message;
  {
    const Tiff tiff = open_tiff(output.temporary(), big ? "w8l" : "w4l", message);  // l: little-endian on any machine
    if (tiff == nullptr || !set_fields(tiff.get(), encoded, options)) output.fail(message);
    std::vector<std::uint16_t> band;
    ttile_t number = 0;
    for (int y = 0; y < encoded.height(); y += tile_size) {
      image_io::quantize_rows(encoded, y, std::min(y + tile_size, encoded.height()), across * tile_size, band);
      band.resize(static_cast<std::size_t>(across) * tile_values);
      for (std::vector<std::uint8_t>& packed : compress_tiles(band, across)) {
        const auto bytes = static_cast<tmsize_t>(packed.size());
        if (TIFFWriteRawTile(tiff.get(), number++, packed.data(), bytes) != bytes) output.fail(message);
      }
    }
    // The directory is written here and not by closing, which cannot say that it failed.
    if (TIFFWriteDirectory(tiff.get()) == 0 || !message.empty()) output.fail(message);
  }
  read_back(output, encoded, across);
  output.commit();
}

}  // namespace belvedere
