#include "renderer/image/png_palette.h"

// The one file that knows libpng, for the one thing OpenImageIO does not give: the indices of a palette image. Masks drawn in a painting
// program are often saved that way.
#include <png.h>

#include <cstring>
#include <vector>

#include "base/error.h"
#include "renderer/image/image_file_parts.h"
#include "renderer/image/png_check.h"

namespace belvedere::image_io {
namespace {

// libpng's simplified reader; it frees itself whatever happens.
struct PngReader {
  png_image image{};
  explicit PngReader(const std::string& path) {
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&image, path.c_str()) == 0) throw_damaged(path, image.message);
  }
  ~PngReader() { png_image_free(&image); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
};

}  // namespace

Grid<std::uint16_t> read_palette_png(const std::string& path) {
  if (!is_png_complete(path)) throw_damaged(path, "a piece is missing or has a wrong checksum");
  PngReader reader(path);
  png_image& image = reader.image;
  check_memory(path, image.width, image.height, 3.0 * image.width * image.height);
  // With alpha in the colour map nothing is blended, and the palette keeps its order.
  image.format = PNG_FORMAT_RGBA_COLORMAP;
  std::vector<png_byte> indices(PNG_IMAGE_SIZE(image));
  std::vector<png_byte> colours(PNG_IMAGE_COLORMAP_SIZE(image));
  if (png_image_finish_read(&image, nullptr, indices.data(), 0, colours.data()) == 0) throw_damaged(path, image.message);
  // A warning of a finished read means that something was not as it should be: a cut-off file, for one.
  if (PNG_IMAGE_FAILED(image)) throw_damaged(path, image.message);
  Grid<std::uint16_t> out(static_cast<int>(image.width), static_cast<int>(image.height));
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = indices[i];
  return out;
}

}  // namespace belvedere::image_io
