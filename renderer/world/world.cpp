#include "renderer/world/world.h"

#include <utility>

#include "base/instruction_set.h"
#include "renderer/paint/sky.h"
#include "renderer/scene/scene_error.h"
#include "renderer/world/fold_check.h"
#include "renderer/world/generalize_view.h"
#include "renderer/world/scene_terrain.h"

namespace belvedere {
namespace {

constexpr double usual_horizon = 0.18;  // of the picture's height from its top, where no terrain meets the sky

// What this machine lacks is said before the work.
const Scene& runnable(const Scene& scene) {
  in_section("sampling", [&] { return choose_instruction_set(scene.tracing.instruction_set); });
  return scene;
}

TerrainModel make_terrain(const World& world, GeneralizedTerrain generalized) {
  TerrainModel terrain = make_terrain_model(world.dem, std::move(generalized.altitude_m), world.land_cover, world.view.deform.exaggeration);
  terrain.came_from = std::move(generalized.came_from);
  if (world.deformation.is_local()) terrain.local = world.deformation;
  return terrain;
}

// Folded ground is refused before the tracer is built.
TracerParameters tracer_parameters(const World& world, Progress& progress) {
  check_folds(world.scene.deform, world.terrain, world.deformation, *world.camera, progress);
  progress.begin("building the ray tracer", 0.0);
  return world.scene.tracing;
}

template <class T>
std::shared_ptr<const T> shared(T value) {
  return std::make_shared<const T>(std::move(value));
}

}  // namespace

World::World(const LoadedScene& loaded, Progress& progress, const Cache& cache) : World(loaded, nullptr, nullptr, progress, cache) {}

World::World(const LoadedScene& loaded, std::shared_ptr<const Dem> known_dem, std::shared_ptr<const LandCover> known_cover,
             Progress& progress, const Cache& cache)
    : scene(runnable(loaded.scene)),
      dem(known_dem ? std::move(known_dem) : shared(make_scene_dem(loaded, progress, cache))),
      view(make_view(scene, *dem, progress)),
      camera(make_camera(view.camera)),
      land_cover(known_cover ? std::move(known_cover) : shared(make_scene_land_cover(loaded, *dem, progress, cache))),
      deformation(view.deform, view.viewer_xy),
      terrain(make_terrain(*this, generalize_for_view(loaded, *dem, land_cover.get(), view, progress, cache))),
      surface(deform(terrain.generalized_m, dem->transform, glm::dvec3(view.viewer_xy, 0.0), deformation)),
      tracer(surface, tracer_parameters(*this, progress)),
      horizon_px(skyline_row_px(*camera, tracer, usual_horizon * scene.output.height)) {}

}  // namespace belvedere
