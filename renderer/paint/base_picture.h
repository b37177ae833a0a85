#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "base/progress.h"
#include "renderer/paint/ground/base_surroundings.h"
#include "renderer/paint/palette.h"
#include "renderer/paint/water/water_image.h"
#include "renderer/trace/camera.h"
#include "texture/strokes/parcels.h"
#include "texture/strokes/stroke_painter.h"

namespace belvedere {

// Base picture (encoded sRGB) at the pixel's tone and at ∓ .17, with accents, tree density and
// haze; sky pixels get sky and clouds. Needs depths, positions, altitudes, classes, tone, fall
// lines, slopes, footprints, relief of all sizes, smooth normals, heights above the valley, rim,
// built and grain. `origin_px`, `picture_size`: position of the buffers in the whole picture. Local
// up to base_margin_px() of base_surroundings.h: a part with that margin equals the whole bit for
// bit. Only the `wanted` pixels of the buffers (empty: all) are made; the result has their size. If
// a wide view is given, only it needs that margin; the buffers need no more than
// base_window(wanted). `image`: the reflections in the water of the wanted pixels, of their size;
// null: looked up in their columns, unless mirroring is off.
BasePicture make_base_picture(const GuidanceBuffers& guidance, const WideView& wide,
                              const Palette& palette, const BaseParameters& parameters,
                              glm::ivec2 origin_px, glm::ivec2 picture_size, Progress& progress,
                              PixelRect wanted = {}, const WaterImage* image = nullptr);
BasePicture make_base_picture(const GuidanceBuffers& guidance, const Palette& palette,
                              const BaseParameters& parameters, glm::ivec2 origin_px,
                              glm::ivec2 picture_size, Progress& progress, PixelRect wanted = {});

// Colour factor of fields on the valley floor: crops, darker borders, pale lanes. Meadow replaces
// them towards the slopes; far fields merge into bands. `metres_per_unit`: metres of ground in a
// unit of the sheet (0: unknown, fields stay separate), `air`: share of air in front of them,
// `drift`: AirParameters::hue_drift, 0…3; 0 leaves the colour unchanged.
glm::vec3 field_colour(const Parcel& parcel, float slope_deg, float metres_per_unit, float air,
                       float drift);

// The ground between houses: `street` is the colour of the settlement's ramp, with gardens between,
// more in a village than in the centre of a town. `built` 0…1 as in GuidanceBuffers; `drift` is
// AirParameters::hue_drift; where villages are drawn house by house (village_share) the ground is
// paler, so that a place reads as one patch. `light` is the tone that indexes ramps. In winter
// gardens are covered by snow.
glm::vec3 town_ground_colour(const Palette& palette, glm::vec3 street, float built,
                             double altitude_m, double light, float drift, float metres_per_unit);

}  // namespace belvedere
