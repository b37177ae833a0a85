#include "renderer/live/rungs.h"

#include <algorithm>
#include <cmath>

namespace belvedere {

const std::vector<Rung>& rungs() {
  static const std::vector<Rung> all = {{.name = "light and colour",
                                         .without = {"fine ground", "rock relief", "strokes"},
                                         .max_width_px = 360,
                                         .max_mcells = 1.0,
                                         .rock_relief = false,
                                         .strokes = false,
                                         .quick_rays = true},
                                        {.name = "larger",
                                         .without = {"fine ground", "rock relief", "strokes"},
                                         .max_mcells = 1.0,
                                         .rock_relief = false,
                                         .strokes = false,
                                         .quick_rays = true},
                                        {.name = "strokes",
                                         .without = {"fine ground", "fine light"},
                                         .max_mcells = 1.0,
                                         .quick_rays = true},
                                        {.name = "as rendered", .without = {}, .copied = true}};
  return all;
}

LoadedScene scene_of_rung(const LoadedScene& loaded, const Rung& rung, const GroundSize& ground) {
  LoadedScene out =
      rung.max_mcells > 0.0 ? with_coarse_ground(loaded, ground, rung.max_mcells) : loaded;
  Scene& scene = out.scene;
  const int width = std::min(scene.output.width, rung.max_width_px);
  if (width < scene.output.width) {
    // The width of the sheet is unchanged, so strokes keep their size on it.
    scene.output.height =
        std::max(16, static_cast<int>(std::lround(static_cast<double>(scene.output.height) * width /
                                                  scene.output.width)));
    scene.output.width = width;
  }
  if (rung.quick_rays) {
    scene.sampling.pixel_samples = 1;
    scene.sampling.shadow_rays = 1;
    scene.sampling.sky_directions = std::min(scene.sampling.sky_directions, 4);
    if (scene.water.mirror == "traced") scene.water.mirror = "column";
  }
  if (!rung.copied) scene.synthesis.enabled = false;
  return out;
}

}  // namespace belvedere
