#include "terrain/layers/layer_drawing.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/error.h"
#include "base/math_exact.h"
#include "base/random.h"
#include "terrain/layers/layer_noise.h"

namespace belvedere {
namespace {

constexpr auto class_count = static_cast<std::size_t>(land_cover_class_count);

// -ln Φ(n), Φ the normal distribution: turns a standard normal number into an exponentially
// distributed one. The largest of ln(p) + Gumbel is the smallest of exponential / p, which avoids
// another logarithm per cell.
class ExponentialOfNormal {
 public:
  ExponentialOfNormal() {
    // Φ by Simpson's rule with fine steps from -12, where it is 2e-33; the upper half by symmetry,
    // so that it stays exact near 1.
    constexpr int fine = 64;
    constexpr double step = 1.0 / per_unit;
    const auto density = [](double x) { return exact::exp(-0.5 * x * x) * 0.3989422804014327; };
    double sum = 1.776e-33;
    const int before = (12 - reach) * per_unit;
    std::vector<double> tail;  // Φ(-reach + i · step), up to 0
    for (int i = 0; i <= reach * per_unit + before; ++i) {
      if (i >= before) tail.push_back(sum);
      for (int k = 0; k < fine; ++k) {
        const double a = -12.0 + (i + static_cast<double>(k) / fine) * step;
        const double h = step / fine;
        sum += h / 6.0 * (density(a) + 4.0 * density(a + 0.5 * h) + density(a + h));
      }
    }
    for (std::size_t i = 0; i < tail.size(); ++i)
      values_.push_back(static_cast<float>(-exact::log(tail[i])));
    for (std::size_t i = tail.size() - 1; i-- > 0;) {
      const double q = tail[i];
      values_.push_back(
          static_cast<float>(q < 1e-4 ? q + 0.5 * q * q + q * q * q / 3.0 : -exact::log(1.0 - q)));
    }
    values_.push_back(values_.back());
  }
  float operator()(float n) const {
    const float at = (std::clamp(n, -static_cast<float>(reach), static_cast<float>(reach)) +
                      static_cast<float>(reach)) *
                     per_unit;
    const auto i = static_cast<std::size_t>(at);
    const float part = at - static_cast<float>(i);
    return values_[i] + part * (values_[i + 1] - values_[i]);
  }

 private:
  static constexpr int reach = 6;
  static constexpr int per_unit = 128;
  std::vector<float> values_;
};

float sharpened(float share, double power) {
  if (power == 1.0) return share;
  if (power == 2.0) return share * share;
  if (!(share > 0.F)) return 0.F;
  return static_cast<float>(exact::pow(static_cast<double>(share), power));
}

}  // namespace

void check_layer_drawing(const LayerDrawingParameters& parameters) {
  const auto range = [](const char* name, double value, double low, double high) {
    if (!(value >= low) || !(value <= high))
      throw Error(ErrorKind::usage, name, fmt::format("{}", value),
                  fmt::format("{}…{}", low, high));
  };
  range("power", parameters.power, 1.0, 4.0);
  range("finest_cells", parameters.finest_cells, 0.3, 8.0);
  range("octaves", parameters.octaves, 1.0, 10.0);
  range("spectrum", parameters.spectrum, 0.0, 4.0);
}

LayerDrawing plan_layer_drawing(const LayerDrawingParameters& parameters,
                                const std::vector<Grid<float>>& samples) {
  check_layer_drawing(parameters);
  LayerDrawing drawing{parameters, {}};
  drawing.factor.fill(1.F);
  if (parameters.power == 1.0 || samples.empty()) return drawing;
  // Shares of the classes, their means, and the sharpened shares of each sample.
  std::vector<std::size_t> present;
  for (std::size_t k = 1; k < class_count; ++k)
    if (std::any_of(samples[k].begin(), samples[k].end(), [](float p) { return p > 0.F; }))
      present.push_back(k);
  if (present.empty()) return drawing;
  const std::size_t classes = present.size();
  std::vector<double> wanted(classes, 0.0);
  std::vector<double> sharp;
  std::size_t count = 0;
  for (std::size_t i = 0; i < samples[1].size(); ++i) {
    double sum = 0.0;
    for (const std::size_t k : present) sum += static_cast<double>(samples[k][i]);
    if (!(sum > 0.0)) continue;
    ++count;
    for (std::size_t c = 0; c < classes; ++c) {
      const double share = static_cast<double>(samples[present[c]][i]) / sum;
      wanted[c] += share;
      sharp.push_back(static_cast<double>(sharpened(static_cast<float>(share), parameters.power)));
    }
  }
  std::vector<double> factor(classes, 1.0);
  std::vector<double> drawn(classes);
  // Each step covers half the distance in logarithms and cannot overshoot; 80 steps give at least
  // three digits.
  for (int step = 0; step < 80; ++step) {
    std::fill(drawn.begin(), drawn.end(), 0.0);
    for (std::size_t i = 0; i < count; ++i) {
      const double* q = sharp.data() + i * classes;
      double sum = 0.0;
      for (std::size_t c = 0; c < classes; ++c) sum += q[c] * factor[c];
      for (std::size_t c = 0; c < classes; ++c) drawn[c] += q[c] * factor[c] / sum;
    }
    for (std::size_t c = 0; c < classes; ++c)
      factor[c] *= std::sqrt(wanted[c] / (drawn[c] + 1e-9 * static_cast<double>(count)));
  }
  for (std::size_t c = 0; c < classes; ++c)
    drawing.factor[present[c]] = static_cast<float>(factor[c]);
  return drawing;
}

Grid<LandCoverClass> draw_classes(const LayerDrawing& drawing,
                                  const std::vector<Grid<float>>& shares,
                                  const GeoTransform& transform, const PixelRect& cells) {
  static const ExponentialOfNormal exponential;
  const LayerDrawingParameters& parameters = drawing.parameters;
  const double cell = 0.5 * (transform.cell_x + transform.cell_y);
  std::vector<LayerNoiseRows::GaussianOctave> octaves;
  double squares = 0.0;
  for (int i = 0; i < parameters.octaves; ++i) {
    const double size = exact::exp2(i);
    octaves.push_back(
        {cell * parameters.finest_cells * size, exact::pow(size, 0.5 * parameters.spectrum), 0});
    squares += octaves.back().weight * octaves.back().weight;
  }
  for (LayerNoiseRows::GaussianOctave& octave : octaves) octave.weight /= std::sqrt(squares);

  Grid<LandCoverClass> out(cells.width(), cells.height(), LandCoverClass::sky);
  Grid<float> min(cells.width(), cells.height(), std::numeric_limits<float>::infinity());
  const auto width = static_cast<std::size_t>(cells.width());
  std::vector<float> noise(width);
  for (std::size_t k = 1; k < class_count; ++k) {
    if (std::all_of(shares[k].begin(), shares[k].end(), [](float p) { return !(p > 0.F); }))
      continue;
    for (std::size_t i = 0; i < octaves.size(); ++i)
      octaves[i].seed = stream_seed(parameters.seed, Stream::class_noise, 100 * (k + 1) + i);
    LayerNoiseRows rows(octaves, transform, cells);
    for (int y = 0; y < cells.height(); ++y) {
      const float* share = shares[k].row(y);
      if (std::all_of(share, share + width, [](float p) { return !(p > 0.F); })) continue;
      rows.fill(cells.y0 + y, noise.data());
      for (std::size_t x = 0; x < width; ++x) {
        if (!(share[x] > 0.F)) continue;
        const float late =
            exponential(noise[x]) / (drawing.factor[k] * sharpened(share[x], parameters.power));
        float& first = min(static_cast<int>(x), y);
        if (late < first) {
          first = late;
          out(static_cast<int>(x), y) = static_cast<LandCoverClass>(k);
        }
      }
    }
  }
  return out;
}

}  // namespace belvedere
