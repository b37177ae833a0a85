#include "renderer/exemplar/exemplars.h"

#include <utility>

#include "renderer/exemplar/example_sheet.h"
#include "renderer/exemplar/texture_models.h"

namespace belvedere {

std::vector<PaintedExemplar> make_exemplars(const LoadedScene& loaded, const View& view,
                                            const Palette& palette,
                                            std::vector<ScannedPainting> scans, Progress& progress,
                                            const Cache& cache) {
  const Scene& scene = loaded.scene;
  std::vector<PaintedExemplar> exemplars;
  for (std::size_t i = 0; i < scene.exemplars.size(); ++i) {
    if (!scene.exemplars[i].model.empty()) continue;
    if (scene.exemplars[i].picture.empty())
      exemplars.push_back(
          paint_example_sheet(scene.exemplars[i], scene, view, palette, progress, cache));
    else if (i < scans.size() && !scans[i].painted.picture.empty())
      exemplars.push_back(std::move(scans[i].painted));
  }
  if (exemplars.empty())
    exemplars.push_back(paint_example_sheet({}, scene, view, palette, progress, cache));
  return exemplars;
}

ExemplarClasses look_at_classes(const LoadedScene& loaded,
                                const std::vector<ScannedPainting>& scans) {
  const Scene& scene = loaded.scene;
  ExemplarClasses found;
  const auto add = [&found](std::string name) -> ExemplarClasses::Flags& {
    found.names.push_back(std::move(name));
    return found.offered_by.emplace_back();
  };
  const auto add_sheet = [&] {
    ExemplarClasses::Flags& offered = add(std::string(example_sheet_name));
    for (const LandCoverClass id : classes_of_example_sheet())
      offered[static_cast<std::size_t>(id)] = true;
  };
  for (std::size_t i = 0; i < scene.exemplars.size(); ++i) {
    if (!scene.exemplars[i].model.empty()) continue;
    if (scene.exemplars[i].picture.empty()) {
      add_sheet();
    } else if (i < scans.size() && !scans[i].painted.picture.empty()) {
      ExemplarClasses::Flags& offered = add(scans[i].painted.exemplar.name);
      for (const std::uint8_t label : scans[i].painted.exemplar.guides.label)
        if (label < offered.size()) offered[label] = true;
    }
  }
  if (found.names.empty()) add_sheet();
  for (const SceneTextureModel& model : read_texture_models(loaded)) {
    ExemplarClasses::Flags& offered = add(model.name);
    for (const LandCoverClass id : model.serves) offered[static_cast<std::size_t>(id)] = true;
  }
  for (const ExemplarClasses::Flags& one : found.offered_by)
    for (std::size_t c = 0; c < one.size(); ++c) found.offered[c] = found.offered[c] || one[c];
  return found;
}

}  // namespace belvedere
