#include "renderer/exemplar/light/painting_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

#include "base/masks/label_blur.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/pixel_rect.h"
#include "base/statistics.h"
#include "renderer/image/srgb.h"
#include "renderer/trace/light_field.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {
namespace {

constexpr double sun_step_deg = 6.0;
constexpr double lowest_sun_deg = 18.0;
constexpr double highest_sun_deg = 60.0;
constexpr double opposite_deg = 75.0;    // of azimuth: another sun, not the same one with an error
constexpr double sun_sharpness = 0.004;  // of the weighted mean, share of variance
constexpr double clip_deviations = 2.5;
constexpr double normal_deviation = 1.4826;  // standard deviation per median absolute deviation
constexpr std::size_t min_region_pixels = 300;
constexpr std::size_t min_class_pixels = 60;
// Light of an open sky, of that of the sun that a slope faces. That of the sky view is
// LightParameters' .30 to .80, somewhat more as painters fill shade with light.
constexpr double sky_light = 0.6;

// Regression sample of a pixel.
struct LightSample {
  std::size_t label;
  double lightness;
  double altitude_km;
  double log_distance;
  glm::dvec3 normal;
  double sky;  // light of the sky
};

// The pictures that samples are read from.
struct LightFields {
  Grid<float> lightness;
  std::array<Grid<float>, 3> normal;
};

LightFields blurred_fields(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& labels,
                           const GuidanceBuffers& guidance, double blur_px) {
  LightFields out;
  const auto channel = [&](auto&& value) {
    Grid<float> grid(labels.width(), labels.height(), 0.F);
    parallel_rows(grid.height(), [&](int y) {
      for (std::size_t i = grid.index(0, y); i < grid.index(0, y + 1); ++i)
        grid[i] = static_cast<float>(value(i));
    });
    return blur_px > 0.0 ? blur_within_labels(grid, labels, blur_px) : grid;
  };
  out.lightness = channel([&](std::size_t i) { return to_oklab(picture[i]).x; });
  for (int c = 0; c < 3; ++c)
    out.normal[static_cast<std::size_t>(c)] =
        channel([&](std::size_t i) { return guidance.normal[i][c]; });
  return out;
}

// Pixels of a rectangle, evenly spaced.
std::vector<LightSample> light_samples(const LightFields& fields, const Grid<std::uint8_t>& labels,
                                       const GuidanceBuffers& guidance, PixelRect rect,
                                       std::size_t max) {
  const auto counts = [&](std::size_t i) {
    return labels[i] != unused_label && !guidance.is_sky(i);
  };
  std::vector<std::size_t> used;
  for (int y = rect.y0; y < rect.y1; ++y)
    for (std::size_t i = labels.index(rect.x0, y);
         i < labels.index(rect.x0, y) + static_cast<std::size_t>(rect.width()); ++i)
      if (counts(i)) used.push_back(i);
  const bool seen = has_channel(guidance, &GuidanceBuffers::sky_view);
  std::vector<LightSample> out;
  const std::size_t count = std::min(max, used.size());
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = used[k * used.size() / count];
    const glm::dvec3 mean(fields.normal[0][i], fields.normal[1][i], fields.normal[2][i]);
    const double length = glm::length(mean);
    if (!(length > 0.0)) continue;
    const glm::dvec3 normal = mean / length;
    const double open = seen ? static_cast<double>(guidance.sky_view[i]) : 1.0;
    out.push_back({labels[i], static_cast<double>(fields.lightness[i]),
                   static_cast<double>(guidance.altitude_m[i]) / 1000.0,
                   exact::log(std::max(static_cast<double>(guidance.depth_m[i]), 1.0)), normal,
                   sky_light * open * 0.5 * (1.0 + normal.z)});
  }
  return out;
}

struct PossibleSun {
  SunPosition position;
  glm::dvec3 direction;
};

const std::vector<PossibleSun>& possible_suns() {
  static const std::vector<PossibleSun> suns = [] {
    std::vector<PossibleSun> out;
    for (double azimuth = 0.0; azimuth < 360.0; azimuth += sun_step_deg)
      for (double altitude = lowest_sun_deg; altitude <= highest_sun_deg; altitude += sun_step_deg)
        out.push_back({{azimuth, altitude}, sun_direction({azimuth, altitude})});
    return out;
  }();
  return suns;
}

double azimuth_between(double a, double b) { return std::abs(std::remainder(a - b, 360.0)); }

// The part of values that no linear function of a class's 1, altitude and ln distance explains.
class WithoutAir {
 public:
  explicit WithoutAir(const std::vector<const LightSample*>& samples) {
    const std::size_t count = samples.size();
    for (std::vector<double>& column : basis_) column.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      basis_[0][i] = 1.0;
      basis_[1][i] = samples[i]->altitude_km;
      basis_[2][i] = samples[i]->log_distance;
    }
    for (std::size_t k = 0; k < basis_.size(); ++k) {
      for (std::size_t j = 0; j < k; ++j) take_off(basis_[k], basis_[j]);
      double square = 0.0;
      for (const double value : basis_[k]) square += value * value;
      const double scale = square > 1e-9 * static_cast<double>(count) ? 1.0 / std::sqrt(square) : 0;
      for (double& value : basis_[k]) value *= scale;
    }
  }

  void apply(std::vector<double>& values) const {
    for (const std::vector<double>& column : basis_) take_off(values, column);
  }

 private:
  static void take_off(std::vector<double>& values, const std::vector<double>& unit) {
    double along = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) along += values[i] * unit[i];
    for (std::size_t i = 0; i < values.size(); ++i) values[i] -= along * unit[i];
  }

  std::array<std::vector<double>, 3> basis_;
};

// Adds, for each sun, the variance of the lightness of one label that its light explains. Returns
// the whole variance.
double add_explained(const std::vector<const LightSample*>& samples,
                     std::vector<double>& explained) {
  const WithoutAir without_air(samples);
  const std::size_t count = samples.size();
  std::vector<double> lightness(count), light(count);
  for (std::size_t i = 0; i < count; ++i) lightness[i] = samples[i]->lightness;
  without_air.apply(lightness);
  std::vector<double> deviations;
  for (const double value : lightness) deviations.push_back(std::abs(value));
  const double limit = clip_deviations * (normal_deviation * median(deviations) + 1e-4);
  double variance = 0.0;
  for (double& value : lightness) value = std::clamp(value, -limit, limit);
  without_air.apply(lightness);
  for (const double value : lightness) variance += value * value;
  const std::vector<PossibleSun>& suns = possible_suns();
  for (std::size_t k = 0; k < suns.size(); ++k) {
    for (std::size_t i = 0; i < count; ++i)
      light[i] = std::max(0.0, glm::dot(samples[i]->normal, suns[k].direction)) + samples[i]->sky;
    without_air.apply(light);
    double both = 0.0, square = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      both += light[i] * lightness[i];
      square += light[i] * light[i];
    }
    // Light that makes paint darker explains nothing.
    if (both > 0.0)
      explained[k] += both * both / std::max(square, 1e-9 * static_cast<double>(count));
  }
  return variance;
}

// `whole`: index of the sun of the whole picture, or none.
SunEstimate estimate_sun(const std::vector<LightSample>& samples, std::optional<std::size_t> whole,
                         std::size_t* found = nullptr) {
  SunEstimate out;
  if (samples.size() < min_region_pixels) return out;
  const std::vector<PossibleSun>& suns = possible_suns();
  std::vector<double> explained(suns.size(), 0.0);
  double variance = 0.0;
  std::array<std::vector<const LightSample*>, 256> by_label;
  for (const LightSample& sample : samples) by_label[sample.label].push_back(&sample);
  for (const std::vector<const LightSample*>& label : by_label)
    if (label.size() >= min_class_pixels) {
      variance += add_explained(label, explained);
      out.pixels += label.size();
    }
  if (!(variance > 1e-6 * static_cast<double>(out.pixels))) return {};
  for (double& value : explained) value /= variance;
  const std::size_t best = static_cast<std::size_t>(
      std::max_element(explained.begin(), explained.end()) - explained.begin());
  glm::dvec3 mean(0.0);
  for (std::size_t k = 0; k < suns.size(); ++k) {
    mean += exact::exp((explained[k] - explained[best]) / sun_sharpness) * suns[k].direction;
    if (azimuth_between(suns[k].position.azimuth_deg, suns[best].position.azimuth_deg) >
        opposite_deg)
      out.elsewhere = std::max(out.elsewhere, explained[k]);
  }
  mean = glm::normalize(mean);
  const double azimuth = to_degrees(exact::atan2(mean.x, mean.y));
  out.azimuth_deg = azimuth < 0.0 ? azimuth + 360.0 : azimuth;
  out.altitude_deg = to_degrees(exact::asin(mean.z));
  out.explained = explained[best];
  out.by_whole = explained[whole.value_or(best)];
  if (found != nullptr) *found = best;
  return out;
}

}  // namespace

PaintingLight find_painting_light(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& labels,
                                  const GuidanceBuffers& guidance,
                                  const PaintingLightParameters& parameters) {
  using B = GuidanceBuffers;
  require_channels(guidance, {&B::depth_m, &B::normal, &B::altitude_m}, "light of a painting");
  const LightFields fields = blurred_fields(picture, labels, guidance, parameters.blur_px);
  const int width = picture.width(), height = picture.height();
  const auto samples_in = [&](PixelRect rect) {
    return light_samples(fields, labels, guidance, rect, parameters.max_pixels);
  };
  std::size_t best = 0;
  PaintingLight out{estimate_sun(samples_in({0, 0, width, height}), std::nullopt, &best),
                    Grid<SunEstimate>(parameters.columns, parameters.rows)};
  parallel_ranges(parameters.columns * parameters.rows, 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const int column = k % parameters.columns, row = k / parameters.columns;
      const PixelRect rect{width * column / parameters.columns, height * row / parameters.rows,
                           width * (column + 1) / parameters.columns,
                           height * (row + 1) / parameters.rows};
      out.regions(column, row) = estimate_sun(samples_in(rect), best);
    }
  });
  return out;
}

}  // namespace belvedere
