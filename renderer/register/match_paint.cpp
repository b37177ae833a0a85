#include "renderer/register/match_paint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/matrix/matrix.h"
#include "base/parallel.h"
#include "base/statistics.h"

namespace belvedere {
namespace {

constexpr std::size_t factors = 7;      // 1, normal, altitude, ln distance, sky
constexpr std::size_t max_across = 32;  // shifts across, so that loops over them have one length
using Factors = std::array<float, factors>;
using Sums = std::array<float, max_across>;  // of each shift across

Grid<Factors> factors_of(const RegisteredGround& ground) {
  std::vector<float> altitudes, distances;
  for (std::size_t i = 0; i < ground.altitude_m.size(); ++i) {
    if (std::isnan(ground.altitude_m[i])) continue;
    altitudes.push_back(ground.altitude_m[i]);
    distances.push_back(ground.distance_m[i]);
  }
  Grid<Factors> out(ground.altitude_m.width(), ground.altitude_m.height());
  if (altitudes.empty()) return out;
  const auto middle = static_cast<double>(value_at_share(std::move(altitudes), 0.5));
  const auto far = static_cast<double>(value_at_share(std::move(distances), 0.5));
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (std::isnan(ground.altitude_m[i])) {
      out[i] = {1.F, 0.F, 0.F, 0.F, 0.F, 0.F, 1.F};
      continue;
    }
    const glm::vec3 n = ground.normal[i];
    const double z = static_cast<double>(ground.altitude_m[i]) - middle;
    const double d = exact::log(static_cast<double>(ground.distance_m[i]) / far);
    out[i] = {1.F, n.x, n.y, n.z, static_cast<float>(z / 500.0), static_cast<float>(2.0 * d), 0.F};
  }
  return out;
}

// A patch's factors as functions without correlation under its window, times the window.
struct Patch {
  std::array<Grid<float>, factors> basis;
  Grid<float> window;
  double area = 0.0;  // sum of the window
};

std::optional<Patch> patch_at(const Grid<Factors>& picture, glm::ivec2 middle, int half) {
  constexpr double min_inside = 0.6, ridge = 1e-3;
  const int side = 2 * half + 1;
  Patch out;
  out.window = Grid<float>(side, side);
  double whole = 0.0;
  const auto hann = [&](int i) {
    return 0.5 - 0.5 * exact::cos(2.0 * std::numbers::pi * (i + 1) / (side + 1));
  };
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double weight = hann(x) * hann(y);
      whole += weight;
      if (!picture.contains(middle.x - half + x, middle.y - half + y)) continue;
      out.window(x, y) = static_cast<float>(weight);
      out.area += weight;
    }
  if (out.area < min_inside * whole) return std::nullopt;
  Matrix moments(factors, factors);
  const auto at = [&](int x, int y) -> const Factors& {
    return picture.clamped(middle.x - half + x, middle.y - half + y);
  };
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (std::size_t i = 0; i < factors; ++i)
        for (std::size_t k = 0; k <= i; ++k)
          moments(i, k) += static_cast<double>(out.window(x, y) * at(x, y)[i] * at(x, y)[k]);
  std::array<double, factors> scale{};
  for (std::size_t i = 0; i < factors; ++i) scale[i] = 1.0 / (std::sqrt(moments(i, i)) + 1e-9);
  for (std::size_t i = 0; i < factors; ++i) {
    for (std::size_t k = 0; k <= i; ++k) moments(i, k) *= scale[i] * scale[k];
    moments(i, i) += ridge;
  }
  const std::optional<Cholesky> uncorrelated = Cholesky::of(std::move(moments));
  if (!uncorrelated) return std::nullopt;
  for (Grid<float>& plane : out.basis) plane = Grid<float>(side, side);
  std::array<double, factors> values{};
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      for (std::size_t i = 0; i < factors; ++i)
        values[i] = static_cast<double>(at(x, y)[i]) * scale[i];
      const std::vector<double> white = uncorrelated->whitened(values);
      for (std::size_t i = 0; i < factors; ++i)
        out.basis[i](x, y) = static_cast<float>(white[i]) * out.window(x, y);
    }
  return out;
}

// A channel of the paint with its borders replicated, and its squares.
struct Channel {
  Grid<float> values, squares;
};

std::array<Channel, 3> padded_channels(const Grid<glm::vec3>& paint, glm::ivec2 border) {
  std::array<Channel, 3> out;
  for (int c = 0; c < 3; ++c) {
    Channel& channel = out[static_cast<std::size_t>(c)];
    channel.values = channel.squares =
        Grid<float>(paint.width() + 2 * border.x + int{max_across}, paint.height() + 2 * border.y);
    for (int y = 0; y < channel.values.height(); ++y)
      for (int x = 0; x < channel.values.width(); ++x) {
        const float value = paint.clamped(x - border.x, y - border.y)[c];
        channel.values(x, y) = value;
        channel.squares(x, y) = value * value;
      }
  }
  return out;
}

// The weighted sum of a plane under a patch, at max_across shifts from a corner.
Sums slide(const Grid<float>& weights, const Grid<float>& plane, glm::ivec2 corner) {
  Sums sums{};
  for (int y = 0; y < weights.height(); ++y) {
    const float* weight = weights.row(y);
    const float* values = plane.row(corner.y + y) + corner.x;
    for (int x = 0; x < weights.width(); ++x)
      for (std::size_t shift = 0; shift < max_across; ++shift)
        sums[shift] += weight[x] * values[static_cast<std::size_t>(x) + shift];
  }
  return sums;
}

// R² at each shift.
Grid<float> explained_shares(const Patch& patch, const std::array<Channel, 3>& paint,
                             glm::ivec2 corner, glm::ivec2 reach) {
  Grid<float> explained(2 * reach.x + 1, 2 * reach.y + 1), variance = explained;
  for (int y = 0; y < explained.height(); ++y)
    for (const Channel& channel : paint) {
      const glm::ivec2 from(corner.x, corner.y + y);
      const Sums mean = slide(patch.window, channel.values, from);
      const Sums square_sum = slide(patch.window, channel.squares, from);
      Sums by_factors{};
      for (const Grid<float>& basis : patch.basis) {
        const Sums sums = slide(basis, channel.values, from);
        for (std::size_t i = 0; i < max_across; ++i) by_factors[i] += sums[i] * sums[i];
      }
      for (int x = 0; x < explained.width(); ++x) {
        const auto i = static_cast<std::size_t>(x);
        const float of_mean = mean[i] * mean[i] / static_cast<float>(patch.area);
        explained(x, y) += by_factors[i] - of_mean;
        variance(x, y) += square_sum[i] - of_mean;
      }
    }
  // A place of even paint says nothing.
  const float max_variance = *std::max_element(variance.begin(), variance.end());
  const float even = 1e-6F * static_cast<float>(patch.area) + 0.02F * max_variance;
  constexpr float max_share = 0.98F;
  for (std::size_t i = 0; i < explained.size(); ++i)
    explained[i] = std::clamp(explained[i] / std::max(variance[i], even), 0.F, max_share);
  return explained;
}

struct Moments {
  double mean = 0.0, variance = 0.0;
};
Moments moments_of(const std::vector<double>& shares, int reach) {
  Moments out;
  for (int i = -reach; i <= reach; ++i) out.mean += i * shares[static_cast<std::size_t>(i + reach)];
  for (int i = -reach; i <= reach; ++i)
    out.variance += square(i - out.mean) * shares[static_cast<std::size_t>(i + reach)];
  return out;
}

// Log-likelihood of each shift, prior included.
Grid<double> log_likelihoods(const Grid<float>& explained, glm::ivec2 reach, double samples,
                             double prior) {
  Grid<double> log_likelihood(explained.width(), explained.height());
  for (int y = 0; y < explained.height(); ++y)
    for (int x = 0; x < explained.width(); ++x)
      log_likelihood(x, y) =
          -0.5 * samples * exact::log(1.0 - static_cast<double>(explained(x, y))) -
          0.5 * (square(1.0 * (x - reach.x)) + square(1.0 * (y - reach.y))) / square(prior);
  return log_likelihood;
}

std::optional<PaintMatch> expected_shift(const Grid<float>& explained, glm::ivec2 reach,
                                         double samples, double prior) {
  const Grid<double> log_likelihood = log_likelihoods(explained, reach, samples, prior);
  const double highest = *std::max_element(log_likelihood.begin(), log_likelihood.end());
  std::vector<double> across(static_cast<std::size_t>(explained.width()));
  std::vector<double> along(static_cast<std::size_t>(explained.height()));
  double sum = 0.0;
  for (int y = 0; y < explained.height(); ++y)
    for (int x = 0; x < explained.width(); ++x) {
      const double p = exact::exp(log_likelihood(x, y) - highest);
      across[static_cast<std::size_t>(x)] += p;
      along[static_cast<std::size_t>(y)] += p;
      sum += p;
    }
  for (double& p : across) p /= sum;
  for (double& p : along) p /= sum;
  const Moments x = moments_of(across, reach.x), y = moments_of(along, reach.y);
  constexpr double max_unsure = 0.6, min_variance = 0.05;
  if (std::max(x.variance, y.variance) > square(max_unsure * prior)) return std::nullopt;
  PaintMatch out;
  const auto without_prior = [&](const Moments& found, double& shift, double& sigma) {
    const double by_all = std::max(found.variance, min_variance);
    const double by_paint = 1.0 / (1.0 / by_all - 1.0 / square(prior));
    shift = found.mean * by_paint / by_all;
    sigma = std::sqrt(by_paint);
  };
  without_prior(x, out.shift_px.x, out.sigma_px.x);
  without_prior(y, out.shift_px.y, out.sigma_px.y);
  return out;
}

double evidence_of(const Grid<float>& explained, glm::ivec2 reach, double samples, double prior) {
  const Grid<double> log_likelihood = log_likelihoods(explained, reach, samples, prior);
  const double highest = *std::max_element(log_likelihood.begin(), log_likelihood.end());
  double sum = 0.0;
  for (const double each : log_likelihood) sum += exact::exp(each - highest);
  return highest + exact::log(sum / static_cast<double>(log_likelihood.size()));
}

}  // namespace

std::vector<PaintMatch> match_paint(const Grid<glm::vec3>& paint, const RegisteredGround& ground,
                                    const MatchPaintParameters& parameters) {
  const Grid<Factors> picture = factors_of(ground);
  const glm::ivec2 reach(std::min(parameters.reach_px.x, (int{max_across} - 1) / 2),
                         parameters.reach_px.y);
  const glm::ivec2 border = glm::ivec2(parameters.half_px) + reach;
  const std::array<Channel, 3> channels = padded_channels(paint, border);
  std::vector<glm::ivec2> middles;
  const int spacing = parameters.spacing_px;
  for (int y = spacing / 2; y < paint.height(); y += spacing)
    for (int x = spacing / 2; x < paint.width(); x += spacing)
      if (!std::isnan(ground.altitude_m(x, y))) middles.emplace_back(x, y);
  constexpr double max_prior = 0.45;  // of the reach
  std::vector<std::optional<PaintMatch>> found(middles.size());
  parallel_rows(static_cast<int>(middles.size()), [&](int i) {
    const glm::ivec2 middle = middles[static_cast<std::size_t>(i)];
    const std::optional<Patch> patch = patch_at(picture, middle, parameters.half_px);
    if (!patch) return;
    const double prior =
        std::clamp(static_cast<double>(ground.sigma_px(middle.x, middle.y)), parameters.prior_px,
                   std::max(parameters.prior_px, max_prior * reach.x));
    std::optional<PaintMatch>& match = found[static_cast<std::size_t>(i)];
    match = expected_shift(explained_shares(*patch, channels, middle, reach), reach,
                           patch->area / parameters.independent_px2, prior);
    if (match) match->pixel = middle;
  });
  std::vector<PaintMatch> out;
  for (const std::optional<PaintMatch>& match : found)
    if (match) out.push_back(*match);
  return out;
}

Grid<double> paint_evidence(const Grid<glm::vec3>& paint, const RegisteredGround& ground,
                            const MatchPaintParameters& parameters) {
  const Grid<Factors> picture = factors_of(ground);
  const std::array<Channel, 3> channels =
      padded_channels(paint, glm::ivec2(parameters.half_px) + parameters.reach_px);
  const int spacing = parameters.spacing_px;
  Grid<double> out(paint.width() / spacing, paint.height() / spacing,
                   std::numeric_limits<double>::quiet_NaN());
  parallel_rows(out.height(), [&](int row) {
    for (int column = 0; column < out.width(); ++column) {
      const glm::ivec2 middle = spacing * glm::ivec2(column, row) + spacing / 2;
      if (std::isnan(ground.altitude_m(middle.x, middle.y))) continue;
      const std::optional<Patch> patch = patch_at(picture, middle, parameters.half_px);
      if (!patch) continue;
      out(column, row) = evidence_of(
          explained_shares(*patch, channels, middle, parameters.reach_px), parameters.reach_px,
          patch->area / parameters.independent_px2, parameters.prior_px);
    }
  });
  return out;
}

}  // namespace belvedere
