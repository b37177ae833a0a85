#include "tests/renderer/exemplar/painting_figures.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/filter.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "renderer/image/srgb.h"
#include "renderer/style/fit/paint_figures.h"

namespace belvedere {
namespace {

constexpr int min_side = 96;
constexpr double local_sigma = 10.0;  // px; wider structures are form, not paint
constexpr double min_contrast = 0.004;
constexpr float min_stroke_coherence = 0.2F;
constexpr int max_lag = 40;        // px
constexpr int lags_per_px = 2;     // positions per pixel at which the correlation is computed
constexpr int sample_step = 3;     // px between the sampled positions
constexpr int max_walk = 64;       // px, in one direction
constexpr double turned = 0.8660;  // cosine of 30°
constexpr double flat_deviation = 0.006;

struct Moments {
  double mean = 0.0;
  double spread = 0.0;
};
Moments moments_of(const Grid<float>& values) {
  const auto n = static_cast<double>(values.size());
  const double mean =
      deterministic_sum(values.size(),
                        [&](std::size_t i) { return static_cast<double>(values[i]); }) /
      n;
  const double squares = deterministic_sum(values.size(), [&](std::size_t i) {
    const double d = static_cast<double>(values[i]) - mean;
    return d * d;
  });
  return {mean, std::sqrt(squares / n)};
}

void measure_colour(const Grid<glm::vec3>& picture, PaintingFigures& out) {
  Grid<float> saturation(picture.width(), picture.height(), 0.F);
  double all = 0.0;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const glm::vec3 c = picture[i];
    const float max = std::max({c.x, c.y, c.z});
    const float chroma = max - std::min({c.x, c.y, c.z});
    if (chroma <= 0.F || max <= 0.F) continue;
    saturation[i] = chroma / max;
    // Sixths of the circle from red.
    float hue = max == c.x   ? (c.y - c.z) / chroma
                : max == c.y ? 2.F + (c.z - c.x) / chroma
                             : 4.F + (c.x - c.y) / chroma;
    if (hue < 0.F) hue += 6.F;
    out.hue_shares[std::min<std::size_t>(static_cast<std::size_t>(hue * 2.F),
                                         PaintingFigures::hue_sectors - 1)] +=
        static_cast<double>(chroma);
    all += static_cast<double>(chroma);
  }
  if (all > 0.0)
    for (double& share : out.hue_shares) share /= all;
  const Moments s = moments_of(saturation);
  out.saturation_mean = s.mean;
  out.saturation_spread = s.spread;
}

// Mean squared difference of neighbours in both directions.
double gradient_energy(const Grid<float>& values) {
  const int width = values.width();
  const auto squared = [](float a, float b) {
    return static_cast<double>(a - b) * static_cast<double>(a - b);
  };
  return deterministic_sum(
             values.size(),
             [&](std::size_t i) {
               const bool right = static_cast<int>(i % static_cast<std::size_t>(width)) + 1 < width;
               const std::size_t below = i + static_cast<std::size_t>(width);
               return (right ? squared(values[i + 1], values[i]) : 0.0) +
                      (below < values.size() ? squared(values[below], values[i]) : 0.0);
             }) /
         static_cast<double>(values.size());
}

double octave_ratio(double fine, double coarse) {
  return fine > 0.0 && coarse > 0.0 ? exact::log2(fine / coarse) : 0.0;
}

// Direction of paint: unit vector along it, and its coherence.
struct Direction {
  Grid<glm::vec2> along;
  Grid<float> coherence;
  Grid<float> energy;
};
Direction find_direction(const Grid<float>& lightness) {
  const int width = lightness.width();
  const int height = lightness.height();
  const Grid<float> smooth = gaussian_blur(lightness, 0.8);
  Grid<float> xx(width, height);
  Grid<float> xy(width, height);
  Grid<float> yy(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      // Scharr's weights: the direction is accurate to a tenth of a degree.
      const auto at = [&](int u, int v) { return smooth.clamped(x + u, y + v); };
      const float gx = (3.F * (at(1, -1) - at(-1, -1)) + 10.F * (at(1, 0) - at(-1, 0)) +
                        3.F * (at(1, 1) - at(-1, 1))) /
                       32.F;
      const float gy = (3.F * (at(-1, 1) - at(-1, -1)) + 10.F * (at(0, 1) - at(0, -1)) +
                        3.F * (at(1, 1) - at(1, -1))) /
                       32.F;
      xx(x, y) = gx * gx;
      xy(x, y) = gx * gy;
      yy(x, y) = gy * gy;
    }
  });
  xx = gaussian_blur(xx, 3.0);
  xy = gaussian_blur(xy, 3.0);
  yy = gaussian_blur(yy, 3.0);
  Direction out{Grid<glm::vec2>(width, height), Grid<float>(width, height),
                Grid<float>(width, height)};
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = lightness.index(x, y);
      const double sum = static_cast<double>(xx[i]) + static_cast<double>(yy[i]);
      const double difference = static_cast<double>(xx[i]) - static_cast<double>(yy[i]);
      const double twice = 2.0 * static_cast<double>(xy[i]);
      const double across =
          0.5 * exact::atan2(twice, difference);  // of the steepest change of lightness
      out.along[i] = glm::vec2(static_cast<float>(-exact::sin(across)),
                               static_cast<float>(exact::cos(across)));
      out.energy[i] = static_cast<float>(sum);
      out.coherence[i] =
          sum > 1e-10 ? static_cast<float>(std::sqrt(difference * difference + twice * twice) / sum)
                      : 0.F;
    }
  });
  return out;
}

// Lightness minus its local mean, in units of its local contrast: a shadow's edge counts no more
// than a stroke in the light.
Grid<float> local_detail(const Grid<float>& lightness) {
  Grid<float> detail = gaussian_blur(lightness, local_sigma);
  for (std::size_t i = 0; i < detail.size(); ++i) detail[i] = lightness[i] - detail[i];
  Grid<float> squared = detail;
  for (float& v : squared) v *= v;
  squared = gaussian_blur(squared, local_sigma);
  for (std::size_t i = 0; i < detail.size(); ++i)
    detail[i] /= std::sqrt(squared[i]) + static_cast<float>(min_contrast);
  return detail;
}

// Three times the lag at which a correlation, given at steps of 1 / lags_per_px from lag 0 on,
// falls below one half.
double three_half_lags(const std::vector<double>& products) {
  if (products.front() <= 0.0) return 0.0;
  for (std::size_t k = 1; k < products.size(); ++k) {
    const double before = products[k - 1] / products.front();
    const double here = products[k] / products.front();
    if (here < 0.5)
      return 3.0 / lags_per_px * (static_cast<double>(k - 1) + (before - 0.5) / (before - here));
  }
  return 3.0 * max_lag;
}

void measure_strokes(const Grid<float>& lightness, const Direction& direction,
                     PaintingFigures& out) {
  const Grid<float> detail = local_detail(lightness);
  constexpr int lags = max_lag * lags_per_px + 1;
  constexpr int margin = max_lag / 2 + 1;
  const int rows = (lightness.height() - 2 * margin + sample_step - 1) / sample_step;
  struct Row {
    std::vector<double> along = std::vector<double>(lags, 0.0);
    std::vector<double> across = std::vector<double>(lags, 0.0);
    double walked = 0.0;
    int walks = 0;
  };
  std::vector<Row> sums(static_cast<std::size_t>(rows));
  const auto sample = [&](glm::vec2 p) {
    return sample_bilinear(detail, static_cast<double>(p.x), static_cast<double>(p.y));
  };
  const auto walk = [&](int x, int y, float sign) {
    const glm::vec2 first = direction.along(x, y) * sign;
    glm::vec2 heading = first;
    glm::vec2 position(static_cast<float>(x), static_cast<float>(y));
    int steps = 0;
    for (; steps < max_walk; ++steps) {
      position += heading;
      const int u = static_cast<int>(std::lround(position.x));
      const int v = static_cast<int>(std::lround(position.y));
      if (!lightness.contains(u, v) || direction.coherence(u, v) < min_stroke_coherence) break;
      const glm::vec2 here = direction.along(u, v);
      heading = glm::dot(here, heading) < 0.F ? -here : here;
      if (static_cast<double>(glm::dot(heading, first)) < turned) break;
    }
    return steps;
  };
  parallel_rows(rows, [&](int j) {
    Row& row = sums[static_cast<std::size_t>(j)];
    const int y = margin + j * sample_step;
    for (int x = margin; x < lightness.width() - margin; x += sample_step) {
      if (direction.coherence(x, y) < min_stroke_coherence) continue;
      const glm::vec2 centre(static_cast<float>(x), static_cast<float>(y));
      const glm::vec2 along = direction.along(x, y);
      const glm::vec2 across(-along.y, along.x);
      for (int k = 0; k < lags; ++k) {
        const float reach = 0.5F * static_cast<float>(k) / lags_per_px;
        const auto at = static_cast<std::size_t>(k);
        row.along[at] +=
            static_cast<double>(sample(centre + reach * along) * sample(centre - reach * along));
        row.across[at] +=
            static_cast<double>(sample(centre + reach * across) * sample(centre - reach * across));
      }
      row.walked += 1 + walk(x, y, 1.F) + walk(x, y, -1.F);
      ++row.walks;
    }
  });
  Row all;
  for (const Row& row : sums) {
    for (std::size_t k = 0; k < lags; ++k) {
      all.along[k] += row.along[k];
      all.across[k] += row.across[k];
    }
    all.walked += row.walked;
    all.walks += row.walks;
  }
  if (all.walks == 0) return;
  out.stroke_length_px = three_half_lags(all.along);
  out.stroke_width_px = three_half_lags(all.across);
  out.direction_run_px = all.walked / all.walks;
}

double measure_flat_share(const Grid<float>& lightness) {
  const int inner_width = lightness.width() - 4;
  std::vector<int> flat(static_cast<std::size_t>(lightness.height() - 4), 0);
  parallel_rows(lightness.height() - 4, [&](int j) {
    for (int i = 0; i < inner_width; ++i) {
      double sum = 0.0;
      double squares = 0.0;
      for (int v = 0; v < 5; ++v)
        for (int u = 0; u < 5; ++u) {
          const auto l = static_cast<double>(lightness(i + u, j + v));
          sum += l;
          squares += l * l;
        }
      if (squares / 25.0 - sum * sum / 625.0 < flat_deviation * flat_deviation)
        ++flat[static_cast<std::size_t>(j)];
    }
  });
  double all = 0.0;
  for (const int n : flat) all += n;
  return all / (static_cast<double>(inner_width) * (lightness.height() - 4));
}

}  // namespace

PaintingFigures measure_painting(const Grid<glm::vec3>& picture) {
  if (picture.width() < min_side || picture.height() < min_side)
    throw Error(ErrorKind::usage, "measure_painting",
                "the picture has " + std::to_string(picture.width()) + " × " +
                    std::to_string(picture.height()) + " pixels",
                "at least 96 each way");
  PaintingFigures out;
  measure_colour(picture, out);
  Grid<float> lightness(picture.width(), picture.height());
  parallel_rows(picture.height(), [&](int y) {
    for (int x = 0; x < picture.width(); ++x)
      lightness(x, y) = static_cast<float>(to_oklab(picture(x, y)).x);
  });
  const Moments light = moments_of(lightness);
  out.lightness_mean = light.mean;
  out.lightness_spread = light.spread;

  const double fine = gradient_energy(gaussian_blur(lightness, 1.0));
  const double centre = gradient_energy(gaussian_blur(lightness, 2.0));
  out.sharpness = octave_ratio(fine, centre);
  out.coarse_sharpness = octave_ratio(centre, gradient_energy(gaussian_blur(lightness, 4.0)));

  const Direction direction = find_direction(lightness);
  const double energy = deterministic_sum(
      lightness.size(), [&](std::size_t i) { return static_cast<double>(direction.energy[i]); });
  if (energy > 0.0)
    out.coherence = deterministic_sum(lightness.size(),
                                      [&](std::size_t i) {
                                        return static_cast<double>(direction.energy[i]) *
                                               static_cast<double>(direction.coherence[i]);
                                      }) /
                    energy;
  measure_strokes(lightness, direction, out);
  out.unevenness =
      measure_unevenness(lightness, Grid<std::uint8_t>(lightness.width(), lightness.height(), 1));
  out.flat_share = measure_flat_share(lightness);
  return out;
}

Grid<glm::vec3> shrink_picture(const Grid<glm::vec3>& encoded, double scale) {
  if (!(scale > 0.0 && scale <= 1.0))
    throw Error(ErrorKind::usage, "scale of a picture", std::to_string(scale),
                "more than 0, at most 1");
  if (scale == 1.0) return encoded;
  const int width = std::max(1, static_cast<int>(encoded.width() * scale));
  const int height = std::max(1, static_cast<int>(encoded.height() * scale));
  // Columns first, then rows: the mean over an area is the mean of means.
  const auto shrink_line = [scale](int n_in, int n_out, auto&& in, auto&& out) {
    for (int k = 0; k < n_out; ++k) {
      const double from = k / scale;
      const double to = std::min((k + 1) / scale, static_cast<double>(n_in));
      glm::dvec3 sum(0.0);
      for (int i = static_cast<int>(from); i < n_in && i < to; ++i)
        sum += (std::min(to, i + 1.0) - std::max(from, static_cast<double>(i))) * in(i);
      out(k, sum / (to - from));
    }
  };
  Grid<glm::vec3> narrow(width, encoded.height());
  parallel_rows(encoded.height(), [&](int y) {
    shrink_line(
        encoded.width(), width,
        [&](int x) {
          const glm::vec3 c = encoded(x, y);
          return glm::dvec3(srgb_decoded(c.x), srgb_decoded(c.y), srgb_decoded(c.z));
        },
        [&](int x, glm::dvec3 c) { narrow(x, y) = glm::vec3(c); });
  });
  Grid<glm::vec3> out(width, height);
  parallel_rows(width, [&](int x) {
    shrink_line(
        narrow.height(), height, [&](int y) { return glm::dvec3(narrow(x, y)); },
        [&](int y, glm::dvec3 c) {
          out(x, y) = glm::vec3(static_cast<float>(srgb_encoded(c.x)),
                                static_cast<float>(srgb_encoded(c.y)),
                                static_cast<float>(srgb_encoded(c.z)));
        });
  });
  return out;
}

}  // namespace belvedere
