#include "texture/statistical/texture_seam.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/grid.h"
#include "base/random.h"
#include "texture/statistical/learn_texture.h"

namespace belvedere {
namespace {

constexpr int learnt_px = 96;      // width next to the band from which a picture's model is learnt:
                                   // what is farther may be of another kind
constexpr int seam_border_px = 1;  // on either side of the ragged border, made by the model of both
constexpr double torn_px = 1.0;    // half width of the noise across the ragged border
constexpr int min_band_px = 24;
constexpr int widest_band_px = 96;  // chosen automatically
constexpr int min_within_px = 48;
// Max remainder of a step that is spread over a band: of a step h times the inner steps, (h - 1) /
// 2 k remains at every column of 2 k.
constexpr double left_of_step = .15;

// Columns next to a band remain, however wide it is.
double ratio_beside(const Grid<Rgb8>& picture, int seam, int band_px) {
  return seam_ratio(picture, seam, band_px, std::max(min_within_px, 2 * band_px));
}

int choose_band(double step, int min_width) {
  const int asked = static_cast<int>(std::ceil((step - 1.0) / (2.0 * left_of_step)));
  return std::clamp(asked, min_band_px, std::clamp(min_width / 2, min_band_px, widest_band_px));
}

Grid<Rgb8> mirrored(const Grid<Rgb8>& picture) {
  Grid<Rgb8> out(picture.width(), picture.height());
  for (int y = 0; y < picture.height(); ++y)
    std::reverse_copy(picture.row(y), picture.row(y) + picture.width(), out.row(y));
  return out;
}

CliqueModel learn(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states,
                  const SeamParameters& parameters) {
  LearnParameters learning;
  learning.types = parameters.types;
  return learn_texture(crop, states, learning).model;
}

// For each row along a seam a position 0…1: the ranks of a noise, so that positions are evenly
// distributed.
std::vector<double> even_places(int height, const SeamParameters& parameters) {
  const auto noise = [&](std::uint64_t n, int y, double width) {
    return gaussian_noise(stream_seed(parameters.seed, Stream::statistical_directions, 10 + n), 0.0,
                          y, width * parameters.band_px);
  };
  std::vector<std::pair<double, int>> rows;
  for (int y = 0; y < height; ++y)
    rows.emplace_back(.8 * noise(0, y, .3) + .6 * noise(1, y, .1), y);
  std::sort(rows.begin(), rows.end());
  std::vector<double> positions(static_cast<std::size_t>(height));
  for (int rank = 0; rank < height; ++rank)
    positions[static_cast<std::size_t>(rows[static_cast<std::size_t>(rank)].second)] =
        (rank + .5) / height;
  return positions;
}

// The last learnt_px columns of `picture` and band_px more made by its own model.
Grid<Rgb8> grow_right(const Grid<Rgb8>& picture, const SeamParameters& parameters) {
  const int k = parameters.band_px;
  const PixelRect near{std::max(0, picture.width() - std::max(learnt_px, k)), 0, picture.width(),
                       picture.height()};
  Grid<Rgb8> grown(near.width() + k, picture.height());
  Grid<std::uint8_t> hole(grown.width(), grown.height());
  for (int y = 0; y < grown.height(); ++y)
    for (int x = 0; x < grown.width(); ++x) {
      grown(x, y) = picture.clamped(near.x0 + x, y);
      hole(x, y) = x >= near.width() ? 1 : 0;
    }
  return fill_texture(grown, hole, learn(part_of(picture, near), {}, parameters),
                      of_seam({.seed = parameters.seed}));
}

// 1 where the right picture begins: right of a line that meanders over the band, visits every
// column equally often, and is slightly torn.
Grid<std::uint8_t> ragged_sides(int height, const SeamParameters& parameters) {
  const int k = parameters.band_px;
  const std::uint64_t torn = stream_seed(parameters.seed, Stream::statistical_directions, 12);
  const double reach = k - 1.0 - seam_border_px - torn_px;
  const std::vector<double> positions = even_places(height, parameters);
  Grid<std::uint8_t> sides(2 * k, height);
  for (int y = 0; y < height; ++y) {
    const double line = k + reach * (2.0 * positions[static_cast<std::size_t>(y)] - 1.0);
    for (int x = 0; x < 2 * k; ++x)
      sides(x, y) =
          x + .5 - line + torn_px * std::clamp(gaussian_noise(torn, x, y, 1.2) / 1.6, -1.0, 1.0) >
                  0.0
              ? 1
              : 0;
  }
  return sides;
}

// Colours of pictures, as cells of 8 levels on a side with their means.
class ColourSet {
 public:
  void add(const Rgb8& colour) {
    Cell& cell = cells_[cell_of(colour)];
    for (std::size_t c = 0; c < 3; ++c) cell.sum[c] += colour[c];
    ++cell.count;
  }
  // The colour itself if the set contains a similar one, otherwise the nearest in it.
  Rgb8 snapped(const Rgb8& colour) const {
    if (cells_[cell_of(colour)].count > 0) return colour;
    int min = std::numeric_limits<int>::max();
    Rgb8 best = colour;
    for (const Cell& cell : cells_) {
      if (cell.count == 0) continue;
      Rgb8 mean{};
      int distance = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        mean[c] = static_cast<std::uint8_t>(cell.sum[c] / cell.count);
        distance += (mean[c] - colour[c]) * (mean[c] - colour[c]);
      }
      if (distance >= min) continue;
      min = distance;
      best = mean;
    }
    return best;
  }

 private:
  struct Cell {
    std::array<std::uint64_t, 3> sum{};
    std::uint64_t count = 0;
  };
  static std::size_t cell_of(const Rgb8& c) {
    return static_cast<std::size_t>(c[0] >> 3U) << 10U |
           static_cast<std::size_t>(c[1] >> 3U) << 5U | static_cast<std::size_t>(c[2] >> 3U);
  }
  std::vector<Cell> cells_ = std::vector<Cell>(std::size_t{1} << 15U);
};

// Pixels within seam_border_px of the other side.
Grid<std::uint8_t> along_border(const Grid<std::uint8_t>& sides, int first, int width) {
  Grid<std::uint8_t> hole(width, sides.height());
  const auto side = [&](int x, int y) {
    const int at = std::clamp(x, 0, sides.width() - 1);
    return sides(at, std::clamp(y, 0, sides.height() - 1));
  };
  for (int y = 0; y < sides.height(); ++y)
    for (int x = 0; x < sides.width(); ++x) {
      bool near = false;
      for (int j = -seam_border_px; j <= seam_border_px && !near; ++j)
        for (int i = -seam_border_px; i <= seam_border_px && !near; ++i)
          near = side(x + i, y + j) != sides(x, y);
      hole(first + x, y) = near ? 1 : 0;
    }
  return hole;
}

}  // namespace

SeamInput synthesize_texture_seam(const Grid<Rgb8>& left, const Grid<Rgb8>& right,
                                  const SeamParameters& given, Progress& progress) {
  if (left.height() != right.height())
    throw Error(
        ErrorKind::usage, "texture seam",
        fmt::format("the pictures are {} and {} pixels high", left.height(), right.height()),
        "pictures of the same height");
  SeamInput with_seam{side_by_side(left, right)};
  Grid<Rgb8>& out = with_seam.picture;
  with_seam.before =
      ratio_beside(out, left.width(), given.band_px == 0 ? min_band_px : given.band_px);
  SeamParameters parameters = given;
  if (parameters.band_px == 0)
    parameters.band_px = choose_band(with_seam.before, std::min(left.width(), right.width()));
  const int k = parameters.band_px;
  const int height = left.height();
  const int min = std::max(min_crop_px, 2 * k);
  if (left.width() < min || right.width() < min || height < min_crop_px)
    throw Error(
        ErrorKind::input, "texture seam",
        fmt::format("the pictures have {} × {} and {} × {} pixels", left.width(), height,
                    right.width(), height),
        fmt::format("at least {} pixels across the seam and {} along it", min, min_crop_px));
  if (with_seam.before <= unseen_seam) {
    with_seam.after = with_seam.before;
    return with_seam;
  }
  progress.begin("synthesizing the seam", 3.0);
  const Grid<Rgb8> from_left = grow_right(left, parameters);
  progress.advance(1.0);
  const Grid<Rgb8> from_right = mirrored(grow_right(mirrored(right), parameters));
  progress.advance(1.0);
  const Grid<std::uint8_t> sides = ragged_sides(height, parameters);

  for (int y = 0; y < height; ++y) {
    // Columns of the band in the two grown pictures.
    const Rgb8* of_left = from_left.row(y) + (from_left.width() - 2 * k);
    const Rgb8* of_right = from_right.row(y);
    for (int x = 0; x < 2 * k; ++x)
      out(left.width() - k + x, y) = sides(x, y) == 0 ? of_left[x] : of_right[x];
  }

  // The border itself, in a window known to both models.
  const int reach = 4 * k + 8;
  const PixelRect window{std::max(0, left.width() - reach - k), 0,
                         std::min(out.width(), left.width() + reach + k), height};
  const Grid<Rgb8> around = part_of(out, window);
  const Grid<std::uint8_t> hole = along_border(sides, left.width() - k - window.x0, window.width());
  Grid<std::uint8_t> states(window.width(), height, pixel_free);
  ColourSet colours;
  for (std::size_t i = 0; i < hole.size(); ++i) {
    if (hole[i] != 0)
      states[i] = 0;
    else
      colours.add(around[i]);
  }
  const Grid<Rgb8> joined = fill_texture(around, hole, learn(around, states, parameters),
                                         of_seam({.seed = parameters.seed + 1}));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < window.width(); ++x)
      if (hole(x, y) != 0) out(window.x0 + x, y) = colours.snapped(joined(x, y));
  progress.advance(1.0);
  with_seam.band_px = k;
  with_seam.after = ratio_beside(out, left.width(), k);
  return with_seam;
}

double seam_ratio(const Grid<Rgb8>& picture, int x, int apart, int within) {
  const auto step = [&](int at) {
    double sum = 0.0;
    for (int y = 0; y < picture.height(); ++y)
      for (std::size_t c = 0; c < 3; ++c)
        sum += std::abs(picture(at, y)[c] - picture(at - 1, y)[c]);
    return sum;
  };
  double inside = 0.0;
  int columns = 0;
  for (int at = std::max(1, x - within); at < std::min(picture.width(), x + within + 1); ++at) {
    if (std::abs(at - x) <= apart) continue;
    inside += step(at);
    ++columns;
  }
  return inside > 0.0 ? step(x) * columns / inside : 0.0;
}

}  // namespace belvedere
