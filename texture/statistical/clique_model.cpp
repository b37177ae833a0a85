#include "texture/statistical/clique_model.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/math_exact.h"

namespace belvedere {
namespace {

constexpr std::array<float, clique_knots / 2> lower_shares = {
    0.F, .004F, .012F, .03F, .06F, .10F, .15F, .21F, .275F, .34F, .40F, .465F};
constexpr int code_steps = 127;  // of each sign
constexpr double mu =
    255.0;  // of the companding: small differences in fine steps, large ones in coarse ones

// The part of a range for code `step` of mu-law.
const std::array<float, code_steps + 1>& code_parts() {
  static const std::array<float, code_steps + 1> parts = [] {
    std::array<float, code_steps + 1> out{};
    for (int step = 0; step <= code_steps; ++step)
      out[static_cast<std::size_t>(step)] = static_cast<float>(
          (exact::pow(1.0 + mu, static_cast<double>(step) / code_steps) - 1.0) / mu);
    return out;
  }();
  return parts;
}

float reach_of(const BandSpace& bands, const CliqueType& type) {
  const DifferenceRange range = difference_range(bands, type);
  return std::max(std::abs(range.low), std::abs(range.high));
}

float decoded(std::int8_t code, float reach) {
  const float part = code_parts()[static_cast<std::size_t>(std::abs(static_cast<int>(code)))];
  return (code < 0 ? -reach : reach) * part;
}

}  // namespace

float clique_knot_share(int k) {
  constexpr int half = clique_knots / 2;
  return k < half ? lower_shares[static_cast<std::size_t>(k)]
                  : 1.F - lower_shares[static_cast<std::size_t>(clique_knots - 1 - k)];
}

DifferenceRange difference_range(const BandSpace& bands, const CliqueType& type) {
  const auto head = static_cast<std::size_t>(type.head);
  const auto tail = static_cast<std::size_t>(type.tail);
  if (type.single()) return {bands.low[head], bands.high[head]};
  return {bands.low[head] - bands.high[tail], bands.high[head] - bands.low[tail]};
}

std::array<std::int8_t, clique_knots> encode_knots(const BandSpace& bands, const CliqueType& type,
                                                   const CliqueKnots& knots) {
  const float reach = reach_of(bands, type);
  std::array<std::int8_t, clique_knots> codes{};
  int last = -code_steps;
  for (std::size_t k = 0; k < knots.size(); ++k) {
    const double part =
        std::min(1.0, static_cast<double>(std::abs(knots[k])) / static_cast<double>(reach));
    const double step = code_steps * exact::log(1.0 + mu * part) / exact::log(1.0 + mu);
    const int code = static_cast<int>(std::floor(step + 0.5));
    last = std::max(last, knots[k] < 0.F ? -code : code);
    codes[k] = static_cast<std::int8_t>(last);
  }
  return codes;
}

CliqueKnots decode_knots(const BandSpace& bands, const Clique& clique) {
  const float reach = reach_of(bands, clique.type);
  CliqueKnots knots{};
  for (std::size_t k = 0; k < knots.size(); ++k) knots[k] = decoded(clique.codes[k], reach);
  return knots;
}

float value_at_share(const CliqueKnots& knots, float share) {
  int k = 1;
  while (k < clique_knots - 1 && clique_knot_share(k) < share) ++k;
  const float from = clique_knot_share(k - 1);
  const float t = std::clamp((share - from) / (clique_knot_share(k) - from), 0.F, 1.F);
  const auto at = static_cast<std::size_t>(k);
  return knots[at - 1] + (knots[at] - knots[at - 1]) * t;
}

float share_below(const CliqueKnots& knots, float value) {
  if (value <= knots.front()) return 0.F;
  if (value >= knots.back()) return 1.F;
  int k = 1;
  while (knots[static_cast<std::size_t>(k)] < value) ++k;
  const auto at = static_cast<std::size_t>(k);
  const float from = clique_knot_share(k - 1);
  const float width = std::max(1e-6F, knots[at] - knots[at - 1]);
  return from + (clique_knot_share(k) - from) * (value - knots[at - 1]) / width;
}

std::size_t model_bytes(const CliqueModel& model) {
  constexpr std::size_t header = 8 + 3 * 4 + 9 * 2 + 6 * 4;
  return header + model.cliques.size() * (4 + clique_knots);
}

Grid<std::uint8_t> widened(const Grid<std::uint8_t>& mask, int px) {
  const auto along = [px](const Grid<std::uint8_t>& from, bool rows) {
    Grid<std::uint8_t> to(from.width(), from.height());
    const int length = rows ? from.width() : from.height();
    for (int line = 0; line < (rows ? from.height() : from.width()); ++line) {
      const auto at = [&](int i) { return rows ? from.index(i, line) : from.index(line, i); };
      int last = -px - 1;  // marked pixel before
      for (int i = 0; i < length; ++i) {
        if (from[at(i)] != 0) last = i;
        if (i - last <= px) to[at(i)] = 1;
      }
      int next = length + px;
      for (int i = length - 1; i >= 0; --i) {
        if (from[at(i)] != 0) next = i;
        if (next - i <= px) to[at(i)] = 1;
      }
    }
    return to;
  };
  return along(along(mask, true), false);
}

Grid<std::uint8_t> near_borders(const Grid<std::uint8_t>& labels, int px) {
  Grid<std::uint8_t> border(labels.width(), labels.height());
  for (int y = 0; y < labels.height(); ++y)
    for (int x = 0; x < labels.width(); ++x) {
      const std::uint8_t own = labels(x, y);
      const auto other = [&](int u, int v) {
        const std::uint8_t label = labels.clamped(u, v);
        return label != own && label != no_label;
      };
      const bool is = own != no_label &&
                      (other(x - 1, y) || other(x + 1, y) || other(x, y - 1) || other(x, y + 1));
      border(x, y) = is ? 1 : 0;
    }
  return px <= 1 ? border : widened(border, px - 1);
}

}  // namespace belvedere
