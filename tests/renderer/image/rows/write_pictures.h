#pragma once

#include <string>
#include <vector>

#include "renderer/image/rows/picture_files.h"

namespace belvedere::test {

// A whole picture at once.
inline void write_pictures(const std::string& stem, const std::vector<std::string>& endings, const Image& linear,
                           const PictureColors& colors = {}) {
  PictureFiles files(stem, endings, linear.width(), linear.height(), colors, 300.0, {});
  files.write_rows(linear);
  files.finish();
}

}  // namespace belvedere::test
