#include "renderer/style/fit_style.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "renderer/image/oklab.h"
#include "renderer/style/fit/fit_air.h"
#include "renderer/style/fit/light_law.h"
#include "renderer/style/fit/missing_classes.h"
#include "renderer/style/fit/paint_figures.h"
#include "renderer/style/fit/ramp_lightness.h"

namespace belvedere {
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
