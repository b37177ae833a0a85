#include "renderer/pipeline/output_color.h"

namespace belvedere {

OutputColor read_output_color(const LoadedScene& loaded) {
  const SceneOutput& output = loaded.scene.output;
  OutputColor color;
  if (!output.ocio_config.empty()) color.display.config = find_scene_file(loaded, output.ocio_config);
  if (!output.profile.empty()) color.profile = read_icc_profile(find_scene_file(loaded, output.profile));
  Grid<glm::vec3> pixel = to_display(Image(1, 1), color.display);
  if (!color.profile.empty()) pixel = to_profile(pixel, color.profile);
  return color;
}

}  // namespace belvedere
