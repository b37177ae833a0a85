#include "base/statistics.h"

namespace belvedere {

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), half, values.end());
  if (values.size() % 2 == 1) return *half;
  return 0.5 * (*std::max_element(values.begin(), half) + *half);
}

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  return value_at_rank(
      values, static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5));
}

}  // namespace belvedere
