#include "tools/pick/relief_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <glm/common.hpp>
#include <mutex>
#include <utility>
#include <vector>

#include "base/grid.h"
#include "base/statistics.h"
#include "terrain/shape/derivatives.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

struct Tint {
  float at;  // share of the range of altitudes
  glm::vec3 colour;
};
constexpr std::array<Tint, 5> tints = {{{0.F, {0.66F, 0.76F, 0.62F}},
                                        {0.25F, {0.80F, 0.83F, 0.68F}},
                                        {0.5F, {0.90F, 0.85F, 0.70F}},
                                        {0.75F, {0.89F, 0.83F, 0.77F}},
                                        {1.F, {0.98F, 0.98F, 0.99F}}}};

glm::vec3 tint_at(float share) {
  for (std::size_t i = 1; i < tints.size(); ++i)
    if (share <= tints[i].at)
      return glm::mix(tints[i - 1].colour, tints[i].colour,
                      std::max(0.F, (share - tints[i - 1].at) / (tints[i].at - tints[i - 1].at)));
  return tints.back().colour;
}

// Of altitudes, without the few lowest and highest.
struct Range {
  float low, high;
};
Range usual_range(const Grid<float>& altitude_m) {
  std::vector<float> some;
  const std::size_t every = altitude_m.size() / 100000 + 1;
  for (std::size_t i = 0; i < altitude_m.size(); i += every) some.push_back(altitude_m[i]);
  const float low = value_at_share(some, 0.02), high = value_at_share(some, 0.995);
  return {low, std::max(high, low + 1.F)};
}

}  // namespace

ReliefMap relief_map(const Dem& dem, int longest_px) {
  const Reduced ground = reduce_to(dem.altitude_m, longest_px);
  const int n = ground.factor;
  ReliefMap out{Grid<glm::vec3>(ground.cells.width(), ground.cells.height()), n};
  const auto shaded = [&](float azimuth_deg, float altitude_deg) {
    return hillshade(ground.cells, n * dem.transform.cell_x, n * dem.transform.cell_y,
                     {azimuth_deg, altitude_deg, 1.4F});
  };
  const Grid<std::uint8_t> sun = shaded(315.F, 40.F), fill = shaded(250.F, 60.F);
  const Range range = usual_range(ground.cells);
  constexpr glm::vec3 no_data(0.30F);
  constexpr float share_of_sun = 0.75F, darkest = 0.30F;
  for (int y = 0; y < out.picture.height(); ++y)
    for (int x = 0; x < out.picture.width(); ++x) {
      if (!dem.filled.empty() && dem.filled(x * n, y * n) != 0) {
        out.picture(x, y) = no_data;
        continue;
      }
      const float light = (share_of_sun * static_cast<float>(sun(x, y)) +
                           (1.F - share_of_sun) * static_cast<float>(fill(x, y))) /
                          255.F;
      const float share = (ground.cells(x, y) - range.low) / (range.high - range.low);
      out.picture(x, y) =
          tint_at(std::clamp(share, 0.F, 1.F)) * std::min(1.F, darkest + (1.2F - darkest) * light);
    }
  return out;
}

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
