#include "renderer/exemplar/light/shadow_texels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/masks/label_blur.h"
#include "base/parallel.h"
#include "renderer/exemplar/light/painting_tone.h"
#include "renderer/image/oklab.h"
#include "texture/synthesis/guide_stack.h"

namespace belvedere {
namespace {

constexpr double blue_share = 0.5;   // weight of the yellow–blue axis in darkness
constexpr double min_darker = 0.07;  // OKLab lightness by which the shadow group is darker …
constexpr double min_bluer = 0.006;  // … and bluer, between the means of the groups
constexpr std::size_t min_shaded_texels = 64;
constexpr double min_share = 0.01;  // of a label's texels; a smaller group is strokes
constexpr double soft = 0.02;       // half width of the transition, OKLab
constexpr int bins = 256;
constexpr double lowest = -0.2;  // of darkness in the histogram
constexpr double highest = 1.2;

// Darkness: positive for dark and blue.
double darkness(double lightness, double yellow) { return 1.0 - lightness - blue_share * yellow; }

struct Group {
  double count = 0.0;
  double darkness = 0.0, lightness = 0.0, yellow = 0.0;  // sums
  void add(const Group& other) {
    count += other.count;
    darkness += other.darkness;
    lightness += other.lightness;
    yellow += other.yellow;
  }
};

// Darkness from which texels of a label are in shadow; above the maximum if none are.
double find_threshold(const std::array<Group, bins>& histogram) {
  constexpr double none = 1e9;
  Group all;
  for (const Group& bin : histogram) all.add(bin);
  if (all.count < static_cast<double>(min_shaded_texels)) return none;
  Group lit;
  double best = -1.0;
  double threshold = none;
  for (std::size_t k = 0; k + 1 < bins; ++k) {
    lit.add(histogram[k]);
    const double shaded = all.count - lit.count;
    if (lit.count < min_share * all.count || shaded < min_share * all.count) continue;
    const double between = (all.darkness - lit.darkness) / shaded - lit.darkness / lit.count;
    const double score = lit.count * shaded * between * between;
    if (score <= best) continue;
    best = score;
    const double darker = lit.lightness / lit.count - (all.lightness - lit.lightness) / shaded;
    const double bluer = lit.yellow / lit.count - (all.yellow - lit.yellow) / shaded;
    threshold =
        darker >= min_darker && bluer >= min_bluer
            ? lowest + (highest - lowest) * static_cast<double>(k + 1) / static_cast<double>(bins)
            : none;
  }
  return threshold;
}

}  // namespace

Grid<float> find_shadow(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& labels,
                        double stroke_px) {
  Grid<float> lightness(picture.width(), picture.height());
  Grid<float> yellow(picture.width(), picture.height());
  parallel_rows(picture.height(), [&](int y) {
    for (int x = 0; x < picture.width(); ++x) {
      const glm::dvec3 lab = to_oklab(picture(x, y));
      lightness(x, y) = static_cast<float>(lab.x);
      yellow(x, y) = static_cast<float>(lab.z);
    }
  });
  lightness = blur_within_labels(lightness, labels, stroke_px);
  yellow = blur_within_labels(yellow, labels, stroke_px);

  std::vector<std::array<Group, bins>> histograms(256);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const double dark = darkness(lightness[i], yellow[i]);
    const double position = (dark - lowest) / (highest - lowest) * bins;
    histograms[labels[i]][static_cast<std::size_t>(std::clamp(position, 0.0, bins - 1.0))].add(
        {1.0, dark, lightness[i], yellow[i]});
  }
  std::array<double, 256> threshold{};
  for (std::size_t label = 0; label < threshold.size(); ++label)
    threshold[label] = find_threshold(histograms[label]);
  Grid<float> shadow(picture.width(), picture.height(), 1.F);
  parallel_rows(picture.height(), [&](int y) {
    for (int x = 0; x < picture.width(); ++x) {
      if (labels(x, y) == unused_label) continue;
      const double beyond = darkness(lightness(x, y), yellow(x, y)) - threshold[labels(x, y)];
      shadow(x, y) = static_cast<float>(std::clamp(0.5 - 0.5 * beyond / soft, 0.0, 1.0));
    }
  });
  return shadow;
}

Grid<float> shadow_share(const Grid<float>& shadow, const Grid<std::uint8_t>& labels) {
  constexpr double share_of_width = 1.0 / 40.0;
  Grid<std::uint8_t> ground = labels;
  for (std::uint8_t& label : ground)
    if (label != unused_label) label = 0;
  static_assert(unused_label == no_label);
  Grid<float> out =
      blur_within_labels(shadow, ground, std::max(1.0, share_of_width * shadow.width()));
  for (std::size_t i = 0; i < out.size(); ++i)
    if (labels[i] == unused_label) out[i] = 1.F;
  return out;
}

}  // namespace belvedere
