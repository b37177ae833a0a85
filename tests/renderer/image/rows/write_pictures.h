#pragma once

#include <string>
#include <vector>

#include "renderer/image/rows/picture_files.h"

namespace belvedere::test {

// A whole picture at once.
inline void write_pictures(const std::string& stem, const std::vector<std::string>& extensions,
                           const Image& linear, const PictureColours& colours = {}) {
  PictureFiles files(stem, extensions, linear.width(), linear.height(), colours, 300.0, {});
  files.write_rows(linear);
  files.finish();
}

}  // namespace belvedere::test
