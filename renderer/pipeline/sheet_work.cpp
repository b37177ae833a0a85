#include "renderer/pipeline/sheet_work.h"

#include <numeric>
#include <utility>

#include "renderer/pipeline/sheet_memory.h"
#include "renderer/stages/lit_picture.h"
#include "renderer/stages/sheet_style.h"
#include "renderer/world/season/scene_season.h"
#include "renderer/world/style/scene_style.h"

namespace belvedere {

bool is_copied(const Scene& scene, const SheetRequest& request) {
  return request.panorama && scene.copies();
}

namespace {

// Everything that paint is read from.
std::string paint_key(const LoadedScene& loaded, const SheetRequest& request) {
  Scene settings;
  settings.palette = loaded.scene.palette;
  settings.style = loaded.scene.style;
  settings.exemplars = loaded.scene.exemplars;
  settings.synthesis = loaded.scene.synthesis;
  return write_scene(settings) + (request.panorama ? "picture\n" : "ground\n") + files_key(loaded) +
         dem_key(loaded);
}

ScenePaint read_paint(const LoadedScene& loaded, const SheetRequest& request, Progress& progress) {
  return request.panorama ? read_scene_paint(loaded, progress)
                          : ScenePaint{{}, read_scene_palette(loaded, progress)};
}

// Paint that copies is used up.
KeptPaint* kept_paint(const LoadedScene& loaded, const SheetRequest& request,
                      const SheetWorkParameters& parameters) {
  return is_copied(loaded.scene, request) ? nullptr : parameters.kept_paint;
}

ScenePaint paint_for(const LoadedScene& loaded, const SheetRequest& request, KeptPaint* kept,
                     Progress& progress) {
  if (kept == nullptr) return read_paint(loaded, request, progress);
  return *keep_or_make(
      &kept->read, paint_key(loaded, request), progress,
      [&](Progress& watcher) { return read_paint(loaded, request, watcher); });
}

// Paint is read before the world, so that wrong files are refused early; the dependencies of its
// colours are known after it.
Palette located_palette(const LoadedScene& loaded, const SheetRequest& request,
                        const ScenePaint& paint, const World& world, KeptPaint* kept) {
  return *keep_or_make(
      kept == nullptr ? nullptr : &kept->located,
      kept == nullptr ? "" : paint_key(loaded, request) + cover_key(loaded), silent_progress(),
      [&](Progress&) { return palette_for_location(paint.palette, loaded, *world.dem); });
}

int block_px_for(const World& world, const ScenePaint& paint, const SheetView& view,
                 const SheetRequest& request) {
  if (request.block_px > 0) return request.block_px;
  const Scene& scene = world.scene;
  StandingBytes standing{.ground = ground_bytes(world), .besides = piece_bytes_of(scene, request)};
  if (is_copied(scene, request))
    standing.besides += copying_bytes(
        scene, std::accumulate(paint.paintings.begin(), paint.paintings.end(), 0.0,
                               [](double texels, const ScannedPainting& painting) {
                                 return texels + static_cast<double>(painting.painted.picture.size());
                               }));
  return choose_block_px(scene, view.pixels_per_unit, standing, min_block_px_of(request),
                         paint.style ? &*paint.style : nullptr);
}

// Everything that the results of rays depend on.
std::string rays_key(const LoadedScene& loaded, const World& world, const KeptWorld& kept) {
  Scene settings;
  settings.sun = loaded.scene.sun;
  settings.sampling = loaded.scene.sampling;
  settings.light_regions = loaded.scene.light_regions;
  settings.light_clouds = loaded.scene.light_clouds;
  return write_scene(settings) + camera_key(loaded, world.view) + kept.tracer.key +
         kept.land_cover.key;
}

std::shared_ptr<const GuidanceBuffers> kept_rays(const LoadedScene& loaded, const World& world,
                                                 const SheetView& view, PixelRect sheet,
                                                 const SheetWorkParameters& parameters,
                                                 const Run& run) {
  if (parameters.kept_rays == nullptr) return nullptr;
  return keep_or_make(parameters.kept_rays, rays_key(loaded, world, *parameters.kept),
                      run.progress, [&](Progress&) { return trace_view(world, view, sheet, run); });
}

GroundInputs inputs_for(const ScenePaint& paint, const World& world, const SheetView& view,
                        bool rock_relief, const Run& run) {
  GroundInputs inputs = make_ground_inputs(world, view, paint.palette, run);
  inputs.rock_relief = rock_relief;
  if (!rock_relief) inputs.tone.ribs = 0.0;
  if (paint.style)
    inputs.style = make_sheet_style(
        *paint.style, to_style_parameters(world.scene, view.pixels_per_unit, view.camera.size()),
        world, view.camera, run);
  return inputs;
}

}  // namespace

SheetWork::SheetWork(const LoadedScene& loaded, const SheetRequest& request,
                     const SheetWorkParameters& parameters, const Run& run, const Run& stage_run)
    : paint(paint_for(loaded, request, kept_paint(loaded, request, parameters), run.progress)),
      world(make_world(loaded, run.progress, run.cache, {}, parameters.kept)),
      position{parameters.scratch_folder, kept_tile_bytes()},
      view(view_of(world)),
      block_px(block_px_for(world, paint, view, request)),
      graph(position, stage_run.progress) {
  paint.palette =
      located_palette(loaded, request, paint, world, kept_paint(loaded, request, parameters));
  const int tile_px = parameters.tile_px > 0
                          ? parameters.tile_px
                          : choose_tile_px(block_px, region_of(world.scene, request));
  GroundInputs inputs = inputs_for(paint, world, view, parameters.rock_relief, stage_run);
  inputs.traced = kept_rays(loaded, world, view, {0, 0, inputs.size_px.x, inputs.size_px.y},
                            parameters, stage_run);
  ground = add_ground_stages(graph, std::move(inputs), tile_px);
}

}  // namespace belvedere
