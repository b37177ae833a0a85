#include "base/pyramid.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

int half_size(int n) { return (n + 1) / 2; }

// Fills padded[-margin…-1] and padded[count…count + margin - 1] by linear extension, nearest first.
void extend_linearly(float* padded, int count, int margin) {
  const int last = count - 1;
  for (int i = 1; i <= margin; ++i) {
    if (count == 1) {
      padded[-i] = padded[0];
      padded[i] = padded[0];
    } else if (count == 2) {  // the inner cell is itself part of the extension
      padded[-i] = padded[0] + static_cast<float>(i) * (padded[0] - padded[1]);
      padded[last + i] = padded[1] + static_cast<float>(i) * (padded[1] - padded[0]);
    } else {
      padded[-i] = 2.0F * padded[0] - padded[i];
      padded[last + i] = 2.0F * padded[last] - padded[last - i];
    }
  }
}

// Row y of a grid; up to two rows outside are extended linearly into `spare`.
const float* extended_row(const Grid<float>& grid, int y, std::vector<float>& spare) {
  const int last = grid.height() - 1;
  if (y >= 0 && y <= last) return grid.row(y);
  if (last == 0) return grid.row(0);
  const int edge = y < 0 ? 0 : last;
  const int beyond = y < 0 ? -y : y - last;
  // Two rows only: the inner row is itself part of the extension.
  const int inner = last == 1 ? 1 - edge : (y < 0 ? beyond : last - beyond);
  const float weight = last == 1 ? static_cast<float>(beyond) : 1.0F;
  const float* a = grid.row(edge);
  const float* b = grid.row(inner);
  spare.resize(static_cast<std::size_t>(grid.width()));
  for (std::size_t x = 0; x < spare.size(); ++x) spare[x] = a[x] + weight * (a[x] - b[x]);
  return spare.data();
}

// Taps of the even cells of an expansion; odd ones are means of two.
struct EvenTaps {
  float centre, side;
};

void expand_row_by(EvenTaps taps, const Grid<float>& coarser, int y, int width, float* out) {
  const int count = coarser.width();
  std::vector<float> padded(static_cast<std::size_t>(count) + 2);
  float* column = padded.data() + 1;
  std::array<std::vector<float>, 2> spare;
  const float* b = coarser.row(y / 2);
  const float* c = extended_row(coarser, y / 2 + 1, spare[0]);
  if (y % 2 == 0) {
    const float* a = extended_row(coarser, y / 2 - 1, spare[1]);
    for (int x = 0; x < count; ++x) column[x] = taps.centre * b[x] + taps.side * (a[x] + c[x]);
  } else {
    for (int x = 0; x < count; ++x) column[x] = 0.5F * (b[x] + c[x]);
  }
  extend_linearly(column, count, 1);
  for (int x = 0; x < width / 2; ++x) {
    const float* v = column + x;
    float* pair = out + std::ptrdiff_t{2} * x;
    pair[0] = taps.centre * v[0] + taps.side * (v[-1] + v[1]);
    pair[1] = 0.5F * (v[0] + v[1]);
  }
  if (width % 2 == 1) {
    const float* v = column + width / 2;
    out[width - 1] = taps.centre * v[0] + taps.side * (v[-1] + v[1]);
  }
}

}  // namespace

Grid<float> reduce(const Grid<float>& level) {
  const int width = level.width();
  Grid<float> out(half_size(width), half_size(level.height()));
  parallel_rows(out.height(), [&](int y) {
    std::array<std::vector<float>, 4> spare;
    const float* a = extended_row(level, 2 * y - 2, spare[0]);
    const float* b = extended_row(level, 2 * y - 1, spare[1]);
    const float* c = level.row(2 * y);
    const float* d = extended_row(level, 2 * y + 1, spare[2]);
    const float* e = extended_row(level, 2 * y + 2, spare[3]);
    std::vector<float> padded(static_cast<std::size_t>(width) + 4);
    float* column = padded.data() + 2;
    for (int x = 0; x < width; ++x)
      column[x] = 0.4F * c[x] + 0.25F * (b[x] + d[x]) + 0.05F * (a[x] + e[x]);
    extend_linearly(column, width, 2);
    float* target = out.row(y);
    for (int x = 0; x < out.width(); ++x) {
      const float* v = column + std::ptrdiff_t{2} * x;
      target[x] = 0.4F * v[0] + 0.25F * (v[-1] + v[1]) + 0.05F * (v[-2] + v[2]);
    }
  });
  return out;
}

void expand_row(const Grid<float>& coarser, int y, int width, float* out) {
  expand_row_by({0.8F, 0.1F}, coarser, y, width, out);
}

void expand_evenly_row(const Grid<float>& coarser, int y, int width, float* out) {
  expand_row_by({0.75F, 0.125F}, coarser, y, width, out);
}

Grid<float> expand(const Grid<float>& coarser, int width, int height) {
  if (half_size(width) != coarser.width() || half_size(height) != coarser.height()) {
    throw Error(ErrorKind::bug, "expand", "the size does not reduce to that of the coarser level");
  }
  Grid<float> out(width, height);
  parallel_rows(height, [&](int y) { expand_row(coarser, y, width, out.row(y)); });
  return out;
}

int max_bands(int width, int height) {
  int bands = 0;
  for (int side = std::min(width, height); half_size(side) >= 2 && side > 2; side = half_size(side))
    ++bands;
  return bands;
}

LaplacianPyramid make_laplacian_pyramid(const Grid<float>& values, int bands) {
  LaplacianPyramid pyramid;
  pyramid.base = values;
  const int count = std::min(bands, max_bands(values.width(), values.height()));
  for (int i = 0; i < count; ++i) {
    Grid<float> band = std::move(pyramid.base);
    pyramid.base = reduce(band);
    parallel_rows(band.height(), [&](int y) {
      std::vector<float> coarse(static_cast<std::size_t>(band.width()));
      expand_row(pyramid.base, y, band.width(), coarse.data());
      float* row = band.row(y);
      for (int x = 0; x < band.width(); ++x) row[x] -= coarse[static_cast<std::size_t>(x)];
    });
    pyramid.bands.push_back(std::move(band));
  }
  return pyramid;
}

std::vector<Grid<float>> make_gaussian_pyramid(const Grid<float>& values, int levels) {
  std::vector<Grid<float>> pyramid;
  pyramid.reserve(static_cast<std::size_t>(std::max(levels, 0)));
  for (int i = 0; i < levels; ++i) pyramid.push_back(i == 0 ? values : reduce(pyramid.back()));
  return pyramid;
}

}  // namespace belvedere
