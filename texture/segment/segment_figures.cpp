#include "texture/segment/segment_figures.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/error.h"

namespace belvedere {
namespace {

// Pixels that a group and a label share.
struct Shared {
  std::vector<double> pixels;  // labels × groups
  std::vector<double> of_group;
  std::vector<double> of_label;
  double all = 0.0;
};

Shared count_shared(const Grid<std::uint16_t>& groups, const Grid<std::uint8_t>& labels,
                    double min_share) {
  std::array<std::size_t, 256> pixels{};
  for (const std::uint8_t label : labels) ++pixels[label];
  std::array<int, 256> row{};
  int rows = 0;
  for (std::size_t label = 0; label < 256; ++label) {
    const bool counts =
        label != unknown_label && pixels[label] > 0 &&
        static_cast<double>(pixels[label]) >= min_share * static_cast<double>(labels.size());
    row[label] = counts ? rows++ : -1;
  }
  const std::size_t columns =
      groups.empty() ? 0 : std::size_t{*std::max_element(groups.begin(), groups.end())} + 1;
  Shared shared{std::vector<double>(static_cast<std::size_t>(rows) * columns, 0.0),
                std::vector<double>(columns, 0.0),
                std::vector<double>(static_cast<std::size_t>(rows), 0.0)};
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (row[labels[i]] < 0) continue;
    const auto r = static_cast<std::size_t>(row[labels[i]]);
    shared.pixels[r * columns + groups[i]] += 1.0;
    shared.of_group[groups[i]] += 1.0;
    shared.of_label[r] += 1.0;
    shared.all += 1.0;
  }
  return shared;
}

}  // namespace

// Shortest augmenting paths with potentials, on costs of the highest value minus the value; the
// matrix is made square by rows or columns of value 0.
std::vector<std::size_t> match_one_to_one(const std::vector<double>& values, std::size_t rows,
                                          std::size_t columns) {
  const std::size_t n = std::max(rows, columns);
  const auto cost = [&](std::size_t r, std::size_t c) {
    return r < rows && c < columns ? -values[r * columns + c] : 0.0;
  };
  // Rows and columns from 1; 0 is the row that searches a column.
  std::vector<double> of_row(n + 1, 0.0), of_column(n + 1, 0.0);
  std::vector<std::size_t> row_of(n + 1, 0), before(n + 1, 0);
  for (std::size_t r = 1; r <= n; ++r) {
    row_of[0] = r;
    std::size_t column = 0;
    std::vector<double> min(n + 1, std::numeric_limits<double>::infinity());
    std::vector<bool> reached(n + 1, false);
    do {
      reached[column] = true;
      const std::size_t row = row_of[column];
      double step = std::numeric_limits<double>::infinity();
      std::size_t next = 0;
      for (std::size_t c = 1; c <= n; ++c) {
        if (reached[c]) continue;
        const double reduced = cost(row - 1, c - 1) - of_row[row] - of_column[c];
        if (reduced < min[c]) {
          min[c] = reduced;
          before[c] = column;
        }
        if (min[c] < step) {
          step = min[c];
          next = c;
        }
      }
      for (std::size_t c = 0; c <= n; ++c) {
        if (reached[c]) {
          of_row[row_of[c]] += step;
          of_column[c] -= step;
        } else {
          min[c] -= step;
        }
      }
      column = next;
    } while (row_of[column] != 0);
    for (; column != 0; column = before[column]) row_of[column] = row_of[before[column]];
  }
  std::vector<std::size_t> out(rows, no_column);
  for (std::size_t c = 1; c <= columns; ++c)
    if (row_of[c] >= 1 && row_of[c] <= rows) out[row_of[c] - 1] = c - 1;
  return out;
}

SegmentAgreement segment_agreement(const Grid<std::uint16_t>& groups,
                                   const Grid<std::uint8_t>& labels, double min_share) {
  if (!groups.same_size(labels))
    throw Error(ErrorKind::usage, "segment agreement", "groups and labels have different sizes",
                "the same size");
  const Shared shared = count_shared(groups, labels, min_share);
  const std::size_t rows = shared.of_label.size();
  const std::size_t columns = shared.of_group.size();
  SegmentAgreement out;
  if (rows == 0 || columns == 0) return out;
  std::vector<double> overlap(rows * columns);
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) {
      const double both = shared.pixels[r * columns + c];
      overlap[r * columns + c] = both / (shared.of_label[r] + shared.of_group[c] - both);
    }
  const std::vector<std::size_t> column = match_one_to_one(overlap, rows, columns);
  for (std::size_t r = 0; r < rows; ++r)
    if (column[r] != no_column)
      out.one_to_one += overlap[r * columns + column[r]] / static_cast<double>(rows);
  std::vector<double> right(rows, 0.0), taken(rows, 0.0);
  for (std::size_t c = 0; c < columns; ++c) {
    if (!(shared.of_group[c] > 0.0)) continue;
    ++out.groups;
    std::size_t max = 0;
    for (std::size_t r = 1; r < rows; ++r)
      if (shared.pixels[r * columns + c] > shared.pixels[max * columns + c]) max = r;
    right[max] += shared.pixels[max * columns + c];
    taken[max] += shared.of_group[c];
  }
  for (std::size_t r = 0; r < rows; ++r) {
    out.merged += right[r] / (shared.of_label[r] + taken[r] - right[r]) / static_cast<double>(rows);
    out.accuracy += right[r] / shared.all;
  }
  return out;
}

}  // namespace belvedere
