#include "renderer/pipeline/sheet_work.h"

#include <utility>

#include "renderer/pipeline/sheet_memory.h"
#include "renderer/stages/lit_picture.h"
#include "renderer/stages/sheet_style.h"
#include "renderer/world/scene_season.h"
#include "renderer/world/style/scene_style.h"

namespace belvedere {

bool is_copied(const Scene& scene, const SheetRequest& request) {
  return request.panorama && scene.synthesis.enabled;
}

namespace {

ScenePaint paint_for(const LoadedScene& loaded, const SheetRequest& request, Progress& progress) {
  return request.panorama ? read_scene_paint(loaded, progress)
                          : ScenePaint{{}, read_scene_palette(loaded, progress)};
}

int block_px_for(const World& world, const ScenePaint& paint, const SheetView& view,
                 const SheetRequest& request) {
  if (request.block_px > 0) return request.block_px;
  const Scene& scene = world.scene;
  StandingBytes standing{.ground = ground_bytes(world), .besides = piece_bytes_of(scene, request)};
  if (is_copied(scene, request)) standing.besides += copying_bytes(scene, paint.paintings);
  return choose_block_px(scene, view.pixels_per_unit, standing, min_block_px_of(request),
                         paint.style ? &*paint.style : nullptr);
}

// Paint is read before the world, so that wrong files are refused early; the dependencies of its
// colours are known after it.
const Palette& adapt_palette_to_location(Palette& palette, const LoadedScene& loaded,
                                         const World& world) {
  palette = palette_for_location(palette, loaded, *world.dem);
  return palette;
}

GroundInputs inputs_for(const LoadedScene& loaded, ScenePaint& paint, const World& world,
                        const SheetView& view, bool rock_relief, const Run& run) {
  GroundInputs inputs = make_ground_inputs(
      world, view, adapt_palette_to_location(paint.palette, loaded, world), run);
  inputs.rock_relief = rock_relief;
  if (paint.style)
    inputs.style = make_sheet_style(
        *paint.style, to_style_parameters(world.scene, view.pixels_per_unit, view.camera.size()),
        world, view.camera, run);
  return inputs;
}

}  // namespace

SheetWork::SheetWork(const LoadedScene& loaded, const SheetRequest& request,
                     const SheetWorkParameters& parameters, const Run& run, const Run& stage_run)
    : paint(paint_for(loaded, request, run.progress)),
      world(make_world(loaded, run.progress, run.cache, {}, parameters.kept)),
      position{parameters.scratch_folder, kept_tile_bytes()},
      view(view_of(world)),
      block_px(block_px_for(world, paint, view, request)),
      graph(position, stage_run.progress),
      ground(add_ground_stages(
          graph, inputs_for(loaded, paint, world, view, parameters.rock_relief, stage_run),
          choose_tile_px(block_px, region_of(world.scene, request)))) {}

}  // namespace belvedere
