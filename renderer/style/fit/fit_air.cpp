#include "renderer/style/fit/fit_air.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/filter.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "renderer/style/fit/style_colours.h"
#include "texture/synthesis/guide_stack.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr std::size_t min_far_texels = 500;
constexpr int figure_width_px = 1200;  // picture width for measuring broken paint and vapour
// Sigmas of strokes, medium-scale forms and large forms, px at that width.
constexpr double stroke_px = 1.5;
constexpr double form_px = 6.0;
constexpr double large_px = 24.0;

glm::dvec3 median_colour(const std::vector<glm::vec3>& texels, std::size_t begin, std::size_t end) {
  glm::dvec3 out(0.0);
  for (int channel = 0; channel < 3; ++channel) {
    std::vector<float> values;
    for (std::size_t i = begin; i < end; ++i) values.push_back(texels[i][channel]);
    out[channel] = static_cast<double>(middle_value(std::move(values)));
  }
  return out;
}

glm::dvec3 median_colour(const std::vector<glm::vec3>& texels) {
  return median_colour(texels, 0, texels.size());
}

// Median colour of the coolest seventh of the ground (lowest b).
glm::dvec3 coolest(std::vector<glm::vec3> ground) {
  std::stable_sort(ground.begin(), ground.end(),
                   [](const glm::vec3& a, const glm::vec3& b) { return a.z < b.z; });
  return median_colour(ground, 0, std::max<std::size_t>(1, ground.size() / 7));
}

Grid<float> lightness_of(const StylePainting& painting) {
  Grid<float> lightness(painting.colours.width(), painting.colours.height());
  for (std::size_t i = 0; i < lightness.size(); ++i) lightness[i] = painting.colours[i].x;
  return lightness;
}

Grid<float> difference(const Grid<float>& a, const Grid<float>& b) {
  Grid<float> out(a.width(), a.height());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = a[i] - b[i];
  return out;
}

// Standard deviation over pixels with `wanted(x, y)`; 0 if there are none.
template <class F>
double deviation(const Grid<float>& values, F wanted) {
  double count = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (int y = 0; y < values.height(); ++y)
    for (int x = 0; x < values.width(); ++x) {
      if (!wanted(x, y)) continue;
      const double v = static_cast<double>(values(x, y));
      count += 1.0;
      sum += v;
      squares += v * v;
    }
  if (count == 0.0) return 0.0;
  return std::sqrt(std::max(0.0, squares / count - sum / count * (sum / count)));
}

bool is_ground(std::uint8_t label) {
  return label != unused_label && label != static_cast<std::uint8_t>(sky);
}

// Medium-scale forms: lightness between sigma 2 and 12 px.
Grid<float> middle_forms(const StylePainting& painting) {
  const Grid<float> lightness = lightness_of(painting);
  return difference(gaussian_blur(lightness, 2.0), gaussian_blur(lightness, 12.0));
}

// The row with a given share of the ground above it.
int ground_row(const Grid<std::uint8_t>& mask, double share) {
  std::vector<std::size_t> count(static_cast<std::size_t>(mask.height()), 0);
  std::size_t total = 0;
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x)
      count[static_cast<std::size_t>(y)] += is_ground(mask(x, y)) ? 1 : 0;
    total += count[static_cast<std::size_t>(y)];
  }
  std::size_t above = 0;
  int y = 0;
  while (y + 1 < mask.height() && static_cast<double>(above += count[static_cast<std::size_t>(y)]) <
                                      share * static_cast<double>(total))
    ++y;
  return y;
}

// Factor on haze: smaller where far ranges show more contrast of forms.
double fit_haze(const StylePainting& painting) {
  const Grid<float> forms = middle_forms(painting);
  const int upper = ground_row(painting.drawn, 0.33);
  const int lower = ground_row(painting.drawn, 0.67);
  const auto ground = [&](int x, int y) { return is_ground(painting.drawn(x, y)); };
  const double far = deviation(forms, [&](int x, int y) { return y < upper && ground(x, y); });
  const double close = deviation(forms, [&](int x, int y) { return y > lower && ground(x, y); });
  return std::clamp(1.3 - 0.5 * far / std::max(close, 1e-3), 0.70, 1.25);
}

// Colours of lit vegetation by hue, and the warmest for larches.
void fit_leaves(const StylePainting& painting, StyleAir& air) {
  std::vector<glm::vec3> green;
  for (const LandCoverClass id : {forest, shrub, pasture, alpine_grass}) {
    const std::vector<glm::vec3> own =
        class_texels(painting.soft, painting.drawn, id, painting.drawn.size());
    if (own.size() > 300) green.insert(green.end(), own.begin(), own.end());
  }
  if (green.empty()) green = painting.ground;
  std::vector<float> lightness;
  lightness.reserve(green.size());
  for (const glm::vec3& texel : green) lightness.push_back(texel.x);
  const float middle = middle_value(std::move(lightness));
  std::vector<std::pair<double, glm::vec3>> lit;
  for (const glm::vec3& texel : green)
    if (texel.x >= middle) lit.emplace_back(exact::atan2(texel.z, texel.y), texel);
  std::stable_sort(lit.begin(), lit.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<glm::vec3> by_hue;
  by_hue.reserve(lit.size());
  for (const auto& [hue, texel] : lit) by_hue.push_back(texel);
  constexpr std::array<double, 4> shares = {0.05, 0.30, 0.55, 0.78};
  const auto count = static_cast<double>(by_hue.size());
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const auto begin = std::min(static_cast<std::size_t>(shares[k] * count), by_hue.size() - 1);
    const auto end =
        std::clamp(static_cast<std::size_t>((shares[k] + 0.2) * count), begin + 1, by_hue.size());
    air.leaves[k] = median_colour(by_hue, begin, end);
  }
  air.larch = median_colour(by_hue, 0, std::max<std::size_t>(1, by_hue.size() / 12));
}

// Change of colour with height in the painting, within classes: an estimate of the effect of
// distance.
glm::dvec3 fit_trend(const StylePainting& painting) {
  const Grid<std::uint8_t>& clean = painting.clean;
  int top = clean.height();
  int bottom = 0;
  for (int y = 0; y < clean.height(); ++y)
    for (int x = 0; x < clean.width(); ++x)
      if (is_ground(painting.drawn(x, y))) {
        top = std::min(top, y);
        bottom = std::max(bottom, y);
      }
  glm::dvec3 product(0.0);
  double squares = 0.0;
  for (const LandCoverClass id : painting.classes) {
    std::vector<std::pair<double, glm::dvec3>> texels;  // height 0…1, colour
    glm::dvec3 colour(0.0);
    double height = 0.0;
    for (int y = 0; y < clean.height(); ++y)
      for (int x = 0; x < clean.width(); ++x) {
        if (clean(x, y) != static_cast<std::uint8_t>(id)) continue;
        texels.emplace_back(static_cast<double>(bottom - y) / std::max(bottom - top, 1),
                            painting.soft(x, y));
        height += texels.back().first;
        colour += texels.back().second;
      }
    const auto count = static_cast<double>(texels.size());
    height /= count;
    colour /= count;
    double variance = 0.0;
    for (const auto& [h, c] : texels) variance += (h - height) * (h - height) / count;
    if (variance < 0.04 * 0.04) continue;
    // Limits the weight of large classes.
    const double weight = std::min(1.0, 8000.0 / count);
    for (const auto& [h, c] : texels) product += weight * (h - height) * (c - colour);
    squares += weight * count * variance;
  }
  const glm::dvec3 slope = product / std::max(squares, 1e-9);
  return {std::clamp(slope.x, -0.16, 0.16), std::clamp(slope.y, -0.04, 0.04),
          std::clamp(slope.z, -0.06, 0.06)};
}

}  // namespace

StyleAir fit_air(const StylePainting& painting, const std::optional<glm::dvec3>& horizon) {
  StyleAir air;
  const glm::dvec3 cool = coolest(painting.ground);
  // Without a sky: the horizon of a clear day.
  const glm::dvec3 low_sky = horizon.value_or(glm::dvec3(0.90, 0.0, 0.02));
  std::vector<glm::vec3> far;
  for (std::size_t i = 0; i < painting.drawn.size(); ++i)
    if (painting.drawn[i] == far_air_label) far.push_back(painting.colours[i]);
  air.far_seen = far.size() > min_far_texels;
  if (air.far_seen) {
    const glm::dvec3 seen = median_colour(far);
    air.near = 0.6 * seen + 0.4 * cool;
    air.far = 0.5 * seen + 0.5 * low_sky;
  } else {
    air.near = 0.5 * low_sky + 0.5 * cool;
    air.far = 0.8 * low_sky + 0.2 * cool;
  }
  air.near.x = std::clamp(air.near.x, 0.42, 0.76);
  air.far.x = std::max(air.far.x, air.near.x + 0.06);
  air.mist = 0.5 * air.far + 0.5 * low_sky;
  air.haze = fit_haze(painting);
  fit_leaves(painting, air);
  return air;
}

PaintFigures measure_paint(const StylePainting& painting) {
  PaintFigures out;
  const Grid<std::uint8_t>& drawn = painting.drawn;
  // Classes with enough texels, and distant haze.
  const auto counts = [&](std::uint8_t label) {
    return label == far_air_label || (label < land_cover_class_count &&
                                      has_class(painting, static_cast<LandCoverClass>(label)));
  };
  out.form_deviation = deviation(middle_forms(painting), [&](int x, int y) {
    return drawn(x, y) != far_air_label && counts(drawn(x, y));
  });
  Grid<float> lightness = lightness_of(painting);
  Grid<std::uint8_t> mask = drawn;
  const double scale = static_cast<double>(figure_width_px) / lightness.width();
  if (scale < 1.0) {
    const Grid<float> soft = gaussian_blur(lightness, std::max(0.3, 0.4 / scale));
    const int width = figure_width_px;
    const int height = std::max(1, static_cast<int>(std::lround(scale * lightness.height())));
    lightness = Grid<float>(width, height);
    mask = Grid<std::uint8_t>(width, height);
    parallel_rows(height, [&](int y) {
      for (int x = 0; x < width; ++x) {
        const double u = (x + 0.5) / scale - 0.5;
        const double v = (y + 0.5) / scale - 0.5;
        lightness(x, y) = sample_bilinear(soft, u, v);
        mask(x, y) =
            drawn.clamped(static_cast<int>(std::lround(u)), static_cast<int>(std::lround(v)));
      }
    });
  }
  const auto ground = [&](int x, int y) { return counts(mask(x, y)); };
  const Grid<float> stroke = gaussian_blur(lightness, stroke_px);
  const Grid<float> form = gaussian_blur(lightness, form_px);
  const double large = std::max(deviation(gaussian_blur(lightness, large_px), ground), 1e-6);
  out.broken = std::min(2.0, deviation(difference(lightness, stroke), ground) / large);
  out.vapour =
      std::clamp((0.35 - deviation(difference(stroke, form), ground) / large) / 0.25, 0.0, 1.0);
  out.trend = fit_trend(painting);
  return out;
}

}  // namespace belvedere
