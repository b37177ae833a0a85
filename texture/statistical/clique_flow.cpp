#include "texture/statistical/clique_flow.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/parallel.h"
#include "texture/statistical/difference_histogram.h"

namespace belvedere {
namespace {

// Rows that one task works on. A pixel's sum is taken in the order of the types whatever the strip, so it changes no bit.
constexpr int strip_rows = 64;

// What cliques ask of each pixel, as sums; divided by what a pixel can take part in.
using Wishes = std::array<Grid<float>, 3>;

FlowTable make_table(const BandPicture& picture, const BandSpace& bands, const Clique& clique) {
  FlowTable table(difference_bins + 1, 0.F);
  const DifferenceHistogram histogram = count_differences(picture, bands, clique.type);
  if (histogram.total == 0) return table;
  const DifferenceRange range = difference_range(bands, clique.type);
  const CliqueKnots knots = decode_knots(bands, clique);
  double below = 0.0;
  for (int i = 0; i <= difference_bins; ++i) {
    const float edge = range.low + (range.high - range.low) * static_cast<float>(i) / difference_bins;
    table[static_cast<std::size_t>(i)] = value_at_share(knots, static_cast<float>(below / static_cast<double>(histogram.total))) - edge;
    if (i < difference_bins) below += static_cast<double>(histogram.counts[static_cast<std::size_t>(i)]);
  }
  return table;
}

// Adds what the cliques of one type ask for to the rows y0 <= y < y1: half to the head, half against it to the tail.
void ask(const BandPicture& picture, const BandSpace& bands, const CliqueType& type, const FlowTable& table, int y0, int y1, Wishes& wishes,
         std::vector<float>& row) {
  const DifferenceRange range = difference_range(bands, type);
  const float to_bin = static_cast<float>(difference_bins) / (range.high - range.low);
  const bool single = type.single();
  const float part = single ? 1.F : 0.5F;
  constexpr float last = static_cast<float>(difference_bins) - 0.001F;
  clique_rows(picture.width(), picture.height(), type, y0 - type.dy, y1, [&](int ty, int hy, int tx, int hx, int cliques) {
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
      float* to = wishes[static_cast<std::size_t>(type.head)].row(hy) + hx;
      for (int x = 0; x < cliques; ++x) to[x] += asked[x];
    }
    if (!single && ty >= y0 && ty < y1) {
      float* to = wishes[static_cast<std::size_t>(type.tail)].row(ty) + tx;
      for (int x = 0; x < cliques; ++x) to[x] -= asked[x];
    }
  });
}

Wishes wishes_of(const BandPicture& picture, const CliqueModel& model, int level, const FlowTable* tables, float rate) {
  const int width = picture.width();
  const int height = picture.height();
  Wishes wishes = {Grid<float>(width, height), Grid<float>(width, height), Grid<float>(width, height)};
  std::array<float, 3> roles{};
  for (const Clique& clique : model.cliques) {
    if (clique.type.level != level) continue;
    roles[static_cast<std::size_t>(clique.type.head)] += 1.F;
    if (!clique.type.single()) roles[static_cast<std::size_t>(clique.type.tail)] += 1.F;
  }
  parallel_ranges((height + strip_rows - 1) / strip_rows, 1, [&](int begin, int end) {
    std::vector<float> row(static_cast<std::size_t>(width));
    for (int strip = begin; strip != end; ++strip) {
      const int y0 = strip * strip_rows;
      const int y1 = std::min(height, y0 + strip_rows);
      const FlowTable* table = tables;
      for (const Clique& clique : model.cliques)
        if (clique.type.level == level) ask(picture, model.bands, clique.type, *table++, y0, y1, wishes, row);
      for (std::size_t b = 0; b < 3; ++b) {
        if (roles[b] == 0.F) continue;
        const float factor = rate / roles[b];
        for (float* v = wishes[b].row(y0); v != wishes[b].row(y0) + static_cast<std::size_t>(width) * static_cast<std::size_t>(y1 - y0);
             ++v)
          *v *= factor;
      }
    }
  });
  return wishes;
}

}  // namespace

void renew_coarser(BandPyramid& pyramid, int level) {
  for (std::size_t l = static_cast<std::size_t>(level); l + 1 < pyramid.size(); ++l) halve(pyramid[l], pyramid[l + 1]);
}

FlowRound find_tables(const BandPyramid& pyramid, const CliqueModel& model, int level) {
  std::vector<const Clique*> asked;
  for (int l = level; l <= model.levels; ++l)
    for (const Clique& clique : model.cliques)
      if (clique.type.level == l) asked.push_back(&clique);
  FlowRound tables(asked.size());
  parallel_ranges(asked.size(), std::size_t{1}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k != end; ++k)
      tables[k] = make_table(pyramid[static_cast<std::size_t>(asked[k]->type.level)], model.bands, *asked[k]);
  });
  return tables;
}

void flow(FlowState& state, const CliqueModel& model, int level, const FlowRound& tables, FlowStep step) {
  std::vector<Wishes> wishes;  // from `level` up
  std::size_t first = 0;
  for (int l = level; l <= model.levels; ++l) {
    wishes.push_back(wishes_of(state.pyramid[static_cast<std::size_t>(l)], model, l, tables.data() + first, step.rate));
    first += static_cast<std::size_t>(
        std::count_if(model.cliques.begin(), model.cliques.end(), [l](const Clique& c) { return c.type.level == l; }));
  }
  for (std::size_t l = wishes.size(); l-- > 1;) {
    const Wishes& coarse = wishes[l];
    Wishes& fine = wishes[l - 1];
    parallel_rows(fine[0].height(), [&](int y) {
      for (std::size_t b = 0; b < 3; ++b)
        for (int x = 0; x < fine[b].width(); ++x) fine[b](x, y) += enlarged(coarse[b], x, y);
    });
  }
  BandPicture& picture = state.pyramid[static_cast<std::size_t>(level)];
  if (!state.speed.states.same_size(picture.states)) state.speed = BandPicture(picture.width(), picture.height());
  parallel_rows(picture.height(), [&](int y) {
    for (std::size_t b = 0; b < 3; ++b) {
      for (int x = 0; x < picture.width(); ++x) {
        if ((picture.states(x, y) & pixel_changes) == 0) continue;
        const float move = step.momentum * state.speed.bands[b](x, y) + wishes[0][b](x, y);
        state.speed.bands[b](x, y) = move;
        picture.bands[b](x, y) = std::clamp(picture.bands[b](x, y) + move, model.bands.low[b], model.bands.high[b]);
      }
    }
  });
}

}  // namespace belvedere
