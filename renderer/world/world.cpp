#include "renderer/world/world.h"

#include <utility>

#include "base/cache/cache.h"
#include "base/instruction_set.h"
#include "renderer/ground/cached_products.h"
#include "renderer/ground/scene_ground_map.h"
#include "renderer/paint/sky.h"
#include "renderer/scene/scene_error.h"
#include "renderer/trace/ground_surroundings.h"
#include "renderer/world/fold_check.h"
#include "renderer/world/generalize_view.h"
#include "renderer/world/ground_plan.h"
#include "renderer/world/ground_windows.h"
#include "renderer/world/kept_world.h"
#include "renderer/world/light/scene_light.h"
#include "renderer/world/scene_dem.h"
#include "renderer/world/scene_land_cover.h"
#include "renderer/world/scene_mist.h"
#include "renderer/world/viewer_check.h"

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

// The cells of the cover do not depend on the camera; how wide rivers are drawn does.
std::shared_ptr<const LandCover> make_cover(const LoadedScene& loaded, const Dem& dem,
                                            const View& view, const SeenFrom& seen,
                                            Catchments& catchments, Progress& progress,
                                            const Cache& cache, KeptWorld* kept,
                                            const std::string& key) {
  if (kept == nullptr)
    return std::make_shared<const LandCover>(
        make_scene_land_cover(loaded, dem, progress, cache, &catchments, &seen));
  const std::shared_ptr<const LandCover> bare = keep_or_make(&kept->bare_cover, key, progress, [&](Progress& watcher) {
        return make_bare_patches(loaded, dem, watcher, cache, &catchments).cover;
      });
  const bool has_lines = loaded.scene.any_features() || !bare->inferred_rivers.empty();
  const std::string seen_as = has_lines ? camera_key(loaded, view) + deform_key(view) : "";
  const std::shared_ptr<const LandCover> before =
      kept->land_cover.key.starts_with(key) ? kept->land_cover.value : nullptr;
  return keep_or_make(&kept->land_cover, key + seen_as, progress, [&](Progress& watcher) {
    if (before != nullptr && !loaded.scene.any_features()) {
      LandCover cover = *before;
      cover.inferred_rivers = bare->inferred_rivers;
      lay_inferred_rivers(cover, loaded, dem, &seen);
      return cover;
    }
    LandCover cover = *bare;
    lay_ground_map(cover, loaded, dem, watcher, cache, &catchments, &seen);
    return cover;
  });
}

}  // namespace

World make_world(const LoadedScene& loaded, Progress& progress, const Cache& cache,
                 KnownTerrain known, KeptWorld* kept) {
  const Scene& scene = loaded.scene;
  // Missing instruction sets are reported before the work.
  in_section("sampling", [&] { return choose_instruction_set(scene.tracing.instruction_set); });
  const auto slot = [kept](auto KeptWorld::*value) {
    return kept == nullptr ? nullptr : &(kept->*value);
  };
  // Of each value, what it is made from.
  const auto key_of = [kept](auto&& make_key) {
    return kept == nullptr ? std::string() : make_key();
  };

  // The ground as measured; the levels of a DEM larger than memory stay for its windows.
  const std::string of_dem = key_of([&] { return dem_key(loaded); });
  const std::shared_ptr<SceneDem> opened =
      known.dem
          ? std::make_shared<SceneDem>()
          : keep_or_make(slot(&KeptWorld::dem), of_dem, progress, [&](Progress& watcher) {
              return open_scene_dem(loaded, watcher, cache);
            });
  const std::shared_ptr<const Dem> dem =
      known.dem ? std::move(known.dem) : std::shared_ptr<const Dem>(opened, &opened->dem);

  // Viewer and light.
  const View view =
      make_view(scene, *dem, progress, ground_altitude_of(*opened), region_of(*opened));
  std::unique_ptr<const Camera> camera = make_camera(view.camera);
  std::shared_ptr<const LightField> light_field = make_light_field(loaded, *dem, view, progress);
  const Deformation deformation(view.deform, view.viewer_xy);
  const SeenFrom seen{*camera, deformation};

  // Land cover. Class rules and the terrain's model both need the drainage: it is computed once.
  std::unique_ptr<Catchments> catchments = std::move(known.catchments);
  if (!known.land_cover && !catchments) catchments = std::make_unique<Catchments>(*dem);
  const std::string of_cover = key_of([&] { return of_dem + cover_key(loaded); });
  const std::shared_ptr<const LandCover> land_cover =
      known.land_cover
          ? std::move(known.land_cover)
          : make_cover(loaded, *dem, view, seen, *catchments, progress, cache, kept, of_cover);

  // The ground for this view. Classes change it only if it is masked by them.
  const std::string of_shape = key_of([&] {
    return of_dem + generalize_key(loaded, view) +
           (scene.generalize.mask_classes.empty() ? "" : of_cover);
  });
  const std::shared_ptr<GeneralizedTerrain> generalized = keep_or_make(
      slot(&KeptWorld::generalized), of_shape, progress, [&](Progress& watcher) {
        std::shared_ptr<const GroundMasks> masks;
        if (opened->data)
          masks = keep_or_make(slot(&KeptWorld::masks),
                               key_of([&] { return of_dem + masks_key(loaded); }), watcher,
                               [&](Progress& inner) {
                                 return preview_masks(loaded, *opened->data,
                                                      dem->halved - opened->data->halved,
                                                      land_cover->map.get(), inner);
                               });
        if (kept == nullptr) opened->data.reset();
        return generalize_for_view(loaded, *dem, land_cover.get(), view, watcher, cache,
                                   {.masks = masks.get()});
      });

  // All that a pixel may need of it, with finer windows where the DEM is larger than memory.
  const std::string of_windows = key_of([&] {
    return opened->levels ? of_cover + camera_key(loaded, view) + deform_key(view) : "";
  });
  const std::optional<Deformation> local =
      deformation.is_local() ? std::optional(deformation) : std::nullopt;
  const std::string of_terrain = of_shape + of_cover + of_windows;
  const std::shared_ptr<TerrainModel> terrain = keep_or_make(
      slot(&KeptWorld::terrain), of_terrain, progress, [&](Progress& watcher) {
        if (kept != nullptr) kept->waters = {};  // read the one before
        const std::shared_ptr<GroundSurroundings> surroundings = keep_or_make(
            slot(&KeptWorld::surroundings), of_cover, watcher, [&](Progress& inner) {
              return cached<GroundSurroundings>(
                  cache, [&] { return surroundings_key(loaded, *dem, *land_cover); }, inner,
                  [&](Progress&) { return find_surroundings(*dem, *land_cover, catchments.get()); });
            });
        const auto take = [kept](auto& value) { return kept == nullptr ? std::move(value) : value; };
        TerrainModel made =
            make_terrain_model(dem, take(generalized->altitude_m), land_cover,
                               view.deform.exaggeration, take(*surroundings));
        made.came_from = take(generalized->came_from);
        made.goes_to = take(generalized->goes_to);
        made.local = local;
        if (opened->levels) {
          const RasterFrame& frame = opened->levels->frame();
          const GroundPlan plan = plan_ground(frame, *dem, view, opened->max_cells);
          watcher.note(describe(plan, frame));
          add_ground_windows(
              made, plan,
              {loaded, view, deformation, opened->sea, *opened->levels, watcher, cache, seen});
          if (kept == nullptr) opened->levels.reset();  // no longer needed
        }
        return made;
      });
  auto waters =
      std::make_shared<const LazyWaters>([&of = *terrain] { return find_water_ground(of); });
  if (kept != nullptr) {
    if (kept->waters.value == nullptr || kept->waters.key != of_terrain)
      kept->waters = {of_terrain, waters};
    waters = kept->waters.value;
  }
  // What differs between views of one ground.
  terrain->land_cover = land_cover;
  terrain->exaggeration = view.deform.exaggeration;
  terrain->local = local;

  // Bent, with its ray-tracing structure. Folded ground is refused before the tracer is built.
  const std::string of_surface =
      key_of([&] { return of_shape + of_windows + deform_key(view); });
  const std::shared_ptr<const DeformedSurface> surface =
      keep_or_make(slot(&KeptWorld::surface), of_surface, progress, [&](Progress&) {
        if (kept != nullptr) kept->tracer = {};  // reads the one before
        return deform_ground(*terrain, glm::dvec3(view.viewer_xy, 0.0), deformation);
      });
  check_folds(scene.deform, *terrain, deformation, *camera, progress);
  const std::shared_ptr<const Tracer> tracer =
      keep_or_make(slot(&KeptWorld::tracer), of_surface + scene.tracing.instruction_set, progress,
                   [&](Progress& watcher) {
                     watcher.begin("building the ray tracer", 0.0);
                     return Tracer(*surface, scene.tracing);
                   });
  check_ground_in_view(*dem, *camera, *tracer, progress);
  const double horizon_px = skyline_row_px(*camera, *tracer, usual_horizon * scene.output.height);
  MistAir mist = make_scene_mist(scene, view, *terrain, deformation, *camera);
  return {scene,
          dem,
          view,
          std::move(camera),
          std::move(light_field),
          land_cover,
          deformation,
          {terrain, surface, tracer},
          *terrain,
          surface,
          *tracer,
          std::move(waters),
          horizon_px,
          std::move(mist)};
}

}  // namespace belvedere
