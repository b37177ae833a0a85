#include "terrain/layers/fit/fit_measures.h"

#include <lcms2.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <numeric>
#include <utility>

#include "base/colour/hsv.h"
#include "base/filter.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/statistics.h"

namespace belvedere {
namespace {

double linear(double encoded) {
  const double v = std::clamp(encoded, 0.0, 255.0) / 255.0;
  return v <= 0.04045 ? v / 12.92 : exact::pow((v + 0.055) / 1.055, 2.4);
}
double lab_curve(double t) {
  return t > 216.0 / 24389.0 ? exact::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
}

}  // namespace

double area_under_curve(std::span<const float> scores, std::span<const std::uint8_t> is_class) {
  std::vector<std::pair<float, std::uint8_t>> sorted(scores.size());
  for (std::size_t i = 0; i != sorted.size(); ++i) sorted[i] = {scores[i], is_class[i]};
  std::sort(sorted.begin(), sorted.end());
  double below = 0.0;  // number of cells of other classes with a smaller score
  double wins = 0.0;
  double own = 0.0;
  for (std::size_t i = 0; i != sorted.size();) {
    std::size_t end = i;
    double hits = 0.0;
    while (end != sorted.size() && sorted[end].first == sorted[i].first)
      hits += sorted[end++].second != 0 ? 1.0 : 0.0;
    const double others = static_cast<double>(end - i) - hits;
    wins += hits * (below + 0.5 * others);
    below += others;
    own += hits;
    i = end;
  }
  return own > 0.0 && below > 0.0 ? wins / (own * below) : std::numeric_limits<double>::quiet_NaN();
}

ClassMeasures measure_classes(const ClassShares& shares, std::span<const std::uint8_t> labels,
                              std::span<const double> offsets) {
  const auto classes = static_cast<std::size_t>(shares.classes);
  const std::vector<std::uint8_t> likely = most_likely(shares, offsets);
  ClassMeasures measures;
  measures.counts.assign(classes, std::vector<std::size_t>(classes, 0));
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i != labels.size(); ++i) {
    if (labels[i] == no_class) continue;
    used.push_back(i);
    ++measures.counts[labels[i]][likely[i]];
  }
  measures.cells = used.size();
  std::size_t right = 0;
  measures.iou.assign(classes, 0.0);
  measures.auc.assign(classes, 0.0);
  for (std::size_t k = 0; k != classes; ++k) {
    right += measures.counts[k][k];
    std::size_t either = 0;
    for (std::size_t j = 0; j != classes; ++j)
      either += measures.counts[k][j] + measures.counts[j][k];
    either -= measures.counts[k][k];
    measures.iou[k] = static_cast<double>(measures.counts[k][k]) /
                      static_cast<double>(std::max<std::size_t>(either, 1));
    measures.mean_iou += measures.iou[k] / static_cast<double>(classes);
  }
  measures.accuracy =
      static_cast<double>(right) / static_cast<double>(std::max<std::size_t>(used.size(), 1));
  parallel_ranges(classes, std::size_t{1}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k != end; ++k) {
      std::vector<float> scores(used.size());
      std::vector<std::uint8_t> own(used.size());
      for (std::size_t i = 0; i != used.size(); ++i) {
        scores[i] = shares.of(used[i])[k];
        own[i] = labels[used[i]] == k ? 1 : 0;
      }
      measures.auc[k] = area_under_curve(scores, own);
    }
  });
  double known = 0.0;
  for (const double auc : measures.auc) {
    if (std::isnan(auc)) continue;
    measures.mean_auc += auc;
    known += 1.0;
  }
  if (known > 0.0) measures.mean_auc /= known;
  return measures;
}

LabColour lab_of_srgb(const glm::dvec3& rgb) {
  const double lr = linear(rgb.x);
  const double lg = linear(rgb.y);
  const double lb = linear(rgb.z);
  const double x = lab_curve((0.4124564 * lr + 0.3575761 * lg + 0.1804375 * lb) / 0.95047);
  const double y = lab_curve(0.2126729 * lr + 0.7151522 * lg + 0.0721750 * lb);
  const double z = lab_curve((0.0193339 * lr + 0.1191920 * lg + 0.9503041 * lb) / 1.08883);
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

double colour_difference(const LabColour& one, const LabColour& other) {
  const cmsCIELab a = {one.l, one.a, one.b};
  const cmsCIELab b = {other.l, other.a, other.b};
  return cmsCIE2000DeltaE(&a, &b, 1.0, 1.0, 1.0);
}

BlockDifference block_difference(const Grid<glm::vec3>& picture, const Grid<glm::vec3>& other,
                                 const Grid<std::uint8_t>* use, int block) {
  constexpr double min_used = 0.3;
  std::vector<double> differences;
  for (int y0 = 0; y0 < picture.height(); y0 += block)
    for (int x0 = 0; x0 < picture.width(); x0 += block) {
      glm::dvec3 own(0.0);
      glm::dvec3 others(0.0);
      double used = 0.0;
      double cells = 0.0;
      for (int y = y0; y < std::min(y0 + block, picture.height()); ++y)
        for (int x = x0; x < std::min(x0 + block, picture.width()); ++x) {
          cells += 1.0;
          if (use != nullptr && (*use)(x, y) == 0) continue;
          used += 1.0;
          own += picture(x, y);
          others += other(x, y);
        }
      if (used < 1.0 || used < min_used * cells) continue;
      differences.push_back(colour_difference(lab_of_srgb(own / used), lab_of_srgb(others / used)));
    }
  BlockDifference result{block, 0.0, 0.0, differences.size()};
  if (differences.empty()) return result;
  result.mean = std::accumulate(differences.begin(), differences.end(), 0.0) /
                static_cast<double>(differences.size());
  result.p95 = value_at_share(std::move(differences), 0.95);
  return result;
}

double gradient_energy(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>* use) {
  const int width = picture.width();
  const int height = picture.height();
  Grid<double> lightness(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x != width; ++x) lightness(x, y) = lab_of_srgb(picture(x, y)).l;
  });
  double sum = 0.0;
  double pairs = 0.0;
  const auto add = [&](int x, int y, int x2, int y2) {
    if (x2 == width || y2 == height ||
        (use != nullptr && ((*use)(x, y) == 0 || (*use)(x2, y2) == 0)))
      return;
    const double d = lightness(x2, y2) - lightness(x, y);
    sum += d * d;
    pairs += 1.0;
  };
  for (int y = 0; y != height; ++y)
    for (int x = 0; x != width; ++x) {
      add(x, y, x + 1, y);
      add(x, y, x, y + 1);
    }
  return pairs > 0.0 ? sum / pairs : 0.0;
}

HueSaturation hue_saturation_of(const glm::dvec3& rgb, double grey_range) {
  const glm::dvec3 hsv = to_hsv(rgb);
  const double range = hsv.z - std::min({rgb.x, rgb.y, rgb.z});
  return {360.0 * hsv.x, hsv.y, hsv.z / 255.0, range <= grey_range};
}

PlanePosition hue_saturation_place(const HueSaturation& colour) {
  constexpr double grey_share = 0.3;
  const exact::Turn turn = exact::turn(to_radians(colour.hue_deg));
  const double reach = colour.own_hue ? 1.0 - grey_share * (1.0 - colour.saturation)
                                      : colour.saturation * (colour.grey ? grey_share : 1.0);
  return {reach * turn.cosine, reach * turn.sine};
}

Grid<glm::vec3> smooth_chroma(const Grid<glm::vec3>& picture, double sigma_cells) {
  const int width = picture.width();
  const int height = picture.height();
  // Luma of Rec. 601, as in JPEG.
  Grid<float> luma(width, height);
  Grid<float> red(width, height);
  Grid<float> blue(width, height);
  for (std::size_t i = 0; i != luma.size(); ++i) {
    luma[i] = 0.299F * picture[i].x + 0.587F * picture[i].y + 0.114F * picture[i].z;
    red[i] = picture[i].x - luma[i];
    blue[i] = picture[i].z - luma[i];
  }
  red = gaussian_blur(red, sigma_cells);
  blue = gaussian_blur(blue, sigma_cells);
  Grid<glm::vec3> smooth(width, height);
  for (std::size_t i = 0; i != smooth.size(); ++i) {
    const float r = luma[i] + red[i];
    const float b = luma[i] + blue[i];
    smooth[i] =
        glm::clamp(glm::vec3(r, (luma[i] - 0.299F * r - 0.114F * b) / 0.587F, b), 0.0F, 255.0F);
  }
  return smooth;
}

}  // namespace belvedere
