#include "renderer/image/png_palette.h"

#include <png.h>

#include <algorithm>
#include <fstream>
#include <string_view>

#include "base/error.h"
#include "base/files/output_file.h"
#include "renderer/image/deflate.h"
#include "renderer/image/image_file.h"

// Checks a PNG without libpng, which prints messages where data is missing, and does not notice a
// missing end of file.
// The one file that uses libpng for what no other library here provides: the indices of a palette
// image, as masks drawn in a painting program are often saved, and our own masks as plain numbers.

namespace belvedere::image_io {
namespace {

std::uint32_t big_endian(const char* bytes) {
  std::uint32_t word = 0;
  for (int i = 0; i < 4; ++i) word = word << 8 | static_cast<std::uint8_t>(bytes[i]);
  return word;
}

}  // namespace

// Chunks of length, type, data and checksum up to IEND (PNG specification, sections 5.3 and 5.5).
bool is_png_complete(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(8);
  std::vector<char> buffer(1 << 16);
  std::array<char, 8> head{};
  while (file.read(head.data(), 8)) {
    std::uint32_t crc = crc32_after(0, head.data() + 4, 4);
    for (std::uint64_t left = big_endian(head.data()); left > 0;) {
      const std::size_t count =
          static_cast<std::size_t>(std::min<std::uint64_t>(left, buffer.size()));
      if (!file.read(buffer.data(), static_cast<std::streamsize>(count))) return false;
      crc = crc32_after(crc, buffer.data(), count);
      left -= count;
    }
    std::array<char, 4> expected{};
    if (!file.read(expected.data(), 4) || big_endian(expected.data()) != crc) return false;
    if (std::string_view(head.data() + 4, 4) == "IEND") return true;
  }
  return false;
}

PngKind read_png_kind(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(24);  // signature, length and type of IHDR, width, height
  const int bits = file.get();
  const int colour_type = file.get();
  if (!file) throw_damaged(path, "its header is missing");
  return {bits, colour_type == 3};
}

namespace {

// libpng's simplified reader; it frees itself in all cases.
struct PngReader {
  png_image image{};
  explicit PngReader(const std::string& path) {
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&image, path.c_str()) == 0)
      throw_damaged(path, image.message);
  }
  ~PngReader() { png_image_free(&image); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
};

// One byte per pixel, grey or the number of a colour.
void write_bytes_png(const std::string& path, const Grid<std::uint8_t>& bytes, png_uint_32 format,
                     const std::vector<std::array<std::uint8_t, 3>>& colours) {
  OutputFile file(path);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(bytes.width());
  image.height = static_cast<png_uint_32>(bytes.height());
  image.format = format;
  image.colormap_entries = static_cast<png_uint_32>(colours.size());
  const int written =
      png_image_write_to_file(&image, file.temporary().c_str(), 0, bytes.row(0), 0, colours.data());
  const std::string reason = image.message;
  png_image_free(&image);
  if (written == 0) file.fail(reason);
  file.commit();
}

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
  if (png_image_finish_read(&image, nullptr, indices.data(), 0, colours.data()) == 0)
    throw_damaged(path, image.message);
  // A warning of a finished read means an irregular file, such as a truncated one.
  if (PNG_IMAGE_FAILED(image)) throw_damaged(path, image.message);
  Grid<std::uint16_t> out(static_cast<int>(image.width), static_cast<int>(image.height));
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = indices[i];
  return out;
}

void write_grey_png(const std::string& path, const Grid<std::uint8_t>& grey) {
  write_bytes_png(path, grey, PNG_FORMAT_GRAY, {});
}

void write_palette_png(const std::string& path, const Grid<std::uint8_t>& numbers,
                       const std::vector<std::array<std::uint8_t, 3>>& colours) {
  write_bytes_png(path, numbers, PNG_FORMAT_RGB_COLORMAP, colours);
}

}  // namespace belvedere::image_io
