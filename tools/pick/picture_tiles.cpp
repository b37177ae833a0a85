#include "tools/pick/picture_tiles.h"

#include <fmt/core.h>

#include <algorithm>
#include <mutex>
#include <utility>

#include "base/grid_part.h"
#include "tools/report/encoded_picture.h"

namespace belvedere::tools {

PictureTiles picture_tiles(const Grid<glm::vec3>& picture, const TileParameters& parameters) {
  constexpr int strip_px = 64;
  PictureTiles out;
  std::mutex mutex;
  const auto read = [&](const TakeRows& take) {
    for (int y = 0; y < picture.height(); y += strip_px)
      take(part_of(picture, {0, y, picture.width(), std::min(y + strip_px, picture.height())}));
  };
  const auto keep = [&](int level, int column, int row, const Grid<glm::vec3>& tile) {
    std::string bytes = jpeg_bytes(tile, parameters.quality);
    const std::lock_guard lock(mutex);
    out.files[fmt::format("{}/{}_{}.jpg", level, column, row)] = std::move(bytes);
  };
  out.pyramid = cut_into_tiles(picture.width(), picture.height(), parameters.tile_px, read, keep);
  return out;
}

}  // namespace belvedere::tools
