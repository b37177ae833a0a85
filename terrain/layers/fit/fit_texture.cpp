#include "terrain/layers/fit/fit_texture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/grid.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/random.h"
#include "terrain/layers/layer_coverage.h"

namespace belvedere {

std::vector<double> octave_weights(int octaves, double gain) {
  std::vector<double> weights;
  double sum = 0.0;
  double weight = 1.0;
  for (int i = 0; i != octaves; ++i, weight *= gain) {
    weights.push_back(weight);
    sum += weight;
  }
  for (double& w : weights) w *= 2.0 / sum;
  return weights;
}

namespace {

constexpr std::size_t levels = 5;  // of blocks, 1…16 cells along a side
// The finest blocks count little: what a sensor adds to single cells is not the ground's.
constexpr std::array<double, levels> block_weight = {1.0, 4.0, 4.0, 2.0, 1.0};
using Energies = std::array<double, levels>;  // NaN: unknown

double lightness_of(const glm::dvec3& rgb) { return (rgb.x + rgb.y + rgb.z) / 3.0; }

// Mean squared difference of neighbouring blocks whose cells all have a value (not NaN).
Energies block_energies(Grid<float> values) {
  constexpr double fewest = 50.0;  // pairs of blocks
  Energies energies;
  energies.fill(std::numeric_limits<double>::quiet_NaN());
  for (double& energy : energies) {
    double sum = 0.0;
    double pairs = 0.0;
    for (int y = 0; y < values.height(); ++y)
      for (int x = 0; x < values.width(); ++x)
        for (const auto& [x2, y2] : {std::pair{x + 1, y}, std::pair{x, y + 1}}) {
          if (!values.contains(x2, y2)) continue;
          const auto step = static_cast<double>(values(x2, y2) - values(x, y));
          if (std::isnan(step)) continue;
          sum += step * step;
          pairs += 1.0;
        }
    if (pairs < fewest) break;
    energy = sum / pairs;
    Grid<float> half(values.width() / 2, values.height() / 2);
    for (int y = 0; y < half.height(); ++y)
      for (int x = 0; x < half.width(); ++x)
        half(x, y) = 0.25F * (values(2 * x, 2 * y) + values(2 * x + 1, 2 * y) +
                              values(2 * x, 2 * y + 1) + values(2 * x + 1, 2 * y + 1));
    values = std::move(half);
  }
  return energies;
}

// Autocorrelation of the cubic B-spline: the B-spline of degree 7.
double spline_correlation(double x) {
  constexpr std::array<double, 9> binomial = {1, -8, 28, -56, 70, -56, 28, -8, 1};
  if (std::abs(x) >= 4.0) return 0.0;
  double sum = 0.0;
  for (int k = 0; k < 9; ++k) {
    const double t = x + 4.0 - k;
    if (t <= 0.0) break;
    const double t2 = t * t;
    sum += binomial[static_cast<std::size_t>(k)] * t2 * t2 * t2 * t;
  }
  return sum / 5040.0;
}

// The energy of one octave of layer noise of weight 1, in blocks of `block` points, its lattice
// `spacing` points wide. Lattice values have a variance of 1/3.
double octave_energy(int block, double spacing) {
  const auto covariance = [&](int lag) {
    double sum = 0.0;
    for (int a = 1 - block; a < block; ++a)
      sum += (block - std::abs(a)) * spline_correlation((lag + a) / spacing);
    return sum / (static_cast<double>(block) * block);
  };
  const double own = covariance(0);
  return 2.0 / 3.0 * own * (own - covariance(block));
}

// Octaves from 2^coarsest cells down to an eighth of a cell.
constexpr int finest_octave = -3;
constexpr int coarsest_octave = 6;
using OctaveEnergies =
    std::array<Energies, static_cast<std::size_t>(coarsest_octave - finest_octave + 1)>;
OctaveEnergies all_octave_energies() {
  constexpr int points = 4;  // along a cell
  OctaveEnergies table{};
  for (std::size_t i = 0; i != table.size(); ++i)
    for (std::size_t j = 0; j != levels; ++j)
      // Cells of a picture are means of what they cover.
      table[i][j] =
          octave_energy(points << j, points * exact::exp2(finest_octave + static_cast<int>(i)));
  return table;
}

// Scale, octaves and gain whose energies have the shape of these, and the factor on its values.
ClassTexture fit_spectrum(const Energies& energies, double cell_m) {
  constexpr int steps = 53;  // of the gain, .3…1.6
  static const OctaveEnergies table = all_octave_energies();
  ClassTexture best;
  double min = std::numeric_limits<double>::infinity();
  for (int coarsest = 2; coarsest <= coarsest_octave; ++coarsest)
    for (int step = 0; step != steps; ++step) {
      const double gain = 0.3 + 0.025 * step;
      const int octaves = coarsest - finest_octave + 1;
      const std::vector<double> weights = octave_weights(octaves, gain);
      std::array<double, levels> ratio{};
      double total = 0.0;
      double mean = 0.0;
      for (std::size_t j = 0; j != levels; ++j) {
        if (!(energies[j] > 0.0)) continue;
        double model = 0.0;
        for (int i = 0; i != octaves; ++i) {
          const auto at = static_cast<std::size_t>(coarsest - i - finest_octave);
          const double weight = weights[static_cast<std::size_t>(i)];
          model += weight * weight * table[at][j];
        }
        ratio[j] = exact::log(energies[j] / model);
        mean += block_weight[j] * ratio[j];
        total += block_weight[j];
      }
      mean /= total;
      double off = 0.0;
      for (std::size_t j = 0; j != levels; ++j)
        if (energies[j] > 0.0) off += block_weight[j] * square(ratio[j] - mean);
      if (off >= min) continue;
      min = off;
      best.noise = {std::round(10.0 * cell_m * exact::exp2(coarsest)) / 10.0, octaves, 0.0, 1.0,
                    std::round(1000.0 * gain) / 1000.0};
      best.strength = std::sqrt(exact::exp(mean));
    }
  return best;
}

// Share of the brightness of a class that its response to light explains, and the gain, as means of
// the channels.
struct LightShare {
  double share = 0.0;
  double gain = 0.0;
};
LightShare light_share(const KnownGround& ground, const Grid<float>& light,
                       const std::array<LightAnswer, 3>& answer, std::size_t of) {
  double count = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  double lit = 0.0;
  double lit_squares = 0.0;
  for (std::size_t i = 0; i != light.size(); ++i) {
    if (ground.labels[i] != of || !(light[i] > 0.05F)) continue;
    const double brightness = lightness_of(ground.picture->rgb[i]);
    const auto cosine = static_cast<double>(light[i]);
    count += 1.0;
    sum += brightness;
    squares += brightness * brightness;
    lit += cosine;
    lit_squares += cosine * cosine;
  }
  LightShare out;
  out.gain = (answer[0].gain + answer[1].gain + answer[2].gain) / 3.0;
  if (count < 1.0 || !(out.gain > 0.0)) return {};
  const double variance = squares / count - square(sum / count);
  const double of_light = square(out.gain) * (lit_squares / count - square(lit / count));
  out.share = variance > 0.0 ? std::clamp(of_light / variance, 0.0, 1.0) : 0.0;
  return out;
}

// Deviation and range of a class's colours in the evenly lit picture.
void measure_colours(const Grid<glm::vec3>& even, const Grid<float>& light,
                     const std::vector<std::uint8_t>& labels, std::size_t of,
                     ClassTexture& texture) {
  std::array<std::vector<float>, 3> values;
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i != even.size(); ++i) {
    if (labels[i] != of || !(light[i] > 0.05F)) continue;
    for (int c = 0; c != 3; ++c) values[static_cast<std::size_t>(c)].push_back(even[i][c]);
    sum += lightness_of(even[i]);
    squares += square(lightness_of(even[i]));
  }
  const auto count = static_cast<double>(values[0].size());
  if (!(count > 0.0)) return;
  texture.deviation = std::sqrt(std::max(0.0, squares / count - square(sum / count)));
  for (std::size_t c = 0; c != 3; ++c)
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
      const auto at =
          values[c].begin() + static_cast<std::ptrdiff_t>((end == 0 ? 0.02 : 0.98) * (count - 1.0));
      std::nth_element(values[c].begin(), at, values[c].end());
      texture.range[c][end] = static_cast<double>(*at);
    }
}

}  // namespace

std::vector<ClassTexture> class_textures(const KnownGround& ground, const GroundFit& fit,
                                         const GroundPrediction& prediction) {
  // Slope of one octave of bumps per length and height: √(1/3 · 151/315 · 2/3), times 2 over the
  // sum of the weights of four.
  constexpr double bump_slope_share = 0.348;
  constexpr double steepest = 0.25;  // rise over run of an octave of bumps
  std::vector<ClassTexture> textures(ground.classes.size());
  if (!ground.picture) return textures;
  const Grid<float> light = sunlight(ground.altitude_m, ground.cell_m, fit.sun);
  const double elevation = to_radians(fit.sun.elevation_deg);
  const Grid<glm::vec3> even =
      lit_evenly(ground.picture->rgb, light, exact::sin(elevation), ground.labels, fit.light);
  for (std::size_t k = 0; k != textures.size(); ++k) {
    Grid<float> rest(light.width(), light.height(), std::numeric_limits<float>::quiet_NaN());
    for (std::size_t i = 0; i != rest.size(); ++i)
      if (ground.labels[i] == k && light[i] > 0.05F)
        rest[i] = static_cast<float>(lightness_of(even[i]) - lightness_of(prediction.even[i]));
    const Energies energies = block_energies(std::move(rest));
    if (!(energies[0] > 0.0) || !(energies[1] > 0.0)) continue;
    textures[k] = fit_spectrum(energies, ground.cell_m);
    measure_colours(even, light, ground.labels, k, textures[k]);
    const LightShare lit = light_share(ground, light, fit.light[k], k);
    textures[k].strength *= std::sqrt(1.0 - lit.share);
    if (!(lit.share > 0.0)) continue;
    // The light of an octave of slopes: gain · cos(elevation) · slope. A difference of neighbours
    // has about twice the variance of the finest octave seen; bumps continue it below a cell.
    const double slope = std::min(steepest, std::sqrt(0.5 * energies[0] * lit.share) /
                                                (lit.gain * std::max(0.1, exact::cos(elevation))));
    textures[k].roughness_m = std::round(100.0 * slope * ground.cell_m / bump_slope_share) / 100.0;
  }
  return textures;
}

}  // namespace belvedere
