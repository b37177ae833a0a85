#include "renderer/pipeline/copied_ground.h"

#include <algorithm>
#include <string>

#include "renderer/paint/composite.h"
#include "texture/strokes/stroke_painter.h"
#include "texture/synthesis/class_supply.h"

namespace belvedere {
namespace {

SynthesisParameters to_synthesis_parameters(const Scene& scene) {
  SynthesisParameters parameters = scene.synthesis.search;
  parameters.seed = scene.seed;
  // What a scene says of one guide leaves the defaults of the others.
  parameters.weights = SceneSynthesis{}.weights;
  for (const auto& given : scene.synthesis.weights) {
    const auto known =
        std::find_if(parameters.weights.begin(), parameters.weights.end(), [&](const auto& weight) { return weight.first == given.first; });
    if (known != parameters.weights.end())
      known->second = given.second;
    else
      parameters.weights.push_back(given);
  }
  for (const auto& [from, to] : with_stand_ins(scene.synthesis.fallback))
    parameters.fallback[static_cast<std::uint8_t>(from)] = static_cast<std::uint8_t>(to);
  return parameters;
}

}  // namespace

PaintDraft draft_paint(const World& world, const Palette& palette, const LitPicture& lit, Progress& progress) {
  PaintDraft draft;
  draft.painting = paint_strokes(lit.base.colour, lit.guidance, lit.base, {.sky = false, .breaks = false, .upright = false},
                                 to_stroke_parameters(world, palette), progress);
  draft.classes = find_painted_classes(draft.painting.sources, lit.guidance, lit.base.colour);
  return draft;
}

MatchField match_exemplars(const std::vector<PaintedExemplar>& exemplars, const Scene& scene, const LitPicture& lit,
                           const PaintDraft& draft, Progress& progress) {
  std::vector<Exemplar> copied_from;
  copied_from.reserve(exemplars.size());
  for (const PaintedExemplar& painted : exemplars) copied_from.push_back(painted.exemplar);
  const GuideStack guides = make_guide_stack(lit.guidance, draft.classes.land_cover);
  const SynthesisParameters parameters = to_synthesis_parameters(scene);
  const std::string scarcity = describe_scarcity(class_supply(copied_from, guides.label, parameters.fallback), [](std::uint8_t label) {
    return std::string(class_name(static_cast<LandCoverClass>(label)));
  });
  if (!scarcity.empty()) progress.note(scarcity);
  return synthesize(copied_from, guides, parameters, progress);
}

Grid<glm::vec3> copy_ground(const MatchField& matches, const std::vector<PaintedExemplar>& exemplars, const Scene& scene,
                            const LitPicture& lit, const PaintDraft& draft) {
  const Grid<glm::vec3> copied = transfer_residual(matches, exemplars, draft.classes.base, lit.base.haze, scene.synthesis.residual);
  return mix_borders(copied, draft.painting, draft.classes.land_cover, lit.guidance.land_cover, lit.base.colour);
}

}  // namespace belvedere
