#include "renderer/image/png_check.h"

// Checks a PNG without libpng, which prints messages where data is missing, and does not notice a
// missing end of file.
#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <string_view>
#include <vector>

#include "renderer/image/deflate.h"
#include "renderer/image/image_file_parts.h"

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

}  // namespace belvedere::image_io
