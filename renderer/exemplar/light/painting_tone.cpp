#include "renderer/exemplar/light/painting_tone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/filter.h"
#include "base/land_cover_class.h"
#include "base/masks/label_blur.h"
#include "base/math_exact.h"
#include "base/matrix/matrix.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "renderer/exemplar/uncertain_places.h"
#include "renderer/image/srgb.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {
namespace {

// Share of a label's texels that are darker, and their tone: the distribution of tone in targets.
struct Knot {
  double share;
  double tone;
};
constexpr std::array<Knot, 5> spread = {
    {{0.01, 0.10}, {0.25, 0.43}, {0.50, 0.64}, {0.75, 0.86}, {0.99, 1.00}}};
constexpr std::size_t lower_quartile = 1, middle = 2, upper_quartile = 3;
constexpr double flat_tone = 0.64;
constexpr double flat_lightness = 1e-4;  // smaller differences count as none

// Interquartile range of a label's lightness, of the usual one of the painting, below which it
// shows one light only.
constexpr double one_light_share = 0.35;
constexpr std::size_t min_border_texels = 32;  // that tell which

// Agreement of paint and modelled light (correlation within labels) from which the model counts,
// and from which it counts fully.
constexpr double no_agreement = 0.05;
constexpr double full_agreement = 0.25;

// The root of lightness: light changes it by about as much for dark paint as for pale paint.
Grid<float> root_of_lightness(const Grid<glm::vec3>& picture) {
  Grid<float> out(picture.width(), picture.height());
  parallel_rows(picture.height(), [&](int y) {
    for (int x = 0; x < picture.width(); ++x)
      out(x, y) = static_cast<float>(std::sqrt(std::max(to_oklab(picture(x, y)).x, 0.0)));
  });
  return out;
}

// How lightness becomes tone within a label.
struct ToneScale {
  std::size_t texels = 0;
  std::array<double, spread.size()> lightness{};  // at the knots

  double range() const { return lightness[upper_quartile] - lightness[lower_quartile]; }
  double tone(double value) const {
    if (lightness.back() - lightness.front() < flat_lightness) return flat_tone;
    const double light = std::clamp(value, lightness.front(), lightness.back());
    std::size_t k = 0;
    while (k + 2 < lightness.size() && light > lightness[k + 1]) ++k;
    const double width = lightness[k + 1] - lightness[k];
    const double share = width > 0.0 ? (light - lightness[k]) / width : 0.5;
    return spread[k].tone + share * (spread[k + 1].tone - spread[k].tone);
  }
};

ToneScale scale_of(std::vector<float>& values) {
  ToneScale scale;
  scale.texels = values.size();
  std::sort(values.begin(), values.end());
  for (std::size_t k = 0; k < spread.size(); ++k)
    scale.lightness[k] = static_cast<double>(
        values[static_cast<std::size_t>(spread[k].share * static_cast<double>(values.size() - 1))]);
  return scale;
}

using ToneScales = std::array<ToneScale, 256>;

ToneScales scales_of_labels(const Grid<float>& lightness, const Grid<std::uint8_t>& labels) {
  std::array<std::vector<float>, 256> sorted;
  for (std::size_t i = 0; i < lightness.size(); ++i)
    if (labels[i] != unused_label) sorted[labels[i]].push_back(lightness[i]);
  ToneScales scales;
  for (std::size_t label = 0; label < sorted.size(); ++label)
    if (!sorted[label].empty()) scales[label] = scale_of(sorted[label]);
  return scales;
}

// The interquartile range of a label in which half of all texels are at most.
double usual_range(const ToneScales& scales) {
  std::vector<std::pair<double, std::size_t>> ranges;
  std::size_t all = 0;
  for (const ToneScale& scale : scales)
    if (scale.texels > 0) {
      ranges.emplace_back(scale.range(), scale.texels);
      all += scale.texels;
    }
  std::sort(ranges.begin(), ranges.end());
  std::size_t below = 0;
  for (const auto& [range, texels] : ranges) {
    below += texels;
    if (2 * below >= all) return range;
  }
  return 0.0;
}

// Lightness of a label's own texels and tone of their neighbours, where it borders on labels that
// show light and shade.
struct BorderLight {
  std::vector<float> lightness, tone;
};

// Labels that show one light only get the scale of the others, and the light that goes on beyond
// their borders.
void place_single_lights(const Grid<float>& lightness, const Grid<std::uint8_t>& labels,
                         ToneScales& scales) {
  const double usual = usual_range(scales);
  std::array<bool, 256> single{};
  for (std::size_t label = 0; label < scales.size(); ++label)
    single[label] = scales[label].texels > 0 && scales[label].range() < one_light_share * usual;
  std::array<BorderLight, 256> border;
  const auto look = [&](std::size_t own, std::size_t other) {
    if (labels[other] == unused_label || !single[labels[own]] || single[labels[other]]) return;
    border[labels[own]].lightness.push_back(lightness[own]);
    border[labels[own]].tone.push_back(
        static_cast<float>(scales[labels[other]].tone(static_cast<double>(lightness[other]))));
  };
  const auto look_both = [&](std::size_t i, std::size_t k) {
    look(i, k);
    look(k, i);
  };
  for (int y = 0; y < labels.height(); ++y)
    for (int x = 0; x < labels.width(); ++x) {
      const std::size_t i = labels.index(x, y);
      if (x + 1 < labels.width()) look_both(i, i + 1);
      if (y + 1 < labels.height()) look_both(i, labels.index(x, y + 1));
    }
  for (std::size_t label = 0; label < scales.size(); ++label) {
    if (!single[label]) continue;
    const bool known = border[label].tone.size() >= min_border_texels;
    const double tone = known ? static_cast<double>(middle_value(border[label].tone)) : flat_tone;
    const double at = known ? static_cast<double>(middle_value(border[label].lightness))
                            : scales[label].lightness[middle];
    // The scale whose quartiles are the usual range apart, moved so that `at` has that tone.
    const double per_tone = usual / (spread[upper_quartile].tone - spread[lower_quartile].tone);
    for (std::size_t k = 0; k < spread.size(); ++k)
      scales[label].lightness[k] = at + (spread[k].tone - tone) * per_tone;
  }
}

// The sums of a regression of lightness on 1, altitude, ln distance and modelled tone.
struct ToneSums {
  Matrix normal{4, 4};
  std::array<double, 4> right{};
  double count = 0.0;
};

// Lightness less what altitude and ln distance explain within a label besides the modelled tone.
struct AirOfLabel {
  double mean_altitude = 0.0, mean_log_distance = 0.0;
  double by_altitude = 0.0, by_log_distance = 0.0;  // slopes
};

double altitude_km(const Grid<float>& altitude_m, std::size_t i) {
  return static_cast<double>(altitude_m[i]) / 1000.0;
}

double log_distance_m(const Grid<float>& depth_m, std::size_t i) {
  return exact::log(std::max(static_cast<double>(depth_m[i]), 1.0));
}

AirOfLabel air_of(ToneSums sums) {
  constexpr double ridge = 1e-3;  // of the count: slopes that nothing tells are 0
  for (std::size_t k = 1; k < 4; ++k) sums.normal(k, k) += ridge * sums.count;
  AirOfLabel out;
  out.mean_altitude = sums.normal(1, 0) / sums.count;
  out.mean_log_distance = sums.normal(2, 0) / sums.count;
  const std::optional<Cholesky> factors = Cholesky::of(sums.normal);
  if (!factors) return out;
  const std::vector<double> slopes = factors->solve(sums.right);
  out.by_altitude = slopes[1];
  out.by_log_distance = slopes[2];
  return out;
}

}  // namespace

Grid<float> estimate_tone(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& labels,
                          double stroke_px) {
  Grid<float> tone = blur_within_labels(root_of_lightness(picture), labels, stroke_px);
  ToneScales scales = scales_of_labels(tone, labels);
  place_single_lights(tone, labels, scales);
  parallel_rows(tone.height(), [&](int y) {
    for (int x = 0; x < tone.width(); ++x)
      tone(x, y) =
          labels(x, y) == unused_label
              ? 0.F
              : static_cast<float>(scales[labels(x, y)].tone(static_cast<double>(tone(x, y))));
  });
  return tone;
}

Grid<float> combine_tone(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& labels,
                         double stroke_px, const Grid<float>& modelled,
                         const Grid<float>& altitude_m, const Grid<float>& depth_m,
                         const Grid<float>& deviation_px) {
  Grid<float> lightness = blur_within_labels(root_of_lightness(picture), labels, stroke_px);
  const Grid<float> model = blur_within_labels(modelled, labels, stroke_px);
  std::array<ToneSums, 256> sums;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == unused_label) continue;
    const std::array<double, 4> terms = {1.0, altitude_km(altitude_m, i),
                                         log_distance_m(depth_m, i), static_cast<double>(model[i])};
    ToneSums& of = sums[labels[i]];
    of.count += 1.0;
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < 4; ++b) of.normal(a, b) += terms[a] * terms[b];
      of.right[a] += terms[a] * static_cast<double>(lightness[i]);
    }
  }
  std::array<AirOfLabel, 256> air;
  for (std::size_t label = 0; label < sums.size(); ++label)
    if (sums[label].count > 0.0) air[label] = air_of(sums[label]);
  std::array<double, 256> mean{}, mean_model{};
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == unused_label) continue;
    const AirOfLabel& own = air[labels[i]];
    lightness[i] -= static_cast<float>(
        own.by_altitude * (altitude_km(altitude_m, i) - own.mean_altitude) +
        own.by_log_distance * (log_distance_m(depth_m, i) - own.mean_log_distance));
    mean[labels[i]] += static_cast<double>(lightness[i]) / sums[labels[i]].count;
    mean_model[labels[i]] += static_cast<double>(model[i]) / sums[labels[i]].count;
  }
  double paint_square = 0.0, model_square = 0.0, both = 0.0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == unused_label) continue;
    const double p = static_cast<double>(lightness[i]) - mean[labels[i]];
    const double m = static_cast<double>(model[i]) - mean_model[labels[i]];
    paint_square += p * p;
    model_square += m * m;
    both += p * m;
  }
  Grid<float> tone = estimate_tone(picture, labels, stroke_px);
  if (!(paint_square > 0.0) || !(model_square > 0.0)) return tone;
  const double agreement = both / std::sqrt(paint_square * model_square);
  const double weight =
      std::clamp((agreement - no_agreement) / (full_agreement - no_agreement), 0.0, 1.0);
  const double scale = std::sqrt(model_square / paint_square);
  for (std::size_t i = 0; i < tone.size(); ++i) {
    if (labels[i] == unused_label) continue;
    const double painted =
        mean_model[labels[i]] + scale * (static_cast<double>(lightness[i]) - mean[labels[i]]);
    const double share = deviation_px.empty()
                             ? 0.5
                             : 0.5 * static_cast<double>(place_trust(
                                         static_cast<double>(deviation_px[i]), tone.width()));
    const double known = painted + share * (static_cast<double>(modelled[i]) - painted);
    tone[i] += static_cast<float>(weight * (known - static_cast<double>(tone[i])));
    tone[i] = std::clamp(tone[i], 0.F, 1.F);
  }
  return tone;
}

Grid<float> spread_tone(Grid<float> tone, const Grid<std::uint8_t>& labels) {
  std::vector<float> values;
  for (std::size_t i = 0; i < tone.size(); ++i)
    if (labels[i] != unused_label) values.push_back(tone[i]);
  if (values.empty()) return tone;
  const ToneScale scale = scale_of(values);
  for (std::size_t i = 0; i < tone.size(); ++i)
    if (labels[i] != unused_label)
      tone[i] = static_cast<float>(scale.tone(static_cast<double>(tone[i])));
  return tone;
}

namespace {

constexpr double strokes_apart = 4.0;  // shadows have finer borders than light: sigma stroke_px / 4
// Weights of lightness, of red against green and of yellow against blue in what shadow looks like:
// dark, blue, and less green than lit ground. They and the threshold were chosen for the best
// agreement (F1) with the program's own pictures, whose shadows are known.
constexpr std::array<double, 3> shade_weights = {-1.0, 0.7, -1.0};
constexpr double shade_from = 0.4;
constexpr double soft = 0.15;        // half width of the transition
constexpr double lower_share = 0.1;  // shares of a label's texels between which
constexpr double upper_share = 0.9;  // its paint is said to range
constexpr float min_range = 0.015F;  // OKLab
constexpr double min_darker = 0.04;  // OKLab lightness by which shadow is darker …
constexpr double min_bluer = 0.006;  // … and bluer than light, between their means
constexpr std::size_t min_shaded_texels = 64;

// How much the texels of a label look like shadow, 0 halfway between its dark and its light paint.
std::vector<double> shade_of(const std::array<Grid<float>, 3>& oklab,
                             const std::vector<std::size_t>& texels) {
  std::vector<double> shade(texels.size(), 0.0);
  std::vector<float> values(texels.size());
  for (std::size_t axis = 0; axis < oklab.size(); ++axis) {
    for (std::size_t k = 0; k < texels.size(); ++k) values[k] = oklab[axis][texels[k]];
    const float low = value_at_share(values, lower_share);
    const float high = value_at_share(values, upper_share);
    const float range = std::max(high - low, min_range);
    for (std::size_t k = 0; k < texels.size(); ++k)
      shade[k] += shade_weights[axis] *
                  static_cast<double>((oklab[axis][texels[k]] - 0.5F * (low + high)) / range);
  }
  return shade;
}

// Whether what looks like shadow is clearly darker and bluer than the rest of the label.
bool is_cast_shadow(const std::array<Grid<float>, 3>& oklab, const std::vector<std::size_t>& texels,
                    const std::vector<double>& shade) {
  std::array<std::array<double, 3>, 2> sums{};  // count, lightness, yellow: lit, shaded
  for (std::size_t k = 0; k < texels.size(); ++k) {
    std::array<double, 3>& sum = sums[shade[k] > shade_from ? 1 : 0];
    sum[0] += 1.0;
    sum[1] += static_cast<double>(oklab[0][texels[k]]);
    sum[2] += static_cast<double>(oklab[2][texels[k]]);
  }
  const auto& [lit, shaded] = sums;
  if (lit[0] < 1.0 || shaded[0] < static_cast<double>(min_shaded_texels)) return false;
  return lit[1] / lit[0] - shaded[1] / shaded[0] >= min_darker &&
         lit[2] / lit[0] - shaded[2] / shaded[0] >= min_bluer;
}

}  // namespace

Grid<float> find_shadow(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& labels,
                        double stroke_px) {
  std::array<Grid<float>, 3> oklab;
  oklab.fill(Grid<float>(picture.width(), picture.height()));
  parallel_rows(picture.height(), [&](int y) {
    for (int x = 0; x < picture.width(); ++x) {
      const glm::dvec3 lab = to_oklab(picture(x, y));
      for (int c = 0; c < 3; ++c)
        oklab[static_cast<std::size_t>(c)](x, y) = static_cast<float>(lab[c]);
    }
  });
  for (Grid<float>& one : oklab) one = blur_within_labels(one, labels, stroke_px / strokes_apart);
  std::array<std::vector<std::size_t>, 256> texels;
  for (std::size_t i = 0; i < labels.size(); ++i) texels[labels[i]].push_back(i);
  Grid<float> shadow(picture.width(), picture.height(), 1.F);
  for (std::size_t label = 0; label < unused_label; ++label) {
    if (texels[label].empty()) continue;
    const std::vector<double> shade = shade_of(oklab, texels[label]);
    if (!is_cast_shadow(oklab, texels[label], shade)) continue;
    for (std::size_t k = 0; k < shade.size(); ++k)
      shadow[texels[label][k]] =
          static_cast<float>(std::clamp(0.5 - 0.5 * (shade[k] - shade_from) / soft, 0.0, 1.0));
  }
  return shadow;
}

Grid<float> find_valley_height(const Grid<std::uint8_t>& labels) {
  constexpr double share_of_width = 3.0 / 800.0;
  constexpr double floor_share = 0.08;  // of level ground near by, where the height is floor_m
  constexpr double floor_m = 60.0;
  constexpr double max_m = 600.0;
  Grid<float> level(labels.width(), labels.height()), ground = level;
  bool any = false;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto id = static_cast<LandCoverClass>(labels[i]);
    const bool is_level = id == LandCoverClass::water || id == LandCoverClass::valley_floor ||
                          id == LandCoverClass::settlement;
    level[i] = is_level ? 1.F : 0.F;
    ground[i] = labels[i] == unused_label ? 0.F : 1.F;
    any = any || is_level;
  }
  if (!any) return {};
  const double sigma = share_of_width * labels.width();
  level = gaussian_blur(level, sigma);
  ground = gaussian_blur(ground, sigma);
  for (std::size_t i = 0; i < level.size(); ++i) {
    const double near =
        static_cast<double>(level[i]) / std::max(static_cast<double>(ground[i]), 1e-6);
    const double logs = exact::log(std::clamp(near, 1e-12, 1.0)) / exact::log(floor_share);
    level[i] = static_cast<float>(std::min(floor_m * logs, max_m));
  }
  return level;
}

}  // namespace belvedere
