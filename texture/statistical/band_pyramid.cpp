#include "texture/statistical/band_pyramid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/matrix.hpp>
#include <utility>

#include "base/matrix/matrix.h"
#include "base/parallel.h"
#include "base/random.h"

namespace belvedere {
namespace {

constexpr std::array<float, 4> halving = {.125F, .375F, .375F, .125F};

bool counts(const Grid<std::uint8_t>& states, std::size_t i) {
  return states.empty() || (states[i] & pixel_counts) != 0;
}

void find_axes(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states, BandSpace& space) {
  std::array<double, 3> mean{};
  glm::dmat3 spread(0.0);
  double n = 0.0;
  for (std::size_t i = 0; i < crop.size(); ++i) {
    if (!counts(states, i)) continue;
    n += 1.0;
    for (std::size_t c = 0; c < 3; ++c) mean[c] += crop[i][c];
  }
  for (std::size_t c = 0; c < 3; ++c)
    space.mean[c] = static_cast<float>(mean[c] /= std::max(n, 1.0));
  for (std::size_t i = 0; i < crop.size(); ++i) {
    if (!counts(states, i)) continue;
    const glm::dvec3 off(crop[i][0] - mean[0], crop[i][1] - mean[1], crop[i][2] - mean[2]);
    spread += glm::outerProduct(off, off) / std::max(n, 1.0);
  }
  const SymmetricEigen eigen = symmetric_eigen(spread);
  std::array<int, 3> order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return eigen.values[a] > eigen.values[b]; });
  for (std::size_t band = 0; band < 3; ++band) {
    const glm::dvec3& axis = eigen.vectors[order[band]];
    const double sign = axis.x + axis.y + axis.z < 0.0 ? -1.0 : 1.0;
    for (int c = 0; c < 3; ++c)
      space.axes[band][static_cast<std::size_t>(c)] = static_cast<std::int16_t>(
          std::lround(sign * axis[c] * static_cast<double>(BandSpace::axis_unit)));
  }
}

}  // namespace

BandPicture to_bands(const Grid<Rgb8>& picture, const BandSpace& bands,
                     const Grid<std::uint8_t>& states) {
  BandPicture out(picture.width(), picture.height());
  if (!states.empty()) out.states = states;
  const std::uint64_t dither = stream_seed(0, Stream::statistical_dither);
  parallel_rows(picture.height(), [&](int y) {
    for (int x = 0; x < picture.width(); ++x) {
      std::array<float, 3> v{};
      for (std::size_t c = 0; c < 3; ++c)
        v[c] = static_cast<float>(picture(x, y)[c]) +
               static_cast<float>(random_uniform(dither, x, y, c)) - 0.5F - bands.mean[c];
      for (int b = 0; b < 3; ++b)
        out.band(b)(x, y) =
            bands.axis(b, 0) * v[0] + bands.axis(b, 1) * v[1] + bands.axis(b, 2) * v[2];
    }
  });
  return out;
}

BandSpace find_bands(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states) {
  BandSpace space;
  find_axes(crop, states, space);
  const BandPicture picture = to_bands(crop, space, states);
  for (std::size_t b = 0; b < 3; ++b) {
    float low = 1e9F;
    float high = -1e9F;
    for (std::size_t i = 0; i < crop.size(); ++i) {
      if (!counts(states, i)) continue;
      low = std::min(low, picture.bands[b][i]);
      high = std::max(high, picture.bands[b][i]);
    }
    space.low[b] = low - 0.5F;
    space.high[b] = high + 0.5F;
  }
  return space;
}

Grid<Rgb8> to_picture(const BandPicture& picture, const BandSpace& bands) {
  Grid<Rgb8> out(picture.width(), picture.height());
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        const int channel = static_cast<int>(c);
        const float value = bands.mean[c] + bands.axis(0, channel) * picture.bands[0](x, y) +
                            bands.axis(1, channel) * picture.bands[1](x, y) +
                            bands.axis(2, channel) * picture.bands[2](x, y);
        out(x, y)[c] = static_cast<std::uint8_t>(std::clamp(value + 0.5F, 0.F, 255.F));
      }
    }
  });
  return out;
}

void halve(const BandPicture& fine, BandPicture& coarse) {
  parallel_rows(coarse.height(), [&](int y) {
    for (int x = 0; x < coarse.width(); ++x) {
      std::array<float, 3> sum{};
      float weight = 0.F;
      for (int j = 0; j < 4; ++j) {
        const int fy = 2 * y + j - 1;
        if (fy < 0 || fy >= fine.height()) continue;
        for (int i = 0; i < 4; ++i) {
          const int fx = 2 * x + i - 1;
          if (fx < 0 || fx >= fine.width() || (fine.states(fx, fy) & pixel_counts) == 0) continue;
          const float w =
              halving[static_cast<std::size_t>(i)] * halving[static_cast<std::size_t>(j)];
          weight += w;
          for (std::size_t b = 0; b < 3; ++b) sum[b] += w * fine.bands[b](fx, fy);
        }
      }
      for (std::size_t b = 0; b < 3; ++b)
        coarse.bands[b](x, y) = weight > 0.F ? sum[b] / weight : 0.F;
    }
  });
}

Grid<std::uint8_t> coarse_states(const Grid<std::uint8_t>& fine) {
  constexpr float min_weight = .4F;
  Grid<std::uint8_t> out((fine.width() + 1) / 2, (fine.height() + 1) / 2);
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) {
      float weight = 0.F;
      std::uint8_t state = 0;
      for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
          const int fx = 2 * x + i - 1;
          const int fy = 2 * y + j - 1;
          if (!fine.contains(fx, fy)) continue;
          const bool under = (i == 1 || i == 2) && (j == 1 || j == 2);
          if (under) state |= static_cast<std::uint8_t>(fine(fx, fy) & pixel_changes);
          if ((fine(fx, fy) & pixel_counts) != 0)
            weight += halving[static_cast<std::size_t>(i)] * halving[static_cast<std::size_t>(j)];
        }
      }
      out(x, y) = static_cast<std::uint8_t>(state | (weight >= min_weight ? pixel_counts : 0));
    }
  }
  return out;
}

BandPyramid make_pyramid(BandPicture finest, int levels) {
  BandPyramid pyramid;
  pyramid.push_back(std::move(finest));
  for (int level = 0; level < levels; ++level) {
    const BandPicture& fine = pyramid.back();
    BandPicture coarse((fine.width() + 1) / 2, (fine.height() + 1) / 2);
    coarse.states = coarse_states(fine.states);
    halve(fine, coarse);
    pyramid.push_back(std::move(coarse));
  }
  return pyramid;
}

float enlarged(const Grid<float>& coarse, int x, int y) {
  // Pixel centres: fine x is at (x - .5) / 2 of the coarse one, a quarter off its centre.
  const int left = x > 0 ? (x - 1) / 2 : -1;
  const int top = y > 0 ? (y - 1) / 2 : -1;
  const float u = (x & 1) != 0 ? .25F : .75F;
  const float v = (y & 1) != 0 ? .25F : .75F;
  const int x0 = std::max(left, 0);
  const int x1 = std::min(left + 1, coarse.width() - 1);
  const int y0 = std::max(top, 0);
  const int y1 = std::min(top + 1, coarse.height() - 1);
  return (1.F - v) * ((1.F - u) * coarse(x0, y0) + u * coarse(x1, y0)) +
         v * ((1.F - u) * coarse(x0, y1) + u * coarse(x1, y1));
}

}  // namespace belvedere
