#pragma once

#include <string>

namespace belvedere::image_io {

// Whether a PNG is complete, with all checksums right.
bool is_png_complete(const std::string& path);
struct PngKind {
  int bits = 8;  // a channel, 1…16
  bool palette = false;
};
PngKind read_png_kind(const std::string& path);

}  // namespace belvedere::image_io
