#include "texture/statistical/cracks.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/filter.h"
#include "base/statistics.h"
#include "texture/statistical/make_texture.h"

namespace belvedere {
namespace {

constexpr double rim_px = 1.0;      // sigma of a crack's edge
constexpr int rim_left_out_px = 2;  // around cracks, where the intact texture is not learnt
constexpr float softness = 24.F;    // levels of depth over which a crack begins
constexpr float min_depth = 24.F;   // less is the noise of intact ground

float luma_of(const Rgb8& c) { return static_cast<float>(2 * c[0] + 5 * c[1] + c[2]) / 8.F; }

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
  Grid<float> depth(crop.width(), crop.height());
  std::array<std::size_t, 3> sum{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < crop.size(); ++i) {
    if (!counts(i) || luma_of(crop[i]) > dark) continue;
    cracked[i] = 1;
    depth[i] = 255.F;
    for (std::size_t c = 0; c < 3; ++c) sum[c] += crop[i][c];
    ++count;
  }
  for (std::size_t c = 0; c < 3; ++c)
    out.colour[c] = static_cast<std::uint8_t>(sum[c] / std::max<std::size_t>(count, 1));
  out.share = static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(all, 1));
  depth = gaussian_blur(depth, rim_px);
  Grid<Rgb8> grey(crop.width(), crop.height());
  for (std::size_t i = 0; i < grey.size(); ++i)
    grey[i].fill(static_cast<std::uint8_t>(std::clamp(depth[i] + .5F, 0.F, 255.F)));
  out.depth = learn_texture(grey, states, parameters, progress).model;
  out.intact = widened(cracked, rim_left_out_px);
  for (std::size_t i = 0; i < crop.size(); ++i)
    out.intact[i] = out.intact[i] == 0 && counts(i) ? pixel_free : std::uint8_t{0};
  return out;
}

std::vector<Grid<Rgb8>> lay_cracks(const Grid<Rgb8>& picture, const CrackModel& cracks, int steps,
                                   std::uint64_t seed, Progress& progress) {
  TextureParameters parameters;
  parameters.seed = seed;
  const Grid<Rgb8> made =
      make_texture(cracks.depth, picture.width(), picture.height(), parameters, progress);
  Grid<float> depth(made.width(), made.height());
  for (std::size_t i = 0; i < made.size(); ++i) depth[i] = luma_of(made[i]);
  depth = gaussian_blur(depth, 0.5 * rim_px);  // levels are whole numbers: without ties
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
