#include "terrain/generalize/generalize_band.h"

#include <algorithm>
#include <cmath>

#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/pyramid.h"

namespace belvedere {
namespace {

// Rows that are alive at the same time, by their number; each has room for `margin` values on both
// sides.
class RowRing {
 public:
  RowRing(int rows, int width, int margin)
      : rows_(rows),
        margin_(margin),
        stride_(width + 2 * margin),
        values_(static_cast<std::size_t>(rows) * static_cast<std::size_t>(stride_)) {}
  float* operator[](int y) {
    return values_.data() +
           static_cast<std::size_t>((y + 2 * rows_) % rows_) * static_cast<std::size_t>(stride_) +
           margin_;
  }

 private:
  int rows_;
  int margin_;
  int stride_;
  std::vector<float> values_;
};

// Linear extension by one value on each side, as in the pyramid.
void extend_by_one(float* row, int width) {
  row[-1] = width == 1 ? row[0] : 2.F * row[0] - row[1];
  row[width] = width == 1 ? row[0] : 2.F * row[width - 1] - row[width - 2];
}

void repeat_ends(float* row, int width, int count) {
  std::fill(row - count, row, row[0]);
  std::fill(row + width, row + width + count, row[width - 1]);
}

std::vector<float> gaussian_taps(double sigma, int radius) {
  std::vector<float> taps(static_cast<std::size_t>(2 * radius + 1), 1.F);
  if (radius == 0) return taps;
  double sum = 0.0;
  for (int k = -radius; k <= radius; ++k) sum += exact::exp(-0.5 * k * k / (sigma * sigma));
  for (int k = -radius; k <= radius; ++k) {
    taps[static_cast<std::size_t>(k + radius)] =
        static_cast<float>(exact::exp(-0.5 * k * k / (sigma * sigma)) / sum);
  }
  return taps;
}

// The operations that a band needs, determined before its rows.
struct Plan {
  bool unchanged = false;    // w = 1 everywhere
  bool local = false;        // some v is used
  bool break_lines = false;  // c is not 1 everywhere
  bool sides = false;        // ridges and valleys differ
  int radius = 0;            // of the blur
  std::vector<float> taps;
};

Plan make_plan(const Band& band, const BandWeights& weights, const BreakLines& lines) {
  Plan plan;
  const bool far = band.share != nullptr;
  const auto any = [far](const WeightSet& near_set, const WeightSet& far_set, auto&& test) {
    return test(near_set) || (far && test(far_set));
  };
  plan.local = any(weights.near, weights.far,
                   [](const WeightSet& w) { return w.ridges != 0.F || w.valleys != 0.F; });
  plan.sides =
      any(weights.near, weights.far, [](const WeightSet& w) { return w.ridges != w.valleys; });
  plan.break_lines = plan.local && lines.exponent > 0.F;
  plan.unchanged =
      !plan.local && band.pixel_ground == nullptr &&
      !any(weights.near, weights.far, [](const WeightSet& w) { return w.global != 1.F; });
  // Beyond three standard deviations lies a 400th of the kernel.
  if (plan.break_lines && lines.blur_cells > 0.0)
    plan.radius = std::max(1, static_cast<int>(std::ceil(3.0 * lines.blur_cells)));
  plan.taps = gaussian_taps(lines.blur_cells, plan.radius);
  return plan;
}

// The rows of one strip. Rows come in ascending order; each kind runs ahead of the weighted row as
// far as its neighbourhood requires.
class BandStrip {
 public:
  BandStrip(const Band& band, const BandWeights& weights, const BreakLines& lines, const Plan& plan,
            int first)
      : band_(band),
        weights_(weights),
        lines_(lines),
        plan_(plan),
        width_(band.level->width()),
        height_(band.level->height()),
        smooth_(plan.radius + 5, width_, 0),
        below_(plan.radius + 5, width_, 0),
        sum_(3, plan.break_lines ? width_ : 0, 1),
        across_(2 * plan.radius + 2, plan.break_lines ? width_ : 0, 0),
        detail_(6, plan.sides ? width_ : 0, 1),
        mean_(3, plan.sides ? width_ : 0, 1),
        line_(static_cast<std::size_t>(plan.local ? width_ + 2 * plan.radius : 0), 1.F),
        sides_(static_cast<std::size_t>(plan.sides ? width_ : 0)),
        even_(sides_.size()),
        gain_(static_cast<std::size_t>(width_)),
        ground_(static_cast<std::size_t>(band.pixel_ground != nullptr ? width_ : 0)),
        next_expanded_(std::max(first - plan.radius - 2, 0)),
        next_sum_(std::max(first - plan.radius, 0) - 1),
        next_line_(std::max(first - plan.radius, 0)),
        next_detail_(std::max(first - 2, -1)),
        next_mean_(first - 1) {}

  void make(int y, float* out) {
    need_expanded(y);
    std::copy_n(below_[y], width_, out);
    WeightRows rows;
    if (plan_.break_lines) rows.break_line = break_line(y);
    if (plan_.local && !plan_.break_lines) rows.break_line = line_.data();  // c = 1
    if (plan_.sides) rows.convex = convex_share(y);
    const auto row = [y](const Grid<float>* grid) {
      return grid == nullptr ? nullptr : grid->row(y);
    };
    rows.share = row(band_.share);
    if (band_.keep != nullptr) rows.keep = band_.keep->row(y);
    rows.mask = row(band_.mask);
    rows.amplify = row(band_.amplify);
    if (band_.pixel_ground != nullptr) rows.ground_m_per_pixel = ground(y);
    weigh_row(rows, weights_, band_.level->row(y), smooth_[y], width_, gain_.data(), out);
  }

 private:
  // expand(G_i+1) and expand(D_i+1) up to row y.
  void need_expanded(int y) {
    for (; next_expanded_ <= y; ++next_expanded_) {
      expand_row(*band_.coarser, next_expanded_, width_, smooth_[next_expanded_]);
      expand_change_row(*band_.coarser_change, next_expanded_, width_, below_[next_expanded_]);
    }
  }

  // Rows -1 and `height` extrapolate the two adjacent rows; a single row is repeated.
  template <class MakeRow>
  void make_extended_row(RowRing& ring, int y, MakeRow&& make_row) {
    float* row = ring[y];
    if (y >= 0 && y < height_) {
      make_row(y, row);
    } else {
      const int edge = y < 0 ? 0 : height_ - 1;
      const int inner = height_ == 1 ? edge : y < 0 ? 1 : height_ - 2;
      std::vector<float> other(static_cast<std::size_t>(width_));
      make_row(edge, row);
      make_row(inner, other.data());
      for (int x = 0; x < width_; ++x) row[x] = 2.F * row[x] - other[static_cast<std::size_t>(x)];
    }
    extend_by_one(row, width_);
  }

  void need_sum(int y) {
    for (; next_sum_ <= y; ++next_sum_) {
      make_extended_row(sum_, next_sum_, [&](int from, float* row) {
        need_expanded(std::min(std::max(from, next_sum_ < 0 ? 1 : 0), height_ - 1));
        add_row(smooth_[from], below_[from], width_, row);
      });
    }
  }

  const float* break_line(int y) {
    const int radius = plan_.radius;
    float* c = line_.data() + radius;
    for (; next_line_ <= std::min(y + radius, height_ - 1); ++next_line_) {
      need_sum(next_line_ + 1);
      break_line_row(sum_[next_line_ - 1], sum_[next_line_], sum_[next_line_ + 1], width_,
                     lines_.scale, c);
      repeat_ends(c, width_, radius);
      blur_across_row(c, plan_.taps, width_, across_[next_line_]);
    }
    around_.clear();
    for (int k = -radius; k <= radius; ++k)
      around_.push_back(across_[std::clamp(y + k, 0, height_ - 1)]);
    blur_down_row(around_.data(), plan_.taps, width_, c);
    if (lines_.exponent != 1.F) power_row(c, width_, lines_.exponent);
    return c;
  }

  // L_i up to row y, without the kernel's alternation.
  void need_detail(int y) {
    for (; next_detail_ <= std::min(y, height_); ++next_detail_) {
      make_extended_row(detail_, next_detail_, [&](int from, float* row) {
        expand_evenly_row(*band_.coarser, from, width_, even_.data());
        subtract_row(band_.level->row(from), even_.data(), width_, row);
      });
    }
  }

  const float* convex_share(int y) {
    for (; next_mean_ <= y + 1; ++next_mean_) {
      make_extended_row(mean_, next_mean_, [&](int from, float* row) {
        need_detail(std::max(from, next_mean_ < 0 ? 1 : 0) + 1);
        binomial_row(detail_[from - 1], detail_[from], detail_[from + 1], width_, row);
      });
    }
    const float* const detail[3] = {detail_[y - 1], detail_[y], detail_[y + 1]};
    const float* const mean[3] = {mean_[y - 1], mean_[y], mean_[y + 1]};
    convex_share_row(detail, mean, width_, lines_.scale.inverse_x, lines_.scale.inverse_y,
                     sides_.data());
    return sides_.data();
  }

  // Ground metres per pixel, linear between the known positions.
  const float* ground(int y) {
    const Grid<float>& known = band_.pixel_ground->m_per_pixel;
    const float cells =
        static_cast<float>(band_.level_cells) / static_cast<float>(band_.pixel_ground->step_cells);
    const auto before = [](float at, int count) {
      return std::min(static_cast<int>(at), count - 1);
    };
    const float v = static_cast<float>(y) * cells;
    const int j = before(v, known.height());
    const float down = std::min(v - static_cast<float>(j), 1.F);
    ground_posts_.resize(static_cast<std::size_t>(known.width()) + 1);
    for (int i = 0; i <= known.width(); ++i)
      ground_posts_[static_cast<std::size_t>(i)] =
          (1.F - down) * known.clamped(i, j) + down * known.clamped(i, j + 1);
    for (int x = 0; x < width_; ++x) {
      const float u = static_cast<float>(x) * cells;
      const int i = before(u, known.width());
      const float across = std::min(u - static_cast<float>(i), 1.F);
      const float* post = ground_posts_.data() + i;
      ground_[static_cast<std::size_t>(x)] = (1.F - across) * post[0] + across * post[1];
    }
    return ground_.data();
  }

  const Band& band_;
  const BandWeights& weights_;
  const BreakLines& lines_;
  const Plan& plan_;
  int width_;
  int height_;
  RowRing smooth_, below_;  // expand(G_i+1), expand(D_i+1)
  RowRing sum_;             // their sum
  RowRing across_;          // c, blurred along the rows
  RowRing detail_, mean_;   // L_i by expand_evenly_row and its binomial mean
  std::vector<float> line_, sides_, even_, gain_, ground_;
  std::vector<float> ground_posts_;
  std::vector<const float*> around_;
  int next_expanded_, next_sum_, next_line_, next_detail_, next_mean_;
};

}  // namespace

void expand_change_row(const Grid<float>& change, int y, int width, float* out) {
  if (change.empty()) {
    std::fill(out, out + width, 0.F);
  } else {
    expand_row(change, y, width, out);
  }
}

Grid<float> add_band(const Band& band, const BandWeights& weights, const BreakLines& break_lines) {
  const Plan plan = make_plan(band, weights, break_lines);
  if (plan.unchanged && band.coarser_change->empty()) return {};
  const int width = band.level->width();
  const int height = band.level->height();
  Grid<float> change(width, height);
  if (plan.unchanged) {
    parallel_rows(height,
                  [&](int y) { expand_row(*band.coarser_change, y, width, change.row(y)); });
    return change;
  }
  // A strip starts some rows early for its neighbours; strips are long compared with that.
  const int strip = 96 + 4 * plan.radius;
  parallel_ranges((height + strip - 1) / strip, 1, [&](int begin, int end) {
    for (int i = begin; i != end; ++i) {
      BandStrip rows(band, weights, break_lines, plan, i * strip);
      for (int y = i * strip; y < std::min((i + 1) * strip, height); ++y)
        rows.make(y, change.row(y));
    }
  });
  return change;
}

}  // namespace belvedere
