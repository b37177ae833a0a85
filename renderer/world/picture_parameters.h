#pragma once

#include <optional>

#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "base/run.h"
#include "renderer/paint/base_picture.h"
#include "renderer/paint/light.h"
#include "renderer/paint/palette.h"
#include "renderer/paint/water/water_image.h"
#include "renderer/rock/rock_relief.h"
#include "renderer/world/world.h"

namespace belvedere {

// Sampling of the world by the pixels of a picture: all of them, or fewer that are as many times as
// large.
struct SheetView {
  const Camera& camera;
  double pixels_per_unit;  // pixels of this view in 0.5 mm of the sheet
  double horizon_px;       // row of the skyline's median, as World::horizon_px
};
SheetView view_of(const World& world);
// The view through a camera of make_reduced_camera(*world.camera, factor).
SheetView reduced_view(const World& world, const Camera& reduced, int factor);

// Traces all channels of a rectangle of the view.
GuidanceBuffers trace_view(const World& world, const SheetView& view, PixelRect region,
                           const Run& run);
// Traces cast shadows alone: the same as in those channels.
Grid<float> trace_view_shadows(const World& world, const SheetView& view, PixelRect region,
                               const Run& run);
// Traces only the channels that depend on form and not on light, one ray per pixel.
GuidanceBuffers trace_forms(const World& world, const Camera& camera, PixelRect region,
                            const Run& run);

// Parameters of rock relief, light and base picture.
RockParameters to_rock_parameters(const World& world, const Palette& palette,
                                  const SheetView& view);
ToneParameters to_tone_parameters(const World& world, const Palette& palette,
                                  const SheetView& view);
// Does not set BaseParameters::mean_light, which is measured on a picture (stages/lit_picture.h).
BaseParameters to_base_parameters(const World& world, const Palette& palette,
                                  const SheetView& view);

// Traced reflections of the water pixels `wanted`; nothing where none of them is water or the scene
// does not ask for it. The buffers begin at `origin_px` and extend water_image_margin_px farther up
// and down, or to the sheet's edge; needs depth_m, land_cover, footprint_m and altitude_m.
std::optional<WaterImage> trace_reflections(const World& world, const SheetView& view,
                                            const Palette& palette, const GuidanceBuffers& guidance,
                                            glm::ivec2 origin_px, PixelRect wanted);

// Brushwork parameters of the strokes of a world.
StrokeParameters to_stroke_parameters(const World& world, const Palette& palette);
StrokeParameters to_stroke_parameters(const World& world, const Palette& palette,
                                      const SheetView& view);

}  // namespace belvedere
