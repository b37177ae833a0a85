#include "renderer/style/style_cumulus.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/math.h"
#include "base/random.h"
#include "base/statistics.h"
#include "renderer/paint/picture_noise.h"

namespace belvedere {
namespace {

// Skies whose upper_edges exceed those of calm skies have cumulus, fully from cumulus_edges on.
// They lie in the sky's upper part, where they are measured; towards the horizon clouds lie level.
constexpr double calm_edges = 0.15;
constexpr double cumulus_edges = 0.30;
constexpr double cumulus_to_row = 0.5;  // shares of the sky's height
constexpr double level_from_row = 0.9;
constexpr double max_cumulus_flatness = 4.0;
// A cumulus is a body with round puffs, each octave half the size of the one before.
constexpr int body_octaves = 2;
constexpr int puff_octaves = 4;
constexpr float puff_share = 0.62F;
constexpr float puff_mean = 0.798F;  // of a normal deviate's amount
constexpr double rim_share = 0.5;    // height of the lit rim over the half-correlation length
// Thickness over which a cloud becomes opaque, in deviations of its body.
constexpr float upper_softness = 0.2F;
constexpr float lower_softness = 0.9F;
constexpr float max_rise = 1.2F;
constexpr float thickness_light = 0.15F;
constexpr int first_cumulus = 8;     // number of a random stream of Stream::style_sky
constexpr int sample_columns = 640;  // of the small sky on which their distribution is measured

// Thickness of clouds, and by how much it exceeds that at the height of a rim above.
struct CumulusFields {
  Grid<float> thickness;
  Grid<float> rise;
};

CumulusFields make_cumulus(const SkyWindow& window, double ppu, double length_x, double length_y,
                           std::uint64_t seed) {
  const int rim_px = std::max(1, static_cast<int>(std::lround(rim_share * length_y * ppu)));
  const glm::ivec2 origin{window.origin_px.x, window.origin_px.y - rim_px};
  Grid<float> all(window.width, window.height + rim_px, 0.0F);
  const auto add = [&](int octave, double sigma_x, double sigma_y, const auto& change) {
    const Grid<float> noise = make_image_noise(
        stream_seed(seed, Stream::style_sky, static_cast<std::uint64_t>(first_cumulus + octave)),
        origin, all.width(), all.height(), ppu, std::max(sigma_x, 0.4), std::max(sigma_y, 0.4));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] += change(noise[i]);
  };
  for (int octave = 0; octave < body_octaves; ++octave) {
    const double finer = sky_sigma_per_length / (1 << octave);
    const float share = octave == 0 ? 1.0F : 0.5F;
    add(octave, finer * length_x, finer * length_y, [&](float n) { return share * n; });
  }
  float share = 1.0F;
  for (int octave = 0; octave < puff_octaves; ++octave) {
    share *= puff_share;
    const double round = sky_sigma_per_length * length_y / (1 << octave);
    add(body_octaves + octave, round, round,
        [&](float n) { return share * (std::abs(n) - puff_mean); });
  }
  CumulusFields cumulus{Grid<float>(window.width, window.height),
                        Grid<float>(window.width, window.height)};
  for (int y = 0; y < window.height; ++y)
    for (int x = 0; x < window.width; ++x) {
      cumulus.thickness(x, y) = all(x, y + rim_px);
      cumulus.rise(x, y) = std::clamp(all(x, y + rim_px) - all(x, y), -max_rise, max_rise);
    }
  return cumulus;
}

// Light on a cloud before it gets the painting's distribution.
float light_on(float thickness, float rise) { return rise + thickness_light * thickness; }

}  // namespace

double cumulus_share(const StyleSky& sky) {
  if (sky.changes.empty()) return 0.0;
  return std::clamp((sky.upper_edges - calm_edges) / (cumulus_edges - calm_edges), 0.0, 1.0);
}

StyleCumulus::StyleCumulus(const StyleSky& sky, const SkyWindow& window,
                           const StylePaintParameters& parameters)
    : window_(window), sky_rows_(parameters.sky_rows), share_(cumulus_share(sky)) {
  if (share_ <= 0.0) return;
  const StyleSkyChange& change = sky.changes.front();
  const double ppu = parameters.pixels_per_unit;
  // A cloud takes the painting's share of the sky's area and keeps its own flatness.
  const double size =
      std::sqrt(change.length_x * parameters.sheet_px.x * change.length_y * parameters.sky_rows) /
      ppu;
  const double flatness = std::sqrt(
      std::clamp(sky.aspect * change.length_x / change.length_y, 1.0, max_cumulus_flatness));
  const auto make = [&](const SkyWindow& part, double scale) {
    return make_cumulus(part, scale * ppu, size * flatness, size / flatness, parameters.seed);
  };
  // Distributions on the whole sheet, from a small picture of it.
  const double scale = std::min(1.0, static_cast<double>(sample_columns) / parameters.sheet_px.x);
  const auto scaled = [&](int px) {
    return std::max(1, static_cast<int>(std::lround(scale * px)));
  };
  const CumulusFields small =
      make({{0, 0}, scaled(parameters.sheet_px.x), scaled(parameters.sky_rows)}, scale);
  const std::vector<float> thickness(small.thickness.begin(), small.thickness.end());
  bare_ = value_at_share(thickness, sky.clear_share);
  std::vector<float> lights;
  for (std::size_t i = 0; i < thickness.size(); ++i)
    if (thickness[i] >= bare_) lights.push_back(light_on(thickness[i], small.rise[i]));
  for (std::size_t q = 0; q < lights_.size(); ++q)
    lights_[q] = value_at_share(lights, sky_quantile_shares[q]);
  CumulusFields cumulus = make(window, 1.0);
  thickness_ = std::move(cumulus.thickness);
  rise_ = std::move(cumulus.rise);
}

float StyleCumulus::share(int row) const {
  const double at = (window_.origin_px.y + row + 0.5) / sky_rows_;
  return static_cast<float>(share_ * (1.0 - smoothstep(cumulus_to_row, level_from_row, at)));
}

float StyleCumulus::cover(int x, int row) const {
  const float softness =
      upper_softness + (lower_softness - upper_softness) * smoothstep(0.5F - rise_(x, row));
  return smoothstep(0.5F + 0.5F * (thickness_(x, row) - bare_) / softness);
}

double StyleCumulus::deviate(int x, int row) const {
  const float light = light_on(thickness_(x, row), rise_(x, row));
  std::size_t i = 0;
  while (i + 2 < lights_.size() && light > lights_[i + 1]) ++i;
  const float width = std::max(lights_[i + 1] - lights_[i], 1e-4F);
  const double t = std::clamp((light - lights_[i]) / width, 0.0F, 1.0F);
  return sky_quantile_deviates[i] + t * (sky_quantile_deviates[i + 1] - sky_quantile_deviates[i]);
}

}  // namespace belvedere
