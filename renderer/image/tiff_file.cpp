#include "renderer/image/tiff_file.h"

// The one file that uses libtiff; its tiles are packed on all threads before they are passed to it.
// See image_io.h for why not OpenImageIO.
#include <fmt/format.h>
#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <limits>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/files/output_file.h"
#include "base/parallel.h"
#include "renderer/image/deflate.h"
#include "renderer/image/provenance.h"

namespace belvedere {
namespace {

constexpr int tiff_tile_size =
    256;  // pixels; 384 KiB a tile, small enough for viewers, large enough to compress
constexpr std::size_t tile_pixels = std::size_t{tiff_tile_size} * tiff_tile_size;
constexpr int tiff_compression_level = 6;
constexpr int tiff_tiles_per_batch = 32;  // are packed together, then written; limits memory

struct CloseTiff {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using Tiff = std::unique_ptr<TIFF, CloseTiff>;

// The library calls these instead of printing; `user` is the std::string that keeps the first
// message.
int keep_message(TIFF*, void* user, const char*, const char* format, va_list arguments) {
  char text[512];
  std::vsnprintf(text, sizeof text, format, arguments);
  auto& kept = *static_cast<std::string*>(user);
  if (kept.empty()) kept = text;
  return 1;
}
int ignore_message(TIFF*, void*, const char*, const char*, va_list) { return 1; }

Tiff open_tiff(const std::string& path, const char* mode, std::string& message) {
  const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                             TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_message, &message);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignore_message, nullptr);
  return Tiff(TIFFOpenExt(path.c_str(), mode, options.get()));
}

// Adobe DNG 1.6: sensor data, before and after demosaicing.
constexpr std::uint16_t photometric_cfa = 32803, photometric_linear_raw = 34892;

bool is_raw_page(TIFF* tiff) {
  std::uint16_t photometric = 0;
  const std::uint8_t* dng_version = nullptr;
  return (TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &photometric) != 0 &&
          (photometric == photometric_cfa || photometric == photometric_linear_raw)) ||
         TIFFGetField(tiff, TIFFTAG_DNGVERSION, &dng_version) != 0;
}

// Horizontal differencing of pixels within a tile (TIFF 6.0, section 14), in place; arithmetic
// modulo 2^16 or 2^8.
template <class Number>
void difference(Number* row, int channels) {
  for (int i = channels * tiff_tile_size - 1; i >= channels; --i)
    row[i] = static_cast<Number>(row[i] - row[i - channels]);
}

// Some tiles of a row of `across`, packed; the same bytes whatever the number of threads. `band`
// has tiff_tile_size full rows.
template <class Number>
std::vector<std::vector<std::uint8_t>> pack_tiles(const std::vector<Number>& band, int channels,
                                                  int across, int first, int count) {
  const std::size_t row_values = static_cast<std::size_t>(channels) * tiff_tile_size;
  std::vector<std::vector<std::uint8_t>> out(static_cast<std::size_t>(count));
  parallel_rows(count, [&](int i) {
    std::vector<Number> tile(row_values * tiff_tile_size);
    for (std::size_t y = 0; y < tiff_tile_size; ++y) {
      const Number* from =
          band.data() +
          (y * static_cast<std::size_t>(across) + static_cast<std::size_t>(first + i)) * row_values;
      std::copy(from, from + row_values,
                tile.begin() + static_cast<std::ptrdiff_t>(y * row_values));
      difference(tile.data() + y * row_values, channels);
    }
    out[static_cast<std::size_t>(i)] =
        Deflater(tiff_compression_level).pack(tile.data(), tile.size() * sizeof(Number));
  });
  return out;
}

// Meaning of the numbers of a pixel.
struct PixelForm {
  int channels;  // 3: red, green, blue; 4: cyan, magenta, yellow, black
  int bits;
};

bool set_fields(TIFF* tiff, int width, int height, PixelForm form,
                const PictureFileOptions& options) {
  bool ok = TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(width)) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(height)) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_TILEWIDTH, static_cast<std::uint32_t>(tiff_tile_size)) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_TILELENGTH, static_cast<std::uint32_t>(tiff_tile_size)) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, form.bits) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, form.channels) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC,
                     form.channels == 4 ? PHOTOMETRIC_SEPARATED : PHOTOMETRIC_RGB) != 0;
  if (form.channels == 4) ok &= TIFFSetField(tiff, TIFFTAG_INKSET, INKSET_CMYK) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT) != 0;
  ok &= TIFFSetField(tiff, TIFFTAG_SOFTWARE, ("Belvedere " + program_version()).c_str()) != 0;
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

std::string_view text_of(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Tiles of whole numbers; derived classes make them from pictures.
template <class Number>
class TileRows : public PictureRows {
 public:
  TileRows(const std::string& path, int width, int height, int channels,
           const PictureFileOptions& options)
      : PictureRows(path, width, height, tiff_tile_size),
        output_(path),
        channels_(channels),
        across_((width + tiff_tile_size - 1) / tiff_tile_size),
        row_values_(static_cast<std::size_t>(channels) * tiff_tile_size) {
    const auto pixel_bytes = static_cast<std::uint64_t>(channels) * sizeof(Number);
    const bool big =
        static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * pixel_bytes >=
        options.big_tiff_from_bytes;
    const PixelForm form = {channels, 8 * static_cast<int>(sizeof(Number))};
    tiff_ = open_tiff(output_.temporary(), big ? "w8l" : "w4l",
                      message_);  // l: little-endian on any machine
    if (tiff_ == nullptr || !set_fields(tiff_.get(), width, height, form, options))
      output_.fail(message_);
    band_.resize(static_cast<std::size_t>(across_) * row_values_ * tiff_tile_size);
  }

 protected:
  // Pixels of a row of the band, including those beyond the picture.
  int row_pixels() const { return across_ * tiff_tile_size; }
  Number* band_row(int row) { return band_.data() + row_at(row); }

 private:
  void write_band(int, int rows) override {
    std::fill(band_.begin() + static_cast<std::ptrdiff_t>(row_at(rows)), band_.end(), Number{0});
    for (int t = 0; t < across_; t += tiff_tiles_per_batch) {
      for (std::vector<std::uint8_t>& packed :
           pack_tiles(band_, channels_, across_, t, std::min(tiff_tiles_per_batch, across_ - t))) {
        const auto bytes = static_cast<tmsize_t>(packed.size());
        written_.add(text_of(packed));
        if (TIFFWriteRawTile(tiff_.get(), tiles_++, packed.data(), bytes) != bytes)
          output_.fail(message_);
      }
    }
  }
  void complete() override {
    // The directory is written here and not by closing, which cannot report a failure.
    if (TIFFWriteDirectory(tiff_.get()) == 0 || !message_.empty()) output_.fail(message_);
    tiff_.reset();
    read_back();
    output_.prepare();
  }
  void replace() override { output_.commit(); }

  // Finds every tile by the file's own directory, and compares it with what was packed.
  void read_back() {
    const Tiff tiff = open_tiff(output_.temporary(), "r", message_);
    if (tiff == nullptr) output_.fail(message_);
    std::uint32_t wide = 0;
    std::uint32_t high = 0;
    TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &wide);
    TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &high);
    if (wide != static_cast<std::uint32_t>(width()) ||
        high != static_cast<std::uint32_t>(height()) || TIFFNumberOfTiles(tiff.get()) != tiles_)
      output_.fail("it has another size");
    ContentHash read;
    std::vector<std::uint8_t> packed;
    for (ttile_t tile = 0; tile < tiles_; ++tile) {
      const std::uint64_t bytes = TIFFGetStrileByteCount(tiff.get(), tile);
      if (bytes == 0 || bytes > 2 * row_values_ * tiff_tile_size * sizeof(Number))
        output_.fail("a tile is missing");
      packed.resize(bytes);
      if (TIFFReadRawTile(tiff.get(), tile, packed.data(), static_cast<tmsize_t>(bytes)) !=
          static_cast<tmsize_t>(bytes))
        output_.fail(message_);
      read.add(text_of(packed));
    }
    if (read.digits() != written_.digits())
      output_.fail("it reads back differently from what was written");
  }
  std::size_t row_at(int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(across_) * row_values_;
  }

  OutputFile output_;
  int channels_;
  int across_;
  std::size_t row_values_;  // of a tile
  std::string message_;
  Tiff tiff_;  // after the message, which it writes to
  std::vector<Number> band_;
  ttile_t tiles_ = 0;
  ContentHash written_;  // of the packed tiles
};

class RgbRows final : public TileRows<std::uint16_t> {
 public:
  RgbRows(const std::string& path, int width, int height, const PictureFileOptions& options)
      : TileRows(path, width, height, 3, options) {}

 private:
  void take(const Grid<glm::vec3>& from, int first, int rows, int at) override {
    image_io::quantize_rows(from, first, rows, row_pixels(), band_row(at));
  }
};

// CMYK: more ink is a larger number (TIFF 6.0, section 16).
template <class Number>
class InkRows final : public TileRows<Number> {
 public:
  InkRows(const std::string& path, int width, int height, const PictureFileOptions& options,
          MakeInks make_inks)
      : TileRows<Number>(path, width, height, 4, options), make_inks_(std::move(make_inks)) {}

 private:
  void take(const Grid<glm::vec3>& from, int first, int rows, int at) override {
    constexpr double highest = std::numeric_limits<Number>::max();
    Grid<glm::vec3> part(from.width(), rows);
    std::copy(from.row(first), from.row(first) + part.size(), part.data());
    const Grid<Inks> inks = make_inks_(part);
    for (int y = 0; y < rows; ++y) {
      Number* to = this->band_row(at + y);
      for (int x = 0; x < inks.width(); ++x)
        for (int c = 0; c < 4; ++c)
          // NOLINTNEXTLINE(bugprone-incorrect-roundings): never negative
          to[4 * x + c] = static_cast<Number>(
              std::clamp(static_cast<double>(inks(x, y)[c]), 0.0, 1.0) * highest + 0.5);
    }
  }

  MakeInks make_inks_;
};

double writer_bytes(int width, double pixel_bytes) {
  const int across = (width + tiff_tile_size - 1) / tiff_tile_size;
  const double tile_bytes = static_cast<double>(tile_pixels) * pixel_bytes;
  return tile_bytes *
         (across + 2.0 * tiff_tiles_per_batch);  // a row of tiles, those that are packed at once
}

}  // namespace

TiffPage largest_tiff_page(const std::string& path) {
  std::string ignored;
  const Tiff tiff = open_tiff(path, "rO", ignored);  // O: no tables of strips
  TiffPage page;
  if (tiff == nullptr) return page;
  // Canon's CR2 has "CR" after the header of a TIFF.
  bool raw = image_io::first_bytes(path).substr(8, 2) == "CR";
  std::uint64_t most = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  bool reduced = false;
  std::vector<std::uint64_t> within;
  constexpr int max_pages = 10000;
  for (int i = 0; i < max_pages; ++i) {
    std::uint32_t kind = 0;
    std::uint32_t w = 0;
    std::uint32_t h = 0;
    TIFFGetField(tiff.get(), TIFFTAG_SUBFILETYPE, &kind);
    TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &w);
    TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &h);
    raw = raw || is_raw_page(tiff.get());
    std::uint16_t count = 0;
    const std::uint64_t* offsets = nullptr;
    if (TIFFGetField(tiff.get(), TIFFTAG_SUBIFD, &count, &offsets) != 0)
      within.insert(within.end(), offsets, offsets + count);
    const std::uint64_t pixels = std::uint64_t{w} * h;
    if ((kind & FILETYPE_MASK) == 0 && pixels > most) {
      most = pixels;
      width = w;
      height = h;
      reduced = (kind & FILETYPE_REDUCEDIMAGE) != 0;
      page.index = i;
      page.of_its_size.clear();
    }
    if ((kind & FILETYPE_MASK) == 0 && w == width && h == height) page.of_its_size.push_back(i + 1);
    page.pages = i + 1;
    if (TIFFReadDirectory(tiff.get()) == 0) break;
  }
  for (std::size_t i = 0; i < within.size() && !raw; ++i)
    raw = TIFFSetSubDirectory(tiff.get(), within[i]) != 0 && is_raw_page(tiff.get());
  if (raw || reduced)
    throw Error(
        ErrorKind::input, path,
        fmt::format("is {}, of which only a preview of {} × {} pixels can be read",
                    raw ? "a camera's raw file" : "a TIFF without its full picture", width, height),
        "the developed picture: export it as a TIFF of 16 bits from a raw converter, such "
        "as darktable or RawTherapee");
  return page;
}

std::unique_ptr<PictureRows> open_tiff_inks(const std::string& path, int width, int height,
                                            int bits, const PictureFileOptions& options,
                                            MakeInks make_inks) {
  if (bits == 8)
    return std::make_unique<InkRows<std::uint8_t>>(path, width, height, options,
                                                   std::move(make_inks));
  if (bits == 16)
    return std::make_unique<InkRows<std::uint16_t>>(path, width, height, options,
                                                    std::move(make_inks));
  throw Error(ErrorKind::usage, path, std::to_string(bits) + " bits", "8, 16");
}

std::unique_ptr<PictureRows> open_tiff16(const std::string& path, int width, int height,
                                         const PictureFileOptions& options) {
  return std::make_unique<RgbRows>(path, width, height, options);
}

double tiff16_writer_bytes(int width, int) { return writer_bytes(width, 6.0); }

void write_tiff16(const std::string& path, const Grid<glm::vec3>& encoded,
                  const PictureFileOptions& options) {
  write_whole(*open_tiff16(path, encoded.width(), encoded.height(), options), encoded);
}

}  // namespace belvedere
