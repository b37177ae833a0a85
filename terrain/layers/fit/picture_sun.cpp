#include "terrain/layers/fit/picture_sun.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/filter.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "terrain/climate/horizon_sweep.h"
#include "terrain/layers/fit/fit_cells.h"

namespace belvedere {
namespace {

// Unit normals, x to the east and y to the north.
Grid<glm::vec3> normals_of(const Grid<float>& altitude_m, double cell_m) {
  Grid<glm::vec3> normals(altitude_m.width(), altitude_m.height());
  parallel_rows(altitude_m.height(), [&](int y) {
    for (int x = 0; x != altitude_m.width(); ++x) {
      // One-sided at the borders, where a clamped neighbour is the cell itself.
      const int left = std::max(x - 1, 0);
      const int right = std::min(x + 1, altitude_m.width() - 1);
      const int top = std::max(y - 1, 0);
      const int bottom = std::min(y + 1, altitude_m.height() - 1);
      const float east =
          (altitude_m(right, y) - altitude_m(left, y)) /
          (static_cast<float>(std::max(right - left, 1)) * static_cast<float>(cell_m));
      const float north =
          (altitude_m(x, top) - altitude_m(x, bottom)) /
          (static_cast<float>(std::max(bottom - top, 1)) * static_cast<float>(cell_m));
      const float length = std::sqrt(east * east + north * north + 1.0F);
      normals(x, y) = {-east / length, -north / length, 1.0F / length};
    }
  });
  return normals;
}

struct Direction {
  glm::vec3 to_sun;
  float tangent;
};
Direction direction_of(double azimuth_deg, double elevation_deg) {
  const exact::Turn azimuth = exact::turn(to_radians(azimuth_deg));
  const exact::Turn elevation = exact::turn(to_radians(elevation_deg));
  return {{azimuth.sine * elevation.cosine, azimuth.cosine * elevation.cosine, elevation.sine},
          static_cast<float>(elevation.sine / elevation.cosine)};
}
float incidence(const glm::vec3& normal, const Direction& sun, float horizon) {
  if (horizon > sun.tangent) return 0.0F;
  return std::max(0.0F,
                  normal.x * sun.to_sun.x + normal.y * sun.to_sun.y + normal.z * sun.to_sun.z);
}

}  // namespace

Grid<float> sunlight(const Grid<float>& altitude_m, double cell_m, const PictureSun& sun) {
  const Grid<float> smooth = gaussian_blur(altitude_m, 1.0);
  const Grid<glm::vec3> normals = normals_of(smooth, cell_m);
  const Grid<float> horizon = horizon_tangents(smooth, {cell_m, cell_m}, sun.azimuth_deg);
  const Direction direction = direction_of(sun.azimuth_deg, sun.elevation_deg);
  Grid<float> light(altitude_m.width(), altitude_m.height());
  for (std::size_t i = 0; i != light.size(); ++i)
    light[i] = incidence(normals[i], direction, horizon[i]);
  return light;
}

PictureSun find_sun(const Grid<float>& altitude_m, double cell_m, const Grid<float>& brightness,
                    const std::vector<std::uint8_t>& labels, const Grid<std::uint8_t>& use,
                    std::optional<double> azimuth_deg) {
  constexpr std::size_t max = 30'000;  // cells used to evaluate suns
  std::vector<std::uint8_t> used(use.size());
  for (std::size_t i = 0; i != used.size(); ++i) used[i] = use[i] != 0 ? 0 : no_class;
  const std::vector<std::uint32_t> cells = draw_labelled(used, max, 1);
  PictureSun best{0.0, 45.0, -1.0};
  if (cells.size() < 3) return best;
  std::array<double, 256> sum{};
  std::array<double, 256> count{};
  const auto label_of = [&](std::uint32_t i) {
    return labels.empty() ? std::uint8_t{0} : labels[i];
  };
  for (const std::uint32_t i : cells) {
    sum[label_of(i)] += static_cast<double>(brightness[i]);
    count[label_of(i)] += 1.0;
  }
  std::vector<double> bright(cells.size());
  double squares = 0.0;
  for (std::size_t j = 0; j != cells.size(); ++j) {
    bright[j] = static_cast<double>(brightness[cells[j]]) -
                sum[label_of(cells[j])] / count[label_of(cells[j])];
    squares += bright[j] * bright[j];
  }
  const Grid<float> smooth = gaussian_blur(altitude_m, 1.0);
  const Grid<glm::vec3> normals = normals_of(smooth, cell_m);
  std::vector<double> azimuths;
  if (azimuth_deg)
    azimuths.push_back(*azimuth_deg);
  else
    for (int a = 0; a != 360; a += 5) azimuths.push_back(a);
  for (const double azimuth : azimuths) {
    const Grid<float> horizon = horizon_tangents(smooth, {cell_m, cell_m}, azimuth);
    for (int elevation = 18; elevation <= 70; elevation += 4) {
      const Direction sun = direction_of(azimuth, elevation);
      double light = 0.0;
      double light2 = 0.0;
      double both = 0.0;
      for (std::size_t j = 0; j != cells.size(); ++j) {
        const auto l = static_cast<double>(incidence(normals[cells[j]], sun, horizon[cells[j]]));
        light += l;
        light2 += l * l;
        both += l * bright[j];
      }
      const double variance = light2 - light * light / static_cast<double>(cells.size());
      const double correlation = variance > 0.0 && squares > 0.0
                                     ? both / std::sqrt(variance * squares)
                                     : 0.0;  // the mean of bright is 0
      if (correlation > best.correlation)
        best = {azimuth, static_cast<double>(elevation), correlation};
    }
  }
  return best;
}

LightAnswers light_answers(const Grid<glm::vec3>& picture, const Grid<float>& light,
                           const std::vector<std::uint8_t>& labels, int classes,
                           const Grid<std::uint8_t>& use) {
  constexpr float lit = 0.05F;
  constexpr double fewest = 50.0;
  struct Sums {
    double n = 0.0, x = 0.0, xx = 0.0;
    glm::dvec3 y{}, xy{};
  };
  std::vector<Sums> sums(static_cast<std::size_t>(classes) + 1);  // the last: of all
  for (std::size_t i = 0; i != light.size(); ++i) {
    if (use[i] == 0 || labels[i] == no_class || !(light[i] > lit)) continue;
    const auto x = static_cast<double>(light[i]);
    const glm::dvec3 rgb = picture[i];
    for (const std::size_t k : {static_cast<std::size_t>(labels[i]), sums.size() - 1}) {
      sums[k].n += 1.0;
      sums[k].x += x;
      sums[k].xx += x * x;
      sums[k].y += rgb;
      sums[k].xy += x * rgb;
    }
  }
  LightAnswers answers(static_cast<std::size_t>(classes));
  for (std::size_t k = 0; k != answers.size(); ++k) {
    const Sums& s = sums[k].n >= fewest ? sums[k] : sums.back();
    const double variance = s.xx - s.x * s.x / std::max(s.n, 1.0);
    for (int c = 0; c != 3; ++c) {
      const double mean = s.y[c] / std::max(s.n, 1.0);
      const double gain = variance > 1e-9 ? (s.xy[c] - s.x * s.y[c] / s.n) / variance : 0.0;
      // A base near 0 would give extreme factors on the darkest slopes.
      answers[k][static_cast<std::size_t>(c)] = {
          gain, std::max(mean - gain * s.x / std::max(s.n, 1.0), 0.02 * mean)};
    }
  }
  return answers;
}

double levelling(const LightAnswer& answer, double cos_incidence, double level_cos) {
  if (!(answer.gain > 1.0)) return 1.0;
  return (answer.gain * level_cos + answer.base) / (answer.gain * cos_incidence + answer.base);
}

Grid<glm::vec3> lit_evenly(const Grid<glm::vec3>& picture, const Grid<float>& light,
                           double level_cos, const std::vector<std::uint8_t>& labels,
                           const LightAnswers& answers) {
  Grid<glm::vec3> even = picture;
  parallel_rows(light.height(), [&](int y) {
    for (std::size_t i = light.index(0, y); i != light.index(0, y + 1); ++i) {
      const std::array<LightAnswer, 3>& answer = answers[labels[i] == no_class ? 0 : labels[i]];
      const auto l = static_cast<double>(light[i]);
      even[i] = glm::dvec3(picture[i]) * glm::dvec3(levelling(answer[0], l, level_cos),
                                                    levelling(answer[1], l, level_cos),
                                                    levelling(answer[2], l, level_cos));
    }
  });
  return even;
}

}  // namespace belvedere
