#include "terrain/layers/layer_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/filter.h"
#include "base/pyramid.h"
#include "base/random.h"
#include "terrain/shape/mask_pieces.h"

namespace belvedere {
namespace {

constexpr double loudness = 2.0;
constexpr double spacing_per_sigma =
    1.7320508075688772;  // the B-spline's deviation is spacing / sqrt(3)

// Factor that gives a sum of independent values of standard deviation 1 with these weights a
// standard deviation of 1.
double inverse_deviation(const std::array<double, 4>& w) {
  return 1.0 / std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2] + w[3] * w[3]);
}

// Normal, or uniform in -1…1.
float lattice_value(bool gaussian, std::uint64_t seed, std::int64_t x, std::int64_t y) {
  return static_cast<float>(gaussian ? random_normal(seed, x, y)
                                     : 2.0 * random_uniform(seed, x, y) - 1.0);
}

// Calls octave(spacing in metres, weight, seed) for the octaves of a layer's noise that are
// resolved by cells of this size.
template <class Octave>
void each_octave(const LayerNoise& noise, std::uint64_t seed, double cell_m, Octave&& octave) {
  double weights = 0.0;
  double weight = 1.0;
  for (int i = 0; i < noise.octaves; ++i, weight *= noise.gain) weights += weight;
  weight = 1.0;
  double spacing = noise.scale_m;
  for (int i = 0; i < noise.octaves; ++i, weight *= noise.gain, spacing *= 0.5) {
    const double seen = std::clamp(spacing / cell_m - 1.0, 0.0, 1.0);
    if (!(seen > 0.0)) break;
    octave(spacing, loudness * seen * weight / weights,
           stream_seed(seed, Stream::class_noise, 1000 + static_cast<std::uint64_t>(i)));
  }
}

}  // namespace

NoiseAtPosition layer_noise_at(const LayerNoise& noise, std::uint64_t seed, glm::dvec2 position_m,
                               double cell_m) {
  NoiseAtPosition out;
  each_octave(noise, seed, cell_m, [&](double spacing_m, double weight, std::uint64_t own) {
    const glm::dvec2 at = position_m / spacing_m;
    const double whole_x = std::floor(at.x);
    const double whole_y = std::floor(at.y);
    const std::array<double, 4> wx = bspline_weights(at.x - whole_x);
    const std::array<double, 4> wy = bspline_weights(at.y - whole_y);
    const std::array<double, 4> dx = bspline_slopes(at.x - whole_x);
    const std::array<double, 4> dy = bspline_slopes(at.y - whole_y);
    const auto x0 = static_cast<std::int64_t>(whole_x) - 1;
    const auto y0 = static_cast<std::int64_t>(whole_y) - 1;
    for (std::size_t j = 0; j < 4; ++j) {
      double row = 0.0;
      double row_slope = 0.0;
      for (std::size_t i = 0; i < 4; ++i) {
        const double value = lattice_value(false, own, x0 + static_cast<std::int64_t>(i),
                                           y0 + static_cast<std::int64_t>(j));
        row += wx[i] * value;
        row_slope += dx[i] * value;
      }
      out.value += weight * wy[j] * row;
      out.slope.x += weight / spacing_m * wy[j] * row_slope;
      out.slope.y += weight / spacing_m * dy[j] * row;
    }
  });
  if (std::abs(out.value) > 1.0) out = {std::clamp(out.value, -1.0, 1.0), glm::dvec2(0.0)};
  return out;
}

LayerNoiseRows::LayerNoiseRows(const LayerNoise& noise, std::uint64_t seed,
                               const GeoTransform& transform, const PixelRect& cells)
    : transform_(transform), cells_(cells) {
  each_octave(noise, seed, 0.5 * (transform.cell_x + transform.cell_y),
              [&](double spacing_m, double weight, std::uint64_t own) {
                add_octave(spacing_m, weight, own);
              });
}

LayerNoiseRows::LayerNoiseRows(const std::vector<GaussianOctave>& octaves,
                               const GeoTransform& transform, const PixelRect& cells)
    : transform_(transform), cells_(cells), gaussian_(true) {
  for (const GaussianOctave& octave : octaves)
    add_octave(octave.sigma_m * spacing_per_sigma, octave.weight, octave.seed);
}

void LayerNoiseRows::add_octave(double spacing_m, double weight, std::uint64_t seed) {
  Octave octave;
  octave.spacing_m = spacing_m;
  octave.weight = static_cast<float>(weight);
  octave.seed = seed;
  const auto width = static_cast<std::size_t>(cells_.width());
  octave.at.resize(width);
  octave.weights.resize(width);
  std::int64_t last = 0;
  for (std::size_t x = 0; x < width; ++x) {
    // By the cell's own number, so that the start of the rectangle does not matter.
    const double position = transform_.to_crs(cells_.x0 + static_cast<int>(x), 0.0).x / spacing_m;
    const double whole = std::floor(position);
    const auto first = static_cast<std::int64_t>(whole) - 1;
    if (x == 0) octave.first_column = first;
    octave.at[x] = static_cast<std::int32_t>(first - octave.first_column);
    const std::array<double, 4> w = bspline_weights(position - whole);
    const double louder = gaussian_ ? inverse_deviation(w) : 1.0;
    for (std::size_t k = 0; k < 4; ++k) octave.weights[x][k] = static_cast<float>(w[k] * louder);
    last = first + 3;
  }
  const auto columns = static_cast<std::size_t>(last - octave.first_column + 1);
  for (std::vector<float>& row : octave.lattice) row.resize(columns);
  octave.line.resize(columns);
  octaves_.push_back(std::move(octave));
}

void LayerNoiseRows::fill(int y, float* out) {
  const int width = cells_.width();
  std::fill_n(out, width, 0.F);
  for (Octave& octave : octaves_) {
    const double position = transform_.to_crs(0.0, y).y / octave.spacing_m;
    const double whole = std::floor(position);
    const auto first = static_cast<std::int64_t>(whole) - 1;
    const std::size_t columns = octave.line.size();
    if (!octave.filled || octave.first_row != first) {
      // Rows of the raster run south, rows of the lattice north: the previous first row is often
      // the second now.
      const bool next = octave.filled && first == octave.first_row - 1;
      if (next) std::rotate(octave.lattice, octave.lattice + 3, octave.lattice + 4);
      for (std::size_t k = 0; k < (next ? 1U : 4U); ++k)
        for (std::size_t i = 0; i < columns; ++i)
          octave.lattice[k][i] = lattice_value(gaussian_, octave.seed,
                                               octave.first_column + static_cast<std::int64_t>(i),
                                               first + static_cast<std::int64_t>(k));
      octave.first_row = first;
      octave.filled = true;
    }
    const std::array<double, 4> w = bspline_weights(position - whole);
    float v[4];
    const double louder = gaussian_ ? inverse_deviation(w) : 1.0;
    for (std::size_t k = 0; k < 4; ++k) v[k] = static_cast<float>(w[k] * louder) * octave.weight;
    const float* a = octave.lattice[0].data();
    const float* b = octave.lattice[1].data();
    const float* c = octave.lattice[2].data();
    const float* d = octave.lattice[3].data();
    float* line = octave.line.data();
    for (std::size_t i = 0; i < columns; ++i)
      line[i] = (v[0] * a[i] + v[1] * b[i]) + (v[2] * c[i] + v[3] * d[i]);
    for (int x = 0; x < width; ++x) {
      const float* at = line + octave.at[static_cast<std::size_t>(x)];
      const std::array<float, 4>& u = octave.weights[static_cast<std::size_t>(x)];
      out[x] += (u[0] * at[0] + u[1] * at[1]) + (u[2] * at[2] + u[3] * at[3]);
    }
  }
  if (gaussian_) return;
  for (int x = 0; x < width; ++x) out[x] = std::clamp(out[x], -1.F, 1.F);
}

namespace {

constexpr int bump_octaves = 4;

// Cubic B-spline of a grid: its value and its derivatives per cell to the right and down.
struct GridPlace {
  double value = 0.0;
  glm::dvec2 change{0.0};
};

GridPlace smooth_at(const Grid<float>& grid, glm::dvec2 cell) {
  const double x = std::clamp(cell.x, -1.0, static_cast<double>(grid.width()));
  const double y = std::clamp(cell.y, -1.0, static_cast<double>(grid.height()));
  const int x0 = static_cast<int>(std::floor(x));
  const int y0 = static_cast<int>(std::floor(y));
  const std::array<double, 4> wx = bspline_weights(x - x0);
  const std::array<double, 4> wy = bspline_weights(y - y0);
  const std::array<double, 4> dx = bspline_slopes(x - x0);
  const std::array<double, 4> dy = bspline_slopes(y - y0);
  GridPlace out;
  for (int j = 0; j < 4; ++j) {
    double row = 0.0;
    double row_change = 0.0;
    for (int i = 0; i < 4; ++i) {
      const double value = grid.clamped(x0 - 1 + i, y0 - 1 + j);
      row += wx[static_cast<std::size_t>(i)] * value;
      row_change += dx[static_cast<std::size_t>(i)] * value;
    }
    out.value += wy[static_cast<std::size_t>(j)] * row;
    out.change.x += wy[static_cast<std::size_t>(j)] * row_change;
    out.change.y += dy[static_cast<std::size_t>(j)] * row;
  }
  return out;
}

}  // namespace

std::uint64_t seed_of_name(const std::string& name) {
  std::uint64_t h = 0;
  for (const char c : name)
    h = mix_bits(h ^ static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  return h;
}

LayerNoise bump_noise(double length_m) { return {length_m, bump_octaves, 1.0, 0.0}; }

std::uint64_t bump_seed(const SurfaceLayer& layer, std::uint64_t seed) {
  return stream_seed(seed, Stream::class_noise, ~seed_of_name(layer.name));
}

glm::dvec2 bump_slope(const GroundRelief& relief, glm::dvec2 position_m, double pixel_m) {
  glm::dvec2 slope(0.0);
  for (const GroundRelief::Bumps& bumps : relief.bumps) {
    // None of them is longer than a pixel.
    if (!(bumps.length_m > pixel_m) || bumps.share.empty()) continue;
    const GridPlace share =
        smooth_at(bumps.share, relief.transform.to_cell(position_m.x, position_m.y));
    const glm::dvec2 share_slope(share.change.x / relief.transform.cell_x,
                                 -share.change.y / relief.transform.cell_y);
    if (!(share.value > 0.0) && share_slope == glm::dvec2(0.0)) continue;
    const NoiseAtPosition noise =
        layer_noise_at(bump_noise(bumps.length_m), bumps.seed, position_m, pixel_m);
    slope += bumps.height_m * (share.value * noise.slope + noise.value * share_slope);
  }
  return slope;
}

Grid<float> lake_depth_m(const Dem& dem, const LakeBedParameters& parameters) {
  const int width = dem.width();
  const Grid<std::uint8_t> lakes = find_lakes(dem.altitude_m, parameters.lakes);
  Grid<std::uint8_t> land(width, dem.height());
  for (std::size_t i = 0; i < land.size(); ++i) land[i] = lakes[i] == 0 ? 1 : 0;
  const Grid<std::int32_t> nearest = nearest_marked(land);
  Grid<float> depth(width, dem.height());
  for (int y = 0; y < dem.height(); ++y)
    for (int x = 0; x < width; ++x) {
      const std::int32_t at = nearest(x, y);
      if (lakes(x, y) == 0 || at < 0) continue;
      const double dx = (at % width - x) * dem.transform.cell_x;
      const double dy = (at / width - y) * dem.transform.cell_y;
      depth(x, y) = static_cast<float>(std::sqrt(dx * dx + dy * dy));
    }
  // For each lake: the maximum distance from the shore, then depths from distances.
  each_piece(lakes, 1, [&](const std::vector<std::int32_t>& lake) {
    float farthest = 0.F;
    for (const std::int32_t i : lake)
      farthest = std::max(farthest, depth[static_cast<std::size_t>(i)]);
    const auto deepest = static_cast<float>(std::min(
        parameters.deepest_m, 0.5 * parameters.shore_slope * static_cast<double>(farthest)));
    for (const std::int32_t i : lake) {
      float& at = depth[static_cast<std::size_t>(i)];
      const float left = farthest > 0.F ? 1.F - at / farthest : 1.F;
      at = deepest * (1.F - left * left);
    }
  });
  return depth;
}

}  // namespace belvedere
