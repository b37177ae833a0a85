#include "renderer/pipeline/output_colour.h"

#include "base/error.h"
#include "renderer/image/icc/press_colour.h"

namespace belvedere {
namespace {

std::vector<std::uint8_t> read_output_profile(const LoadedScene& loaded) {
  const SceneOutput& output = loaded.scene.output;
  if (output.profile.empty())
    return output.colours == "srgb" ? std::vector<std::uint8_t>()
                                    : colour_space_profile(output.colours);
  if (output.colours != "srgb")
    throw Error(ErrorKind::usage, "output.colours",
                "\"" + output.colours + "\" with output.profile", "one of the two");
  return read_device_profile(find_scene_file(loaded, output.profile));
}

}  // namespace

OutputColour read_output_colour(const LoadedScene& loaded) {
  const SceneOutput& output = loaded.scene.output;
  OutputColour colour;
  if (!output.ocio_config.empty())
    colour.display.config = find_scene_file(loaded, output.ocio_config);
  colour.profile = read_output_profile(loaded);
  colour.device = {rendering_intent(output.intent), output.black_point};
  colour.ink_limit_percent = output.ink_limit;
  const Grid<glm::vec3> pixel = to_display(Image(1, 1), colour.display);
  if (is_cmyk_profile(colour.profile))
    PressConversion(colour.profile, colour.device).convert(pixel);
  else if (!colour.profile.empty())
    ProfileConversion(colour.profile, colour.device).convert(pixel);
  return colour;
}

}  // namespace belvedere
