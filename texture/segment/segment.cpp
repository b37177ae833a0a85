#include "texture/segment/segment.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

constexpr double reduced_pixels = 200'000.0;  // for which the filter bank's lengths are designed
constexpr std::size_t max_around = 9;         // pieces in 3 × 3 blocks

// A piece near a pixel: its mean colour in the blocks around.
struct Near {
  std::uint16_t piece = 0;
  glm::vec3 sum{0.F};
  float blocks = 0.F;
  float distance =
      std::numeric_limits<float>::infinity();  // to its nearest block, squared, in blocks
};

// The piece whose nearby paint is most similar to the pixel; a block of distance weighs as much as
// a tenth of the range of colours.
std::uint16_t nearest_paint(const Grid<std::uint16_t>& of, const Grid<glm::vec3>& reduced,
                            const glm::vec3& colour, int x, int y, int factor) {
  const int bx = x / factor;
  const int by = y / factor;
  std::array<Near, max_around> around;
  std::size_t count = 0;
  const auto position = [factor](int v) {
    return (static_cast<float>(v) + .5F) / static_cast<float>(factor) - .5F;
  };
  for (int j = std::max(by - 1, 0); j <= std::min(by + 1, of.height() - 1); ++j)
    for (int i = std::max(bx - 1, 0); i <= std::min(bx + 1, of.width() - 1); ++i) {
      std::size_t k = 0;
      while (k < count && around[k].piece != of(i, j)) ++k;
      if (k == count) around[count++].piece = of(i, j);
      const float dx = position(x) - static_cast<float>(i);
      const float dy = position(y) - static_cast<float>(j);
      around[k].sum += reduced(i, j);
      around[k].blocks += 1.F;
      around[k].distance = std::min(around[k].distance, dx * dx + dy * dy);
    }
  std::size_t best = 0;
  float min = std::numeric_limits<float>::infinity();
  for (std::size_t k = 0; k < count; ++k) {
    const glm::vec3 step = colour - around[k].sum / around[k].blocks;
    const float cost = glm::dot(step, step) + .01F * around[k].distance;
    if (cost < min) {
      min = cost;
      best = k;
    }
  }
  return around[best].piece;
}

// A pixel with at most one equal neighbour takes the majority of its neighbours.
Grid<std::uint16_t> without_specks(const Grid<std::uint16_t>& of) {
  Grid<std::uint16_t> out = of;
  parallel_rows(of.height(), [&](int y) {
    for (int x = 0; x < of.width(); ++x) {
      std::array<std::uint16_t, 9> around{};
      std::size_t n = 0;
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) around[n++] = of.clamped(x + i, y + j);
      auto max = std::count(around.begin(), around.end(), of(x, y));
      if (max > 2) continue;
      for (const std::uint16_t piece : around)
        if (const auto here = std::count(around.begin(), around.end(), piece); here > max) {
          max = here;
          out(x, y) = piece;
        }
    }
  });
  return out;
}

}  // namespace

Segments find_segments(const Grid<glm::vec3>& oklab, const SegmentParameters& parameters) {
  if (oklab.width() < min_segment_side || oklab.height() < min_segment_side)
    throw Error(ErrorKind::input, "the picture to segment",
                fmt::format("{} × {} pixels", oklab.width(), oklab.height()),
                fmt::format("at least {} pixels on each side", min_segment_side));
  Segments segments;
  segments.pieces = find_superpixels(oklab, parameters.pieces);
  const PieceFeatures features = measure_pieces(oklab, segments.pieces, parameters.distance);
  segments.pixels = features.pixels;
  segments.distance = piece_distances(oklab, segments.pieces, features, parameters.distance);
  return segments;
}

Partition group_pieces(const Segments& segments, double theta) {
  const std::size_t count = segments.pieces.count;
  PairWeights weights(count);
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a + 1; b < count; ++b)
      weights.set(
          a, b,
          (theta - segments.distance(a, b)) * std::min(segments.pixels[a], segments.pixels[b]));
  return partition_cliques(weights);
}

int segment_reduction(int width, int height) {
  return std::max(
      static_cast<int>(std::sqrt(static_cast<double>(width) * height / reduced_pixels) + 0.5), 1);
}

Grid<glm::vec3> reduce_blocks(const Grid<glm::vec3>& picture, int factor) {
  if (factor <= 1) return picture;
  Grid<glm::vec3> out((picture.width() + factor - 1) / factor,
                      (picture.height() + factor - 1) / factor);
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x) {
      glm::vec3 sum(0.F);
      float count = 0.F;
      for (int j = y * factor; j < std::min((y + 1) * factor, picture.height()); ++j)
        for (int i = x * factor; i < std::min((x + 1) * factor, picture.width()); ++i) {
          sum += picture(i, j);
          count += 1.F;
        }
      out(x, y) = sum / count;
    }
  });
  return out;
}

Grid<std::uint16_t> enlarge_pieces(const Grid<std::uint16_t>& of, const Grid<glm::vec3>& picture,
                                   int factor) {
  if (factor <= 1) return of;
  const Grid<glm::vec3> reduced = reduce_blocks(picture, factor);
  Grid<std::uint16_t> out(picture.width(), picture.height());
  parallel_rows(picture.height(), [&](int y) {
    const int by = y / factor;
    for (int bx = 0; bx < of.width(); ++bx) {
      bool inner = true;
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) inner = inner && of.clamped(bx + i, by + j) == of(bx, by);
      for (int x = bx * factor; x < std::min((bx + 1) * factor, picture.width()); ++x)
        out(x, y) = inner ? of(bx, by) : nearest_paint(of, reduced, picture(x, y), x, y, factor);
    }
  });
  return without_specks(out);
}

}  // namespace belvedere
