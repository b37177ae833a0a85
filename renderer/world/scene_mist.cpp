#include "renderer/world/scene_mist.h"

#include <fmt/core.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>

#include "base/filter.h"
#include "base/random_streams.h"
#include "renderer/world/scene_position.h"

namespace belvedere {
namespace {

MistParameters to_parameters(const SceneMist& given, const Dem& dem, std::size_t number) {
  MistParameters mist = given.look;
  mist.kind = given.kind == "valley" ? MistKind::valley
              : given.kind == "lee"  ? MistKind::lee
                                     : MistKind::sea;
  mist.to_m = given.to_m.value_or(mist.to_m);
  const bool thin = mist.kind == MistKind::valley;
  mist.visibility_m = given.visibility_m.value_or(thin ? 500.0 : mist.visibility_m);
  mist.patches = given.patches.value_or(thin ? 0.35 : mist.patches);
  if (given.position || given.position_lonlat)
    mist.position = resolve_place(dem, given.position, given.position_lonlat,
                                  fmt::format("air.mist.{}", number));
  return mist;
}

}  // namespace

MistAir make_scene_mist(const Scene& scene, const View& view, const TerrainModel& terrain,
                        const Deformation& deformation, const Camera& camera) {
  MistAir air;
  if (scene.air.mist.empty()) return air;
  const Dem& dem = *terrain.dem;
  air.seed = scene.seed;
  air.rim_fade_m = view.air.rim_fade_m;
  bool floors = false;
  for (std::size_t k = 0; k < scene.air.mist.size(); ++k) {
    const MistParameters mist = to_parameters(scene.air.mist[k], dem, k);
    if (mist.kind == MistKind::lee) {
      const glm::dvec2 cell = dem.transform.to_cell(mist.position->x, mist.position->y);
      const double ground_m = sample_bilinear(terrain.generalized_m, cell.x, cell.y);
      const std::optional<LeeCloud> cloud = make_lee_cloud(
          mist, ground_m, deformation, camera, stream_seed(scene.seed, Stream::mist_layers, k));
      if (cloud) air.clouds.push_back(*cloud);
      continue;
    }
    floors = floors || mist.kind == MistKind::valley;
    air.layers.push_back(mist);
  }
  if (air.layers.empty()) return air;
  air.ground = make_mist_ground(terrain.generalized_m, terrain.rim_m, dem.transform, floors);
  const double right = dem.width() - 1.0;
  const double bottom = dem.height() - 1.0;
  for (const glm::dvec2 corner : {glm::dvec2(0.0), glm::dvec2(right, 0.0), glm::dvec2(0.0, bottom),
                                  glm::dvec2(right, bottom)}) {
    const glm::dvec2 position = dem.transform.to_crs(corner.x, corner.y);
    air.farthest_m =
        std::max(air.farthest_m, glm::length(deformation.point({position, 0.0}) - camera.eye()));
  }
  return air;
}

}  // namespace belvedere
