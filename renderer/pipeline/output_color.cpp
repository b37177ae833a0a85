#include "renderer/pipeline/output_color.h"

#include "base/error.h"
#include "renderer/image/icc/press_color.h"

namespace belvedere {
namespace {

std::vector<std::uint8_t> read_output_profile(const LoadedScene& loaded) {
  const SceneOutput& output = loaded.scene.output;
  if (output.profile.empty()) return output.colours == "srgb" ? std::vector<std::uint8_t>() : color_space_profile(output.colours);
  if (output.colours != "srgb")
    throw Error(ErrorKind::usage, "output.colours", "\"" + output.colours + "\" beside output.profile", "one of the two");
  return read_device_profile(find_scene_file(loaded, output.profile));
}

}  // namespace

OutputColor read_output_color(const LoadedScene& loaded) {
  const SceneOutput& output = loaded.scene.output;
  OutputColor color;
  if (!output.ocio_config.empty()) color.display.config = find_scene_file(loaded, output.ocio_config);
  color.profile = read_output_profile(loaded);
  color.device = {rendering_intent(output.intent), output.black_point};
  color.ink_limit_percent = output.ink_limit;
  const Grid<glm::vec3> pixel = to_display(Image(1, 1), color.display);
  if (is_cmyk_profile(color.profile))
    PressConversion(color.profile, color.device).convert(pixel);
  else if (!color.profile.empty())
    ProfileConversion(color.profile, color.device).convert(pixel);
  return color;
}

}  // namespace belvedere
