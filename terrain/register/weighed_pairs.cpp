#include "terrain/register/weighed_pairs.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace belvedere {

double mean_score(const WeighedPairs& weighed) {
  double sum = 0.0;
  for (std::size_t i = 0; i < weighed.index.size(); ++i) sum += weighed.judgement.scores[i];
  return sum / static_cast<double>(weighed.index.size());
}

double weight_of(double square_deviations) {
  constexpr double freedom = 4.0, hopeless = 30.0, hardly_any = 0.01;
  if (square_deviations > hopeless) return hardly_any;
  return std::min((freedom + 2.0) / (freedom + square_deviations), 1.0);
}

void weigh_by_agreement(WeighedPairs& weighed, double sigma_px, int rounds) {
  constexpr double min_weight_of_pairs = 0.25;
  PairFit fit = weighed.fit;
  fit.field.places = displaced_places(fit);
  double best_score = -std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    if (std::optional<PairFit> next = refitted(fit, sigma_px)) fit = *std::move(next);
    PairJudgement judgement = judge_pairs(fit, sigma_px);
    const std::vector<double> square_deviations = judgement.square_deviations;
    if (judgement.score > best_score) {
      best_score = judgement.score;
      weighed.fit = fit;
      weighed.judgement = std::move(judgement);
    }
    for (std::size_t i = 0; i < fit.pairs.size(); ++i) {
      const double weight = weight_of(square_deviations[i]);
      fit.weights[i] = i < weighed.index.size() ? std::max(weight, min_weight_of_pairs) : weight;
    }
    fit.field.places = displaced_places(fit);
  }
}

}  // namespace belvedere
