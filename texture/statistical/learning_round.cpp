#include "texture/statistical/learning_round.h"

#include "base/parallel.h"

namespace belvedere {

std::vector<CliqueCandidate> make_candidates(const BandPicture& example, const BandSpace& bands,
                                             const std::vector<CliqueType>& types) {
  std::vector<CliqueCandidate> out(types.size());
  parallel_ranges(types.size(), std::size_t{8}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k != end; ++k) {
      const DifferenceHistogram histogram = count_differences(example, bands, types[k]);
      const CliqueKnots knots = find_knots(histogram, difference_range(bands, types[k]));
      out[k] = {{types[k], encode_knots(bands, types[k], knots)}, HistogramGroups(histogram)};
    }
  });
  return out;
}

LearningRound evaluate_candidates(const std::vector<CliqueCandidate>& candidates,
                                  const BandPicture& made, const BandSpace& bands) {
  std::vector<HistogramGroups::Distance> off(candidates.size());
  parallel_ranges(candidates.size(), std::size_t{8}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k != end; ++k)
      if (!candidates[k].in)
        off[k] = candidates[k].groups.distance(
            count_differences(made, bands, candidates[k].clique.type));
  });
  LearningRound round{{}, candidates.size()};
  double sum = 0.0;
  int held = 0;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (candidates[k].in) {
      ++round.told.types;
      continue;
    }
    sum += off[k].l1;
    ++held;
    if (off[k].l2 <= round.told.worst_l2) continue;
    round.told.worst_l2 = off[k].l2;
    round.worst = k;
  }
  round.told.held_out_l1 = held > 0 ? sum / held : 0.0;
  return round;
}

}  // namespace belvedere
