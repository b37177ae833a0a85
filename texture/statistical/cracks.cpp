#include "texture/statistical/cracks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/filter.h"
#include "base/masks/label_blur.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/rising_queue.h"
#include "base/statistics.h"
#include "texture/statistical/make_texture.h"

namespace belvedere {
namespace {

constexpr double rim_level = 150.0;  // depth at the edge of a crack, of 255
constexpr double per_px = 35.0;      // that it gains inwards …
constexpr double fade_px = 3.0;      // … and over which it fades outwards: pairs of a narrow line
                                     // alone come out as clots
constexpr int rim_left_out_px = 2;   // around cracks, where the intact texture is not learnt
constexpr double ridge_px = 2.0;     // sigma of the depth whose ridges are cracks
constexpr float softness = 2.F;      // levels per px² of a ridge over which a crack begins
constexpr float min_ridge = 1.5F;    // less is the noise of intact ground
constexpr double pieces_share = .8;  // of all cracks, before pieces of them are joined …
constexpr double joined_like = .4;   // … by lines as deep as this share of all

float luma_of(const Rgb8& c) { return static_cast<float>(2 * c[0] + 5 * c[1] + c[2]) / 8.F; }

// Grey: how deep inside a crack, or how near to one, a pixel is.
Grid<Rgb8> depth_picture(const Grid<std::uint8_t>& cracked) {
  Grid<std::uint8_t> intact(cracked.width(), cracked.height());
  for (std::size_t i = 0; i < intact.size(); ++i) intact[i] = cracked[i] == 0 ? 1 : 0;
  const Grid<std::int32_t> inside = nearest_marked(cracked);
  const Grid<std::int32_t> outside = nearest_marked(intact);
  Grid<Rgb8> out(cracked.width(), cracked.height());
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      const std::int32_t other = (cracked(x, y) != 0 ? outside : inside)(x, y);
      const double right = x - other % out.width();
      const double down = y - other / out.width();
      const double px = other < 0 ? 1e3 : std::sqrt(right * right + down * down);
      const double depth = cracked(x, y) != 0 ? std::min(rim_level + per_px * px, 255.0)
                                              : rim_level * exact::exp(-px / fade_px);
      out(x, y).fill(static_cast<std::uint8_t>(depth + .5));
    }
  return out;
}

// How sharply the depth falls off to both sides, levels per px²: minus the lower eigenvalue of its
// second derivatives. Pits of one depth are apart where the ridge between them is still a line.
Grid<float> find_ridges(const Grid<Rgb8>& made) {
  Grid<float> depth(made.width(), made.height());
  for (std::size_t i = 0; i < made.size(); ++i) depth[i] = luma_of(made[i]);
  depth = gaussian_blur(depth, ridge_px);
  Grid<float> out(made.width(), made.height());
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x) {
      const auto at = [&](int u, int v) { return depth.clamped(x + u, y + v); };
      const float xx = at(-1, 0) + at(1, 0) - 2.F * at(0, 0);
      const float yy = at(0, -1) + at(0, 1) - 2.F * at(0, 0);
      const float xy = (at(-1, -1) + at(1, 1) - at(-1, 1) - at(1, -1)) / 4.F;
      const float half = (xx - yy) / 2.F;
      out(x, y) = std::sqrt(half * half + xy * xy) - (xx + yy) / 2.F;
    }
  });
  return out;
}

float ridge_of_share(const Grid<float>& ridges, double share) {
  return std::max(min_ridge,
                  value_at_share(std::vector<float>(ridges.begin(), ridges.end()), 1.0 - share));
}

// Joins pieces of cracks, which a texture of pairs of pixels leaves short, along the highest
// ridges between them (where floods from all of them meet first), until there are as few for their
// pixels as in the crop.
Grid<float> join_cracks(Grid<float> ridges, const CrackModel& cracks) {
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  const float from = ridge_of_share(ridges, pieces_share * cracks.share);
  const float joined = ridge_of_share(ridges, joined_like * cracks.share);
  Grid<std::uint8_t> cracked(ridges.width(), ridges.height());
  for (std::size_t i = 0; i < cracked.size(); ++i) cracked[i] = ridges[i] > from ? 1 : 0;
  LabelPatches<std::uint8_t> pieces = find_patches(cracked, [](std::uint8_t) { return true; });
  auto left = static_cast<double>(std::count(pieces.labels.begin(), pieces.labels.end(), 1));
  const double wanted = std::max(
      1.0, cracks.pieces * static_cast<double>(std::count(cracked.begin(), cracked.end(), 1)));
  std::vector<std::uint32_t> same(pieces.sizes.size());
  for (std::size_t i = 0; i < same.size(); ++i) same[i] = static_cast<std::uint32_t>(i);
  const auto piece_at = [&](std::size_t i) {
    std::uint32_t piece = pieces.of_cell[i];
    while (same[piece] != piece) piece = same[piece] = same[same[piece]];
    return piece;
  };
  RisingQueue flood;
  Grid<std::uint32_t> origin(ridges.width(), ridges.height(), none);
  Grid<std::uint8_t> passed(ridges.width(), ridges.height());
  for (std::size_t i = 0; i < cracked.size(); ++i) {
    if (cracked[i] == 0) continue;
    origin[i] = static_cast<std::uint32_t>(i);
    flood.push(rising_key(-ridges[i], origin[i]));
  }
  Grid<std::uint8_t> path(ridges.width(), ridges.height());
  while (left > wanted && !flood.empty()) {
    const auto i = static_cast<std::uint32_t>(flood.pop());
    const int x = static_cast<int>(i) % ridges.width();
    const int y = static_cast<int>(i) / ridges.width();
    passed[i] = 1;
    for (int beside = 0; beside < 9; ++beside) {
      const int u = x + beside % 3 - 1;
      const int v = y + beside / 3 - 1;
      if (!ridges.contains(u, v)) continue;
      const std::size_t j = ridges.index(u, v);
      if (origin[j] == none) {
        origin[j] = i;
        pieces.of_cell[j] = pieces.of_cell[i];
        flood.push(rising_key(-ridges[j], static_cast<std::uint32_t>(j)));
      } else if (passed[j] != 0 && piece_at(i) != piece_at(j)) {
        same[piece_at(i)] = piece_at(j);
        left -= 1.0;
        for (std::size_t k : {std::size_t{i}, j})
          for (; cracked[k] == 0; k = origin[k]) path[k] = 1;
      }
    }
  }
  for (std::size_t i = 0; i < path.size(); ++i)
    if (path[i] != 0) ridges[i] = std::max(ridges[i], joined);
  return ridges;
}

}  // namespace

CrackModel learn_cracks(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states, double darkest,
                        const LearnParameters& parameters, Progress& progress) {
  const auto counts = [&](std::size_t i) {
    return states.empty() || (states[i] & pixel_counts) != 0;
  };
  std::vector<float> sorted;
  for (std::size_t i = 0; i < crop.size(); ++i)
    if (counts(i)) sorted.push_back(luma_of(crop[i]));
  const std::size_t all = sorted.size();
  const float dark = all == 0 ? 0.F : value_at_share(std::move(sorted), darkest);
  CrackModel out;
  Grid<std::uint8_t> cracked(crop.width(), crop.height());
  std::array<std::size_t, 3> sum{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < crop.size(); ++i) {
    if (!counts(i) || luma_of(crop[i]) > dark) continue;
    cracked[i] = 1;
    for (std::size_t c = 0; c < 3; ++c) sum[c] += crop[i][c];
    ++count;
  }
  for (std::size_t c = 0; c < 3; ++c)
    out.colour[c] = static_cast<std::uint8_t>(sum[c] / std::max<std::size_t>(count, 1));
  out.share = static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(all, 1));
  const auto patches = find_patches(cracked, [](std::uint8_t) { return true; });
  out.pieces = static_cast<double>(std::count(patches.labels.begin(), patches.labels.end(), 1)) /
               static_cast<double>(std::max<std::size_t>(count, 1));
  out.depth = learn_texture(depth_picture(cracked), states, parameters, progress).model;
  out.depth.polish = false;  // it breaks lines into dabs
  out.intact = widened(cracked, rim_left_out_px);
  for (std::size_t i = 0; i < crop.size(); ++i)
    out.intact[i] = out.intact[i] == 0 && counts(i) ? pixel_free : std::uint8_t{0};
  return out;
}

std::vector<Grid<Rgb8>> lay_cracks(const Grid<Rgb8>& picture, const CrackModel& cracks, int steps,
                                   std::uint64_t seed, Progress& progress) {
  const Grid<Rgb8> made =
      make_texture(cracks.depth, picture.width(), picture.height(), {.seed = seed}, progress);
  const Grid<float> ridges = join_cracks(find_ridges(made), cracks);
  std::vector<Grid<Rgb8>> out;
  for (int step = 1; step <= steps; ++step) {
    const float from = ridge_of_share(ridges, cracks.share * step / steps);
    Grid<Rgb8>& laid = out.emplace_back(picture);
    for (std::size_t i = 0; i < laid.size(); ++i) {
      const float cover = std::clamp((ridges[i] - from) / softness + .5F, 0.F, 1.F);
      for (std::size_t c = 0; c < 3; ++c)
        laid[i][c] = static_cast<std::uint8_t>(
            static_cast<float>(laid[i][c]) +
            cover * (static_cast<float>(cracks.colour[c]) - static_cast<float>(laid[i][c])) + .5F);
    }
  }
  return out;
}

}  // namespace belvedere
