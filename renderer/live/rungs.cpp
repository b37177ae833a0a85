#include "renderer/live/rungs.h"

#include <algorithm>

#include "renderer/scene/draft.h"

namespace belvedere {
namespace {

constexpr double preview_mcells = 1.0;

}  // namespace

const std::vector<Rung>& rungs() {
  static const std::vector<std::string> without_forms = {"rock relief", "strokes"};
  static const std::vector<Rung> all = {
      {.name = "light and colour", .without = without_forms, .max_width_px = 360, .strokes = false},
      {.name = "larger", .without = without_forms, .strokes = false},
      {.name = "strokes", .without = {"fine light"}},
      {.name = "as rendered", .without = {}}};
  return all;
}

LoadedScene scene_of_rung(const LoadedScene& loaded, const Rung& rung) {
  LoadedScene out = loaded;
  Scene& scene = out.scene;
  scene.output = with_width(scene.output, std::min(scene.output.width, rung.max_width_px));
  if (rung.is_last()) return out;
  scene.terrain.preview_mcells = preview_mcells;
  scene.sampling.pixel_samples = 1;
  scene.sampling.shadow_rays = 1;
  scene.sampling.sky_directions = std::min(scene.sampling.sky_directions, 4);
  if (scene.water.mirror == "traced") scene.water.mirror = "column";
  scene.synthesis.enabled = false;
  return out;
}

}  // namespace belvedere
