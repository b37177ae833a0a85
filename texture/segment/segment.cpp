#include "texture/segment/segment.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "base/filter.h"
#include "base/math_exact.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

Grid<float> channel_of(const Grid<glm::vec3>& picture, int channel, double gain, double blur_px) {
  Grid<float> out(picture.width(), picture.height());
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = static_cast<float>(gain) * picture[i][channel];
  return gaussian_blur(out, blur_px);
}

// |d/dx|, |d/dy| and sigma |Laplacian| of lightness (0…100) blurred by sigma, smoothed over a few
// strokes. Logarithms, because perceived strength of texture depends on ratios.
void add_responses(const Grid<float>& lightness, double sigma, double gain,
                   std::vector<Grid<float>>& channels) {
  const Grid<float> soft = gaussian_blur(lightness, sigma);
  std::array<Grid<float>, 3> response;
  for (Grid<float>& one : response) one = Grid<float>(soft.width(), soft.height());
  parallel_rows(soft.height(), [&](int y) {
    for (int x = 0; x < soft.width(); ++x) {
      const float left = soft.clamped(x - 1, y);
      const float right = soft.clamped(x + 1, y);
      const float up = soft.clamped(x, y - 1);
      const float down = soft.clamped(x, y + 1);
      response[0](x, y) = std::abs(right - left) / 2.F;
      response[1](x, y) = std::abs(down - up) / 2.F;
      response[2](x, y) =
          static_cast<float>(sigma) * std::abs(left + right + up + down - 4.F * soft(x, y));
    }
  });
  for (const Grid<float>& one : response) {
    Grid<float> smooth = gaussian_blur(one, 2.0 * sigma + 4.0);
    parallel_rows(smooth.height(), [&](int y) {
      for (int x = 0; x < smooth.width(); ++x)
        smooth(x, y) =
            static_cast<float>(gain * exact::log(1.0 + static_cast<double>(smooth(x, y))));
    });
    channels.push_back(std::move(smooth));
  }
}

// The difference across each border of two pieces: colours two pixels away from it on both sides,
// mean along the border.
using Borders = std::map<std::pair<std::uint16_t, std::uint16_t>, double>;
Borders measure_borders(const Grid<glm::vec3>& oklab, const Superpixels& pieces,
                        const PieceDistanceParameters& parameters) {
  const Grid<float> lightness =
      channel_of(oklab, 0, parameters.lightness_gain, parameters.border_blur_px);
  const Grid<float> a = channel_of(oklab, 1, parameters.colour_gain, parameters.border_blur_px);
  const Grid<float> b = channel_of(oklab, 2, parameters.colour_gain, parameters.border_blur_px);
  struct Sum {
    double step = 0.0;
    double length = 0.0;
  };
  std::map<std::pair<std::uint16_t, std::uint16_t>, Sum> sums;
  const Grid<std::uint16_t>& of = pieces.of;
  const auto meet = [&](int x, int y, int dx, int dy) {
    if (!of.contains(x + dx, y + dy) || of(x, y) == of(x + dx, y + dy)) return;
    const auto paint = [&](int px, int py) {
      return glm::dvec3(lightness.clamped(px, py), a.clamped(px, py), b.clamped(px, py));
    };
    Sum& sum = sums[std::minmax(of(x, y), of(x + dx, y + dy))];
    sum.step += glm::length(paint(x + 3 * dx, y + 3 * dy) - paint(x - 2 * dx, y - 2 * dy));
    sum.length += 1.0;
  };
  for (int y = 0; y < of.height(); ++y)
    for (int x = 0; x < of.width(); ++x) {
      meet(x, y, 1, 0);
      meet(x, y, 0, 1);
    }
  Borders borders;
  for (const auto& [pair, sum] : sums) borders[pair] = sum.step / sum.length;
  return borders;
}

// Shortest paths from one piece to all others (Dijkstra 1959; for some hundreds a plain search is
// as fast as a queue).
using Neighbours = std::vector<std::vector<std::pair<std::size_t, double>>>;
std::vector<double> ways_from(std::size_t start, const Neighbours& neighbours) {
  std::vector<double> way(neighbours.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> done(neighbours.size(), false);
  way[start] = 0.0;
  for (;;) {
    std::size_t next = neighbours.size();
    for (std::size_t i = 0; i < neighbours.size(); ++i)
      if (!done[i] && std::isfinite(way[i]) && (next == neighbours.size() || way[i] < way[next]))
        next = i;
    if (next == neighbours.size()) return way;
    done[next] = true;
    for (const auto& [other, cost] : neighbours[next])
      way[other] = std::min(way[other], way[next] + cost);
  }
}

}  // namespace

double PieceFeatures::distance(std::size_t a, std::size_t b) const {
  double sum = 0.0;
  for (std::size_t d = 0; d < dimensions; ++d) {
    const double step = values[a * dimensions + d] - values[b * dimensions + d];
    sum += step * step;
  }
  return std::sqrt(sum);
}

PieceFeatures measure_pieces(const Grid<glm::vec3>& oklab, const Superpixels& pieces,
                             const PieceDistanceParameters& parameters) {
  std::vector<Grid<float>> channels;
  channels.push_back(channel_of(oklab, 0, parameters.lightness_gain, parameters.colour_blur_px));
  channels.push_back(channel_of(oklab, 1, parameters.colour_gain, parameters.colour_blur_px));
  channels.push_back(channel_of(oklab, 2, parameters.colour_gain, parameters.colour_blur_px));
  const Grid<float> lightness = channel_of(oklab, 0, 100.0, 0.0);
  for (const double sigma : {1.0, 2.0, 4.0})
    add_responses(lightness, sigma, parameters.texture_gain, channels);
  const std::size_t position = channels.size();
  PieceFeatures out{position + 2, std::vector<double>(pieces.count * (position + 2), 0.0),
                    std::vector<double>(pieces.count, 0.0)};
  for (int y = 0; y < oklab.height(); ++y)
    for (int x = 0; x < oklab.width(); ++x) {
      const std::size_t piece = pieces.of(x, y);
      double* values = &out.values[piece * out.dimensions];
      out.pixels[piece] += 1.0;
      for (std::size_t d = 0; d < position; ++d)
        values[d] += static_cast<double>(channels[d](x, y));
      values[position] += parameters.across_gain * x / oklab.width();
      values[position + 1] += parameters.down_gain * y / oklab.height();
    }
  for (std::size_t piece = 0; piece < pieces.count; ++piece)
    for (std::size_t d = 0; d < out.dimensions; ++d)
      out.values[piece * out.dimensions + d] /= out.pixels[piece];
  return out;
}

PairWeights piece_distances(const Grid<glm::vec3>& oklab, const Superpixels& pieces,
                            const PieceFeatures& features,
                            const PieceDistanceParameters& parameters) {
  Neighbours neighbours(pieces.count);
  const Borders borders = measure_borders(oklab, pieces, parameters);
  for (const auto& [pair, step] : borders) {
    const std::size_t a = pair.first;
    const std::size_t b = pair.second;
    const double cost =
        std::max(0.5 * step + 0.5 * features.distance(a, b) - parameters.way_free, 0.0);
    neighbours[a].emplace_back(b, cost);
    neighbours[b].emplace_back(a, cost);
  }
  PairWeights distances(pieces.count);
  for (std::size_t a = 0; a < pieces.count; ++a) {
    const std::vector<double> way = ways_from(a, neighbours);
    for (std::size_t b = a + 1; b < pieces.count; ++b) {
      const double apart = features.distance(a, b);
      const double barred = parameters.way_gain * std::min(way[b], parameters.way_max);
      distances.set(a, b, std::sqrt(apart * apart + barred * barred));
    }
  }
  for (const auto& [pair, step] : borders) {
    const double closer = parameters.neighbour_gain * (parameters.neighbour_step - step);
    distances.set(pair.first, pair.second, distances(pair.first, pair.second) - closer);
  }
  return distances;
}

namespace {

// Remaining things to merge, by the number of each thing's first piece.
class Forest {
 public:
  Forest(const PairWeights& distance, const std::vector<double>& pixels, const Partition& groups)
      : count_(pixels.size()),
        pixels_(pixels),
        group_(groups),
        node_(count_),
        alive_(count_, true),
        sum_(count_ * count_),
        weight_(count_ * count_),
        root_(count_) {
    std::iota(node_.begin(), node_.end(), std::uint16_t{0});
    for (const double area : pixels) all_ += area;
    for (std::size_t a = 0; a < count_; ++a) update_root(a);
    for (std::size_t a = 0; a < count_; ++a)
      for (std::size_t b = 0; b < count_; ++b) {
        if (a == b) continue;
        weight_[a * count_ + b] = std::min(pixels[a], pixels[b]);
        sum_[a * count_ + b] = weight_[a * count_ + b] * distance(a, b);
      }
  }

  // Merges the best two of one group, or of any: false if there are none.
  bool join_best(bool within_groups, JoinTree& tree) {
    std::size_t first = count_;
    std::size_t second = count_;
    double min = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < count_; ++a) {
      if (!alive_[a]) continue;
      for (std::size_t b = a + 1; b < count_; ++b) {
        if (!alive_[b] || (within_groups && group_[a] != group_[b])) continue;
        const double cost =
            sum_[a * count_ + b] / weight_[a * count_ + b] * std::min(root_[a], root_[b]);
        if (cost < min) {
          min = cost;
          first = a;
          second = b;
        }
      }
    }
    if (first == count_) return false;
    tree.joins.push_back({node_[first], node_[second]});
    node_[first] = static_cast<std::uint16_t>(count_ + tree.joins.size() - 1);
    alive_[second] = false;
    pixels_[first] += pixels_[second];
    update_root(first);
    for (std::size_t c = 0; c < count_; ++c) {
      if (c == first || !alive_[c]) continue;
      sum_[first * count_ + c] += sum_[second * count_ + c];
      weight_[first * count_ + c] += weight_[second * count_ + c];
      sum_[c * count_ + first] = sum_[first * count_ + c];
      weight_[c * count_ + first] = weight_[first * count_ + c];
    }
    return true;
  }

 private:
  void update_root(std::size_t a) { root_[a] = std::sqrt(std::sqrt(pixels_[a] / all_)); }

  std::size_t count_;
  std::vector<double> pixels_;
  const Partition& group_;
  std::vector<std::uint16_t> node_;
  std::vector<bool> alive_;
  std::vector<double> sum_,
      weight_;  // of the distances between two things, and of the pairs they are means over
  std::vector<double> root_;
  double all_ = 0.0;
};

}  // namespace

JoinTree join_pieces(const PairWeights& distance, const std::vector<double>& pixels,
                     const Partition& groups) {
  JoinTree tree{pixels.size(), {}};
  Forest forest(distance, pixels, groups);
  while (forest.join_best(true, tree)) {
  }
  while (forest.join_best(false, tree)) {
  }
  return tree;
}

namespace {

// For each piece the node that contains it when `count` are left.
std::vector<std::uint16_t> nodes_of_pieces(const JoinTree& tree, std::size_t count) {
  const std::size_t kept = tree.pieces - std::min(std::max<std::size_t>(count, 1), tree.pieces);
  // From the last counted join downwards: each node passes its group to its two parts.
  std::vector<std::uint16_t> of(tree.pieces + tree.joins.size());
  std::iota(of.begin(), of.end(), std::uint16_t{0});
  for (std::size_t k = kept; k-- > 0;)
    for (const std::uint16_t part : tree.joins[k]) of[part] = of[tree.pieces + k];
  of.resize(tree.pieces);
  return of;
}

}  // namespace

Partition cut_tree(const JoinTree& tree, std::size_t count) {
  return in_order(nodes_of_pieces(tree, count));
}

std::vector<std::uint16_t> cut_nodes(const JoinTree& tree, std::size_t count) {
  std::vector<std::uint16_t> nodes;
  for (const std::uint16_t node : nodes_of_pieces(tree, count))
    if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) nodes.push_back(node);
  return nodes;
}

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
