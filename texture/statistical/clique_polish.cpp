#include "texture/statistical/clique_polish.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random_streams.h"
#include "texture/statistical/difference_histogram.h"

namespace belvedere {
namespace {

constexpr int lattice =
    4;  // distance of the pixels of one phase, so that none is another's 4-neighbour

// One type of the level, prepared for summation.
struct Term {
  CliqueType type;
  float low;
  float to_bin;
  std::array<float, potential_bins> potential{};
};

float potential_of(const Term& term, float difference) {
  const int bin = static_cast<int>((difference - term.low) * term.to_bin);
  return term.potential[static_cast<std::size_t>(std::clamp(bin, 0, potential_bins - 1))];
}

std::vector<Term> make_terms(const CliqueModel& model, int level) {
  std::vector<Term> terms;
  for (const Clique& clique : model.cliques) {
    if (clique.type.level != level) continue;
    const DifferenceRange range = difference_range(model.bands, clique.type);
    terms.push_back({clique.type, range.low, potential_bins / (range.high - range.low)});
  }
  return terms;
}

// Shares of the model in bins of potentials.
std::vector<std::array<float, potential_bins>> wanted_shares(const CliqueModel& model, int level) {
  std::vector<std::array<float, potential_bins>> out;
  for (const Clique& clique : model.cliques) {
    if (clique.type.level != level) continue;
    const DifferenceRange range = difference_range(model.bands, clique.type);
    const CliqueKnots knots = decode_knots(model.bands, clique);
    const float width = (range.high - range.low) / potential_bins;
    std::array<float, potential_bins> shares{};
    for (int i = 0; i < potential_bins; ++i)
      shares[static_cast<std::size_t>(i)] =
          share_below(knots, range.low + static_cast<float>(i + 1) * width) -
          share_below(knots, range.low + static_cast<float>(i) * width);
    out.push_back(shares);
  }
  return out;
}

void correct(const BandPicture& picture, const BandSpace& bands, Term& term,
             const std::array<float, potential_bins>& wanted, double correction,
             double share_floor) {
  const DifferenceHistogram histogram = count_differences(picture, bands, term.type);
  constexpr std::size_t joined = difference_bins / potential_bins;
  const double total = static_cast<double>(std::max<std::uint64_t>(histogram.total, 1));
  for (std::size_t i = 0; i < term.potential.size(); ++i) {
    double count = 0.0;
    for (std::size_t j = 0; j < joined; ++j) count += histogram.counts[joined * i + j];
    term.potential[i] += static_cast<float>(
        correction * exact::log((count / total + share_floor) /
                                (std::max(0.0, static_cast<double>(wanted[i])) + share_floor)));
  }
}

using Colour = std::array<float, 3>;

Colour colour_at(const BandPicture& p, int x, int y) {
  return {p.bands[0](x, y), p.bands[1](x, y), p.bands[2](x, y)};
}

// The cost of a change of one pixel: the potentials of all cliques with that pixel at an end.
float cost(const BandPicture& p, const std::vector<Term>& terms, int x, int y, const Colour& from,
           const Colour& to) {
  const auto counted = [&](int cx, int cy) {
    return p.states.contains(cx, cy) && (p.states(cx, cy) & pixel_counts) != 0;
  };
  float sum = 0.F;
  for (const Term& term : terms) {
    const CliqueType& t = term.type;
    const auto head = static_cast<std::size_t>(t.head);
    const auto tail = static_cast<std::size_t>(t.tail);
    if (t.dx == 0 && t.dy == 0) {
      const auto own = [&](const Colour& c) { return t.single() ? c[head] : c[head] - c[tail]; };
      sum += potential_of(term, own(to)) - potential_of(term, own(from));
      continue;
    }
    if (to[head] != from[head] && counted(x - t.dx, y - t.dy)) {
      const float other = p.bands[tail](x - t.dx, y - t.dy);
      sum += potential_of(term, to[head] - other) - potential_of(term, from[head] - other);
    }
    if (to[tail] != from[tail] && counted(x + t.dx, y + t.dy)) {
      const float other = p.bands[head](x + t.dx, y + t.dy);
      sum += potential_of(term, other - to[tail]) - potential_of(term, other - from[tail]);
    }
  }
  return sum;
}

// Picks one of `count` items. A draw rounded to float can be 1.
std::size_t one_of(std::size_t count, float which) {
  return std::min(count - 1, static_cast<std::size_t>(which * static_cast<float>(count)));
}

// A proposed colour: that of one of its eight neighbours, slightly changed, or its own with one
// band changed.
Colour proposal(const BandPicture& p, const BandSpace& bands, int x, int y, const Colour& own,
                bool of_neighbour, std::uint64_t seed, TexturePosition position) {
  constexpr std::array<std::array<int, 2>, 8> around = {
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};
  const auto draw = [&](std::uint64_t n) {
    return static_cast<float>(random_uniform(seed, position.x + x, position.y + y, n));
  };
  Colour to = own;
  const float which = draw(0);
  if (of_neighbour) {
    const std::array<int, 2>& step = around[one_of(around.size(), which)];
    const int nx = std::clamp(x + step[0], 0, p.width() - 1);
    const int ny = std::clamp(y + step[1], 0, p.height() - 1);
    for (std::size_t b = 0; b < 3; ++b) to[b] = p.bands[b](nx, ny) + (draw(1 + b) - .5F) * 3.F;
  } else {
    const std::size_t b = one_of(to.size(), which);
    const float size = draw(2);
    to[b] += (draw(1) - .5F) * size * .25F * (bands.high[b] - bands.low[b]);
  }
  for (std::size_t b = 0; b < 3; ++b) to[b] = std::clamp(to[b], bands.low[b], bands.high[b]);
  return to;
}

// One sweep: the pixels of each of sixteen phases decide by the current picture, then change
// together.
void sweep(BandPicture& p, const CliqueModel& model, const std::vector<Term>& terms,
           bool of_neighbour, std::uint64_t seed, TexturePosition position) {
  const auto first = [](int phase, int origin) {
    return (((phase - origin) % lattice) + lattice) % lattice;
  };
  const int across = (p.width() + lattice - 1) / lattice;
  std::vector<Colour> next(static_cast<std::size_t>(across) *
                           static_cast<std::size_t>((p.height() + lattice - 1) / lattice));
  std::vector<std::uint8_t> taken(next.size());
  for (int phase = 0; phase < lattice * lattice; ++phase) {
    // Phases are those of the unbounded texture, so that all windows decide in the same order.
    const int x0 = first((phase * 5) % lattice, position.x);
    const int y0 = first(phase / lattice, position.y);
    const int rows = (p.height() - y0 + lattice - 1) / lattice;
    const auto each = [&](auto&& f) {
      parallel_ranges(std::max(rows, 0), 4, [&](int begin, int end) {
        for (int r = begin; r != end; ++r)
          for (int x = x0, k = r * across; x < p.width(); x += lattice, ++k)
            f(x, y0 + lattice * r, static_cast<std::size_t>(k));
      });
    };
    each([&](int x, int y, std::size_t k) {
      taken[k] = 0;
      if ((p.states(x, y) & pixel_changes) == 0) return;
      const Colour own = colour_at(p, x, y);
      next[k] = proposal(p, model.bands, x, y, own, of_neighbour, seed, position);
      const float rise = cost(p, terms, x, y, own, next[k]);
      const bool take = rise <= 0.F || random_uniform(seed, position.x + x, position.y + y, 8) <
                                           exact::exp(-static_cast<double>(rise));
      taken[k] = take ? 1 : 0;
    });
    each([&](int x, int y, std::size_t k) {
      if (taken[k] == 0) return;
      for (std::size_t b = 0; b < 3; ++b) p.bands[b](x, y) = next[k][b];
    });
  }
}

}  // namespace

void polish(FlowState& state, const CliqueModel& model, int level,
            const PolishParameters& parameters, TexturePosition position,
            const PolishRecord* replay, PolishRecord* record) {
  std::vector<Term> terms = make_terms(model, level);
  constexpr std::size_t min_terms = 4;  // with fewer there is no information about neighbours
  if (terms.size() < min_terms) return;
  const auto wanted = wanted_shares(model, level);
  CliqueModel coarser = model;
  std::erase_if(coarser.cliques, [level](const Clique& c) { return c.type.level <= level; });
  BandPicture& picture = state.pyramid[static_cast<std::size_t>(level)];
  std::size_t rounds = 0;
  const auto round = [&](const CliqueModel& of, FlowStep step) {
    renew_coarser(state.pyramid, level);
    const FlowRound tables =
        replay != nullptr ? replay->rounds[rounds++] : find_tables(state.pyramid, of, level);
    if (record != nullptr) record->rounds.push_back(tables);
    flow(state, of, level, tables, step);
  };
  for (int t = 0; t < parameters.sweeps; ++t) {
    const double correction =
        parameters.correction * std::min(1.0, 3.0 * (parameters.sweeps - t) / parameters.sweeps);
    if (replay != nullptr) {
      const std::vector<float>& all = replay->sweeps[static_cast<std::size_t>(t)];
      for (std::size_t k = 0; k < terms.size(); ++k)
        std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(k * potential_bins), potential_bins,
                    terms[k].potential.begin());
    } else {
      parallel_ranges(terms.size(), std::size_t{1}, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k != end; ++k)
          correct(picture, model.bands, terms[k], wanted[k], correction, parameters.share_floor);
      });
    }
    if (record != nullptr) {
      std::vector<float>& all = record->sweeps.emplace_back();
      for (const Term& term : terms)
        all.insert(all.end(), term.potential.begin(), term.potential.end());
    }
    const std::uint64_t seed = stream_seed(parameters.seed, Stream::statistical_moves,
                                           static_cast<std::uint64_t>(1000 * level + t));
    sweep(picture, model, terms, t % 2 == 1, seed, position);
    if (t % 2 == 1 && !coarser.cliques.empty()) round(coarser, {.rate = .6F, .momentum = 0.F});
  }
  for (int i = 0; i < 3 && parameters.resolve; ++i) round(model, {.rate = .5F, .momentum = 0.F});
}

}  // namespace belvedere
