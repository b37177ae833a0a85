#include "terrain/layers/fit/fit_texture.h"

#include <algorithm>
#include <array>
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
namespace {

constexpr std::size_t levels = 5;  // of blocks, 1…16 cells along a side
// The finest blocks count little: what a sensor adds to single cells is not the ground's.
constexpr std::array<double, levels> block_weight = {1.0, 4.0, 4.0, 2.0, 1.0};
using Energies = std::array<double, levels>;  // NaN: unknown

double lightness_of(const glm::vec3& rgb) {
  return (static_cast<double>(rgb.x) + static_cast<double>(rgb.y) + static_cast<double>(rgb.z)) /
         3.0;
}

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

// As LayerNoise: the factor 2 over the sum of the weights.
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

// The factor by which noise of a relative deviation must raise a coverage so that its mean between
// 0 and 1 stays.
double kept_mean_factor(double coverage, double deviation) {
  constexpr std::size_t steps = 81;  // from -4 to 4 standard deviations
  std::array<double, steps> values{};
  std::array<double, steps> weights{};
  double total = 0.0;
  for (std::size_t i = 0; i != steps; ++i) {
    values[i] = 0.1 * static_cast<double>(i) - 4.0;
    total += weights[i] = exact::exp(-0.5 * square(values[i]));
  }
  double low = 0.25;
  double high = 4.0;
  for (int halving = 0; halving != 30; ++halving) {
    const double factor = 0.5 * (low + high);
    double mean = 0.0;
    for (std::size_t i = 0; i != steps; ++i)
      mean += weights[i] / total * unit(factor * coverage * (1.0 + deviation * values[i]));
    (mean < coverage ? low : high) = factor;
  }
  return 0.5 * (low + high);
}

// Standard deviation of layer noise.
double noise_deviation(const LayerNoise& noise) {
  constexpr double octave_variance = 0.0765;  // 1/3 (151/315)², of lattice values under B-splines
  double squares = 0.0;
  for (const double weight : octave_weights(noise.octaves, noise.gain)) squares += square(weight);
  return std::sqrt(octave_variance * squares);
}

// Effect of a relative change of each layer's coverage on the lightness of some cells, and the
// layer's mean coverage where it lies, as a share of its parent's.
struct LayerEffects {
  std::vector<std::vector<double>> of_layer;  // [layer][cell]
  std::vector<double> fullness;               // [layer]
};
LayerEffects layer_effects(const LayerProgram& program, const std::vector<Grid<float>>& coverage) {
  const std::vector<SurfaceLayer>& layers = program.layers.layers;
  const std::size_t count = layers.size();
  const std::size_t cells = coverage[0].size();
  const bool sum = program.layers.model == LayerModel::additive;
  const std::vector<Grid<float>> seen = layer_shares(program, coverage);
  const auto lightness = [](std::uint32_t rgb) {
    return static_cast<double>((rgb >> 16U & 255U) + (rgb >> 8U & 255U) + (rgb & 255U)) / 3.0;
  };
  LayerEffects out{std::vector(count, std::vector<double>(cells, 0.0)),
                   std::vector<double>(count, 0.0)};
  std::vector<double> squares(count, 0.0);
  std::vector<double> sums(count, 1e-12);
  std::vector<double> area(count);   // visible, with children
  std::vector<double> shown(count);  // times lightness
  std::vector<double> under(count);  // lightness before the layer
  for (std::size_t i = 0; i != cells; ++i) {
    double colour = lightness(program.layers.ground_rgb);
    double all = static_cast<double>(seen[0][i]) * colour;
    for (std::size_t k = 0; k != count; ++k) {
      const double own = lightness(layers[k].rgb);
      area[k] = static_cast<double>(seen[k + 1][i]);
      shown[k] = area[k] * own;
      all += shown[k];
      under[k] = colour;
      if (program.paints[k]) colour += static_cast<double>(coverage[k][i]) * (own - colour);
    }
    for (std::size_t k = count; k-- > 0;)
      if (layers[k].parent >= 0) {
        const auto parent = static_cast<std::size_t>(layers[k].parent);
        area[parent] += area[k];
        shown[parent] += shown[k];
      }
    for (std::size_t k = 0; k != count; ++k) {
      const bool child = layers[k].parent >= 0;
      const auto parent = static_cast<std::size_t>(std::max(layers[k].parent, 0));
      // Siblings of a sum share their parent's ground.
      const double whole = !child ? 1.0
                           : sum  ? area[parent]
                                  : static_cast<double>(coverage[parent][i]);
      const double beside = !sum          ? under[k]
                            : !child      ? all
                            : whole > 0.0 ? shown[parent] / whole
                                          : 0.0;
      const double covered =
          whole > 0.0 ? (sum ? area[k] : static_cast<double>(coverage[k][i])) / whole : 0.0;
      out.of_layer[k][i] = shown[k] - area[k] * beside;
      sums[k] += covered;
      squares[k] += covered * covered;
    }
  }
  for (std::size_t k = 0; k != count; ++k) out.fullness[k] = squares[k] / sums[k];
  return out;
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

SurfaceLayers with_textures(SurfaceLayers layers, const KnownGround& ground, const GroundFit& fit,
                            const std::vector<ClassTexture>& textures) {
  constexpr std::size_t max = 20'000;
  const auto rounded = [](double value) { return std::round(1e5 * value) / 1e5; };
  if (!ground.picture) return layers;
  const std::vector<std::uint32_t> some = draw_labelled(ground.labels, max, 5);
  const int count = static_cast<int>(some.size());
  std::vector<Grid<float>> inputs(ground.inputs.size(), Grid<float>(count, 1));
  for (std::size_t a = 0; a != inputs.size(); ++a)
    for (std::size_t i = 0; i != some.size(); ++i) inputs[a][i] = ground.inputs[a][some[i]];
  const LayerProgram program = compile_layers(layers);
  const LayerEffects effects =
      layer_effects(program, layer_coverage(program, inputs, {}, {0, 0, count, 1}, 0));
  const std::uint64_t seed = stream_seed(0, Stream::layers_fit, 20);
  std::size_t rank = 0;
  double base = 0.0;  // height of the bumps of a product's ground
  for (std::size_t begin = 0, end = 0; begin != layers.layers.size(); begin = end, ++rank) {
    for (end = begin + 1; end != layers.layers.size() && layers.layers[end].parent >= 0;) ++end;
    const auto k = static_cast<std::size_t>(fit.classes.order[rank]);
    const ClassTexture& texture = textures[k];
    double energy = 0.0;
    double cells = 0.0;
    for (std::size_t i = 0; i != some.size(); ++i) {
      if (ground.labels[some[i]] != k) continue;
      cells += 1.0;
      for (std::size_t l = begin; l != end; ++l)
        energy += square((1.0 - effects.fullness[l]) * effects.of_layer[l][i]);
    }
    // Bumps of a product's ground lie under all classes: the others add what they lack.
    const bool product = layers.model == LayerModel::product;
    if (rank == 0 && product) base = texture.roughness_m;
    const double height = std::sqrt(
        std::max(0.0, square(texture.roughness_m) - (product && rank > 0 ? square(base) : 0.0)));
    // They are of the layer that covers the class, or of all that divide it.
    for (std::size_t l = begin; height > 0.0 && l != (product ? begin + 1 : end); ++l) {
      layers.layers[l].roughness_m = std::round(100.0 * height) / 100.0;
      layers.layers[l].roughness_scale_m = ground.cell_m;
    }
    if (!(texture.strength > 0.0) || !(energy > 0.0)) continue;
    const double loud = texture.strength / std::sqrt(energy / cells);
    for (std::size_t l = begin; l != end; ++l) {
      LayerNoise& noise = layers.layers[l].noise;
      const double bias = noise.bias;
      const double full = effects.fullness[l];
      LayerNoise made = texture.noise;
      const double spread = noise_deviation(made);
      const double deviation = std::min(product ? 1.5 : 1.2, loud * (1.0 - full) * spread);
      if (!(deviation >= 0.02)) continue;
      const double varied = random_uniform(seed, static_cast<std::int64_t>(l), 0) - 0.5;
      made.scale_m = std::round(10.0 * made.scale_m * exact::exp2(varied)) / 10.0;
      if (product) {
        made.bias = rounded(bias * kept_mean_factor(std::clamp(full, 0.02, 0.98), deviation));
        made.amplitude = rounded(made.bias * deviation / spread);
      } else {
        // e^noise has a mean of its own where a layer is rare.
        made.bias = rounded(bias - 0.5 * square(deviation) * std::max(0.0, 1.0 - 2.0 * full));
        made.amplitude = rounded(deviation / spread);
      }
      noise = made;
    }
  }
  check_surface_layers(layers, layers.name);
  return layers;
}

}  // namespace belvedere
