#include "texture/statistical/clique_flow.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "base/parallel.h"
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

}  // namespace belvedere
