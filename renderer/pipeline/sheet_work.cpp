#include "renderer/pipeline/sheet_work.h"

#include <numeric>
#include <utility>

#include "renderer/stages/lit_picture.h"
#include "renderer/stages/sheet_style.h"
#include "renderer/world/scene_season.h"
#include "renderer/world/scene_style.h"

namespace belvedere {

bool is_copied(const Scene& scene, const SheetRequest& request) {
  return request.panorama && scene.copies();
}

namespace {

ScenePaint read_paint(const LoadedScene& loaded, const SheetRequest& request, Progress& progress) {
  return request.panorama ? read_scene_paint(loaded, progress)
                          : ScenePaint{{}, read_scene_palette(loaded, progress)};
}

// Paint that copies is used up.
SceneValues paint_values(const LoadedScene& loaded, const SheetRequest& request,
                         const SheetWorkParameters& parameters, Progress& progress) {
  return {loaded, is_copied(loaded.scene, request) ? nullptr : parameters.kept_paint, progress};
}

void reads_of_paint(Scene& to, const Scene& from) {
  to.palette = from.palette;
  to.style = from.style;
  to.exemplars = from.exemplars;
  to.synthesis = from.synthesis;
}

Value<ScenePaint> paint_for(const LoadedScene& loaded, const SheetRequest& request,
                            const SheetWorkParameters& parameters, Progress& progress) {
  return paint_values(loaded, request, parameters, progress)
      .make<ScenePaint>("paint", reads_of_paint,
                        {{"request", request.panorama ? "of a picture" : "of the ground"}},
                        [&](const Making& m) { return read_paint(m.scene, request, m.progress); });
}

// Paint is read before the world, so that wrong files are refused early; the dependencies of its
// colours are known after it.
Palette located_palette(const LoadedScene& loaded, const SheetRequest& request,
                        const ValueInput& read, const Palette& palette, const World& world,
                        const SheetWorkParameters& parameters) {
  const std::string of_dem = parameters.kept == nullptr ? "" : parameters.kept->key("dem");
  return *paint_values(loaded, request, parameters, silent_progress())
              .make<Palette>(
                  "located palette",
                  [](Scene& to, const Scene& from) {
                    to.palette = from.palette;
                    to.season = from.season;
                    to.synthesis.colours = from.synthesis.colours;
                    to.land_cover = from.land_cover;
                    to.climate = from.climate;
                  },
                  {read, {"dem", of_dem}},
                  [&](const Making& m) {
                    return palette_for_location(palette, m.scene, *world.dem);
                  });
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
                                 return texels +
                                        static_cast<double>(painting.painted.picture.size());
                               }));
  return choose_block_px(scene, view.pixels_per_unit, standing, min_block_px_of(request),
                         paint.style ? &*paint.style : nullptr);
}

// Results of rays of the whole sheet, of the picture before if only paint differs, and all but the
// shadows if only the sun does; else null.
std::shared_ptr<const GuidanceBuffers> kept_rays(const LoadedScene& loaded, const World& world,
                                                 const SheetView& view, PixelRect sheet,
                                                 const SheetWorkParameters& parameters,
                                                 const Run& run) {
  if (!parameters.keep_rays) return nullptr;
  ValueStore& store = *parameters.kept;
  const SceneValues values(loaded, &store, run.progress);
  bool of_this_sun = false;
  const auto rays = values.make<GuidanceBuffers>(
      "rays", [](Scene& to, const Scene& from) { to.sampling = from.sampling; },
      {{"tracer", store.key("tracer")},
       {"terrain", store.key("terrain")},
       {"land cover", store.key("land cover")},
       content_of(world.view.camera)},
      [&](const Making&) {
        of_this_sun = true;
        return trace_view(world, view, sheet, run);
      });
  rays->shadow = *values.make<const Grid<float>>(
      "shadows",
      [](Scene& to, const Scene& from) {
        to.seed = from.seed;
        to.sun = from.sun;
        to.light_regions = from.light_regions;
        to.light_clouds = from.light_clouds;
      },
      {rays},
      [&](const Making&) {
        return of_this_sun ? rays->shadow : trace_view_shadows(world, view, sheet, run);
      });
  return rays.value;
}

GroundInputs inputs_for(const ScenePaint& paint, const World& world, const SheetView& view,
                        bool rock_relief, const Run& run) {
  GroundInputs inputs = make_ground_inputs(world, view, paint.palette, run);
  inputs.rock_relief = rock_relief;
  if (!rock_relief) inputs.tone.ribs = 0.0;
  inputs.base.tones = rock_relief;
  if (paint.style)
    inputs.style = make_sheet_style(
        *paint.style, to_style_parameters(world.scene, view.pixels_per_unit, view.camera.size()),
        world, view.camera, run);
  return inputs;
}

}  // namespace

SheetWork::SheetWork(const LoadedScene& loaded, const SheetRequest& request,
                     const SheetWorkParameters& parameters, const Run& run, const Run& stage_run)
    : SheetWork(loaded, request, parameters, run, stage_run,
                paint_for(loaded, request, parameters, run.progress)) {}

SheetWork::SheetWork(const LoadedScene& loaded, const SheetRequest& request,
                     const SheetWorkParameters& parameters, const Run& run, const Run& stage_run,
                     const Value<ScenePaint>& read)
    : paint(read.key.empty() ? std::move(*read) : *read),
      world(make_world(loaded, run.progress, run.cache, {}, parameters.kept)),
      scratch{parameters.scratch_folder, kept_tile_bytes()},
      view(view_of(world)),
      block_px(block_px_for(world, paint, view, request)),
      graph(scratch, stage_run.progress) {
  paint.palette = located_palette(loaded, request, read, paint.palette, world, parameters);
  const int tile_px = parameters.tile_px > 0
                          ? parameters.tile_px
                          : choose_tile_px(block_px, region_of(world.scene, request));
  GroundInputs inputs = inputs_for(paint, world, view, parameters.rock_relief, stage_run);
  inputs.traced = kept_rays(loaded, world, view, {0, 0, inputs.size_px.x, inputs.size_px.y},
                            parameters, stage_run);
  ground = add_ground_stages(graph, std::move(inputs), tile_px);
}

}  // namespace belvedere
