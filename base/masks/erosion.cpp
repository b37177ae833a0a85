#include "base/masks/erosion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/random.h"

namespace belvedere {
namespace {

constexpr int usual = 256;   // slowness of an average cell
constexpr int fastest = 90;  // its bounds
constexpr int slowest = 700;
constexpr double by_standing = .8;  // extra slowness of a full neighbourhood over an empty one
// A front passes around slow cells and runs ahead in fast ones, so it advances further than the
// mean slowness suggests. This factor was measured on flat borders for steps of 1 to 16 cells
// (within 7 %).
double detours(double ragged) { return 1.0 + .2 * ragged + .7 * ragged * ragged; }
constexpr std::uint64_t noise_part = 77;  // part of the stream used for classes

// Steps of a front from a cell: sides, corners and knight's moves, with lengths in 1/1024 cells.
struct Way {
  int dx, dy;
  std::uint64_t length;
};
constexpr std::array<Way, 16> ways = {{{1, 0, 1024},
                                       {-1, 0, 1024},
                                       {0, 1, 1024},
                                       {0, -1, 1024},
                                       {1, 1, 1448},
                                       {-1, 1, 1448},
                                       {1, -1, 1448},
                                       {-1, -1, 1448},
                                       {2, 1, 2290},
                                       {2, -1, 2290},
                                       {-2, 1, 2290},
                                       {-2, -1, 2290},
                                       {1, 2, 2290},
                                       {1, -2, 2290},
                                       {-1, 2, 2290},
                                       {-1, -2, 2290}}};

int layer_cells(const ErosionParameters& p) {
  return std::max(2, static_cast<int>(std::ceil(p.step / p.cell)));
}

// The mean share of the label around the cells of a layer behind a flat border: the j-th of n has
// radius + j columns of 2 radius + 1.
double flat_standing(const ErosionParameters& p) {
  const double layer = std::max(1.0, std::round(p.step / p.cell));
  const int radius = layer_cells(p);
  return (radius + (layer + 1.0) / 2.0) / (2.0 * radius + 1.0);
}

// Number of cells of `label` in the rectangle up to and including a cell (summed-area table).
Grid<std::uint32_t> sums_of(const Grid<std::uint8_t>& labels, std::uint8_t label) {
  Grid<std::uint32_t> sums(labels.width() + 1, labels.height() + 1);
  for (int y = 0; y < labels.height(); ++y) {
    std::uint32_t row = 0;
    for (int x = 0; x < labels.width(); ++x) {
      row += labels(x, y) == label ? 1 : 0;
      sums(x + 1, y + 1) = sums(x + 1, y) + row;
    }
  }
  return sums;
}

class Front {
 public:
  Front(const Grid<std::uint8_t>& labels, std::uint8_t label, const std::array<bool, 256>& opens,
        const ErosionParameters& p)
      : labels_(labels),
        label_(label),
        opens_(opens),
        p_(p),
        radius_(layer_cells(p)),
        flat_(flat_standing(p)),
        detours_(detours(p.ragged)),
        noise_(stream_seed(p.seed, Stream::class_noise, noise_part)),
        standing_(sums_of(labels, label)),
        slowness_(labels.width(), labels.height()),
        best_(labels.width(), labels.height(), never) {}

  // Time at which a cell is reached (upper bits) and the label that reaches it (lowest 8).
  static constexpr std::uint64_t never = ~std::uint64_t{0};

  const Grid<std::uint64_t>& run() {
    // Times are in 1/1024 cells times slowness.
    const auto limit = static_cast<std::uint64_t>(p_.step / p_.cell * 1024.0 * usual);
    for (int y = 0; y < labels_.height(); ++y)
      for (int x = 0; x < labels_.width(); ++x)
        if (labels_(x, y) != label_ && opens_[labels_(x, y)]) leave(x, y, labels_(x, y), limit);
    while (!open_.empty()) {
      const auto [key, index] = open_.top();
      open_.pop();
      if (key != best_[index]) continue;
      const int x = static_cast<int>(index % static_cast<std::size_t>(labels_.width()));
      const int y = static_cast<int>(index / static_cast<std::size_t>(labels_.width()));
      leave(x, y, key, limit);
    }
    return best_;
  }

 private:
  int slowness(int x, int y) {
    std::uint16_t& known = slowness_(x, y);
    if (known != 0) return known;
    const int x0 = std::max(0, x - radius_);
    const int y0 = std::max(0, y - radius_);
    const int x1 = std::min(labels_.width(), x + radius_ + 1);
    const int y1 = std::min(labels_.height(), y + radius_ + 1);
    const std::uint32_t count =
        standing_(x1, y1) - standing_(x0, y1) - standing_(x1, y0) + standing_(x0, y0);
    const double share = static_cast<double>(count) / (static_cast<double>(x1 - x0) * (y1 - y0));
    double slow = 1.0 + by_standing * (share - flat_);
    if (p_.ragged > 0.0) {
      const double px = p_.x + x * p_.dx;
      const double py = p_.y + y * p_.dy;
      slow += p_.ragged * (.8 * gaussian_noise(noise_, px, py, 2.0 * p_.step) +
                           .5 * gaussian_noise(noise_ + 1, px, py, .6 * p_.step));
    }
    known = static_cast<std::uint16_t>(
        std::clamp(static_cast<int>(std::floor(detours_ * slow * usual + .5)), fastest, slowest));
    return known;
  }

  // From a cell that was reached with `key`.
  void leave(int x, int y, std::uint64_t key, std::uint64_t limit) {
    const bool outside = labels_(x, y) != label_;
    const std::uint64_t time = outside ? 0 : key >> 8U;
    for (const Way& way : ways) {
      const int tx = x + way.dx;
      const int ty = y + way.dy;
      if (!labels_.contains(tx, ty) || labels_(tx, ty) != label_) continue;
      const int there = slowness(tx, ty);
      const int slow = outside ? there : (slowness(x, y) + there) / 2;
      // A border lies half a cell before the first cell centre behind it.
      const std::uint64_t at =
          time + (outside ? way.length - 512 : way.length) * static_cast<std::uint64_t>(slow);
      if (at > limit) continue;
      const std::uint64_t found = at << 8U | (key & 0xffU);
      const std::size_t index = labels_.index(tx, ty);
      if (found >= best_[index]) continue;
      best_[index] = found;
      open_.push({found, index});
    }
  }

  using Entry = std::pair<std::uint64_t, std::size_t>;
  const Grid<std::uint8_t>& labels_;
  const std::uint8_t label_;
  const std::array<bool, 256>& opens_;
  const ErosionParameters& p_;
  const int radius_;
  const double flat_;
  const double detours_;
  const std::uint64_t noise_;
  const Grid<std::uint32_t> standing_;
  Grid<std::uint16_t> slowness_;
  Grid<std::uint64_t> best_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
};

}  // namespace

Erosion erode(const Grid<std::uint8_t>& labels, std::uint8_t label,
              const std::array<bool, 256>& opens, const ErosionParameters& parameters,
              Progress& progress) {
  if (parameters.levels < 1 || parameters.levels > 255 || parameters.step < .5 * parameters.cell)
    throw Error(ErrorKind::bug, "erode", "no levels, or layers thinner than half a cell");
  Erosion out{labels, Grid<std::uint8_t>(labels.width(), labels.height())};
  progress.begin("eroding", parameters.levels);
  for (int level = 1; level <= parameters.levels; ++level) {
    const Grid<std::uint8_t> before = out.labels;
    Front front(before, label, opens, parameters);
    const Grid<std::uint64_t>& reached = front.run();
    for (std::size_t i = 0; i < reached.size(); ++i) {
      if (reached[i] == Front::never) continue;
      out.labels[i] = static_cast<std::uint8_t>(reached[i] & 0xffU);
      out.level[i] = static_cast<std::uint8_t>(level);
    }
    progress.advance(1.0);
  }
  return out;
}

int erosion_reach(const ErosionParameters& parameters) {
  const double layer = (parameters.step / parameters.cell + .5) * usual / fastest;
  return parameters.levels * (static_cast<int>(std::ceil(layer)) + layer_cells(parameters) + 2);
}

}  // namespace belvedere
