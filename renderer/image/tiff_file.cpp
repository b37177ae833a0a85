#include "renderer/image/tiff_file.h"

// The one file that knows libtiff; its tiles are packed on all threads before it gets them. See image_io.h for why not OpenImageIO.
#include <tiffio.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <memory>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "renderer/image/deflate.h"
#include "renderer/image/image_file_parts.h"
#include "renderer/image/output_file.h"
#include "renderer/image/provenance.h"

namespace belvedere {
namespace {

constexpr int tile_size = 256;  // pixels; 384 KiB a tile, small enough for viewers, large enough to compress
constexpr std::size_t row_values = std::size_t{3} * tile_size;
constexpr std::size_t tile_values = row_values * tile_size;
constexpr int compression_level = 6;
constexpr int tiles_at_once = 32;  // are packed together, then written: more would be held

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

// Some tiles of a row of `across`, packed; the same bytes whatever the number of threads. `band` has tile_size full rows.
std::vector<std::vector<std::uint8_t>> pack_tiles(const std::vector<std::uint16_t>& band, int across, int first, int count) {
  std::vector<std::vector<std::uint8_t>> out(static_cast<std::size_t>(count));
  parallel_rows(count, [&](int i) {
    std::vector<std::uint16_t> tile(tile_values);
    for (std::size_t y = 0; y < tile_size; ++y) {
      const std::uint16_t* from = band.data() + (y * static_cast<std::size_t>(across) + static_cast<std::size_t>(first + i)) * row_values;
      std::copy(from, from + row_values, tile.begin() + static_cast<std::ptrdiff_t>(y * row_values));
      difference(tile.data() + y * row_values);
    }
    out[static_cast<std::size_t>(i)] = Deflater(compression_level).pack(tile.data(), tile.size() * 2);
  });
  return out;
}

bool set_fields(TIFF* tiff, int width, int height, const PictureFileOptions& options) {
  bool ok = TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(width)) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(height)) != 0;
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

std::string_view text_of(const std::vector<std::uint8_t>& bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

class TiffRows : public PictureRows {
 public:
  TiffRows(const std::string& path, int width, int height, const PictureFileOptions& options)
      : PictureRows(path, width, height, tile_size), output_(path), across_((width + tile_size - 1) / tile_size) {
    const bool big = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * 6 >= options.big_tiff_from_bytes;
    tiff_ = open_tiff(output_.temporary(), big ? "w8l" : "w4l", message_);  // l: little-endian on any machine
    if (tiff_ == nullptr || !set_fields(tiff_.get(), width, height, options)) output_.fail(message_);
    band_.resize(static_cast<std::size_t>(across_) * tile_values);
  }

 private:
  void take(const Grid<glm::vec3>& from, int first, int rows, int at) override {
    image_io::quantize_rows(from, first, rows, across_ * tile_size, band_.data() + row_at(at));
  }
  void write_band(int, int rows) override {
    std::fill(band_.begin() + static_cast<std::ptrdiff_t>(row_at(rows)), band_.end(), std::uint16_t{0});
    for (int t = 0; t < across_; t += tiles_at_once) {
      for (std::vector<std::uint8_t>& packed : pack_tiles(band_, across_, t, std::min(tiles_at_once, across_ - t))) {
        const auto bytes = static_cast<tmsize_t>(packed.size());
        written_.add(text_of(packed));
        if (TIFFWriteRawTile(tiff_.get(), tiles_++, packed.data(), bytes) != bytes) output_.fail(message_);
      }
    }
  }
  void complete() override {
    // The directory is written here and not by closing, which cannot say that it failed.
    if (TIFFWriteDirectory(tiff_.get()) == 0 || !message_.empty()) output_.fail(message_);
    tiff_.reset();
    read_back();
    output_.prepare();
  }
  void replace() override { output_.commit(); }

  // Every tile is found by the file's own directory and is as it was packed.
  void read_back() {
    const Tiff tiff = open_tiff(output_.temporary(), "r", message_);
    if (tiff == nullptr) output_.fail(message_);
    std::uint32_t wide = 0;
    std::uint32_t high = 0;
    TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &wide);
    TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &high);
    if (wide != static_cast<std::uint32_t>(width()) || high != static_cast<std::uint32_t>(height()) ||
        TIFFNumberOfTiles(tiff.get()) != tiles_)
      output_.fail("it has another size");
    ContentHash read;
    std::vector<std::uint8_t> packed;
    for (ttile_t tile = 0; tile < tiles_; ++tile) {
      const std::uint64_t bytes = TIFFGetStrileByteCount(tiff.get(), tile);
      if (bytes == 0 || bytes > 2 * tile_values * sizeof(std::uint16_t)) output_.fail("a tile is missing");
      packed.resize(bytes);
      if (TIFFReadRawTile(tiff.get(), tile, packed.data(), static_cast<tmsize_t>(bytes)) != static_cast<tmsize_t>(bytes))
        output_.fail(message_);
      read.add(text_of(packed));
    }
    if (read.digits() != written_.digits()) output_.fail("it reads otherwise than it was written");
  }
  std::size_t row_at(int row) const { return static_cast<std::size_t>(row) * static_cast<std::size_t>(across_) * row_values; }

  OutputFile output_;
  int across_;
  std::string message_;
  Tiff tiff_;  // after the message, which it writes to
  std::vector<std::uint16_t> band_;
  ttile_t tiles_ = 0;
  ContentHash written_;  // of the packed tiles
};

}  // namespace

std::unique_ptr<PictureRows> open_tiff16(const std::string& path, int width, int height, const PictureFileOptions& options) {
  return std::make_unique<TiffRows>(path, width, height, options);
}

double tiff16_writer_bytes(int width, int) {
  const int across = (width + tile_size - 1) / tile_size;
  constexpr double tile_bytes = static_cast<double>(tile_values * sizeof(std::uint16_t));
  return tile_bytes * (across + 2.0 * tiles_at_once);  // a row of tiles, those that are packed at once
}

void write_tiff16(const std::string& path, const Grid<glm::vec3>& encoded, const PictureFileOptions& options) {
  write_whole(*open_tiff16(path, encoded.width(), encoded.height(), options), encoded);
}

}  // namespace belvedere
