#include "renderer/style/fit/paint_figures.h"

#include <algorithm>
#include <vector>

#include "base/filter.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {
namespace {

constexpr int figure_width_px = 1200;  // picture width for measuring broken paint and vapour
// Sigmas of strokes, medium-scale forms and large forms, px at that width.
constexpr double stroke_px = 1.5;
constexpr double form_px = 6.0;
constexpr double large_px = 24.0;

constexpr int window_px = 32;          // of fine contrast
constexpr double fine_paint_px = 4.0;  // sigma above which structures are not fine
constexpr double min_window_contrast = 0.001;
constexpr double border_px = 3.0;     // sigma at which borders are found
constexpr double border_share = 0.1;  // of the ground with the steepest gradients
constexpr int line_half_px = 3;       // a dark line lies within, its two sides beyond
constexpr int side_from_px = 6;
constexpr int side_to_px = 12;
// Depth of lines relative to that of light lines, L: painters without lines have up to 0.01.
constexpr double no_lines = 0.02;
constexpr double full_lines = 0.09;

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

// The painting's lightness and mask at most figure_width_px wide.
struct FigurePicture {
  Grid<float> lightness;
  Grid<std::uint8_t> mask;
};
FigurePicture figure_picture(const StylePainting& painting) {
  Grid<float> lightness = lightness_of(painting);
  Grid<std::uint8_t> mask = painting.drawn;
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
        mask(x, y) = painting.drawn.clamped(static_cast<int>(std::lround(u)),
                                            static_cast<int>(std::lround(v)));
      }
    });
  }
  return {std::move(lightness), std::move(mask)};
}

// Strength of dark lines along borders: across the steepest gradients, how much darker the darkest
// paint is than both sides, minus how much lighter the lightest is.
template <class F>
double measure_contour_lines(const Grid<float>& lightness, F ground) {
  const Grid<float> soft = gaussian_blur(lightness, border_px);
  const Grid<float> paint = gaussian_blur(lightness, 0.7);
  const auto slope = [&](int x, int y) {
    return glm::vec2(soft.clamped(x + 1, y) - soft.clamped(x - 1, y),
                     soft.clamped(x, y + 1) - soft.clamped(x, y - 1));
  };
  std::vector<float> steepness;
  for (int y = 0; y < soft.height(); ++y)
    for (int x = 0; x < soft.width(); ++x)
      if (ground(x, y)) steepness.push_back(glm::length(slope(x, y)));
  if (steepness.empty()) return 0.0;
  const float steep = value_at_share(std::move(steepness), 1.0 - border_share);
  double sum = 0.0;
  double count = 0.0;
  for (int y = 0; y < soft.height(); ++y)
    for (int x = 0; x < soft.width(); ++x) {
      if (!ground(x, y)) continue;
      const glm::vec2 along = slope(x, y);
      const float length = glm::length(along);
      if (!(length > steep)) continue;
      const auto at = [&](int k) {
        return static_cast<double>(sample_bilinear(
            paint, static_cast<double>(x) + k * static_cast<double>(along.x / length),
            static_cast<double>(y) + k * static_cast<double>(along.y / length)));
      };
      double darkest = 1e9;
      double lightest = -1e9;
      for (int k = -line_half_px; k <= line_half_px; ++k) {
        darkest = std::min(darkest, at(k));
        lightest = std::max(lightest, at(k));
      }
      double before = 0.0;
      double after = 0.0;
      for (int k = side_from_px; k <= side_to_px; ++k) {
        before += at(-k) / (side_to_px - side_from_px + 1);
        after += at(k) / (side_to_px - side_from_px + 1);
      }
      sum += (std::min(before, after) - darkest) - (lightest - std::max(before, after));
      count += 1.0;
    }
  const double depth = count > 0.0 ? sum / count : 0.0;
  return std::clamp((depth - no_lines) / (full_lines - no_lines), 0.0, 1.0);
}

// Change of colour with height in the painting, within classes: an estimate of the effect of
// distance.
glm::dvec3 fit_trend(const StylePainting& painting) {
  const Grid<std::uint8_t>& clean = painting.clean;
  int top = clean.height();
  int bottom = 0;
  for (int y = 0; y < clean.height(); ++y)
    for (int x = 0; x < clean.width(); ++x)
      if (is_ground_label(painting.drawn(x, y))) {
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

bool is_ground_label(std::uint8_t label) {
  return label != unused_label && label != static_cast<std::uint8_t>(sky);
}

// Medium-scale forms: lightness between sigma 2 and 12 px.
Grid<float> middle_forms(const StylePainting& painting) {
  const Grid<float> lightness = lightness_of(painting);
  return difference(gaussian_blur(lightness, 2.0), gaussian_blur(lightness, 12.0));
}

double measure_unevenness(const Grid<float>& lightness, const Grid<std::uint8_t>& ground) {
  const Grid<float> fine = difference(lightness, gaussian_blur(lightness, fine_paint_px));
  std::vector<double> contrasts;
  for (int v = 0; v + window_px <= fine.height(); v += window_px)
    for (int u = 0; u + window_px <= fine.width(); u += window_px) {
      double count = 0.0;
      double sum = 0.0;
      double squares = 0.0;
      for (int y = v; y < v + window_px; ++y)
        for (int x = u; x < u + window_px; ++x) {
          if (ground(x, y) == 0) continue;
          const double value = static_cast<double>(fine(x, y));
          count += 1.0;
          sum += value;
          squares += value * value;
        }
      if (count < 0.8 * window_px * window_px) continue;
      const double mean = sum / count;
      contrasts.push_back(exact::log2(std::sqrt(std::max(0.0, squares / count - mean * mean)) +
                                      min_window_contrast));
    }
  if (contrasts.size() < 4) return 0.0;
  double mean = 0.0;
  for (const double c : contrasts) mean += c / static_cast<double>(contrasts.size());
  double variance = 0.0;
  for (const double c : contrasts)
    variance += (c - mean) * (c - mean) / static_cast<double>(contrasts.size());
  return std::sqrt(variance);
}

PaintFigures measure_paint(const StylePainting& painting) {
  PaintFigures out;
  const Grid<std::uint8_t>& drawn = painting.drawn;
  // Classes with enough texels, and distant haze.
  const auto counts = [&](std::uint8_t label) {
    return label == far_air_label || (label < land_cover_class_count &&
                                      has_class(painting, static_cast<LandCoverClass>(label)));
  };
  out.form_deviation = deviation_where(middle_forms(painting), [&](int x, int y) {
    return drawn(x, y) != far_air_label && counts(drawn(x, y));
  });
  const FigurePicture figure = figure_picture(painting);
  const Grid<float>& lightness = figure.lightness;
  const Grid<std::uint8_t>& mask = figure.mask;
  const auto ground = [&](int x, int y) { return counts(mask(x, y)); };
  const Grid<float> stroke = gaussian_blur(lightness, stroke_px);
  const Grid<float> form = gaussian_blur(lightness, form_px);
  const double large = std::max(deviation_where(gaussian_blur(lightness, large_px), ground), 1e-6);
  out.broken = std::min(2.0, deviation_where(difference(lightness, stroke), ground) / large);
  out.vapour = std::clamp((0.35 - deviation_where(difference(stroke, form), ground) / large) / 0.25,
                          0.0, 1.0);
  Grid<std::uint8_t> is_ground(mask.width(), mask.height());
  for (std::size_t i = 0; i < mask.size(); ++i) is_ground[i] = counts(mask[i]) ? 1 : 0;
  out.unevenness = measure_unevenness(lightness, is_ground);
  out.contour_lines = measure_contour_lines(lightness, ground);
  out.trend = fit_trend(painting);
  return out;
}

}  // namespace belvedere
