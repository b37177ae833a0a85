#include "texture/synthesis/synth_plane.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>

#include "base/error.h"
#include "base/parallel.h"

namespace belvedere::synth {

Plane::Place Plane::position(std::uint32_t index) const {
  const int part = part_of(index);
  const std::uint32_t inside = index - parts[static_cast<std::size_t>(part)].origin;
  const std::uint32_t across = static_cast<std::uint32_t>(stride);
  return {part, static_cast<int>(inside % across), static_cast<int>(inside / across)};
}

Plane make_plane(const std::vector<std::pair<int, int>>& sizes, int guide_count, int margin) {
  Plane plane;
  plane.margin = margin;
  plane.guide_count = guide_count;
  for (const auto& [width, height] : sizes)
    plane.stride = std::max(plane.stride, width + 2 * margin);
  std::uint64_t rows = static_cast<std::uint64_t>(margin);
  for (const auto& [width, height] : sizes) {
    const std::uint64_t origin =
        rows * static_cast<std::uint64_t>(plane.stride) + static_cast<std::uint64_t>(margin);
    rows += static_cast<std::uint64_t>(height + margin);
    if ((rows + static_cast<std::uint64_t>(margin)) * static_cast<std::uint64_t>(plane.stride) >
        0x7fffffffULL) {
      throw Error(ErrorKind::limit, "synthesis",
                  fmt::format("pictures of {} rows by {} columns together", rows, plane.stride),
                  "at most 2147 million pixels, and as many texels in all exemplars together");
    }
    plane.parts.push_back({width, height, static_cast<std::uint32_t>(origin)});
  }
  const std::size_t count = static_cast<std::size_t>(rows) * static_cast<std::size_t>(plane.stride);
  plane.words.assign(count, no_class << 24);
  plane.guides.assign(count * static_cast<std::size_t>(guide_count) + 8,
                      0);  // vector reads of 8 guides stay inside
  return plane;
}

void pad(Plane& plane) {
  for (const Plane::Part& part : plane.parts) {
    for (int y = -plane.margin; y < part.height + plane.margin; ++y) {
      const bool inside_row = y >= 0 && y < part.height;
      const std::int64_t row =
          static_cast<std::int64_t>(part.origin) + static_cast<std::int64_t>(y) * plane.stride;
      const std::int64_t from =
          static_cast<std::int64_t>(part.origin) +
          static_cast<std::int64_t>(std::clamp(y, 0, part.height - 1)) * plane.stride;
      for (int x = -plane.margin; x < part.width + plane.margin; ++x) {
        if (inside_row && x >= 0 && x < part.width) continue;
        const std::uint32_t colour =
            plane.words[static_cast<std::size_t>(from + std::clamp(x, 0, part.width - 1))] &
            0xffffffU;
        plane.words[static_cast<std::size_t>(row + x)] = colour | no_class << 24;
      }
    }
  }
}

namespace {

// The most frequent class of the 2 × 2 children, ties to the lower one; children beyond the border
// repeat the last.
std::uint32_t majority(const std::array<std::uint32_t, 4>& classes) {
  std::uint32_t best = no_class;
  int best_count = 0;
  for (const std::uint32_t candidate : classes) {
    const int count = static_cast<int>(std::count(classes.begin(), classes.end(), candidate));
    if (count > best_count || (count == best_count && candidate < best)) {
      best = candidate;
      best_count = count;
    }
  }
  return best;
}

}  // namespace

namespace {

bool same_depth(float a, float b, float ratio) {
  return a == b || std::max(a, b) <= ratio * std::min(a, b);
}

// The cuts of the coarse texel at (x, y) of a picture.
std::uint8_t halved_cuts(const Plane& fine, int picture, int x, int y) {
  const Plane::Part& part = fine.parts[static_cast<std::size_t>(picture)];
  const auto is_cut = [&](int fx, int fy, std::uint8_t side) {
    return (fine.cuts[fine.index(picture, std::min(fx, part.width - 1),
                                 std::min(fy, part.height - 1))] &
            side) != 0;
  };
  const auto line_is_cut = [&](int other, std::uint8_t side) {
    const bool across = side == cut::right;
    for (int step = 0; step < 2; ++step)
      if (is_cut(2 * x + (across ? step : other), 2 * y + (across ? other : step), side))
        return true;
    return false;
  };
  std::uint8_t cuts = 0;
  for (const std::uint8_t side : {cut::right, cut::down})
    if (line_is_cut(0, side) && line_is_cut(1, side)) cuts |= side;
  return cuts;
}

}  // namespace

Plane halve(const Plane& fine) {
  std::vector<std::pair<int, int>> sizes;
  for (const Plane::Part& part : fine.parts)
    sizes.emplace_back((part.width + 1) / 2, (part.height + 1) / 2);
  Plane coarse = make_plane(sizes, fine.guide_count, fine.margin);
  coarse.known = fine.known;
  coarse.lacking_price = fine.lacking_price;
  const std::size_t guides = static_cast<std::size_t>(fine.guide_count);
  if (!fine.cuts.empty()) coarse.cuts.assign(coarse.words.size(), 0);
  for (std::size_t p = 0; p < fine.parts.size(); ++p) {
    const Plane::Part& part = fine.parts[p];
    parallel_rows(coarse.parts[p].height, [&](int y) {
      std::vector<int> sums(guides);
      for (int x = 0; x < coarse.parts[p].width; ++x) {
        constexpr std::array<int, 4> tap{1, 3, 3, 1};
        std::array<int, 3> colour{};
        std::fill(sums.begin(), sums.end(), 0);
        int total = 0;
        for (int j = 0; j < 4; ++j) {
          const int fy = std::clamp(2 * y - 1 + j, 0, part.height - 1);
          for (int i = 0; i < 4; ++i) {
            const std::uint32_t at =
                fine.index(static_cast<int>(p), std::clamp(2 * x - 1 + i, 0, part.width - 1), fy);
            const std::uint32_t word = fine.words[at];
            if (class_of(word) == no_class) continue;
            const int weight = tap[static_cast<std::size_t>(i)] * tap[static_cast<std::size_t>(j)];
            total += weight;
            for (std::size_t c = 0; c < 3; ++c)
              colour[c] += weight * static_cast<int>(word >> (8 * c) & 255U);
            const std::uint8_t* values = fine.guides_at(at);
            for (std::size_t g = 0; g < guides; ++g) sums[g] += weight * values[g];
          }
        }
        if (total == 0) continue;
        std::array<std::uint32_t, 4> classes{};
        for (int child = 0; child < 4; ++child) {
          const int fx = std::min(2 * x + (child & 1), part.width - 1);
          const int fy = std::min(2 * y + (child >> 1), part.height - 1);
          classes[static_cast<std::size_t>(child)] =
              class_of(fine.words[fine.index(static_cast<int>(p), fx, fy)]);
        }
        const std::uint32_t at = coarse.index(static_cast<int>(p), x, y);
        if (!fine.cuts.empty()) coarse.cuts[at] = halved_cuts(fine, static_cast<int>(p), x, y);
        std::uint32_t word = majority(classes) << 24;
        for (std::size_t c = 0; c < 3; ++c)
          word |= static_cast<std::uint32_t>((colour[c] + total / 2) / total) << (8 * c);
        coarse.words[at] = word;
        for (std::size_t g = 0; g < guides; ++g) {
          coarse.guides[at * guides + g] = static_cast<std::uint8_t>((sums[g] + total / 2) / total);
        }
      }
    });
  }
  pad(coarse);
  return coarse;
}

bool add_cuts(const Grid<float>& depth_m, int part, float ratio, Plane& plane) {
  plane.cuts.resize(plane.words.size(), 0);
  std::atomic<bool> any = false;
  parallel_rows(depth_m.height(), [&](int y) {
    for (int x = 0; x < depth_m.width(); ++x) {
      std::uint8_t cuts = 0;
      const float here = depth_m(x, y);
      if (x + 1 < depth_m.width() && !same_depth(here, depth_m(x + 1, y), ratio))
        cuts |= cut::right;
      if (y + 1 < depth_m.height() && !same_depth(here, depth_m(x, y + 1), ratio))
        cuts |= cut::down;
      if (cuts == 0) continue;
      plane.cuts[plane.index(part, x, y)] = cuts;
      any.store(true, std::memory_order_relaxed);
    }
  });
  return any.load();
}

Grid<float> halve_depth(const Grid<float>& depth_m, const Plane& fine, const Plane& coarse) {
  Grid<float> out(coarse.parts[0].width, coarse.parts[0].height);
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x) {
      const std::uint32_t label_class = class_of(coarse.words[coarse.index(0, x, y)]);
      out(x, y) = depth_m(2 * x, 2 * y);
      for (int child = 0; child < 4; ++child) {
        const int fx = std::min(2 * x + (child & 1), depth_m.width() - 1);
        const int fy = std::min(2 * y + (child >> 1), depth_m.height() - 1);
        if (class_of(fine.words[fine.index(0, fx, fy)]) == label_class) {
          out(x, y) = depth_m(fx, fy);
          break;
        }
      }
    }
  });
  return out;
}

std::vector<std::uint8_t> make_links(const Grid<float>& depth_m, const Plane& plane, float ratio,
                                     int radius) {
  std::vector<std::uint8_t> links(plane.words.size(), 0);
  const int width = depth_m.width();
  const int height = depth_m.height();
  const auto same_surface = [ratio](float a, float b) { return same_depth(a, b, ratio); };
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const float here = depth_m(x, y);
      std::uint8_t bits = 0;
      if (x + 1 < width && same_surface(here, depth_m(x + 1, y))) bits |= link::right;
      if (x > 0 && same_surface(here, depth_m(x - 1, y))) bits |= link::left;
      if (y + 1 < height && same_surface(here, depth_m(x, y + 1))) bits |= link::down;
      if (y > 0 && same_surface(here, depth_m(x, y - 1))) bits |= link::up;
      links[plane.index(0, x, y)] = bits;
    }
  });
  // A patch is cut if one of its links is missing; the picture's own border is not a cut, because
  // padding masks it.
  std::vector<std::uint8_t> flagged = links;
  parallel_rows(height, [&](int y) {
    const int y1 = std::min(height - 1, y + radius);
    for (int x = 0; x < width; ++x) {
      const int x1 = std::min(width - 1, x + radius);
      bool cut = false;
      for (int j = std::max(0, y - radius); j <= y1 && !cut; ++j) {
        for (int i = std::max(0, x - radius); i <= x1 && !cut; ++i) {
          const std::uint8_t bits = links[plane.index(0, i, j)];
          cut = (i < x1 && !(bits & link::right)) || (j < y1 && !(bits & link::down));
        }
      }
      if (cut) flagged[plane.index(0, x, y)] |= link::cut_patch;
    }
  });
  return flagged;
}

bool linked(const std::uint8_t* links, int stride, std::uint32_t from, int dx, int dy) {
  const std::uint8_t horizontal = dx > 0 ? link::right : link::left;
  const std::uint8_t vertical = dy > 0 ? link::down : link::up;
  const auto at = [&](int sx, int sy) {
    return links[static_cast<std::ptrdiff_t>(from) + sx + static_cast<std::ptrdiff_t>(sy) * stride];
  };
  if (dy == 0) return (at(0, 0) & horizontal) != 0;
  if (dx == 0) return (at(0, 0) & vertical) != 0;
  return ((at(0, 0) & horizontal) && (at(dx, 0) & vertical)) ||
         ((at(0, 0) & vertical) && (at(0, dy) & horizontal));
}

}  // namespace belvedere::synth
