#include "renderer/style/fit/fit_brushwork.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/filter.h"
#include "base/masks/label_blur.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/pixel_rect.h"
#include "base/random.h"
#include "base/statistics.h"
#include "renderer/style/fit/style_painting.h"

namespace belvedere {
namespace {

constexpr double local_px = 10.0;       // sigma of the local normalization of lightness
constexpr double min_contrast = 0.004;  // added to the local contrast
constexpr double fine_px = 0.35;        // sigma of the blur that removes grain
constexpr double form_fine_px = 4.0;    // sigmas of larger forms
constexpr double form_around_px = 8.0;
constexpr double lag_step_px = 0.5;
constexpr double max_lag_px = 40.0;

// Structure tensor of lightness.
struct Tensor {
  Grid<float> xx, xy, yy;
};

Tensor structure_tensor(const Grid<float>& lightness, double fine_sigma, double around_sigma) {
  const Grid<float> soft = gaussian_blur(lightness, fine_sigma);
  Tensor t{Grid<float>(soft.width(), soft.height()), Grid<float>(soft.width(), soft.height()),
           Grid<float>(soft.width(), soft.height())};
  parallel_rows(soft.height(), [&](int y) {
    for (int x = 0; x < soft.width(); ++x) {  // Sobel weights
      const auto at = [&](int u, int v) { return soft.clamped(x + u, y + v); };
      const float gx =
          (at(1, -1) - at(-1, -1) + 2.0F * (at(1, 0) - at(-1, 0)) + at(1, 1) - at(-1, 1)) / 8.0F;
      const float gy =
          (at(-1, 1) - at(-1, -1) + 2.0F * (at(0, 1) - at(0, -1)) + at(1, 1) - at(1, -1)) / 8.0F;
      t.xx(x, y) = gx * gx;
      t.xy(x, y) = gx * gy;
      t.yy(x, y) = gy * gy;
    }
  });
  t.xx = gaussian_blur(t.xx, around_sigma);
  t.xy = gaussian_blur(t.xy, around_sigma);
  t.yy = gaussian_blur(t.yy, around_sigma);
  return t;
}

// Direction along the paint as a doubled angle, and its coherence, 0…1.
struct PaintDirection {
  double cos2 = -1.0;
  double sin2 = 0.0;
  double coherence = 0.0;
  // Cosine and sine of the halved angle, within ±90° of the x axis.
  double cosine() const { return std::sqrt(std::max(0.0, 0.5 * (1.0 + cos2))); }
  double sine() const { return std::copysign(std::sqrt(std::max(0.0, 0.5 * (1.0 - cos2))), sin2); }
};

PaintDirection direction_at(const Tensor& t, std::size_t i) {
  const double difference = static_cast<double>(t.xx[i]) - static_cast<double>(t.yy[i]);
  const double twice = 2.0 * static_cast<double>(t.xy[i]);
  const double size = exact::hypot(difference, twice);
  if (size < 1e-12) return {};
  // Along the paint is perpendicular to the strongest gradient.
  const double energy = static_cast<double>(t.xx[i]) + static_cast<double>(t.yy[i]);
  return {-difference / size, -twice / size, size / std::max(energy, 1e-9)};
}

// Lightness minus the local mean, over the local contrast.
Grid<float> normalized(const Grid<float>& lightness) {
  const Grid<float> mean = gaussian_blur(lightness, local_px);
  Grid<float> off(lightness.width(), lightness.height());
  Grid<float> squares(lightness.width(), lightness.height());
  for (std::size_t i = 0; i < off.size(); ++i) {
    off[i] = lightness[i] - mean[i];
    squares[i] = off[i] * off[i];
  }
  squares = gaussian_blur(squares, local_px);
  for (std::size_t i = 0; i < off.size(); ++i)
    off[i] /= std::sqrt(std::max(squares[i], 0.0F)) + static_cast<float>(min_contrast);
  return off;
}

Grid<float> lightness_channel(const Grid<glm::vec3>& colours) {
  Grid<float> lightness(colours.width(), colours.height());
  for (std::size_t i = 0; i < lightness.size(); ++i) lightness[i] = colours[i].x;
  return lightness;
}

struct Sample {
  int x = 0;
  int y = 0;
  PaintDirection direction;
  PaintDirection form;
};

// The lag, px, at which autocorrelation has fallen to one half, along the paint or across it.
double half_distance(const Grid<float>& values, const std::vector<Sample>& samples, bool along) {
  double base = 0.0;
  for (const Sample& s : samples) {
    const double v = static_cast<double>(values(s.x, s.y));
    base += v * v;
  }
  if (base <= 0.0) return max_lag_px;
  double before = 1.0;
  for (int step = 1; step * lag_step_px < max_lag_px; ++step) {
    const double lag = step * lag_step_px;
    double sum = 0.0;
    for (const Sample& s : samples) {
      const double ux = along ? s.direction.cosine() : -s.direction.sine();
      const double uy = along ? s.direction.sine() : s.direction.cosine();
      const double there =
          static_cast<double>(sample_bilinear(values, s.x + lag * ux, s.y + lag * uy)) +
          static_cast<double>(sample_bilinear(values, s.x - lag * ux, s.y - lag * uy));
      sum += 0.5 * static_cast<double>(values(s.x, s.y)) * there;
    }
    const double correlation = sum / base;
    if (correlation < 0.5)
      return lag - lag_step_px +
             lag_step_px * (before - 0.5) / std::max(before - correlation, 1e-6);
    before = correlation;
  }
  return max_lag_px;
}

// Stratified choice of `count` of 0…size - 1, ascending: one of each equal part; all if no more
// exist.
std::vector<std::size_t> spread_choice(std::size_t size, std::size_t count, std::uint64_t seed) {
  std::vector<std::size_t> chosen;
  if (size <= count) {
    for (std::size_t i = 0; i < size; ++i) chosen.push_back(i);
    return chosen;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const double place =
        (static_cast<double>(i) + random_uniform(seed, static_cast<std::int64_t>(i), 0)) *
        static_cast<double>(size) / static_cast<double>(count);
    chosen.push_back(std::min(static_cast<std::size_t>(place), size - 1));
  }
  return chosen;
}

bool darker(const glm::vec3& a, const glm::vec3& b) { return a.x < b.x; }

struct Difference {
  float mean_lightness;  // around the stroke
  glm::vec3 residual;
};

// Residuals of each third of lightness, minus their mean, clamped to ± max_deviations.
void fit_residuals(std::vector<Difference> differences, const BrushworkParameters& parameters,
                   std::uint64_t seed, StyleBrushwork& out) {
  std::stable_sort(differences.begin(), differences.end(), [](const auto& a, const auto& b) {
    return a.mean_lightness < b.mean_lightness;
  });
  for (std::size_t third = 0; third < 3; ++third) {
    std::vector<glm::vec3> own;
    for (std::size_t i = third * differences.size() / 3; i < (third + 1) * differences.size() / 3;
         ++i)
      own.push_back(differences[i].residual);
    glm::dvec3 mean(0.0);
    glm::dvec3 squares(0.0);
    for (const glm::vec3& r : own) {
      mean += glm::dvec3(r);
      squares += glm::dvec3(r) * glm::dvec3(r);
    }
    const auto count = static_cast<double>(own.size());
    mean /= count;
    std::stable_sort(own.begin(), own.end(), darker);
    for (const std::size_t i :
         spread_choice(own.size(), static_cast<std::size_t>(parameters.residuals), seed + third)) {
      glm::vec3 residual(0.0F);
      for (int c = 0; c < 3; ++c) {
        const double limit = parameters.max_deviations *
                             std::sqrt(std::max(0.0, squares[c] / count - mean[c] * mean[c]));
        residual[c] =
            static_cast<float>(std::clamp(static_cast<double>(own[i][c]) - mean[c], -limit, limit));
      }
      out.residuals[third].push_back(residual);
    }
  }
}

void fit_accents(std::vector<glm::vec3> texels, const BrushworkParameters& parameters,
                 std::uint64_t seed, StyleBrushwork& out) {
  const auto squared_chroma = [](const glm::vec3& c) { return c.y * c.y + c.z * c.z; };
  std::vector<float> chromas;
  chromas.reserve(texels.size());
  for (const glm::vec3& texel : texels) chromas.push_back(squared_chroma(texel));
  const float least = value_at_share(std::move(chromas), 1.0 - parameters.accent_share);
  std::erase_if(texels, [&](const glm::vec3& texel) { return squared_chroma(texel) < least; });
  std::stable_sort(texels.begin(), texels.end(), darker);
  for (const std::size_t i :
       spread_choice(texels.size(), static_cast<std::size_t>(parameters.accents), seed))
    out.accents.push_back(texels[i]);
}

// Fields on which all classes are measured.
struct PaintFields {
  Grid<float> normal;
  Tensor strokes;
  Tensor forms;
  Grid<glm::vec3> fine;
};

// The pixels of a class by rows, and their bounding box.
struct ClassPlaces {
  std::vector<std::array<int, 2>> places;
  PixelRect box{std::numeric_limits<int>::max(), std::numeric_limits<int>::max(), 0, 0};
};

ClassPlaces find_places(const Grid<std::uint8_t>& mask, std::uint8_t label) {
  ClassPlaces out;
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x)
      if (mask(x, y) == label) {
        out.places.push_back({x, y});
        out.box = {std::min(out.box.x0, x), std::min(out.box.y0, y), std::max(out.box.x1, x + 1),
                   std::max(out.box.y1, y + 1)};
      }
  return out;
}

// Local mean colour of a class from its own pixels only, over its box.
Grid<glm::vec3> class_means(const Grid<glm::vec3>& colours, const ClassPlaces& own,
                            double sigma_px) {
  Grid<glm::vec3> part(own.box.width(), own.box.height(), glm::vec3(0.0F));
  Grid<std::uint8_t> labels(own.box.width(), own.box.height(), no_label);
  for (const auto& [x, y] : own.places) {
    part(x - own.box.x0, y - own.box.y0) = colours(x, y);
    labels(x - own.box.x0, y - own.box.y0) = 0;
  }
  return blur_within_classes(part, labels, sigma_px);
}

// Length of the mean direction of strokes within Gaussians of growing sigma, over that of the
// directions themselves (quadratic means).
std::array<double, 4> fit_steadiness(const Tensor& strokes, const ClassPlaces& own) {
  Grid<float> cosines(own.box.width(), own.box.height(), 0.0F);
  Grid<float> sines = cosines;
  Grid<float> weight = cosines;
  const int stride = strokes.xx.width();
  double squares = 0.0;
  for (const auto& [x, y] : own.places) {
    const PaintDirection direction =
        direction_at(strokes, static_cast<std::size_t>(y) * static_cast<std::size_t>(stride) +
                                  static_cast<std::size_t>(x));
    const std::size_t i = weight.index(x - own.box.x0, y - own.box.y0);
    cosines[i] = static_cast<float>(direction.coherence * direction.cos2);
    sines[i] = static_cast<float>(direction.coherence * direction.sin2);
    weight[i] = 1.0F;
    squares += direction.coherence * direction.coherence;
  }
  std::array<double, 4> out{};
  double before = 1.0;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const double sigma_px = 8.0 * (1 << k);
    const Grid<float> c = gaussian_blur(cosines, sigma_px);
    const Grid<float> s = gaussian_blur(sines, sigma_px);
    const Grid<float> w = gaussian_blur(weight, sigma_px);
    double left = 0.0;
    for (std::size_t i = 0; i < w.size(); ++i)
      if (weight[i] > 0.0F)
        left += static_cast<double>(c[i] * c[i] + s[i] * s[i]) /
                std::max(static_cast<double>(w[i] * w[i]), 1e-6);
    before = std::min(before, std::sqrt(left / std::max(squares, 1e-9)));
    out[k] = before;
  }
  return out;
}

StyleBrushwork fit_class(const Grid<glm::vec3>& colours, const Grid<std::uint8_t>& mask,
                         std::uint8_t label, const PaintFields& fields,
                         const BrushworkParameters& parameters) {
  const ClassPlaces own = find_places(mask, label);
  StyleBrushwork out;
  if (own.places.size() < parameters.min_texels) return out;
  const std::uint64_t seed = stream_seed(label, Stream::style_fit);
  std::vector<Sample> samples;
  double level = 0.0;
  double form = 0.0;
  double coherence = 0.0;
  for (const std::size_t i : spread_choice(own.places.size(), parameters.samples, seed)) {
    Sample s{own.places[i][0], own.places[i][1], {}, {}};
    const std::size_t at = mask.index(s.x, s.y);
    s.direction = direction_at(fields.strokes, at);
    s.form = direction_at(fields.forms, at);
    level += s.direction.coherence * s.direction.cos2;
    form +=
        s.direction.coherence * (s.direction.cos2 * s.form.cos2 + s.direction.sin2 * s.form.sin2);
    coherence += s.direction.coherence;
    samples.push_back(s);
  }
  out.level = level / std::max(coherence, 1e-9);
  out.form = form / std::max(coherence, 1e-9);
  out.coherence = coherence / static_cast<double>(samples.size());
  out.length_px =
      std::clamp(3.0 * half_distance(fields.normal, samples, true), 1.0, parameters.max_length_px);
  out.width_px =
      std::clamp(3.0 * half_distance(fields.normal, samples, false), 0.5, parameters.max_width_px);
  if (label == static_cast<std::uint8_t>(LandCoverClass::sky))
    out.steadiness = fit_steadiness(fields.strokes, own);
  const Grid<glm::vec3> means = class_means(colours, own, std::max(3.0, 1.2 * out.length_px));
  std::vector<Difference> differences;
  double sum = 0.0;
  double squares = 0.0;
  for (const Sample& s : samples) {
    const glm::vec3& mean = means(s.x - own.box.x0, s.y - own.box.y0);
    const glm::vec3 residual = fields.fine(s.x, s.y) - mean;
    differences.push_back({mean.x, residual});
    sum += static_cast<double>(residual.x);
    squares += static_cast<double>(residual.x) * static_cast<double>(residual.x);
  }
  const auto count = static_cast<double>(samples.size());
  out.lightness_deviation = std::sqrt(std::max(0.0, squares / count - sum / count * (sum / count)));
  fit_residuals(std::move(differences), parameters, stream_seed(label, Stream::style_fit, 1), out);
  std::vector<glm::vec3> texels;
  for (const auto& [x, y] : own.places) texels.push_back(fields.fine(x, y));
  fit_accents(std::move(texels), parameters, stream_seed(label, Stream::style_fit, 2), out);
  return out;
}

}  // namespace

std::array<StyleBrushwork, land_cover_class_count> fit_brushwork(
    const Grid<glm::vec3>& colours, const Grid<std::uint8_t>& mask,
    const BrushworkParameters& parameters) {
  const Grid<float> lightness = lightness_channel(colours);
  PaintFields fields;
  fields.normal = normalized(lightness);
  fields.strokes = structure_tensor(lightness, 0.8, 3.0);
  fields.forms = structure_tensor(gaussian_blur(lightness, form_fine_px), 1.0, form_around_px);
  fields.fine = Grid<glm::vec3>(colours.width(), colours.height());
  for (int channel = 0; channel < 3; ++channel) {
    Grid<float> values(colours.width(), colours.height());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = colours[i][channel];
    values = gaussian_blur(values, fine_px);
    for (std::size_t i = 0; i < values.size(); ++i) fields.fine[i][channel] = values[i];
  }
  std::array<StyleBrushwork, land_cover_class_count> out;
  parallel_ranges(land_cover_class_count, 1, [&](int begin, int end) {
    for (int c = begin; c != end; ++c)
      out[static_cast<std::size_t>(c)] =
          fit_class(colours, mask, static_cast<std::uint8_t>(c), fields, parameters);
  });
  return out;
}

}  // namespace belvedere
