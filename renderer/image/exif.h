#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace belvedere {

// Exif (CIPA DC-008), the small TIFF that many formats embed, as far as the program writes and
// reads it.
struct ExifTags {
  std::string description;     // ImageDescription
  std::string software;        // Software
  double dots_per_inch = 0.0;  // XResolution and YResolution, to 1/10000; 0: not stated
  bool operator==(const ExifTags&) const = default;
};

std::vector<std::uint8_t> write_exif(const ExifTags& tags);
// Reads the tags of any program, in either byte order. Damaged fields read as not stated.
ExifTags read_exif(const std::vector<std::uint8_t>& bytes);

}  // namespace belvedere
