#include "renderer/image/exif.h"

#include <cmath>
#include <string_view>
#include <utility>

namespace belvedere {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint16_t tag_description = 0x10e;
constexpr std::uint16_t tag_x_resolution = 0x11a;
constexpr std::uint16_t tag_y_resolution = 0x11b;
constexpr std::uint16_t tag_resolution_unit = 0x128;
constexpr std::uint16_t tag_software = 0x131;

void put(Bytes& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

class ExifWriter {
 public:
  void add_text(std::uint16_t tag, const std::string& text) {
    Bytes bytes(text.begin(), text.end());
    bytes.push_back(0);
    const auto count = static_cast<std::uint32_t>(bytes.size());
    entries_.push_back({tag, 2, count, std::move(bytes)});
  }
  void add_short(std::uint16_t tag, std::uint16_t value) {
    Bytes bytes;
    put(bytes, value, 2);
    entries_.push_back({tag, 3, 1, std::move(bytes)});
  }
  void add_ratio(std::uint16_t tag, double value) {
    constexpr std::uint32_t parts = 10000;
    Bytes bytes;
    put(bytes, static_cast<std::uint32_t>(std::lround(value * parts)), 4);
    put(bytes, parts, 4);
    entries_.push_back({tag, 5, 1, std::move(bytes)});
  }

  // Little-endian: the header, one directory of entries in the order of their tags, then values
  // longer than the 4 bytes of an entry.
  Bytes bytes() const {
    Bytes out;
    for (const char c : std::string_view("II*\0", 4)) out.push_back(static_cast<std::uint8_t>(c));
    put(out, 8, 4);
    put(out, static_cast<std::uint32_t>(entries_.size()), 2);
    std::size_t at = 8 + 2 + 12 * entries_.size() + 4;
    Bytes data;
    for (const Entry& entry : entries_) {
      put(out, entry.tag, 2);
      put(out, entry.type, 2);
      put(out, entry.count, 4);
      Bytes value = entry.value;
      if (value.size() > 4) {
        put(out, static_cast<std::uint32_t>(at + data.size()), 4);
        value.resize((value.size() + 1) / 2 * 2);
        data.insert(data.end(), value.begin(), value.end());
      } else {
        value.resize(4);
        out.insert(out.end(), value.begin(), value.end());
      }
    }
    put(out, 0, 4);  // no further directory
    out.insert(out.end(), data.begin(), data.end());
    return out;
  }

 private:
  struct Entry {
    std::uint16_t tag;
    std::uint16_t type;
    std::uint32_t count;
    Bytes value;
  };
  std::vector<Entry> entries_;
};

// Offsets beyond its end read as 0.
class ExifReader {
 public:
  explicit ExifReader(const Bytes& tiff) : tiff_(tiff), big_(!tiff.empty() && tiff[0] == 'M') {}
  std::string text(std::uint16_t tag) const {
    const std::size_t entry = find(tag);
    if (entry == 0) return {};
    const std::size_t count = number(entry + 4, 4);
    const std::size_t at = count > 4 ? number(entry + 8, 4) : entry + 8;
    if (count == 0 || at > tiff_.size() || count > tiff_.size() - at) return {};
    const std::string text(tiff_.begin() + static_cast<std::ptrdiff_t>(at),
                           tiff_.begin() + static_cast<std::ptrdiff_t>(at + count));
    return text.substr(0, text.find('\0'));
  }
  double dots_per_inch() const {
    const std::size_t entry = find(tag_x_resolution);
    if (entry == 0) return 0.0;
    const std::size_t at = number(entry + 8, 4);
    const double divisor = number(at + 4, 4);
    const double resolution = divisor > 0.0 ? number(at, 4) / divisor : 0.0;
    const std::size_t unit = find(tag_resolution_unit);
    return unit != 0 && number(unit + 8, 2) == 3 ? resolution * 2.54
                                                 : resolution;  // 3: per centimetre, else per inch
  }

 private:
  std::uint32_t number(std::size_t at, std::size_t count) const {
    std::uint32_t out = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t position = at + (big_ ? i : count - 1 - i);
      out = out << 8 | (position < tiff_.size() ? tiff_[position] : 0U);
    }
    return out;
  }
  // Offset of the entry, 0 where there is none.
  std::size_t find(std::uint16_t tag) const {
    const std::size_t directory = number(4, 4);
    const std::size_t count = number(directory, 2);
    if (directory + 2 + 12 * count > tiff_.size()) return 0;
    for (std::size_t i = 0; i < count; ++i)
      if (number(directory + 2 + 12 * i, 2) == tag) return directory + 2 + 12 * i;
    return 0;
  }
  const Bytes& tiff_;
  bool big_;
};

}  // namespace

std::vector<std::uint8_t> write_exif(const ExifTags& tags) {
  ExifWriter exif;
  if (!tags.description.empty()) exif.add_text(tag_description, tags.description);
  if (tags.dots_per_inch > 0.0) {
    exif.add_ratio(tag_x_resolution, tags.dots_per_inch);
    exif.add_ratio(tag_y_resolution, tags.dots_per_inch);
    exif.add_short(tag_resolution_unit, 2);  // inches
  }
  if (!tags.software.empty()) exif.add_text(tag_software, tags.software);
  return exif.bytes();
}

ExifTags read_exif(const std::vector<std::uint8_t>& bytes) {
  const ExifReader exif(bytes);
  return {exif.text(tag_description), exif.text(tag_software), exif.dots_per_inch()};
}

}  // namespace belvedere
