#pragma once

#include <memory>

#include "base/guidance_buffers.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "renderer/paint/paint.h"
#include "renderer/paint/palette.h"
#include "renderer/scene/scene_file.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/tracer.h"
#include "renderer/world/ground.h"
#include "renderer/world/view.h"

namespace belvedere {

// Everything about a scene that is made before the first pixel: owned in one place because pixels of any part of the picture need all of
// it.
struct Stage {
  Scene scene;
  View view;
  Ground ground;
  Palette palette;
  std::unique_ptr<Camera> camera;
  std::unique_ptr<Tracer> tracer;
  double horizon_px = 0.0;  // row of the skyline's median
};
// Reads, generalizes and bends the terrain, sets up camera, sun and palette, builds the acceleration structure.
Stage set_stage(const LoadedScene& scene, Progress& progress);
// The same with terrain that is already there: several views of one made-up terrain.
Stage set_stage(const LoadedScene& scene, Dem dem, LandCover land_cover, Progress& progress);
// The hand the stage's strokes are painted in.
StrokeParameters to_stroke_parameters(const Stage& stage);

// The traced channels with light and base picture: complete guidance buffers, and the ground strokes are painted on.
struct LitPicture {
  GuidanceBuffers guidance;  // tone and base included
  PaintGround ground;
};
// A rectangle of the picture. Where it is only a part, the outer lit_margin_px() pixels are not final. tile_size changes no bit.
LitPicture make_lit_picture(const Stage& stage, PixelRect region, int tile_size, Progress& progress);
int lit_margin_px(const Scene& scene);

}  // namespace belvedere
