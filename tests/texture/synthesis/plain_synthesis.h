#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "tests/grids.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere::test {

// Texture synthesis after Wei & Levoy (2000) and Jenny & Jenny (2013), plain and slow, as a
// reference for synthesize: row by row each pixel copies the texel of its class whose neighbours
// above and to the left, an L of 7 × 7, are most similar to those already made,
//   C = mean of the squared differences of R, G and B over the L + 6.2 × weight × (difference of
//   the guide)², of all texels, ties to the first. 6.2 gives a weight the same effect as in
//   synthesize. A neighbour outside the exemplar counts as the difference of black and white.
//   `coherent`: only continuations of a neighbour's copy are compared, and all texels if there are
//   none (Ashikhmin 2001).
class PlainSynthesis {
 public:
  PlainSynthesis(const Exemplar& exemplar, const GuideStack& target, double weight, bool coherent)
      : exemplar_(exemplar),
        target_(target),
        weight_(weight),
        coherent_(coherent),
        made_(target.width(), target.height()) {}

  MatchField run() {
    for (const auto [x, y] : test::cells(made_)) {
      std::vector<Match> candidates;
      if (coherent_) candidates = continuing(x, y);
      made_(x, y) =
          cheapest(x, y, candidates.empty() ? all_texels_of(target_.label(x, y)) : candidates);
    }
    return made_;
  }

 private:
  static constexpr int radius = 3;

  template <class Visit>
  void visit_made(int x, int y, const Visit& visit) const {
    for (int dy = -radius; dy <= 0; ++dy)
      for (int dx = -radius; dx <= radius && (dy < 0 || dx < 0); ++dx)
        if (made_.contains(x + dx, y + dy)) visit(made_(x + dx, y + dy), dx, dy);
  }

  double cost(int x, int y, const Match& texel, double best) const {
    const double off =
        target_.guides[0].values(x, y) - exemplar_.guides.guides[0].values(texel.x, texel.y);
    double sum = 0.0;
    int count = 0;
    visit_made(x, y, [&](const Match& made, int dx, int dy) {
      ++count;
      if (sum > best * 24) return;  // of at most 24 neighbours: it cannot win any more
      const Rgb8& a = exemplar_.picture(made.x, made.y);
      const bool inside = exemplar_.picture.contains(texel.x + dx, texel.y + dy);
      for (std::size_t c = 0; c < 3; ++c) {
        const int d = inside ? a[c] - exemplar_.picture(texel.x + dx, texel.y + dy)[c] : 255;
        sum += d * d;
      }
    });
    return (count > 0 ? sum / count : 0.0) + 6.2 * weight_ * off * off;
  }

  Match cheapest(int x, int y, const std::vector<Match>& candidates) const {
    Match found;
    double best = std::numeric_limits<double>::infinity();
    for (const Match& texel : candidates) {
      const double here = cost(x, y, texel, best);
      if (here < best) {
        best = here;
        found = texel;
      }
    }
    return found;
  }

  std::vector<Match> continuing(int x, int y) const {
    std::vector<Match> candidates;
    visit_made(x, y, [&](const Match& made, int dx, int dy) {
      const int u = made.x - dx;
      const int v = made.y - dy;
      if (exemplar_.picture.contains(u, v) && exemplar_.guides.label(u, v) == target_.label(x, y))
        candidates.push_back({0, static_cast<std::uint16_t>(u), static_cast<std::uint16_t>(v)});
    });
    return candidates;
  }

  std::vector<Match> all_texels_of(std::uint8_t label) const {
    std::vector<Match> texels;
    const Grid<std::uint8_t>& labels = exemplar_.guides.label;
    for (const auto [u, v] : test::cells(labels))
      if (labels(u, v) == label)
        texels.push_back({0, static_cast<std::uint16_t>(u), static_cast<std::uint16_t>(v)});
    return texels;
  }

  const Exemplar& exemplar_;
  const GuideStack& target_;
  double weight_;
  bool coherent_;
  MatchField made_;
};

}  // namespace belvedere::test
