#include "texture/statistical/cracks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/filter.h"
#include "base/math_exact.h"
#include "base/statistics.h"
#include "texture/statistical/make_texture.h"

namespace belvedere {
namespace {

constexpr double rim_level = 150.0;  // depth at the edge of a crack, of 255
constexpr double per_px = 35.0;      // that it gains inwards …
constexpr double fade_px = 3.0;      // … and over which it fades outwards: pairs of a narrow line
                                     // alone come out as clots
constexpr int rim_left_out_px = 2;   // around cracks, where the intact texture is not learnt
constexpr double without_ties_px = .5;  // sigma; levels are whole numbers
constexpr float softness = 24.F;        // levels of depth over which a crack begins
constexpr float min_depth = 24.F;       // less is the noise of intact ground

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
  Grid<float> depth(made.width(), made.height());
  for (std::size_t i = 0; i < made.size(); ++i) depth[i] = luma_of(made[i]);
  depth = gaussian_blur(depth, without_ties_px);
  std::vector<Grid<Rgb8>> out;
  for (int step = 1; step <= steps; ++step) {
    const float from =
        std::max(min_depth, value_at_share(std::vector<float>(depth.begin(), depth.end()),
                                           1.0 - cracks.share * step / steps));
    Grid<Rgb8>& laid = out.emplace_back(picture);
    for (std::size_t i = 0; i < laid.size(); ++i) {
      const float cover = std::clamp((depth[i] - from) / softness + .5F, 0.F, 1.F);
      for (std::size_t c = 0; c < 3; ++c)
        laid[i][c] = static_cast<std::uint8_t>(
            static_cast<float>(laid[i][c]) +
            cover * (static_cast<float>(cracks.colour[c]) - static_cast<float>(laid[i][c])) + .5F);
    }
  }
  return out;
}

}  // namespace belvedere
