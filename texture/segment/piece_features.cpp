#include "texture/segment/piece_features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <utility>

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

}  // namespace belvedere
