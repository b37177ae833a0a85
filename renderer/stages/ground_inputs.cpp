#include "renderer/stages/ground_inputs.h"

#include "renderer/stages/sheet_style.h"
#include "renderer/world/style/scene_style.h"

namespace belvedere {

GroundInputs make_unlit_inputs(const World& world, const SheetView& view, const Palette& palette,
                               const Run& run) {
  return {.world = &world,
          .palette = &palette,
          .run = run,
          .camera = &view.camera,
          .size_px = view.camera.size(),
          .pixels_per_unit = view.pixels_per_unit,
          .horizon_px = view.horizon_px,
          .has_mist = !world.mist.empty(),
          .rock = to_rock_parameters(world, palette, view),
          .tone = to_tone_parameters(world, palette, view),
          .base = to_base_parameters(world, palette, view),
          .strokes = to_stroke_parameters(world, palette, view)};
}

GroundInputs estimate_ground_inputs(const Scene& scene, double pixels_per_unit,
                                    const Style* style) {
  GroundInputs inputs{.size_px = {scene.output.width, scene.output.height},
                      .pixels_per_unit = pixels_per_unit};
  inputs.tone.pixels_per_unit = inputs.base.pixels_per_unit = inputs.strokes.pixels_per_unit =
      pixels_per_unit;
  inputs.rock.light.pixels_per_unit = pixels_per_unit;
  inputs.rock.kind = inputs.base.rock = &find_rock_kind(scene.land_cover.rock);
  if (style != nullptr)
    inputs.style = std::make_shared<const SheetStyle>(
        SheetStyle{*style, to_style_parameters(scene, pixels_per_unit, inputs.size_px)});
  return inputs;
}

}  // namespace belvedere
