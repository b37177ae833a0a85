#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/files.h"

// Picture files made byte by byte from their specifications, so that readers are tested against
// something other than our own writers.
namespace belvedere::test {

inline std::string big_endian(std::uint32_t v) {
  return {static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8),
          static_cast<char>(v)};
}

inline std::string little_endian(std::uint64_t v, int bytes) {
  std::string out;
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(v >> (8 * i));
  return out;
}

inline std::string png_chunk(const std::string& type, const std::string& data) {
  std::uint32_t crc = 0xffffffffu;
  for (const char c : type + data) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int k = 0; k < 8; ++k) crc = (crc & 1) != 0 ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
  }
  return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(~crc);
}

// `rows`: all bytes of all rows without filter bytes. colour_type: 0 grey, 2 RGB, 3 palette, 4 grey
// and alpha, 6 RGB and alpha.
inline std::string make_png(int width, int height, int bits, int colour_type,
                            const std::string& rows, const std::string& palette = {}) {
  const std::string header = big_endian(static_cast<std::uint32_t>(width)) +
                             big_endian(static_cast<std::uint32_t>(height)) +
                             static_cast<char>(bits) + static_cast<char>(colour_type) +
                             std::string(3, '\0');
  std::string raw;
  const std::size_t row_bytes = height > 0 ? rows.size() / static_cast<std::size_t>(height) : 0;
  for (int y = 0; y < height && row_bytes > 0; ++y)
    raw += '\0' + rows.substr(static_cast<std::size_t>(y) * row_bytes, row_bytes);
  // zlib with one stored block (up to 65535 bytes).
  std::uint32_t a = 1, b = 0;
  for (const char c : raw) {
    a = (a + static_cast<std::uint8_t>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const std::string packed = "\x78\x01\x01" + little_endian(raw.size(), 2) +
                             little_endian(~raw.size(), 2) + raw + big_endian(b << 16 | a);
  std::string out = "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header);
  if (!palette.empty()) out += png_chunk("PLTE", palette);
  return out + png_chunk("IDAT", packed) + png_chunk("IEND", "");
}

// A directory of a TIFF: a grey picture of one value.
struct TiffPageBytes {
  int width, height;
  int value = 0;
  int kind = 0;         // NewSubfileType: 1 a reduced copy, 4 a mask
  int photometric = 1;  // 1: grey, black is 0
};

// A little-endian TIFF of pages; the one of a single page may have a SubIFD. `room`: bytes between
// its head and the first directory.
inline std::string make_tiff_pages(const std::vector<TiffPageBytes>& pages,
                                   const std::optional<TiffPageBytes>& within = {}, int room = 0) {
  std::string out = std::string("II*\0", 4) +
                    little_endian(8 + static_cast<std::uint64_t>(room), 4) +
                    std::string(static_cast<std::size_t>(room), '\0');
  // Directories lie one after the other, each with its pixels; `next`: whether one follows it.
  const auto add = [&](const TiffPageBytes& page, bool next, bool sub) {
    const std::size_t count = sub ? 10 : 9;
    const std::size_t pixels = static_cast<std::size_t>(page.width * page.height);
    const std::size_t data = out.size() + 2 + 12 * count + 4;
    const auto entry = [&](int tag, int type, std::uint64_t values, std::uint64_t value) {
      out += little_endian(static_cast<std::uint64_t>(tag), 2) +
             little_endian(static_cast<std::uint64_t>(type), 2) + little_endian(values, 4) +
             little_endian(value, 4);
    };
    out += little_endian(count, 2);
    entry(254, 4, 1, static_cast<std::uint64_t>(page.kind));
    entry(256, 4, 1, static_cast<std::uint64_t>(page.width));
    entry(257, 4, 1, static_cast<std::uint64_t>(page.height));
    entry(258, 3, 1, 8);
    entry(259, 3, 1, 1);
    entry(262, 3, 1, static_cast<std::uint64_t>(page.photometric));
    entry(273, 4, 1, data);
    entry(277, 3, 1, 1);
    entry(279, 4, 1, pixels);
    if (sub) entry(330, 4, 1, data + pixels);
    out += little_endian(next ? data + pixels : 0, 4);
    out += std::string(pixels, static_cast<char>(page.value));
  };
  for (std::size_t i = 0; i < pages.size(); ++i)
    add(pages[i], i + 1 < pages.size(), within.has_value());
  if (within) add(*within, false, false);
  return out;
}

// A JPEG of 8 × 8 pixels of CMYK.
inline const std::string cmyk_jpeg(
    "\xff\xd8\xff\xee\x00\x0e\x41\x64\x6f\x62\x65\x00\x64\x00\x00\x00\x00\x00\xff\xdb\x00\x43\x00"
    "\x0d\x09\x0a\x0b\x0a\x08\x0d\x0b\x0a"
    "\x0b\x0e\x0e\x0d\x0f\x13\x20\x15\x13\x12\x12\x13\x27\x1c\x1e\x17\x20\x2e\x29\x31\x30\x2e\x29"
    "\x2d\x2c\x33\x3a\x4a\x3e\x33\x36\x46"
    "\x37\x2c\x2d\x40\x57\x41\x46\x4c\x4e\x52\x53\x52\x32\x3e\x5a\x61\x5a\x50\x60\x4a\x51\x52\x4f"
    "\xff\xc0\x00\x14\x08\x00\x08\x00\x08"
    "\x04\x43\x11\x00\x4d\x11\x00\x59\x11\x00\x4b\x11\x00\xff\xc4\x00\x14\x00\x01\x00\x00\x00\x00"
    "\x00\x00\x00\x00\x00\x00\x00\x00\x00"
    "\x00\x00\x07\xff\xc4\x00\x14\x10\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00"
    "\x00\x00\xff\xda\x00\x0e\x04\x43\x00"
    "\x4d\x00\x59\x00\x4b\x00\x00\x3f\x00\x4e\x27\x13\x89\xcf\xff\xd9",
    176);

// An uncompressed TIFF of 8-bit grey with its directory in front of the rows; one strip a row.
inline std::string make_tiff(int width, int height, const std::string& rows, int photometric = 1) {
  const int entries = 9;
  const std::uint32_t tables = 8 + 2 + 12 * entries + 4;
  const auto h = static_cast<std::uint32_t>(height);
  const auto w = static_cast<std::uint32_t>(width);
  const std::uint32_t data = tables + 8 * h;
  std::string out = std::string("II*\0", 4) + little_endian(8, 4) + little_endian(entries, 2);
  const auto entry = [&](int tag, int type, std::uint32_t count, std::uint32_t value) {
    out += little_endian(static_cast<std::uint64_t>(tag), 2) +
           little_endian(static_cast<std::uint64_t>(type), 2) + little_endian(count, 4) +
           little_endian(value, 4);
  };
  entry(256, 4, 1, w);
  entry(257, 4, 1, h);
  entry(258, 3, 1, 8);
  entry(259, 3, 1, 1);
  entry(262, 3, 1, static_cast<std::uint32_t>(photometric));
  entry(273, 4, h, tables);
  entry(277, 3, 1, 1);
  entry(278, 4, 1, 1);
  entry(279, 4, h, tables + 4 * h);
  out += little_endian(0, 4);
  for (std::uint32_t y = 0; y < h; ++y) out += little_endian(data + y * w, 4);
  for (std::uint32_t y = 0; y < h; ++y) out += little_endian(w, 4);
  return out + rows;
}

// The header of an OpenEXR file with one float channel "Z" and nothing after it.
inline std::string make_exr_header(std::uint32_t width, std::uint32_t height) {
  using namespace std::string_literals;
  const auto attribute = [](const std::string& name, const std::string& type,
                            const std::string& value) {
    return name + '\0' + type + '\0' + little_endian(value.size(), 4) + value;
  };
  const std::string window =
      little_endian(0, 8) + little_endian(width - 1, 4) + little_endian(height - 1, 4);
  std::string out = "\x76\x2f\x31\x01\x02\0\0\0"s;
  out += attribute("channels", "chlist",
                   "Z\0"s + little_endian(2, 4) + little_endian(0, 4) + little_endian(1, 4) +
                       little_endian(1, 4) + "\0"s);
  out += attribute("compression", "compression", "\0"s);
  out += attribute("dataWindow", "box2i", window);
  out += attribute("displayWindow", "box2i", window);
  out += attribute("lineOrder", "lineOrder", "\0"s);
  out += attribute("pixelAspectRatio", "float", "\0\0\x80\x3f"s);
  out += attribute("screenWindowCenter", "v2f", std::string(8, '\0'));
  out += attribute("screenWindowWidth", "float", "\0\0\x80\x3f"s);
  return out + '\0';
}

}  // namespace belvedere::test
