#include "renderer/exemplar/uncertain_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "base/filter.h"
#include "base/masks/label_blur.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

constexpr double half_trust_share = 0.01;  // of the width: deviation at trust .5
constexpr float min_trust = 1e-4F;
constexpr float exact_px = 0.5F;  // smaller deviations are none
constexpr int steps = 10;         // of deviation: .5 … 1, 1 … 2, … px and beyond

// The step of a deviation, or -1 for none.
int step_of(float deviation_px) {
  int step = -1;
  for (float from = exact_px; deviation_px >= from && step + 1 < steps; from *= 2.F) ++step;
  return step;
}

// The deviation that stands for a step: the middle of its range.
double deviation_of(int step) { return 0.75 * static_cast<double>(1 << step); }

std::array<bool, steps> used_steps(const Grid<float>& deviation_px) {
  std::array<bool, steps> used{};
  for (const float deviation : deviation_px)
    if (const int step = step_of(deviation); step >= 0) used[static_cast<std::size_t>(step)] = true;
  return used;
}

// Calls take(i) for the pixels of a step.
void each_of_step(const Grid<float>& deviation_px, int step,
                  const std::function<void(std::size_t)>& take) {
  for (std::size_t i = 0; i < deviation_px.size(); ++i)
    if (step_of(deviation_px[i]) == step) take(i);
}

}  // namespace

Grid<float> place_deviation(const Grid<float>& trust) {
  Grid<float> out(trust.width(), trust.height());
  const double half_px = half_trust_share * trust.width();
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x) {
      const double share = static_cast<double>(std::clamp(trust(x, y), min_trust, 1.F));
      out(x, y) = static_cast<float>(half_px * std::sqrt(1.0 / share - 1.0));
    }
  });
  return out;
}

float place_trust(double deviation_px, int width) {
  const double halves = deviation_px / (half_trust_share * width);
  return static_cast<float>(1.0 / (1.0 + halves * halves));
}

Grid<float> average_over_places(const Grid<float>& values, const Grid<std::uint8_t>& labels,
                                const Grid<float>& deviation_px) {
  Grid<float> out = values;
  const std::array<bool, steps> used = used_steps(deviation_px);
  for (int step = 0; step < steps; ++step) {
    if (!used[static_cast<std::size_t>(step)]) continue;
    const Grid<float> blurred = blur_within_labels(values, labels, deviation_of(step));
    each_of_step(deviation_px, step, [&](std::size_t i) {
      if (labels[i] != unused_label) out[i] = blurred[i];
    });
  }
  return out;
}

void average_over_places(const Grid<float>& deviation_px, GuideStack& guides) {
  for (Guide& guide : guides.guides) {
    if (guide.name == "tone" || guide.name == "shadow") continue;
    Grid<float> values(guide.values.width(), guide.values.height());
    std::copy(guide.values.begin(), guide.values.end(), values.begin());
    values = average_over_places(values, guides.label, deviation_px);
    for (std::size_t i = 0; i < values.size(); ++i)
      guide.values[i] = static_cast<std::uint8_t>(std::lround(values[i]));
  }
}

Grid<std::uint8_t> certain_labels(const Grid<std::uint8_t>& labels,
                                  const Grid<float>& deviation_px) {
  Grid<std::uint8_t> out = labels;
  std::array<bool, 256> present{};
  for (const std::uint8_t label : labels) present[label] = true;
  const std::array<bool, steps> used = used_steps(deviation_px);
  for (std::size_t label = 0; label < unused_label; ++label) {
    if (!present[label]) continue;
    Grid<float> own(labels.width(), labels.height());
    for (std::size_t i = 0; i < own.size(); ++i) own[i] = labels[i] == label ? 1.F : 0.F;
    for (int step = 0; step < steps; ++step) {
      if (!used[static_cast<std::size_t>(step)]) continue;
      const Grid<float> share = gaussian_blur(own, deviation_of(step));
      each_of_step(deviation_px, step, [&](std::size_t i) {
        if (labels[i] == label && share[i] < 0.5F) out[i] = unused_label;
      });
    }
  }
  return out;
}

Grid<std::uint8_t> certain_sky(Grid<std::uint8_t> labels, int skyline_px) {
  constexpr auto sky = static_cast<std::uint8_t>(LandCoverClass::sky);
  // From above, so that rows below are still as they were.
  for (int y = 0; y < labels.height(); ++y)
    for (int x = 0; x < labels.width(); ++x)
      if (labels(x, y) == sky && labels.clamped(x, y + skyline_px) != sky)
        labels(x, y) = unused_label;
  return labels;
}

namespace {

// Deviation of a texel's brightness from its surroundings for which the costs of synthesis are
// tuned, encoded sRGB: strong, even strokes.
constexpr double tuned_contrast = 14.0 / 255.0;
constexpr double around_texels = 2.0;

}  // namespace

Grid<Rgb8> seam_picture(const PaintedExemplar& painted, const Grid<std::uint8_t>& labels,
                        double residual) {
  const Grid<glm::vec3>& picture = painted.picture;
  Grid<glm::vec3> carried = picture;
  if (!painted.base.empty())
    for (std::size_t i = 0; i < carried.size(); ++i)
      carried[i] -= static_cast<float>(residual) * painted.base[i];
  Grid<float> brightness(carried.width(), carried.height());
  for (std::size_t i = 0; i < carried.size(); ++i)
    brightness[i] = (carried[i].x + carried[i].y + carried[i].z) / 3.F;
  const Grid<float> around = gaussian_blur(brightness, around_texels);

  struct Sums {
    glm::dvec3 colour{0.0};
    double squares = 0.0;
    double count = 0.0;
  };
  std::array<Sums, 256> sums{};
  for (std::size_t i = 0; i < carried.size(); ++i) {
    Sums& s = sums[labels[i]];
    const double detail = brightness[i] - around[i];
    s.colour += glm::dvec3(carried[i]);
    s.squares += detail * detail;
    s.count += 1.0;
  }
  std::array<glm::vec3, 256> centre{};
  std::array<float, 256> gain{};
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const double count = std::max(1.0, sums[k].count);
    centre[k] = glm::vec3(sums[k].colour / count);
    gain[k] = static_cast<float>(
        std::clamp(tuned_contrast / std::sqrt(sums[k].squares / count + 1e-12), 1.0, 8.0));
  }
  Grid<Rgb8> seams(picture.width(), picture.height());
  for (std::size_t i = 0; i < seams.size(); ++i) {
    const std::uint8_t k = labels[i];
    seams[i] = to_rgb8(glm::vec3(0.5F) + gain[k] * (carried[i] - centre[k]));
  }
  return seams;
}

}  // namespace belvedere
