#include "texture/synthesis/synth_pieces.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/random.h"

namespace belvedere::synth {

std::uint32_t Pieces::root(std::uint32_t pixel) {
  while (parent_[pixel] >= 0) {
    const std::uint32_t up = static_cast<std::uint32_t>(parent_[pixel]);
    if (parent_[up] >= 0) parent_[pixel] = parent_[up];  // halve the path
    pixel = up;
  }
  return pixel;
}

std::uint32_t Pieces::first_pixel(std::uint32_t pixel) const {
  while (parent_[pixel] >= 0) pixel = static_cast<std::uint32_t>(parent_[pixel]);
  return pixel;
}

void Pieces::unite(std::uint32_t a, std::uint32_t b) {
  a = root(a);
  b = root(b);
  if (a == b) return;
  if (b < a) std::swap(a, b);
  parent_[a] += parent_[b];
  parent_[b] = static_cast<std::int32_t>(a);
}

void Pieces::find(const Plane& target, const Plane& exemplars,
                  const std::vector<std::uint32_t>& match, const std::uint32_t* fixed) {
  constexpr int band = 64;  // rows united by one thread; bands are joined afterwards
  const Plane::Part& part = target.parts[0];
  const std::uint32_t across = static_cast<std::uint32_t>(target.stride);
  const std::uint32_t texels_across = static_cast<std::uint32_t>(exemplars.stride);
  const auto with_left = [&](std::uint32_t at) { return match[at - 1] + 1 == match[at]; };
  const auto with_upper = [&](std::uint32_t at) {
    return match[at - across] + texels_across == match[at];
  };
  const int bands = (part.height + band - 1) / band;
  parallel_rows(bands, [&](int i) {
    for (int y = i * band; y < std::min(part.height, (i + 1) * band); ++y) {
      const std::uint32_t row = target.index(0, 0, y);
      for (std::uint32_t at = row; at < row + static_cast<std::uint32_t>(part.width); ++at) {
        parent_[at] = -1;
        const bool left = at > row && with_left(at);
        if (left) {
          const std::uint32_t first = root(at - 1);
          parent_[at] = static_cast<std::int32_t>(first);
          --parent_[first];
        }
        // If the left pixel and the two above are joined too, the union already exists.
        if (y > i * band && with_upper(at) &&
            !(left && with_upper(at - 1) && with_left(at - across)))
          unite(at - across, at);
      }
    }
  });
  for (int i = 1; i < bands; ++i) {
    const std::uint32_t row = target.index(0, 0, i * band);
    for (std::uint32_t at = row; at < row + static_cast<std::uint32_t>(part.width); ++at) {
      if (with_upper(at)) unite(at - across, at);
    }
  }
  if (fixed != nullptr) {
    fixed_count_.assign(parent_.size(), 0);
    target.for_each([&](std::uint32_t at) {
      if (fixed[at] != exemplars.nowhere()) ++fixed_count_[first_pixel(at)];
    });
  }
  std::vector<std::uint32_t> largest(static_cast<std::size_t>(bands), 0);
  parallel_rows(bands, [&](int i) {
    for (int y = i * band; y < std::min(part.height, (i + 1) * band); ++y) {
      const std::uint32_t row = target.index(0, 0, y);
      for (std::uint32_t at = row; at < row + static_cast<std::uint32_t>(part.width); ++at) {
        const std::uint32_t first = first_pixel(at);
        std::uint32_t size = static_cast<std::uint32_t>(-parent_[first]);
        if (fixed != nullptr && fixed_count_[first] > 0) size += size - fixed_count_[first];
        size_[at] = static_cast<std::uint16_t>(std::min<std::uint32_t>(65535, size));
        largest[static_cast<std::size_t>(i)] = std::max(largest[static_cast<std::size_t>(i)], size);
      }
    }
  });
  largest_ = *std::max_element(largest.begin(), largest.end());
}

Cell cell_around(int x, int y, std::uint64_t key) {
  const int square_x = x / cell_side;
  const int square_y = y / cell_side;
  Cell nearest;
  int min = INT32_MAX;
  for (int j = square_y - 1; j <= square_y + 1; ++j) {
    for (int i = square_x - 1; i <= square_x + 1; ++i) {
      const std::uint64_t bits = random_bits(key, i, j, 3);
      const int dx = i * cell_side + static_cast<int>((bits & 0xffff) * cell_side >> 16) - x;
      const int dy = j * cell_side + static_cast<int>((bits >> 16 & 0xffff) * cell_side >> 16) - y;
      if (dx * dx + dy * dy < min) {
        min = dx * dx + dy * dy;
        nearest = {i, j, (i + j) & 1};
      }
    }
  }
  return nearest;
}

}  // namespace belvedere::synth
