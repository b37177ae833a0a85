#include "renderer/style/fit_style.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <vector>

#include "base/math_exact.h"
#include "base/statistics.h"
#include "renderer/image/srgb.h"
#include "renderer/style/fit/missing_classes.h"
#include "renderer/style/fit/paint_figures.h"
#include "texture/synthesis/exemplar.h"

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

namespace {

constexpr double power_step = 0.02;
constexpr double min_power = 0.45;

}  // namespace

LightenedRamps lighten_ramps(const ClassRamps& ramps, double goal, double max_lightness,
                             const LightLaw& law) {
  LightenedRamps out{ramps, 1.0};
  // In small steps, because hue follows the law of light along a curve.
  while (ground_lightness(out.ramps) < goal && out.power > min_power) {
    const double next = out.power - power_step;
    for (std::size_t c = 1; c < out.ramps.size(); ++c) {
      std::array<double, 4> lightness{};
      for (std::size_t k = 0; k < lightness.size(); ++k)
        lightness[k] = max_lightness * exact::pow(std::max(out.ramps[c][k].x, 0.02) / max_lightness,
                                                  next / out.power);
      out.ramps[c] =
          move_lightness(out.ramps[c], lightness, law_of(static_cast<LandCoverClass>(c), law));
    }
    out.power = next;
  }
  return out;
}

namespace {

// Shares of the scene's warmth and drift that suit all paintings (A8): the fitted palette already
// contains the painting's own.
constexpr double warm_share = 0.25;
constexpr double drift_share = 0.6;
constexpr double rock_drift_share = 0.4;
constexpr double leaf_share = 0.30;

glm::vec3 encoded(const glm::dvec3& lab) { return glm::clamp(from_oklab(lab), 0.0F, 1.0F); }

ClassRamps fit_ramps_of(const StylePainting& painting, const LightLaw& law,
                        const PaintFigures& figures, const ClassRamps& reference,
                        const StyleFitParameters& parameters, std::vector<std::string>& notes) {
  const SeenRamps seen = fit_class_ramps(painting, law, reference, parameters.ramps);
  notes.insert(notes.end(), seen.notes.begin(), seen.notes.end());
  const DerivedRamps all = derive_missing_classes(seen, painting, law, reference);
  notes.insert(notes.end(), all.notes.begin(), all.notes.end());
  double lightness = 0.0;
  for (const glm::vec3& texel : painting.ground) lightness += static_cast<double>(texel.x);
  lightness /= static_cast<double>(painting.ground.size());
  const double goal = std::max(parameters.min_ground_lightness, lightness + 0.05 * figures.vapour);
  const LightenedRamps light = lighten_ramps(all.ramps, goal, painting.max_lightness, law);
  const ClassRamps strong =
      strengthen_chroma(light.ramps, reference, painting, parameters.separate);
  const ClassRamps apart = separate_classes(strong, seen.seen, reference, parameters.separate);
  // Separating the classes may have darkened the ground.
  const LightenedRamps again = lighten_ramps(apart, goal, painting.max_lightness, law);
  if (const double power = light.power * again.power; power < 0.995)
    notes.push_back(fmt::format("darker than a map may be: lightened by the power {:.2f}", power));
  if (const double lacking = lacking_distance(again.ramps, reference, parameters.separate);
      lacking > parameters.separate.lacking)
    notes.push_back(
        fmt::format("classes are hard to tell apart: {:.0f} % of the distances that "
                    "maps need are lacking",
                    100.0 * lacking));
  return again.ramps;
}

Palette make_palette(const ClassRamps& ramps, const FittedSky& sky, const StyleAir& air,
                     const std::string& name) {
  Palette palette;
  palette.name = name;
  for (std::size_t c = 1; c < ramps.size(); ++c)
    palette.classes[c].stops = {{0.0, encoded_ramp(ramps[c])}};
  // A painting without sky gets a pale one.
  const std::vector<glm::dvec3> gradient =
      sky.gradient.empty() ? std::vector<glm::dvec3>{{0.72, -0.02, -0.06}, {0.90, 0.0, 0.02}}
                           : sky.gradient;
  for (std::size_t i = 0; i < gradient.size(); ++i)
    palette.sky.emplace_back(static_cast<double>(i) / static_cast<double>(gradient.size() - 1),
                             encoded(gradient[i]));
  if (!sky.gradient.empty()) {
    palette.cloud_light = encoded(sky.cloud_light);
    palette.cloud_shade = encoded(sky.cloud_shade);
  }
  palette.haze_near = encoded(air.near);
  palette.haze_far = encoded(air.far);
  palette.range_mist = encoded(air.mist);
  for (const glm::dvec3& leaf : air.leaves) palette.growth.leaves.push_back(encoded(leaf));
  palette.growth.leaf_share = leaf_share;
  palette.growth.larch = encoded(air.larch);
  palette.growth.larch_share = leaf_share;
  palette.haze_share = air.haze;
  palette.warm_share = warm_share;
  palette.ground_drift_share = drift_share;
  palette.forest_drift_share = drift_share;
  palette.rock_drift_share = rock_drift_share;
  return palette;
}

std::string listed_classes(const std::vector<LandCoverClass>& ids) {
  std::string list;
  for (const LandCoverClass id : ids) list += (list.empty() ? "" : ", ") + class_words(id);
  return list;
}

// Notes classes that lost much of their mask: the drawn or inferred class was wrong there.
void note_cleaned(const StylePainting& painting, std::vector<std::string>& notes) {
  for (const LandCoverClass id : painting.classes) {
    const auto label = static_cast<std::uint8_t>(id);
    const auto drawn = std::count(painting.drawn.begin(), painting.drawn.end(), label);
    const auto kept = std::count(painting.clean.begin(), painting.clean.end(), label);
    const double lost = 1.0 - static_cast<double>(kept) / static_cast<double>(drawn);
    if (lost > 0.2)
      notes.push_back(
          fmt::format("{:.0f} % of what the mask calls {} looks like another class and "
                      "was left out",
                      100.0 * lost, class_words(id)));
  }
}

}  // namespace

Style fit_style(const Grid<glm::vec3>& painting, const Grid<std::uint8_t>& mask,
                const Palette& reference, const StyleFitParameters& parameters,
                Progress& progress) {
  progress.begin("preparing the painting", 0.0);
  const StylePainting prepared = prepare_painting(painting, mask, parameters.mask);
  progress.begin("fitting colours", 0.0);
  const ClassRamps reference_ramps = palette_ramps(reference);
  const LightLaw law = fit_light_law(prepared);
  const PaintFigures figures = measure_paint(prepared);
  Style style;
  style.name = parameters.name;
  style.origin = parameters.origin;
  style.licence = parameters.licence;
  style.notes.push_back("classes seen: " + listed_classes(prepared.classes));
  note_cleaned(prepared, style.notes);
  const ClassRamps ramps =
      fit_ramps_of(prepared, law, figures, reference_ramps, parameters, style.notes);
  const FittedSky sky = fit_sky(prepared.colours, prepared.drawn, parameters.sky);
  const StyleAir air =
      fit_air(prepared, sky.gradient.empty() ? std::nullopt : std::optional(sky.gradient.back()));
  style.palette = make_palette(ramps, sky, air, parameters.name);
  style.sky = sky.sky;
  progress.begin("measuring strokes", 0.0);
  style.brushwork = fit_brushwork(prepared.colours, prepared.clean, parameters.brushwork);
  // Geometric mean of one unit per pixel and the whole painting on the whole sheet (B2).
  style.units_per_px = std::clamp(1.2 * std::sqrt(2400.0 / painting.width()), 1.0, 2.6);
  style.broken = figures.broken;
  style.vapour = figures.vapour;
  style.form_deviation = figures.form_deviation;
  style.unevenness = figures.unevenness;
  style.contour_lines = figures.contour_lines;
  style.trend = glm::vec3(figures.trend);
  style.hue_by_light = law.hue_by_light;
  if (sky.gradient.empty())
    style.notes.emplace_back(
        "no sky in the painting: a plain pale one, and the air of a clear day");
  if (!air.far_seen)
    style.notes.emplace_back(
        "no far air in the mask: the air's colours are from the horizon and the coolest ground");
  return style;
}

}  // namespace belvedere
