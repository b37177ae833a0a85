#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace belvedere {

// A finished picture to print.
struct PressPicture {
  std::string file;
  int width = 0;
  int height = 0;
  double dots_per_inch = 0.0;         // 0: the file does not state it
  std::vector<std::uint8_t> profile;  // its own, RGB; empty: sRGB
};

// `path` is a picture, or the folder of a rendered scene: of its panorama.tif, .jxl or .png, the
// first that holds encoded RGB of full size. Error(input) where there is none, or the picture is
// CMYK or linear already.
PressPicture find_press_picture(const std::string& path);

}  // namespace belvedere
