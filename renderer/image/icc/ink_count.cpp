#include "renderer/image/icc/ink_count.h"

#include <algorithm>
#include <vector>

#include "base/parallel.h"

namespace belvedere {
namespace {

constexpr double steps_a_percent = 65536.0;
constexpr double tolerance_percent = 0.5;

struct RowCount {
  std::uint64_t above = 0;
  std::uint64_t sum = 0;
  double highest_percent = 0.0;
};

}  // namespace

void InkCount::add(const Grid<Inks>& rows) {
  std::vector<RowCount> counts(static_cast<std::size_t>(rows.height()));
  parallel_rows(rows.height(), [&](int y) {
    RowCount& count = counts[static_cast<std::size_t>(y)];
    const Inks* row = rows.row(y);
    for (int x = 0; x < rows.width(); ++x) {
      const double percent =
          100.0 * (static_cast<double>(row[x].x) + row[x].y + row[x].z + row[x].w);
      count.above += percent > coverage_.limit_percent + tolerance_percent ? 1 : 0;
      count.sum += static_cast<std::uint64_t>(std::max(0.0, percent) * steps_a_percent);
      count.highest_percent = std::max(count.highest_percent, percent);
    }
  });
  for (const RowCount& count : counts) {
    coverage_.pixels_above += count.above;
    coverage_.highest_percent = std::max(coverage_.highest_percent, count.highest_percent);
    sum_ += count.sum;
  }
  coverage_.pixels += rows.size();
}

InkCoverage InkCount::coverage() const {
  InkCoverage coverage = coverage_;
  if (coverage.pixels > 0)
    coverage.mean_percent =
        static_cast<double>(sum_) / steps_a_percent / static_cast<double>(coverage.pixels);
  return coverage;
}

}  // namespace belvedere
