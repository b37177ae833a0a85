#include "terrain/layers/fit/textured_layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/grid.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/random.h"
#include "terrain/layers/layer_coverage.h"

namespace belvedere {
namespace {

double mean_channel(const glm::dvec3& rgb) { return (rgb.x + rgb.y + rgb.z) / 3.0; }

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

glm::dvec3 channels_of(std::uint32_t rgb) {
  return glm::dvec3(rgb >> 16U & 255U, rgb >> 8U & 255U, rgb & 255U);
}

// A top-level layer with its children, which paint one class.
struct ClassLayers {
  std::size_t class_index = 0;
  std::size_t begin = 0;
  std::size_t end = 0;
  std::vector<std::size_t> cells;  // of the class, columns of the coverages
};

// Variance of the lightness of a class's cells as a quadratic in the factor by which its colours
// are moved apart about their mean: a f² + b f + c.
struct LightnessVariance {
  glm::dvec3 mean{0.0};
  double a = 0.0;
  double b = 0.0;
  double c = 0.0;
};
LightnessVariance lightness_variance(const SurfaceLayers& layers, const ClassLayers& own,
                                     const std::vector<Grid<float>>& seen) {
  LightnessVariance out;
  double area = 1e-12;
  for (std::size_t l = own.begin; l != own.end; ++l)
    for (const std::size_t i : own.cells) {
      out.mean += static_cast<double>(seen[l + 1][i]) * channels_of(layers.layers[l].rgb);
      area += static_cast<double>(seen[l + 1][i]);
    }
  out.mean /= area;
  const double mean = mean_channel(out.mean);
  glm::dvec2 sums(0.0);
  for (const std::size_t i : own.cells) {
    double around = static_cast<double>(seen[0][i]) * mean_channel(channels_of(layers.ground_rgb));
    double apart = 0.0;
    for (std::size_t l = 0; l != layers.layers.size(); ++l) {
      const auto share = static_cast<double>(seen[l + 1][i]);
      const double lightness = mean_channel(channels_of(layers.layers[l].rgb));
      const bool moved = l >= own.begin && l < own.end;
      around += share * (moved ? mean : lightness);
      if (moved) apart += share * (lightness - mean);
    }
    sums += glm::dvec2(around, apart);
    out.a += apart * apart;
    out.b += 2.0 * around * apart;
    out.c += around * around;
  }
  const auto count = static_cast<double>(own.cells.size());
  sums /= count;
  out.a = out.a / count - sums.y * sums.y;
  out.b = out.b / count - 2.0 * sums.x * sums.y;
  out.c = out.c / count - sums.x * sums.x;
  return out;
}

// Moves the colours of a class apart so that lightness varies as in the picture, at most threefold
// and within the picture's range.
void spread_colours(std::vector<SurfaceLayer>& layers, const ClassLayers& own,
                    const LightnessVariance& variance, const ClassTexture& texture) {
  const auto& [mean, a, b, c] = variance;
  const double lacking = square(texture.deviation) - c;
  if (!(a > 1e-6) || a + b >= lacking) return;
  double factor = std::min(3.0, (std::sqrt(b * b + 4.0 * a * lacking) - b) / (2.0 * a));
  for (std::size_t l = own.begin; l != own.end; ++l)
    for (int k = 0; k != 3; ++k) {
      const double apart = channels_of(layers[l].rgb)[k] - mean[k];
      const double limit = texture.range[static_cast<std::size_t>(k)][apart > 0.0 ? 1 : 0];
      if (std::abs(apart) > 1e-6)
        factor = std::min(factor, std::max(1.0, (limit - mean[k]) / apart));
    }
  for (std::size_t l = own.begin; l != own.end; ++l) {
    const glm::dvec3 moved = mean + factor * (channels_of(layers[l].rgb) - mean);
    layers[l].rgb = 0;
    for (int k = 0; k != 3; ++k)
      layers[l].rgb = layers[l].rgb << 8U |
                      static_cast<std::uint32_t>(std::clamp(std::round(moved[k]), 0.0, 255.0));
  }
}

// The bumps of a product's ground lie under all classes: the others add what they lack. They are of
// the layer that covers the class, or of all that divide it.
void add_bumps(SurfaceLayers& layers, const std::vector<ClassLayers>& classes,
               const std::vector<ClassTexture>& textures, double cell_m) {
  const bool product = layers.model == LayerModel::product;
  double base = 0.0;
  for (const ClassLayers& own : classes) {
    const double wanted = textures[own.class_index].roughness_m;
    const bool first = own.begin == 0;
    if (first && product) base = wanted;
    const double height =
        std::sqrt(std::max(0.0, square(wanted) - (product && !first ? square(base) : 0.0)));
    for (std::size_t l = own.begin; height > 0.0 && l != (product ? own.begin + 1 : own.end); ++l) {
      layers.layers[l].roughness_m = std::round(100.0 * height) / 100.0;
      layers.layers[l].roughness_scale_m = cell_m;
    }
  }
}

// Noise of a class's layers, `louder` times as strong as its texture asks where coverage has no
// bounds.
void add_noise(SurfaceLayers& layers, const ClassLayers& own, const ClassTexture& texture,
               const LayerEffects& effects, double louder) {
  constexpr double most = 4.0;  // relative deviation: patches with sharp borders
  const auto rounded = [](double value) { return std::round(1e5 * value) / 1e5; };
  const std::uint64_t seed = stream_seed(0, Stream::layers_fit, 20);
  double energy = 0.0;
  for (const std::size_t i : own.cells)
    for (std::size_t l = own.begin; l != own.end; ++l)
      energy += square((1.0 - effects.fullness[l]) * effects.of_layer[l][i]);
  if (!(texture.strength > 0.0) || !(energy > 0.0)) return;
  const double loud =
      louder * texture.strength / std::sqrt(energy / static_cast<double>(own.cells.size()));
  for (std::size_t l = own.begin; l != own.end; ++l) {
    LayerNoise& noise = layers.layers[l].noise;
    const double bias = noise.bias;
    const double full = effects.fullness[l];
    LayerNoise made = texture.noise;
    const double spread = noise_deviation(made);
    const double deviation = std::min(most, loud * (1.0 - full) * spread);
    if (!(deviation >= 0.02)) continue;
    const double varied = random_uniform(seed, static_cast<std::int64_t>(l), 0) - 0.5;
    made.scale_m = std::round(10.0 * made.scale_m * exact::exp2(varied)) / 10.0;
    if (layers.model == LayerModel::product) {
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

}  // namespace

SurfaceLayers with_textures(SurfaceLayers layers, const KnownGround& ground, const GroundFit& fit,
                            const std::vector<ClassTexture>& textures) {
  constexpr std::size_t max = 20'000;
  if (!ground.picture) return layers;
  const std::vector<std::uint32_t> some = draw_labelled(ground.labels, max, 5);
  const int count = static_cast<int>(some.size());
  std::vector<Grid<float>> inputs(ground.inputs.size(), Grid<float>(count, 1));
  for (std::size_t a = 0; a != inputs.size(); ++a)
    for (std::size_t i = 0; i != some.size(); ++i) inputs[a][i] = ground.inputs[a][some[i]];
  const LayerProgram program = compile_layers(layers);
  const LayerEffects effects =
      layer_effects(program, layer_coverage(program, inputs, {}, {0, 0, count, 1}, 0));
  std::vector<ClassLayers> classes;
  for (std::size_t begin = 0, end = 0; begin != layers.layers.size(); begin = end) {
    for (end = begin + 1; end != layers.layers.size() && layers.layers[end].parent >= 0;) ++end;
    classes.push_back(
        {static_cast<std::size_t>(fit.classes.order[classes.size()]), begin, end, {}});
    for (std::size_t i = 0; i != some.size(); ++i)
      if (ground.labels[some[i]] == classes.back().class_index) classes.back().cells.push_back(i);
  }
  add_bumps(layers, classes, textures, ground.cell_m);
  // Noise as strong as if coverage had no bounds; then stronger, by what bounds took away.
  const SurfaceLayers smooth = layers;
  std::vector<double> louder(classes.size(), 1.0);
  const GeoTransform line = {0.0, 0.0, ground.cell_m, ground.cell_m};  // of cells side by side
  for (int round = 0;; ++round) {
    layers = smooth;
    for (std::size_t n = 0; n != classes.size(); ++n)
      add_noise(layers, classes[n], textures[classes[n].class_index], effects, louder[n]);
    const LayerProgram noisy = compile_layers(layers);
    const std::vector<Grid<float>> seen =
        layer_shares(noisy, layer_coverage(noisy, inputs, line, {0, 0, count, 1}, 0));
    for (std::size_t n = 0; n != classes.size(); ++n) {
      if (classes[n].cells.empty()) continue;
      const ClassTexture& texture = textures[classes[n].class_index];
      const LightnessVariance variance = lightness_variance(layers, classes[n], seen);
      const double made = std::sqrt(std::max(1e-6, variance.a + variance.b + variance.c));
      if (round != 3)
        louder[n] *= std::clamp(texture.deviation / made, 1.0, 2.0);
      else
        spread_colours(layers.layers, classes[n], variance, texture);
    }
    if (round == 3) break;
  }
  check_surface_layers(layers, layers.name);
  return layers;
}

}  // namespace belvedere
