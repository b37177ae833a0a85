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

constexpr double usual_horizon = 0.18;  // of the picture's height from its top, where no terrain meets the sky

// What this machine lacks is said before the work.
const Scene& runnable(const Scene& scene) {
  in_section("sampling", [&] { return choose_instruction_set(scene.tracing.instruction_set); });
  return scene;
}

// Opens the scene's DEM; the levels of one that is larger than memory stay for its windows.
std::shared_ptr<const Dem> take_dem(const LoadedScene& loaded, SceneDem& opened, Progress& progress, const Cache& cache) {
  opened = open_scene_dem(loaded, progress, cache);
  return std::make_shared<const Dem>(opened.levels ? opened.dem : std::move(opened.dem));
}

// Null for a DEM that was there before: what it is from afar says all.
const CoarseAltitudes* region_of(const SceneDem& opened) { return opened.region.blocks.cells.empty() ? nullptr : &opened.region; }

// Class rules and the terrain's model both ask where water runs: it is found once.
std::shared_ptr<const LandCover> make_cover(const LoadedScene& loaded, const World& world, std::unique_ptr<Catchments>& catchments,
                                            Progress& progress, const Cache& cache) {
  const Dem& dem = *world.dem;
  const Deformation deformation(world.view.deform, world.view.viewer_xy);
  const SeenFrom seen{*world.camera, deformation};
  catchments = std::make_unique<Catchments>(dem);
  return std::make_shared<const LandCover>(make_scene_land_cover(loaded, dem, progress, cache, catchments.get(), &seen));
}

CacheKey surroundings_key(const LoadedScene& loaded, const Dem& dem, const LandCover& land_cover) {
  const auto& [origin_x, origin_y, cell_x, cell_y] = land_cover.classes.transform;
  CacheKeyText key;
  key.add("classes", land_cover.classes.cells).add("classes_x", origin_x).add("classes_y", origin_y);
  key.add("classes_cell_x", cell_x).add("classes_cell_y", cell_y);
  add_dem(key, dem);
  return make_cache_key(CachedProduct::ground_surroundings, key, subject_of(loaded));
}

TerrainModel make_terrain(const World& world, GeneralizedTerrain generalized, const LoadedScene& loaded, Catchments* catchments,
                          Progress& progress, const Cache& cache) {
  GroundSurroundings surroundings = cached<GroundSurroundings>(
      cache, [&] { return surroundings_key(loaded, *world.dem, *world.land_cover); }, progress,
      [&](Progress&) { return find_surroundings(*world.dem, *world.land_cover, catchments); });
  TerrainModel terrain = make_terrain_model(world.dem, std::move(generalized.altitude_m), world.land_cover, world.view.deform.exaggeration,
                                            std::move(surroundings));
  terrain.came_from = std::move(generalized.came_from);
  terrain.goes_to = std::move(generalized.goes_to);
  if (world.deformation.is_local()) terrain.local = world.deformation;
  return terrain;
}

// The same with its windows, if there are any; then nobody asks for the levels any more.
TerrainModel with_windows(TerrainModel terrain, const LoadedScene& loaded, const World& world, SceneDem& opened, Progress& progress,
                          const Cache& cache) {
  if (!opened.levels) return terrain;
  const RasterFrame& frame = opened.levels->frame();
  const GroundPlan plan = plan_ground(frame, *world.dem, world.view, opened.most_cells);
  progress.note(describe(plan, frame));
  const SeenFrom seen{*world.camera, world.deformation};
  add_ground_windows(terrain, plan, {loaded, world.view, world.deformation, opened.sea, *opened.levels, progress, cache, seen});
  opened = {};
  return terrain;
}

// Folded ground is refused before the tracer is built.
TracerParameters tracer_parameters(const World& world, Progress& progress) {
  check_folds(world.scene.deform, world.terrain, world.deformation, *world.camera, progress);
  progress.begin("building the ray tracer", 0.0);
  return world.scene.tracing;
}

}  // namespace

World::World(const LoadedScene& loaded, Progress& progress, const Cache& cache)
    : World(loaded, nullptr, nullptr, {}, nullptr, progress, cache) {}

World::World(const LoadedScene& loaded, std::shared_ptr<const Dem> known_dem, std::shared_ptr<const LandCover> known_cover,
             Progress& progress, const Cache& cache, std::unique_ptr<Catchments> catchments)
    : World(loaded, std::move(known_dem), std::move(known_cover), {}, std::move(catchments), progress, cache) {}

World::World(const LoadedScene& loaded, std::shared_ptr<const Dem> known_dem, std::shared_ptr<const LandCover> known_cover, SceneDem opened,
             std::unique_ptr<Catchments> catchments, Progress& progress, const Cache& cache)
    : scene(runnable(loaded.scene)),
      dem(known_dem ? std::move(known_dem) : take_dem(loaded, opened, progress, cache)),
      view(make_view(scene, *dem, progress, ground_altitude_of(opened), region_of(opened))),
      camera(make_camera(view.camera)),
      light_field(make_light_field(loaded, *dem, view, progress)),
      land_cover(known_cover ? std::move(known_cover) : make_cover(loaded, *this, catchments, progress, cache)),
      deformation(view.deform, view.viewer_xy),
      terrain(with_windows(make_terrain(*this, generalize_for_view(loaded, *dem, land_cover.get(), view, progress, cache), loaded,
                                        catchments.get(), progress, cache),
                           loaded, *this, opened, progress, cache)),
      surface(deform_ground(terrain, glm::dvec3(view.viewer_xy, 0.0), deformation)),
      tracer(surface, tracer_parameters(*this, progress)),
      horizon_px(skyline_row_px(*camera, tracer, usual_horizon * scene.output.height)),
      mist(make_scene_mist(scene, view, terrain, deformation, *camera)) {}

}  // namespace belvedere
