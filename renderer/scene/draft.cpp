#include "renderer/scene/draft.h"

#include <algorithm>
#include <cmath>

namespace belvedere {
namespace {

int third(int px) {
  constexpr int min_px = 64;
  return std::min(px,
                  std::max(min_px, (px + 1) / 3));  // rounded, because thirds never lie on halves
}

}  // namespace

SceneOutput with_width(SceneOutput output, int width_px) {
  constexpr int min_px = 16;
  if (width_px == output.width) return output;
  output.height = std::max(min_px, static_cast<int>(std::lround(static_cast<double>(output.height) *
                                                                width_px / output.width)));
  output.width = width_px;
  return output;
}

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
