#include "tools/web/tile_pyramid.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

#include "base/grid_part.h"
#include "base/parallel.h"
#include "renderer/image/image_io.h"
#include "renderer/image/oiio_file.h"
#include "renderer/image/rows/row_reducer.h"
#include "renderer/paint/composite.h"

namespace belvedere::tools {
namespace {

// One level of the picture: collects rows until they make a row of tiles, writes these, and passes
// the rows on to the next level.
class Level {
 public:
  Level(std::string folder, int width, int height, const TileParameters& parameters)
      : folder_(std::move(folder)),
        parameters_(parameters),
        band_(width, std::min(height, parameters.tile_px)),
        height_(height) {
    std::filesystem::create_directories(folder_);
    if (std::max(width, height) <= parameters_.tile_px) return;
    reducer_ = std::make_unique<RowReducer>(width, height, 2);
  }

  bool last() const { return reducer_ == nullptr; }
  int next_width() const { return reducer_->width(); }
  int next_height() const { return reducer_->height(); }

  void take(const Grid<glm::vec3>& encoded) {
    for (int y = 0; y < encoded.height(); ++y) {
      std::copy_n(encoded.row(y), encoded.width(), band_.row(filled_));
      if (++filled_ == band_.height() || written_ + filled_ == height_) write();
    }
  }
  // Rows of the next level; often none.
  Grid<glm::vec3> smaller(const Grid<glm::vec3>& encoded) {
    return encode_srgb(reducer_->reduce(decode_srgb(encoded)));
  }

 private:
  void write() {
    const int row = written_ / parameters_.tile_px;
    const int across = (band_.width() + parameters_.tile_px - 1) / parameters_.tile_px;
    parallel_rows(across, [&](int column) {
      const int x0 = column * parameters_.tile_px;
      const PixelRect tile{x0, 0, std::min(x0 + parameters_.tile_px, band_.width()), filled_};
      write_jpeg(fmt::format("{}/{}_{}.jpg", folder_, column, row), part_of(band_, tile),
                 parameters_.quality);
    });
    written_ += filled_;
    filled_ = 0;
  }

  std::string folder_;
  TileParameters parameters_;
  Grid<glm::vec3> band_;
  int height_;
  int filled_ = 0;   // rows of the band
  int written_ = 0;  // rows of the picture
  std::unique_ptr<RowReducer> reducer_;
};

}  // namespace

TilePyramid write_tile_pyramid(const std::string& picture, const std::string& folder,
                               const TileParameters& parameters, Progress& progress) {
  const ImageInfo info = read_image_info(picture);
  std::vector<std::unique_ptr<Level>> levels;
  for (int width = info.width, height = info.height;;) {
    levels.push_back(std::make_unique<Level>(fmt::format("{}/{}", folder, levels.size()), width,
                                             height, parameters));
    if (levels.back()->last()) break;
    width = levels.back()->next_width();
    height = levels.back()->next_height();
  }
  progress.begin("cutting the picture into tiles", info.height);
  read_picture_rows(picture, [&](int, const Grid<glm::vec3>& rows) {
    Grid<glm::vec3> encoded = rows;
    for (std::size_t k = 0; k < levels.size() && encoded.height() > 0; ++k) {
      levels[k]->take(encoded);
      if (!levels[k]->last()) encoded = levels[k]->smaller(encoded);
    }
    progress.advance(rows.height());
  });
  return {info.width, info.height, parameters.tile_px, static_cast<int>(levels.size())};
}

}  // namespace belvedere::tools
