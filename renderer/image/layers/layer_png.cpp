#include "renderer/image/layers/layer_png.h"

// Uses libpng besides png_palette.cpp: OpenImageIO cannot write unassociated alpha.
#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <memory>
#include <vector>

#include "base/error.h"

namespace belvedere {
namespace {

// Layers are mostly empty or noise: the fastest of zlib's levels that finds runs.
constexpr int layer_compression_level = 2;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

void on_error(png_structp png, png_const_charp text) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = text;
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

class PngWriter {
 public:
  PngWriter(const std::string& path, int width, int height, int bits, int channels,
            double dots_per_inch)
      : path_(path), file_(std::fopen(path.c_str(), "wb")) {
    if (file_ == nullptr) fail("it cannot be created");
    png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, &message_, on_error, ignore_warning);
    info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
    if (info_ == nullptr) throw std::bad_alloc();
    call([&] {
      png_init_io(png_, file_.get());
      png_set_compression_level(png_, layer_compression_level);
      png_set_filter(png_, 0, PNG_FILTER_SUB);
      png_set_IHDR(png_, info_, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height),
                   bits, channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB,
                   PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
      png_set_sRGB(png_, info_, PNG_sRGB_INTENT_PERCEPTUAL);
      if (dots_per_inch > 0.0) {
        const auto per_metre = static_cast<png_uint_32>(std::lround(dots_per_inch / 0.0254));
        png_set_pHYs(png_, info_, per_metre, per_metre, PNG_RESOLUTION_METER);
      }
      png_write_info(png_, info_);
    });
  }
  ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  void write_row(const std::vector<png_byte>& row) {
    call([&] { png_write_row(png_, row.data()); });
  }
  void finish() {
    call([&] { png_write_end(png_, info_); });
    if (std::fflush(file_.get()) != 0) fail("it cannot be written");
  }

 private:
  template <class F>
  void call(F&& f) {
    // libpng reports errors by longjmp: `f` calls nothing else, and holds nothing that would have
    // to be freed.
    if (setjmp(png_jmpbuf(png_)) != 0) fail(message_);  // NOLINT(modernize-avoid-setjmp-longjmp)
    f();
  }
  [[noreturn]] void fail(const std::string& reason) {
    throw Error(ErrorKind::output, path_, reason);
  }

  std::string path_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  std::string message_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

}  // namespace

void write_layer_png(const std::string& path, int width, int height, double dots_per_inch,
                     bool opaque, const LayerRows& rows, Progress& progress) {
  const int channels = opaque ? 3 : 4;
  PngWriter png(path, width, height, 16, channels, dots_per_inch);
  std::vector<png_byte> bytes(static_cast<std::size_t>(width * channels) * 2);
  for (int y0 = 0; y0 < height; y0 += layer_band_rows) {
    const Grid<LayerPixel> band = rows(y0, std::min(height, y0 + layer_band_rows));
    for (int y = 0; y < band.height(); ++y) {
      png_byte* to = bytes.data();
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < channels; ++c) {
          const std::uint16_t value = band(x, y)[static_cast<std::size_t>(c)];
          *to++ = static_cast<png_byte>(value >> 8);
          *to++ = static_cast<png_byte>(value & 255);
        }
      png.write_row(bytes);
    }
    progress.advance(band.height());
  }
  png.finish();
}

void write_thumbnail_png(const std::string& path, int width, int height, int longest_px,
                         const LayerRows& rows) {
  const int factor = std::max(1, (std::max(width, height) + longest_px - 1) / longest_px);
  const int across = std::max(1, width / factor);
  const int down = std::max(1, height / factor);
  PngWriter png(path, across, down, 8, 3, 0.0);
  std::vector<png_byte> bytes(static_cast<std::size_t>(across) * 3);
  for (int y = 0; y < down; ++y) {
    const Grid<LayerPixel> band = rows(y * factor, std::min(height, (y + 1) * factor));
    for (int x = 0; x < across; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        std::uint64_t sum = 0;
        std::uint64_t count = 0;
        for (int v = 0; v < band.height(); ++v)
          for (int u = x * factor; u < std::min(width, (x + 1) * factor); ++u, ++count)
            sum += band(u, v)[c];
        bytes[static_cast<std::size_t>(x) * 3 + c] =
            static_cast<png_byte>(sum / std::max<std::uint64_t>(1, count) / 257);
      }
    png.write_row(bytes);
  }
  png.finish();
}

}  // namespace belvedere
