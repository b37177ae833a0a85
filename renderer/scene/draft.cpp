#include "renderer/scene/draft.h"

#include <algorithm>

namespace belvedere {
namespace {

int third(int px) {
  constexpr int min_px = 64;
  return std::min(px,
                  std::max(min_px, (px + 1) / 3));  // rounded, because thirds never lie on halves
}

}  // namespace

Scene make_draft(Scene scene) {
  // The width of the sheet is unchanged, so strokes keep their size on it.
  scene.output.width = third(scene.output.width);
  scene.output.height = third(scene.output.height);
  scene.sampling.pixel_samples = 1;
  scene.sampling.sky_directions = (scene.sampling.sky_directions + 3) / 4;  // 0 stays none
  scene.synthesis.enabled = false;
  if (scene.water.mirror == "traced") scene.water.mirror = "column";
  return scene;
}

}  // namespace belvedere
