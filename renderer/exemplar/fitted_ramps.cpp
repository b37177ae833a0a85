#include "renderer/exemplar/fitted_ramps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/vec4.hpp>
#include <utility>

#include "base/parallel.h"
#include "base/statistics.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {
namespace {

constexpr int tone_bins = 12;
constexpr int distance_bins = 8;
constexpr int distance_nodes = 4;
constexpr int min_distance_range = 8;  // steps of the guide; a smaller range counts as one distance

// Weights of the terms that keep ramps smooth where texels are few, relative to data whose weights
// sum to 1.
constexpr double bend_weight = 2e-3;      // second differences over tone
constexpr double distance_weight = 1e-3;  // differences from one distance to the next
constexpr double slope_weight = 1e-5;  // differences over tone: decides if all texels have one tone

// The two nodes around a position and the share of the upper one.
struct Between {
  std::size_t lower = 0;
  double share = 0.0;
};
template <class Nodes>
Between between(const Nodes& nodes, double position) {
  if (nodes.size() < 2 || position <= nodes.front()) return {};
  if (position >= nodes.back()) return {nodes.size() - 2, 1.0};
  std::size_t k = 0;
  while (k + 2 < nodes.size() && position > nodes[k + 1]) ++k;
  return {k, (position - nodes[k]) / (nodes[k + 1] - nodes[k])};
}

// A median colour and its weight.
struct Sample {
  double tone;
  double distance;
  glm::dvec3 colour;
  double weight;
};

// Medians of tone × distance of one label's texels.
std::vector<Sample> find_medians(const std::vector<std::size_t>& texels,
                                 const Grid<glm::vec3>& picture, const Grid<float>& tone,
                                 const Grid<std::uint8_t>& distance, double nearest,
                                 double farthest) {
  std::vector<std::vector<std::size_t>> cells(static_cast<std::size_t>(tone_bins * distance_bins));
  const double range = std::max(farthest - nearest, 1.0);
  for (const std::size_t i : texels) {
    const int t = std::clamp(static_cast<int>(tone[i] * tone_bins), 0, tone_bins - 1);
    const double far = distance.empty() ? 0.0 : (distance[i] - nearest) / range;
    const int d = std::clamp(static_cast<int>(far * distance_bins), 0, distance_bins - 1);
    cells[static_cast<std::size_t>(d * tone_bins + t)].push_back(i);
  }
  std::vector<Sample> samples;
  std::vector<float> values;
  double total = 0.0;
  for (const std::vector<std::size_t>& cell : cells) {
    if (cell.empty()) continue;
    Sample sample{0.0, 0.0, {}, std::sqrt(static_cast<double>(cell.size()))};
    for (const std::size_t i : cell) {
      sample.tone +=
          static_cast<double>(std::clamp(tone[i], 0.F, 1.F)) / static_cast<double>(cell.size());
      if (!distance.empty()) sample.distance += distance[i] / static_cast<double>(cell.size());
    }
    for (int c = 0; c < 3; ++c) {
      values.clear();
      for (const std::size_t i : cell) values.push_back(picture[i][c]);
      sample.colour[c] = static_cast<double>(value_at_rank(values, values.size() / 2));
    }
    total += sample.weight;
    samples.push_back(sample);
  }
  for (Sample& sample : samples) sample.weight /= total;
  return samples;
}

// A small symmetric system with three right-hand sides; Cholesky.
class NormalEquations {
 public:
  explicit NormalEquations(std::size_t size)
      : size_(size), matrix_(size * size, 0.0), right_(size, glm::dvec3(0.0)) {}

  // Adds weight · (Σ factor · unknown - value)².
  void add(const std::vector<std::pair<std::size_t, double>>& terms, glm::dvec3 value,
           double weight) {
    for (const auto& [i, a] : terms) {
      for (const auto& [j, b] : terms) matrix_[i * size_ + j] += weight * a * b;
      right_[i] += weight * a * value;
    }
  }

  std::vector<glm::dvec3> solve() {
    for (std::size_t i = 0; i < size_; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        double sum = matrix_[i * size_ + j];
        for (std::size_t k = 0; k < j; ++k) sum -= matrix_[i * size_ + k] * matrix_[j * size_ + k];
        matrix_[i * size_ + j] =
            i == j ? std::sqrt(std::max(sum, 1e-12)) : sum / matrix_[j * size_ + j];
      }
    std::vector<glm::dvec3> x = right_;
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t k = 0; k < i; ++k) x[i] -= matrix_[i * size_ + k] * x[k];
      x[i] /= matrix_[i * size_ + i];
    }
    for (std::size_t i = size_; i-- > 0;) {
      for (std::size_t k = i + 1; k < size_; ++k) x[i] -= matrix_[k * size_ + i] * x[k];
      x[i] /= matrix_[i * size_ + i];
    }
    return x;
  }

 private:
  std::size_t size_;
  std::vector<double> matrix_;
  std::vector<glm::dvec3> right_;
};

LabelRamps fit_label(const std::vector<std::size_t>& texels, const Grid<glm::vec3>& picture,
                     const Grid<float>& tone, const Grid<std::uint8_t>& distance) {
  LabelRamps fitted;
  fitted.texels = texels.size();
  if (texels.size() < min_texels) return fitted;
  int nearest = 255;
  int farthest = 0;
  if (!distance.empty())
    for (const std::size_t i : texels) {
      nearest = std::min<int>(nearest, distance[i]);
      farthest = std::max<int>(farthest, distance[i]);
    }
  const bool deep = farthest - nearest >= min_distance_range;
  if (deep)
    for (int k = 0; k < distance_nodes; ++k)
      fitted.distances.push_back(nearest + (farthest - nearest) * static_cast<double>(k) /
                                               (distance_nodes - 1));
  else
    fitted.distances.push_back(distance.empty() ? 0.0 : 0.5 * (nearest + farthest));

  constexpr std::size_t stops = ramp_tones.size();
  const std::size_t layers = fitted.distances.size();
  NormalEquations equations(stops * layers);
  for (const Sample& s : find_medians(texels, picture, tone, deep ? distance : Grid<std::uint8_t>(),
                                      static_cast<double>(nearest), farthest)) {
    const Between t = between(ramp_tones, s.tone);
    const Between d = between(fitted.distances, s.distance);
    std::vector<std::pair<std::size_t, double>> terms;
    for (std::size_t j = 0; j < (layers > 1 ? 2U : 1U); ++j)
      for (std::size_t k = 0; k < 2; ++k) {
        const double share = (k == 1 ? t.share : 1.0 - t.share) * (layers == 1 ? 1.0
                                                                   : j == 1    ? d.share
                                                                               : 1.0 - d.share);
        if (share > 0.0) terms.emplace_back((d.lower + j) * stops + t.lower + k, share);
      }
    equations.add(terms, s.colour, s.weight);
  }
  for (std::size_t d = 0; d < layers; ++d)
    for (std::size_t t = 0; t < stops; ++t) {
      const std::size_t i = d * stops + t;
      // Slopes, because the tones of the stops are not quite evenly spaced.
      const auto step = [&](std::size_t k) {
        return 1.0 / (3.0 * (ramp_tones[k + 1] - ramp_tones[k]));
      };
      if (t + 2 < stops)
        equations.add({{i, step(t)}, {i + 1, -step(t) - step(t + 1)}, {i + 2, step(t + 1)}},
                      glm::dvec3(0.0), bend_weight / static_cast<double>(layers));
      if (t + 1 < stops) equations.add({{i, -1.0}, {i + 1, 1.0}}, glm::dvec3(0.0), slope_weight);
      if (d + 1 < layers)
        equations.add({{i, -1.0}, {i + stops, 1.0}}, glm::dvec3(0.0),
                      distance_weight / static_cast<double>(layers));
    }
  const std::vector<glm::dvec3> solution = equations.solve();
  fitted.ramps.resize(layers);
  for (std::size_t d = 0; d < layers; ++d)
    for (std::size_t t = 0; t < stops; ++t)
      fitted.ramps[d][t] = glm::clamp(glm::vec3(solution[d * stops + t]), 0.F, 1.F);
  return fitted;
}

}  // namespace

glm::vec3 LabelRamps::colour(double tone, double distance) const {
  const Between t = between(ramp_tones, tone);
  const Between d = between(distances, distance);
  const auto at = [&](std::size_t layer) {
    return glm::mix(ramps[layer][t.lower], ramps[layer][t.lower + 1], static_cast<float>(t.share));
  };
  return ramps.size() == 1 ? at(0)
                           : glm::mix(at(d.lower), at(d.lower + 1), static_cast<float>(d.share));
}

FittedRamps fit_ramps(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& labels,
                      const Grid<float>& tone, const Grid<std::uint8_t>& distance) {
  std::array<std::vector<std::size_t>, 256> texels;
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (labels[i] != unused_label) texels[labels[i]].push_back(i);
  FittedRamps ramps;
  parallel_rows(256, [&](int label) {
    const auto k = static_cast<std::size_t>(label);
    ramps[k] = fit_label(texels[k], picture, tone, distance);
  });
  return ramps;
}

Grid<glm::vec3> make_ramp_base(const FittedRamps& ramps, const Grid<glm::vec3>& picture,
                               const Grid<std::uint8_t>& labels, const Grid<float>& tone,
                               const Grid<std::uint8_t>& distance) {
  Grid<glm::vec3> base = picture;
  parallel_rows(base.height(), [&](int y) {
    for (int x = 0; x < base.width(); ++x) {
      const LabelRamps& ramp = ramps[labels(x, y)];
      if (labels(x, y) == unused_label || ramp.ramps.empty()) continue;
      base(x, y) = ramp.colour(tone(x, y), distance.empty() ? 0.0 : distance(x, y));
    }
  });
  return base;
}

Grid<glm::vec3> make_centred_base(const FittedRamps& ramps, const Grid<glm::vec3>& picture,
                                  const Grid<std::uint8_t>& labels, const Grid<float>& tone,
                                  const Grid<std::uint8_t>& distance) {
  Grid<glm::vec3> base = make_ramp_base(ramps, picture, labels, tone, distance);
  std::array<glm::dvec4, 256> sums{};  // of the difference, and its count
  for (std::size_t i = 0; i < base.size(); ++i)
    sums[labels[i]] += glm::dvec4(glm::dvec3(picture[i] - base[i]), 1.0);
  for (std::size_t i = 0; i < base.size(); ++i)
    base[i] += glm::vec3(glm::dvec3(sums[labels[i]]) / sums[labels[i]].w);
  return base;
}

}  // namespace belvedere
