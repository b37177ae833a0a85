#include "renderer/rock/spur_peaks.h"

#include <algorithm>
#include <bit>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/rock/spur_peaks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef BELVEDERE_SPUR_PEAKS
#define BELVEDERE_SPUR_PEAKS
namespace belvedere::peaks {
enum Field : int {
  position_x,
  position_y,
  down_x,
  down_y,
  skew_head,
  skew_foot,
  length,
  foot,
  top,
  flank_0,
  flank_1,
  depth,
  tolerance,
  parent,
  fields
};
constexpr int row_lanes = 8;  // cells of a row evaluated at once
static_assert(2 * spur_form::max_reach + 1 <= row_lanes);

struct Question {
  const float* first;    // position_x of the first cell
  std::ptrdiff_t field;  // numbers to the next field …
  std::ptrdiff_t row;    // … and row
  int across = 0;        // cells
  int down = 0;
  glm::vec2 position;
  float inverse = 1.0F;  // of the spacing
  float slender = 1.0F;
  float depth_m = 0.0F;
  float lost_beyond = 0.0F;
  std::uint32_t parent = 0;
};

// The two highest of each column of cells, with their rows; height -1e9 where there is none.
struct Columns {
  alignas(64) float best[row_lanes];
  alignas(64) float next[row_lanes];
  alignas(64) std::int32_t best_row[row_lanes];
  alignas(64) std::int32_t next_row[row_lanes];
};
}  // namespace belvedere::peaks
#endif

HWY_BEFORE_NAMESPACE();
namespace belvedere::peaks {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::CappedTag<float, row_lanes>;
using Words = hn::Rebind<std::int32_t, Floats>;

// highest_spur (spurs.cpp) without its branches, for some columns of cells: the order of operations
// is fixed.
HWY_INLINE void FindColumns(const Question& q, int column, Columns& out) {
  using namespace spur_form;
  const Floats d;
  const Words w;
  const auto zero = hn::Zero(d);
  const auto one = [&](float value) HWY_ATTR { return hn::Set(d, value); };
  const auto inside = hn::Lt(hn::Add(hn::Iota(d, 0.0F), one(static_cast<float>(column))),
                             one(static_cast<float>(q.across)));
  const auto none = one(-1e9F);
  auto best = none;
  auto next = none;
  auto best_row = hn::Zero(w);
  auto next_row = hn::Zero(w);
  for (int y = 0; y < q.down; ++y) {
    const float* cell = q.first + y * q.row + column;
    const auto of = [&](Field field) HWY_ATTR { return hn::LoadU(d, cell + field * q.field); };
    const auto offset_x = hn::Mul(hn::Sub(one(q.position.x), of(position_x)), one(q.inverse));
    const auto offset_y = hn::Mul(hn::Sub(one(q.position.y), of(position_y)), one(q.inverse));
    const auto apart = hn::Sqrt(hn::Add(hn::Mul(offset_x, offset_x), hn::Mul(offset_y, offset_y)));
    const auto stray_m = hn::Mul(of(tolerance), hn::Add(one(stray), apart));
    const auto on_surface =
        hn::And(inside, hn::Le(hn::Abs(hn::Sub(one(q.depth_m), of(depth))), stray_m));
    const auto dx = of(down_x);
    const auto dy = of(down_y);
    const auto v = hn::Mul(hn::Add(hn::Mul(offset_x, dx), hn::Mul(offset_y, dy)), one(q.slender));
    const auto u = hn::Sub(hn::Mul(offset_x, dy), hn::Mul(offset_y, dx));
    const auto wide = hn::Abs(u);
    const auto head = hn::Sub(hn::Mul(of(skew_head), u), hn::Mul(one(head_point), wide));
    const auto tail =
        hn::Add(hn::Add(of(length), hn::Mul(of(skew_foot), u)), hn::Mul(one(foot_point), wide));
    const auto on_head = hn::Mul(one(head_rise), hn::Sub(v, head));
    const auto on_back = hn::Mul(one(back_rise), hn::Sub(v, head));
    const auto on_foot =
        hn::Sub(hn::Mul(one(back_rise), hn::Sub(tail, head)), hn::Mul(of(foot), hn::Sub(v, tail)));
    const auto is_back = hn::Or(hn::Lt(v, tail), hn::Lt(tail, head));
    const auto along =
        hn::IfThenElse(hn::Lt(v, head), on_head, hn::IfThenElse(is_back, on_back, on_foot));
    const auto flank = hn::IfThenElse(hn::Gt(u, zero), of(flank_1), of(flank_0));
    const auto clamped = hn::Min(hn::Max(v, one(opening_from)), one(opening_to));
    const auto steepness =
        hn::Div(flank, hn::Add(one(opening), hn::Mul(one(opening_along), clamped)));
    auto height = hn::Sub(hn::Add(of(top), along), hn::Mul(steepness, wide));
    const auto same_parent =
        hn::Eq(hn::BitCast(w, of(parent)), hn::Set(w, std::bit_cast<std::int32_t>(q.parent)));
    height =
        hn::Sub(height, hn::IfThenZeroElse(hn::RebindMask(d, same_parent), one(q.lost_beyond)));
    height = hn::IfThenElse(on_surface, height, none);
    const auto row = hn::Set(w, y);
    const auto higher = hn::Gt(height, best);
    const auto second = hn::AndNot(higher, hn::Gt(height, next));
    const auto higher_w = hn::RebindMask(w, higher);
    next_row = hn::IfThenElse(higher_w, best_row,
                              hn::IfThenElse(hn::RebindMask(w, second), row, next_row));
    next = hn::IfThenElse(higher, best, hn::IfThenElse(second, height, next));
    best_row = hn::IfThenElse(higher_w, row, best_row);
    best = hn::IfThenElse(higher, height, best);
  }
  hn::StoreU(best, d, out.best + column);
  hn::StoreU(next, d, out.next + column);
  hn::StoreU(best_row, w, out.best_row + column);
  hn::StoreU(next_row, w, out.next_row + column);
}

void FindPeaks(const Question& question, Columns& out) {
  for (int column = 0; column < question.across; column += static_cast<int>(hn::Lanes(Floats())))
    FindColumns(question, column, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace belvedere::peaks
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace belvedere {
namespace peaks {
HWY_EXPORT(FindPeaks);
}  // namespace peaks

SpurLanes to_lanes(const SpurCells& cells) {
  SpurLanes lanes;
  // The last read of a row extends beyond its end: those cells hold no spur.
  lanes.row = cells.count.x + peaks::row_lanes;
  lanes.field = lanes.row * cells.count.y;
  lanes.numbers.assign(
      static_cast<std::size_t>(peaks::fields) * static_cast<std::size_t>(lanes.field), 0.0F);
  std::fill_n(lanes.numbers.begin() + peaks::tolerance * lanes.field, lanes.field, -1.0F);
  for (int y = 0; y < cells.count.y; ++y)
    for (int x = 0; x < cells.count.x; ++x) {
      const Spur& spur =
          cells.spurs[static_cast<std::size_t>(y) * static_cast<std::size_t>(cells.count.x) +
                      static_cast<std::size_t>(x)];
      if (!spur.grown) continue;
      const auto set = [&](peaks::Field field, float value) {
        lanes.numbers[static_cast<std::size_t>(field * lanes.field + y * lanes.row + x)] = value;
      };
      set(peaks::position_x, spur.position.x);
      set(peaks::position_y, spur.position.y);
      set(peaks::down_x, spur.down.x);
      set(peaks::down_y, spur.down.y);
      set(peaks::skew_head, spur.skew_head);
      set(peaks::skew_foot, spur.skew_foot);
      set(peaks::length, spur.length);
      set(peaks::foot, spur.foot);
      set(peaks::top, spur.top);
      set(peaks::flank_0, spur.flank[0]);
      set(peaks::flank_1, spur.flank[1]);
      set(peaks::depth, spur.depth_m);
      set(peaks::tolerance, spur.tolerance_m);
      set(peaks::parent, std::bit_cast<float>(spur.parent));
    }
  return lanes;
}

SpurPeaks find_peaks(const SpurCells& cells, float slender, glm::vec2 position, float depth_m,
                     std::uint32_t parent) {
  using namespace spur_form;
  const int column = static_cast<int>(std::floor(position.x / cells.spacing)) - cells.first.x;
  const int row = static_cast<int>(std::floor(position.y / cells.spacing)) - cells.first.y;
  const int across = cells.any_direction ? max_reach : reach_across;
  const int below = cells.any_direction ? max_reach : reach_down;
  const int x0 = std::max(column - across, 0);
  const int x1 = std::min(column + across, cells.count.x - 1);
  const int y0 = std::max(row - reach_up, 0);
  const int y1 = std::min(row + below, cells.count.y - 1);
  SpurPeaks found;
  if (x1 < x0 || y1 < y0) return found;
  const peaks::Question question{.first = cells.lanes.numbers.data() + y0 * cells.lanes.row + x0,
                                 .field = cells.lanes.field,
                                 .row = cells.lanes.row,
                                 .across = x1 - x0 + 1,
                                 .down = y1 - y0 + 1,
                                 .position = position,
                                 .inverse = 1.0F / cells.spacing,
                                 .slender = slender,
                                 .depth_m = depth_m,
                                 .lost_beyond = cells.lost_beyond,
                                 .parent = parent};
  peaks::Columns columns;
  HWY_DYNAMIC_DISPATCH(peaks::FindPeaks)(question, columns);
  // Ties go to the first in the order of rows, independent of the order of lanes.
  float best_height = -1e9F;
  const auto count = [&](float height, int y, int x) {
    if (height <= -1e9F || height < found.next_height) return;
    const int number = (y0 + y) * cells.count.x + x0 + x;
    if (height > best_height || (height == best_height && number < found.best)) {
      found.next = found.best;
      found.next_height = best_height;
      found.best = number;
      best_height = height;
    } else if (height > found.next_height || number < found.next) {
      found.next = number;
      found.next_height = height;
    }
  };
  for (int x = 0; x < question.across; ++x) {
    count(columns.best[x], columns.best_row[x], x);
    count(columns.next[x], columns.next_row[x], x);
  }
  return found;
}

}  // namespace belvedere
#endif
