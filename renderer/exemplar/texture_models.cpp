#include "renderer/exemplar/texture_models.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>

#include "renderer/world/ground_texture.h"
#include "texture/composite/make_composite.h"

namespace belvedere {
namespace {

using Counts = std::array<std::size_t, 256>;

Counts count_labels(const Grid<std::uint8_t>& labels) {
  Counts counts{};
  for (const std::uint8_t label : labels) ++counts[label];
  return counts;
}

ModelLight light_of(const std::string& name) {
  return name == "lit" ? ModelLight::lit : name == "shaded" ? ModelLight::shaded : ModelLight::any;
}

// The first model that serves a class in that light.
std::vector<SceneTextureModel>::const_iterator find_model(
    const std::vector<SceneTextureModel>& models, LandCoverClass id, ModelLight light) {
  return std::find_if(models.begin(), models.end(), [&](const SceneTextureModel& model) {
    const bool lights = model.light == ModelLight::any || model.light == light;
    return lights && std::find(model.serves.begin(), model.serves.end(), id) != model.serves.end();
  });
}

// Labels of a composite are class numbers: each paints its class.
void add_labels(CompositeModel composite, const std::string& path, const SceneTextureModel& plain,
                std::vector<SceneTextureModel>& models) {
  const std::vector<LandCoverClass> classes = classes_of_labels(composite, path);
  for (std::size_t k = 0; k < classes.size(); ++k) {
    const LandCoverClass id = classes[k];
    const bool served = plain.serves.empty() || std::find(plain.serves.begin(), plain.serves.end(),
                                                          id) != plain.serves.end();
    if (id == LandCoverClass::sky || !served) continue;  // the sky is the scene's
    SceneTextureModel& model = models.emplace_back(plain);
    model.name = fmt::format("{} ({})", plain.name, class_name(id));
    model.model = std::move(composite.labels[k].model);
    model.serves = {id};
  }
}

}  // namespace

std::vector<SceneTextureModel> read_texture_models(const LoadedScene& loaded) {
  std::vector<SceneTextureModel> models;
  const std::vector<SceneExemplar>& exemplars = loaded.scene.exemplars;
  for (std::size_t i = 0; i < exemplars.size(); ++i) {
    const SceneExemplar& settings = exemplars[i];
    if (settings.model.empty()) continue;
    const std::string path = find_scene_file(loaded, settings.model);
    if (path.empty()) continue;  // optional: others were rejected before the work began
    const SceneTextureModel plain{.name = settings.model,
                                  .model = {},
                                  .serves = settings.serves,
                                  .always = settings.prefer == "model",
                                  .light = light_of(settings.light),
                                  .light_px = settings.stroke_px,
                                  .block = i};
    if (settings.model.ends_with(".composite")) {
      add_labels(read_composite(path), path, plain, models);
    } else {
      models.push_back(plain);
      models.back().model = read_model(path);
    }
  }
  return models;
}

std::vector<ModelledClass> choose_modelled(const std::vector<SceneTextureModel>& models,
                                           const std::vector<Exemplar>& exemplars,
                                           const Grid<std::uint8_t>& target,
                                           const SynthesisParameters& parameters) {
  Counts texels{};
  for (const Exemplar& exemplar : exemplars) {
    const Counts own = count_labels(exemplar.guides.label);
    for (std::size_t label = 0; label < texels.size(); ++label) texels[label] += own[label];
  }
  const Counts pixels = count_labels(target);
  std::vector<ModelledClass> chosen;
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    const auto model = find_model(models, info.id, ModelLight::lit);
    const auto shaded = find_model(models, info.id, ModelLight::shaded);
    if (model == models.end() || shaded == models.end()) continue;
    const bool always = model->always || shaded->always;
    const auto label = static_cast<std::size_t>(info.id);
    std::size_t asked = pixels[label];
    for (const auto& [from, to] : parameters.fallback)
      if (to == label && from != to && texels[from] == 0) asked += pixels[from];
    const bool few = asked > texels[label] * pixels_per_texel;
    if (!always && texels[label] > 0 && !few) continue;
    std::string why;
    if (pixels[label] > 0 || always)
      why = fmt::format(
          "{} is painted from the texture model {}: {}", info.name,
          model == shaded ? model->name
                          : fmt::format("{}, in the shade {}", model->name, shaded->name),
          always ? std::string("the scene prefers it")
          : texels[label] == 0
              ? std::string("no exemplar has texels of it")
              : fmt::format("too few texels, {} for {} pixels", texels[label], asked));
    chosen.push_back({info.id, static_cast<std::size_t>(model - models.begin()),
                      static_cast<std::size_t>(shaded - models.begin()), std::move(why)});
  }
  return chosen;
}

LabelRamps model_ramps(const CliqueModel& model) {
  // Deviation of the first band from its mean: its own histogram at the coarsest level that has
  // one.
  CliqueKnots knots{};
  for (const Clique& clique : model.cliques)
    if (clique.type.single() && clique.type.head == 0) {
      knots = decode_knots(model.bands, clique);
      break;
    }
  constexpr std::array<float, 4> shares = {
      .05F, .34F, .66F, .95F};  // the darkest and lightest strokes do not count as light
  ToneRamp ramp{};
  for (std::size_t t = 0; t < ramp.size(); ++t)
    for (int c = 0; c < 3; ++c)
      ramp[t][c] = glm::clamp((model.bands.mean[static_cast<std::size_t>(c)] +
                               model.bands.axis(0, c) * value_at_share(knots, shares[t])) /
                                  255.F,
                              0.F, 1.F);
  return {.distances = {0.0},
          .ramps = {ramp},
          .texels = static_cast<std::size_t>(model.crop_width) *
                    static_cast<std::size_t>(model.crop_height)};
}

LabelRamps model_ramps(const std::vector<SceneTextureModel>& models, const SceneTextureModel& model,
                       LandCoverClass id) {
  LabelRamps ramps = model_ramps(model.model);
  if (model.light == ModelLight::any) return ramps;
  const bool lit = model.light == ModelLight::lit;
  const auto other = find_model(models, id, lit ? ModelLight::shaded : ModelLight::lit);
  if (other == models.end()) return ramps;
  const ToneRamp rest = model_ramps(other->model).ramps[0];
  ToneRamp& own = ramps.ramps[0];
  const auto half = static_cast<std::ptrdiff_t>(own.size() / 2);
  if (lit)
    std::copy(rest.begin(), rest.begin() + half, own.begin());
  else
    std::copy(rest.begin() + half, rest.end(), own.begin() + half);
  return ramps;
}

}  // namespace belvedere
