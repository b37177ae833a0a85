#include "tools/web/tile_pyramid.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

#include "base/grid.h"
#include "base/parallel.h"
#include "renderer/image/image_io.h"
#include "renderer/image/oiio_file.h"
#include "renderer/image/rows/picture_rows.h"
#include "renderer/paint/composite.h"

namespace belvedere::tools {
namespace {

// One level of the picture: collects rows until they make a row of tiles, cuts these, and passes
// the rows on to the next level.
class Level {
 public:
  Level(int number, int width, int height, int tile_px, const TakeTile& take_tile)
      : number_(number),
        tile_px_(tile_px),
        take_tile_(take_tile),
        band_(width, std::min(height, tile_px)),
        height_(height) {
    if (std::max(width, height) <= tile_px_) return;
    reducer_ = std::make_unique<RowReducer>(width, height, 2);
  }

  bool last() const { return reducer_ == nullptr; }
  int next_width() const { return reducer_->width(); }
  int next_height() const { return reducer_->height(); }

  void take(const Grid<glm::vec3>& encoded) {
    for (int y = 0; y < encoded.height(); ++y) {
      std::copy_n(encoded.row(y), encoded.width(), band_.row(filled_));
      if (++filled_ == band_.height() || taken_ + filled_ == height_) cut();
    }
  }
  // Rows of the next level; often none.
  Grid<glm::vec3> smaller(const Grid<glm::vec3>& encoded) {
    return encode_srgb(reducer_->reduce(decode_srgb(encoded)));
  }

 private:
  void cut() {
    const int row = taken_ / tile_px_;
    const int across = (band_.width() + tile_px_ - 1) / tile_px_;
    parallel_rows(across, [&](int column) {
      const int x0 = column * tile_px_;
      const PixelRect tile{x0, 0, std::min(x0 + tile_px_, band_.width()), filled_};
      take_tile_(number_, column, row, part_of(band_, tile));
    });
    taken_ += filled_;
    filled_ = 0;
  }

  int number_;
  int tile_px_;
  const TakeTile& take_tile_;
  Grid<glm::vec3> band_;
  int height_;
  int filled_ = 0;  // rows of the band
  int taken_ = 0;   // rows of the picture
  std::unique_ptr<RowReducer> reducer_;
};

}  // namespace

TilePyramid cut_into_tiles(int width, int height, int tile_px, const ReadRows& read,
                           const TakeTile& take) {
  std::vector<std::unique_ptr<Level>> levels;
  for (int w = width, h = height;;) {
    levels.push_back(std::make_unique<Level>(static_cast<int>(levels.size()), w, h, tile_px, take));
    if (levels.back()->last()) break;
    w = levels.back()->next_width();
    h = levels.back()->next_height();
  }
  read([&](const Grid<glm::vec3>& rows) {
    Grid<glm::vec3> encoded = rows;
    for (std::size_t k = 0; k < levels.size() && encoded.height() > 0; ++k) {
      levels[k]->take(encoded);
      if (!levels[k]->last()) encoded = levels[k]->smaller(encoded);
    }
  });
  return {width, height, tile_px, static_cast<int>(levels.size())};
}

TilePyramid write_tile_pyramid(const std::string& picture, const std::string& folder,
                               const TileParameters& parameters, Progress& progress) {
  const ImageInfo info = read_image_info(picture);
  progress.begin("cutting the picture into tiles", info.height);
  return cut_into_tiles(
      info.width, info.height, parameters.tile_px,
      [&](const TakeRows& take) {
        read_picture_rows(picture, [&](int, const Grid<glm::vec3>& rows) {
          take(rows);
          progress.advance(rows.height());
        });
      },
      [&](int level, int column, int row, const Grid<glm::vec3>& tile) {
        const std::string place = fmt::format("{}/{}", folder, level);
        std::filesystem::create_directories(place);
        write_jpeg(fmt::format("{}/{}_{}.jpg", place, column, row), tile, parameters.quality);
      });
}

}  // namespace belvedere::tools
