#include "renderer/style/fit/fit_air.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/math_exact.h"
#include "base/statistics.h"
#include "renderer/style/fit/paint_figures.h"
#include "renderer/style/fit/style_colours.h"
#include "texture/synthesis/guide_stack.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr std::size_t min_far_texels = 500;
glm::dvec3 median_colour(const std::vector<glm::vec3>& texels, std::size_t begin, std::size_t end) {
  glm::dvec3 out(0.0);
  for (int channel = 0; channel < 3; ++channel) {
    std::vector<float> values;
    for (std::size_t i = begin; i < end; ++i) values.push_back(texels[i][channel]);
    out[channel] = static_cast<double>(middle_value(std::move(values)));
  }
  return out;
}

glm::dvec3 median_colour(const std::vector<glm::vec3>& texels) {
  return median_colour(texels, 0, texels.size());
}

// Median colour of the coolest seventh of the ground (lowest b).
glm::dvec3 coolest(std::vector<glm::vec3> ground) {
  std::stable_sort(ground.begin(), ground.end(),
                   [](const glm::vec3& a, const glm::vec3& b) { return a.z < b.z; });
  return median_colour(ground, 0, std::max<std::size_t>(1, ground.size() / 7));
}

// The row with a given share of the ground above it.
int ground_row(const Grid<std::uint8_t>& mask, double share) {
  std::vector<std::size_t> count(static_cast<std::size_t>(mask.height()), 0);
  std::size_t total = 0;
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x)
      count[static_cast<std::size_t>(y)] += is_ground_label(mask(x, y)) ? 1 : 0;
    total += count[static_cast<std::size_t>(y)];
  }
  std::size_t above = 0;
  int y = 0;
  while (y + 1 < mask.height() && static_cast<double>(above += count[static_cast<std::size_t>(y)]) <
                                      share * static_cast<double>(total))
    ++y;
  return y;
}

// Factor on haze: smaller where far ranges show more contrast of forms.
double fit_haze(const StylePainting& painting) {
  const Grid<float> forms = middle_forms(painting);
  const int upper = ground_row(painting.drawn, 0.33);
  const int lower = ground_row(painting.drawn, 0.67);
  const auto ground = [&](int x, int y) { return is_ground_label(painting.drawn(x, y)); };
  const double far =
      deviation_where(forms, [&](int x, int y) { return y < upper && ground(x, y); });
  const double close =
      deviation_where(forms, [&](int x, int y) { return y > lower && ground(x, y); });
  return std::clamp(1.3 - 0.5 * far / std::max(close, 1e-3), 0.70, 1.25);
}

// Colours of lit vegetation by hue, and the warmest for larches.
void fit_leaves(const StylePainting& painting, StyleAir& air) {
  std::vector<glm::vec3> green;
  for (const LandCoverClass id : {forest, shrub, pasture, alpine_grass}) {
    const std::vector<glm::vec3> own =
        class_texels(painting.soft, painting.drawn, id, painting.drawn.size());
    if (own.size() > 300) green.insert(green.end(), own.begin(), own.end());
  }
  if (green.empty()) green = painting.ground;
  std::vector<float> lightness;
  lightness.reserve(green.size());
  for (const glm::vec3& texel : green) lightness.push_back(texel.x);
  const float middle = middle_value(std::move(lightness));
  std::vector<std::pair<double, glm::vec3>> lit;
  for (const glm::vec3& texel : green)
    if (texel.x >= middle) lit.emplace_back(exact::atan2(texel.z, texel.y), texel);
  std::stable_sort(lit.begin(), lit.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<glm::vec3> by_hue;
  by_hue.reserve(lit.size());
  for (const auto& [hue, texel] : lit) by_hue.push_back(texel);
  constexpr std::array<double, 4> shares = {0.05, 0.30, 0.55, 0.78};
  const auto count = static_cast<double>(by_hue.size());
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const auto begin = std::min(static_cast<std::size_t>(shares[k] * count), by_hue.size() - 1);
    const auto end =
        std::clamp(static_cast<std::size_t>((shares[k] + 0.2) * count), begin + 1, by_hue.size());
    air.leaves[k] = median_colour(by_hue, begin, end);
  }
  air.larch = median_colour(by_hue, 0, std::max<std::size_t>(1, by_hue.size() / 12));
}

}  // namespace

StyleAir fit_air(const StylePainting& painting, const std::optional<glm::dvec3>& horizon) {
  StyleAir air;
  const glm::dvec3 cool = coolest(painting.ground);
  // Without a sky: the horizon of a clear day.
  const glm::dvec3 low_sky = horizon.value_or(glm::dvec3(0.90, 0.0, 0.02));
  std::vector<glm::vec3> far;
  for (std::size_t i = 0; i < painting.drawn.size(); ++i)
    if (painting.drawn[i] == far_air_label) far.push_back(painting.colours[i]);
  air.far_seen = far.size() > min_far_texels;
  if (air.far_seen) {
    const glm::dvec3 seen = median_colour(far);
    air.near = 0.6 * seen + 0.4 * cool;
    air.far = 0.5 * seen + 0.5 * low_sky;
  } else {
    air.near = 0.5 * low_sky + 0.5 * cool;
    air.far = 0.8 * low_sky + 0.2 * cool;
  }
  air.near.x = std::clamp(air.near.x, 0.42, 0.76);
  air.far.x = std::max(air.far.x, air.near.x + 0.06);
  air.mist = 0.5 * air.far + 0.5 * low_sky;
  air.haze = fit_haze(painting);
  fit_leaves(painting, air);
  return air;
}

}  // namespace belvedere
