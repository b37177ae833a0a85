// Whether PNG and JPEG files are whole, from their structure alone: the decoders print, or fill up with grey, where data is missing.
#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

#include "renderer/image_io_detail.h"

namespace belvedere::image_io {
namespace {

constexpr auto crc_table = [] {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t c = i;
    for (int k = 0; k < 8; ++k) c = (c & 1) != 0 ? 0xedb88320u ^ (c >> 1) : c >> 1;
    table[i] = c;
  }
  return table;
}();

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
    std::uint32_t crc = 0xffffffffu;
    const auto add = [&](const char* bytes, std::size_t count) {
      for (std::size_t i = 0; i < count; ++i) crc = crc_table[(crc ^ static_cast<std::uint8_t>(bytes[i])) & 0xff] ^ (crc >> 8);
    };
    add(head.data() + 4, 4);
    for (std::uint64_t left = big_endian(head.data()); left > 0;) {
      const std::size_t count = static_cast<std::size_t>(std::min<std::uint64_t>(left, buffer.size()));
      if (!file.read(buffer.data(), static_cast<std::streamsize>(count))) return false;
      add(buffer.data(), count);
      left -= count;
    }
    std::array<char, 4> wanted{};
    if (!file.read(wanted.data(), 4) || big_endian(wanted.data()) != ~crc) return false;
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

// Segments, and coded data in which 0xFF is followed by 0 or a restart marker, up to the end marker (ITU T.81, annex B).
bool is_jpeg_complete(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(2);  // behind the start marker
  bool coded = false;
  for (int c = file.get(); file; c = file.get()) {
    if (c != 0xff) {
      if (!coded) return false;
      continue;
    }
    int marker = file.get();
    while (marker == 0xff) marker = file.get();
    if (marker == 0xd9) return true;
    if (marker == 0x00 || marker == 0x01 || (marker >= 0xd0 && marker <= 0xd7)) continue;
    const int high = file.get();
    const int low = file.get();
    if (!file || high * 256 + low < 2) return false;
    file.seekg(high * 256 + low - 2, std::ios::cur);
    coded = marker == 0xda;  // start of scan
  }
  return false;
}

}  // namespace belvedere::image_io
