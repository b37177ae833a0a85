#include "renderer/pipeline/scene_paint.h"

#include "base/error.h"
#include "renderer/image/icc/press_colour.h"
#include "renderer/world/scene_style.h"

namespace belvedere {
namespace {

bool takes_colours(const Scene& scene) { return scene.synthesis.colours == "painting"; }
// Colours may be taken from a painting even if its strokes are not used.
bool reads_paintings(const Scene& scene) { return scene.copies() || takes_colours(scene); }

}  // namespace

ScenePaint read_scene_paint(const LoadedScene& loaded, Progress& progress) {
  ScenePaint paint;
  paint.style = named_style(loaded);
  paint.palette = named_palette(loaded);
  if (reads_paintings(loaded.scene)) paint.paintings = read_scans(loaded, progress);
  if (takes_colours(loaded.scene))
    paint.palette = take_colours(paint.palette, paint.paintings,
                                 with_stand_ins(loaded.scene.synthesis.fallback));
  return paint;
}

Palette read_scene_palette(const LoadedScene& loaded, Progress& progress) {
  return takes_colours(loaded.scene) ? read_scene_paint(loaded, progress).palette
                                     : named_palette(loaded);
}

void require_inputs(const LoadedScene& loaded) {
  require_scene_files(loaded);
  if (reads_paintings(loaded.scene)) check_paintings(loaded);
}

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
