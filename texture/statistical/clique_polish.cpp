#include "texture/statistical/clique_polish.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"
#include "texture/statistical/difference_histogram.h"

namespace belvedere {
namespace {

// Rows per task. A pixel's sum is taken in the order of the types, so the strip height does not
// change the result.
constexpr int strip_rows = 64;

// Requested changes of each pixel, as sums over cliques; divided by the number of cliques a pixel
// can be part of.
using Targets = std::array<Grid<float>, 3>;

FlowTable make_table(const BandPicture& picture, const BandSpace& bands, const Clique& clique) {
  FlowTable table(difference_bins + 1, 0.F);
  const DifferenceHistogram histogram = count_differences(picture, bands, clique.type);
  if (histogram.total == 0) return table;
  const DifferenceRange range = difference_range(bands, clique.type);
  const CliqueKnots knots = decode_knots(bands, clique);
  double below = 0.0;
  for (int i = 0; i <= difference_bins; ++i) {
    const float edge =
        range.low + (range.high - range.low) * static_cast<float>(i) / difference_bins;
    table[static_cast<std::size_t>(i)] =
        value_at_share(knots, static_cast<float>(below / static_cast<double>(histogram.total))) -
        edge;
    if (i < difference_bins)
      below += static_cast<double>(histogram.counts[static_cast<std::size_t>(i)]);
  }
  return table;
}

// Adds the changes requested by the cliques of one type to the rows y0 <= y < y1; `requests` begins
// at row `first`. Half goes to the head, half with opposite sign to the tail.
void ask(const BandPicture& picture, const BandSpace& bands, const CliqueType& type,
         const FlowTable& table, int y0, int y1, Targets& requests, int first,
         std::vector<float>& row) {
  const DifferenceRange range = difference_range(bands, type);
  const float to_bin = static_cast<float>(difference_bins) / (range.high - range.low);
  const bool single = type.single();
  const float part = single ? 1.F : 0.5F;
  constexpr float last = static_cast<float>(difference_bins) - 0.001F;
  clique_rows(
      picture.width(), picture.height(), type, y0 - type.dy, y1,
      [&](int ty, int hy, int tx, int hx, int cliques) {
        const float* head = picture.band(type.head).row(hy) + hx;
        const float* tail = picture.band(type.tail).row(ty) + tx;
        const std::uint8_t* head_state = picture.states.row(hy) + hx;
        const std::uint8_t* tail_state = picture.states.row(ty) + tx;
        float* asked = row.data();
        for (int x = 0; x < cliques; ++x) {
          const float difference = single ? head[x] : head[x] - tail[x];
          const float at = std::clamp((difference - range.low) * to_bin, 0.F, last);
          const int bin = static_cast<int>(at);
          const float* edges = table.data() + bin;
          const float move = edges[0] + (at - static_cast<float>(bin)) * (edges[1] - edges[0]);
          asked[x] = (head_state[x] & tail_state[x] & pixel_counts) != 0 ? part * move : 0.F;
        }
        if (hy >= y0 && hy < y1) {
          float* to = requests[static_cast<std::size_t>(type.head)].row(hy - first) + hx;
          for (int x = 0; x < cliques; ++x) to[x] += asked[x];
        }
        if (!single && ty >= y0 && ty < y1) {
          float* to = requests[static_cast<std::size_t>(type.tail)].row(ty - first) + tx;
          for (int x = 0; x < cliques; ++x) to[x] -= asked[x];
        }
      });
}

// Requests of all cliques of a level, as the mean over the roles of a pixel, times a rate.
struct LevelTarget {
  const BandPicture& picture;
  const CliqueModel& model;
  int level;
  const FlowTable* tables;
  std::array<float, 3> factor{};  // 0: the band has no requests

  LevelTarget(const BandPicture& of, const CliqueModel& by, int at_level, const FlowTable* with,
              float rate)
      : picture(of), model(by), level(at_level), tables(with) {
    for (const Clique& clique : model.cliques) {
      if (clique.type.level != level) continue;
      factor[static_cast<std::size_t>(clique.type.head)] += 1.F;
      if (!clique.type.single()) factor[static_cast<std::size_t>(clique.type.tail)] += 1.F;
    }
    for (float& f : factor)
      if (f != 0.F) f = rate / f;
  }

  // Adds to the rows y0 <= y < y1 of requests that are 0 and begin with row `first`.
  void add_rows(int y0, int y1, Targets& requests, int first, std::vector<float>& row) const {
    const FlowTable* table = tables;
    for (const Clique& clique : model.cliques)
      if (clique.type.level == level)
        ask(picture, model.bands, clique.type, *table++, y0, y1, requests, first, row);
    for (std::size_t b = 0; b < 3; ++b) {
      if (factor[b] == 0.F) continue;
      // Fixed pixels get no requests: their cliques are not in the tables, which may come from a
      // few pixels only.
      for (int y = y0; y < y1; ++y)
        for (int x = 0; x < picture.width(); ++x)
          requests[b](x, y - first) *=
              (picture.states(x, y) & pixel_changes) != 0 ? factor[b] : 0.F;
    }
  }
};

// f(first row, row behind the last) for strips of a height.
template <class F>
void for_strips(int height, F&& f) {
  parallel_ranges((height + strip_rows - 1) / strip_rows, 1, [&](int begin, int end) {
    for (int strip = begin; strip != end; ++strip)
      f(strip * strip_rows, std::min(height, (strip + 1) * strip_rows));
  });
}

Targets blank_targets(int width, int height) {
  return {Grid<float>(width, height), Grid<float>(width, height), Grid<float>(width, height)};
}

Targets targets_of(const LevelTarget& request) {
  Targets requests = blank_targets(request.picture.width(), request.picture.height());
  for_strips(request.picture.height(), [&](int y0, int y1) {
    std::vector<float> row(static_cast<std::size_t>(request.picture.width()));
    request.add_rows(y0, y1, requests, 0, row);
  });
  return requests;
}

}  // namespace

void renew_coarser(BandPyramid& pyramid, int level) {
  for (std::size_t l = static_cast<std::size_t>(level); l + 1 < pyramid.size(); ++l)
    halve(pyramid[l], pyramid[l + 1]);
}

FlowRound find_tables(const BandPyramid& pyramid, const CliqueModel& model, int level) {
  std::vector<const Clique*> asked;
  for (int l = level; l <= model.levels; ++l)
    for (const Clique& clique : model.cliques)
      if (clique.type.level == l) asked.push_back(&clique);
  FlowRound tables(asked.size());
  parallel_ranges(asked.size(), std::size_t{1}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k != end; ++k)
      tables[k] = make_table(pyramid[static_cast<std::size_t>(asked[k]->type.level)], model.bands,
                             *asked[k]);
  });
  return tables;
}

void flow(FlowState& state, const CliqueModel& model, int level, const FlowRound& tables,
          FlowStep step) {
  // Requests of the coarser levels as grids, propagated from the coarsest down; those of the
  // finest, which would take as much memory as its picture, strip by strip.
  std::vector<LevelTarget> requests;  // from `level` up
  std::size_t first = 0;
  for (int l = level; l <= model.levels; ++l) {
    requests.emplace_back(state.pyramid[static_cast<std::size_t>(l)], model, l,
                          tables.data() + first, step.rate);
    first +=
        static_cast<std::size_t>(std::count_if(model.cliques.begin(), model.cliques.end(),
                                               [l](const Clique& c) { return c.type.level == l; }));
  }
  Targets coarse;
  for (std::size_t l = requests.size(); l-- > 1;) {
    Targets fine = targets_of(requests[l]);
    if (l + 1 < requests.size())
      parallel_rows(fine[0].height(), [&](int y) {
        for (std::size_t b = 0; b < 3; ++b)
          for (int x = 0; x < fine[b].width(); ++x) fine[b](x, y) += enlarged(coarse[b], x, y);
      });
    coarse = std::move(fine);
  }
  BandPicture& picture = state.pyramid[static_cast<std::size_t>(level)];
  const int width = picture.width();
  if (!state.speed.states.same_size(picture.states))
    state.speed = BandPicture(width, picture.height());
  for_strips(picture.height(), [&](int y0, int y1) {
    Targets own = blank_targets(width, y1 - y0);
    std::vector<float> row(static_cast<std::size_t>(width));
    requests.front().add_rows(y0, y1, own, y0, row);
    for (int y = y0; y < y1; ++y)
      for (std::size_t b = 0; b < 3; ++b)
        for (int x = 0; x < width; ++x) {
          if ((picture.states(x, y) & pixel_changes) == 0) continue;
          float request = own[b](x, y - y0);
          if (requests.size() > 1) request += enlarged(coarse[b], x, y);
          state.speed.bands[b](x, y) = step.momentum * state.speed.bands[b](x, y) + request;
        }
  });
  // Until here strips have read each other's pixels.
  parallel_rows(picture.height(), [&](int y) {
    for (std::size_t b = 0; b < 3; ++b)
      for (int x = 0; x < width; ++x)
        if ((picture.states(x, y) & pixel_changes) != 0)
          picture.bands[b](x, y) = std::clamp(picture.bands[b](x, y) + state.speed.bands[b](x, y),
                                              model.bands.low[b], model.bands.high[b]);
  });
}

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
