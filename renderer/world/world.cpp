#include "renderer/world/world.h"

#include <utility>

#include "base/cache/cache.h"
#include "base/instruction_set.h"
#include "renderer/ground/cached_products.h"
#include "renderer/paint/sky.h"
#include "renderer/scene/scene_error.h"
#include "renderer/trace/ground_surroundings.h"
#include "renderer/world/fold_check.h"
#include "renderer/world/generalize_view.h"
#include "renderer/world/ground_plan.h"
#include "renderer/world/ground_windows.h"
#include "renderer/world/light/scene_light.h"
#include "renderer/world/scene_dem.h"
#include "renderer/world/scene_land_cover.h"
#include "renderer/world/scene_mist.h"

namespace belvedere {

void each_field(auto& bytes, FieldsOf<FloorPlan> auto& plan) {
  auto& [built, grain] = plan;
  bytes(built, grain);
}

void each_field(auto& bytes, FieldsOf<GroundSurroundings> auto& surroundings) {
  auto& [valley_height_m, rim_m, flow, floor_plan] = surroundings;
  bytes(valley_height_m, rim_m, flow, floor_plan);
}

namespace {

constexpr double usual_horizon =
    0.18;  // of the picture's height from its top, where no terrain meets the sky

// Null for a DEM that was given: its own reduced copy is sufficient.
const CoarseAltitudes* region_of(const SceneDem& opened) {
  return opened.region.blocks.cells.empty() ? nullptr : &opened.region;
}

CacheKey surroundings_key(const LoadedScene& loaded, const Dem& dem, const LandCover& land_cover) {
  const auto& [origin_x, origin_y, cell_x, cell_y] = land_cover.classes.transform;
  CacheKeyText key;
  key.add("classes", land_cover.classes.cells)
      .add("classes_x", origin_x)
      .add("classes_y", origin_y);
  key.add("classes_cell_x", cell_x).add("classes_cell_y", cell_y);
  add_dem(key, dem);
  return make_cache_key(CachedProduct::ground_surroundings, key, subject_of(loaded));
}

}  // namespace

World make_world(const LoadedScene& loaded, Progress& progress, const Cache& cache,
                 KnownTerrain known) {
  const Scene& scene = loaded.scene;
  // Missing instruction sets are reported before the work.
  in_section("sampling", [&] { return choose_instruction_set(scene.tracing.instruction_set); });

  // The ground as measured; the levels of a DEM larger than memory stay for its windows.
  SceneDem opened = known.dem ? SceneDem() : open_scene_dem(loaded, progress, cache);
  std::shared_ptr<const Dem> dem =
      known.dem ? std::move(known.dem)
                : std::make_shared<const Dem>(opened.levels ? opened.dem : std::move(opened.dem));

  // Viewer and light.
  const View view = make_view(scene, *dem, progress, ground_altitude_of(opened), region_of(opened));
  std::unique_ptr<const Camera> camera = make_camera(view.camera);
  std::shared_ptr<const LightField> light_field = make_light_field(loaded, *dem, view, progress);
  const Deformation deformation(view.deform, view.viewer_xy);
  const SeenFrom seen{*camera, deformation};

  // Land cover. Class rules and the terrain's model both need the drainage: it is computed once.
  std::unique_ptr<Catchments> catchments = std::move(known.catchments);
  if (!known.land_cover && !catchments) catchments = std::make_unique<Catchments>(*dem);
  std::shared_ptr<const LandCover> land_cover = std::move(known.land_cover);
  if (!land_cover)
    land_cover = std::make_shared<const LandCover>(
        make_scene_land_cover(loaded, *dem, progress, cache, catchments.get(), &seen));

  // The ground for this view: generalized, with finer windows where the DEM is larger than memory.
  GeneralizedTerrain generalized =
      generalize_for_view(loaded, *dem, land_cover.get(), view, progress, cache);
  GroundSurroundings surroundings = cached<GroundSurroundings>(
      cache, [&] { return surroundings_key(loaded, *dem, *land_cover); }, progress,
      [&](Progress&) { return find_surroundings(*dem, *land_cover, catchments.get()); });
  TerrainModel terrain = make_terrain_model(dem, std::move(generalized.altitude_m), land_cover,
                                            view.deform.exaggeration, std::move(surroundings));
  terrain.came_from = std::move(generalized.came_from);
  terrain.goes_to = std::move(generalized.goes_to);
  if (deformation.is_local()) terrain.local = deformation;
  if (opened.levels) {
    const RasterFrame& frame = opened.levels->frame();
    const GroundPlan plan = plan_ground(frame, *dem, view, opened.max_cells);
    progress.note(describe(plan, frame));
    add_ground_windows(
        terrain, plan,
        {loaded, view, deformation, opened.sea, *opened.levels, progress, cache, seen});
    opened = {};  // the levels are no longer needed
  }

  // Bent, with its ray-tracing structure. Folded ground is refused before the tracer is built.
  auto surface = std::make_unique<const DeformedSurface>(
      deform_ground(terrain, glm::dvec3(view.viewer_xy, 0.0), deformation));
  check_folds(scene.deform, terrain, deformation, *camera, progress);
  progress.begin("building the ray tracer", 0.0);
  Tracer tracer(*surface, scene.tracing);
  const double horizon_px = skyline_row_px(*camera, tracer, usual_horizon * scene.output.height);
  MistAir mist = make_scene_mist(scene, view, terrain, deformation, *camera);
  return {scene,
          std::move(dem),
          view,
          std::move(camera),
          std::move(light_field),
          std::move(land_cover),
          deformation,
          std::move(terrain),
          std::move(surface),
          std::move(tracer),
          horizon_px,
          std::move(mist)};
}

}  // namespace belvedere
