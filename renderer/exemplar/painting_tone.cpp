#include "renderer/exemplar/painting_tone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/masks/label_blur.h"
#include "base/parallel.h"
#include "renderer/image/oklab.h"
#include "texture/synthesis/guide_stack.h"

namespace belvedere {
namespace {

// Share of a label's texels that are darker, and their tone: the distribution of tone in targets.
struct Knot {
  double share;
  double tone;
};
constexpr std::array<Knot, 5> spread = {
    {{0.01, 0.10}, {0.25, 0.43}, {0.50, 0.64}, {0.75, 0.86}, {0.99, 1.00}}};
constexpr double flat_tone = 0.64;
constexpr double flat_lightness = 1e-4;  // smaller differences count as none

}  // namespace

Grid<float> estimate_tone(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& labels,
                          double stroke_px) {
  Grid<float> lightness(picture.width(), picture.height());
  parallel_rows(picture.height(), [&](int y) {
    for (int x = 0; x < picture.width(); ++x)
      lightness(x, y) = static_cast<float>(to_oklab(picture(x, y)).x);
  });
  Grid<float> tone = blur_within_labels(lightness, labels, stroke_px);
  std::array<std::vector<float>, 256> sorted;
  for (std::size_t i = 0; i < tone.size(); ++i) sorted[labels[i]].push_back(tone[i]);
  sorted[unused_label].clear();
  std::array<std::array<double, spread.size()>, 256> lights{};
  for (std::size_t label = 0; label < sorted.size(); ++label) {
    std::vector<float>& values = sorted[label];
    if (values.empty()) continue;
    std::sort(values.begin(), values.end());
    for (std::size_t k = 0; k < spread.size(); ++k)
      lights[label][k] = static_cast<double>(values[static_cast<std::size_t>(
          spread[k].share * static_cast<double>(values.size() - 1))]);
  }
  parallel_rows(tone.height(), [&](int y) {
    for (int x = 0; x < tone.width(); ++x) {
      const std::uint8_t label = labels(x, y);
      float& value = tone(x, y);
      const auto& knots = lights[label];
      if (label == unused_label) {
        value = 0.F;
      } else if (knots.back() - knots.front() < flat_lightness) {
        value = static_cast<float>(flat_tone);
      } else {
        const double light = std::clamp(static_cast<double>(value), knots.front(), knots.back());
        std::size_t k = 0;
        while (k + 2 < knots.size() && light > knots[k + 1]) ++k;
        const double width = knots[k + 1] - knots[k];
        const double share = width > 0.0 ? (light - knots[k]) / width : 0.5;
        value = static_cast<float>(spread[k].tone + share * (spread[k + 1].tone - spread[k].tone));
      }
    }
  });
  return tone;
}

}  // namespace belvedere
