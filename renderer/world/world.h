#pragma once

#include <memory>
#include <vector>

#include "base/cache/cache.h"
#include "base/progress.h"
#include "renderer/image/image_io.h"
#include "renderer/mist/mist_sight.h"
#include "renderer/paint/water/water_ground.h"
#include "renderer/scene/scene.h"
#include "renderer/scene/scene_file.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/geo_map.h"
#include "renderer/trace/guidance.h"
#include "renderer/trace/terrain_model.h"
#include "renderer/trace/tracer.h"
#include "renderer/world/lazy_value.h"
#include "renderer/world/scene_dem.h"
#include "renderer/world/view.h"
#include "terrain/cover/land_cover.h"
#include "terrain/deform/bend_search.h"
#include "terrain/deform/deform.h"
#include "terrain/io/dem.h"
#include "terrain/shape/hydrology.h"

namespace belvedere {

// The ground that rays hit.
struct TracedGround {
  // Generalized for a view, and all that a pixel may need of the ground.
  std::shared_ptr<const TerrainModel> terrain;
  // Exaggerated and bent; its origin is the viewer's position at altitude 0.
  std::shared_ptr<const DeformedSurface> surface;
  std::shared_ptr<const Tracer> tracer;  // reads the surface
};

// The ground of waters, computed when paint first needs it.
using LazyWaters = LazyValue<std::shared_ptr<const WaterGround>>;

// A scene prepared for its first pixel, each value made from those above it. Kept together because
// any part of the picture needs all of it; constant after it is made (make_world).
struct World {
  const Scene scene;
  const std::shared_ptr<const Dem>
      dem;  // of a DEM larger than memory the whole in coarse cells: terrain has finer windows
  const View view;  // camera and sun on this DEM
  const std::unique_ptr<const Camera> camera;
  const std::shared_ptr<const LightField> light_field;  // null: uniform light
  const std::shared_ptr<const LandCover> land_cover;
  const Deformation deformation;
  const TracedGround ground;
  const TerrainModel& terrain;  // of `ground`, as the next two
  const std::shared_ptr<const DeformedSurface> surface;
  const Tracer& tracer;
  const std::shared_ptr<const LazyWaters> waters;  // of the terrain
  const double horizon_px;                         // row of the skyline's median
  const MistAir mist;
  const double sunny_side;  // as in BaseParameters
};

// Terrain to reuse, for several views of one synthetic terrain; null members are made.
struct KnownTerrain {
  std::shared_ptr<const Dem> dem = nullptr;
  std::shared_ptr<const LandCover> land_cover = nullptr;
  std::unique_ptr<Catchments> catchments = nullptr;  // drainage of the DEM
};

class ValueStore;  // scene_values.h

// Reads, generalizes and bends the terrain, sets up camera and sun, builds the acceleration
// structure. Throws Error for any problem of scene or data as early as possible: the machine's
// instruction set first, the camera's position before land cover is made. `store`: holds values of
// the previous world for reuse and receives those of this one; null: none are kept.
World make_world(const LoadedScene& loaded, Progress& progress, const Cache& cache = no_cache(),
                 KnownTerrain known = {}, ValueStore* store = nullptr);

// The header of every file of a picture: provenance (scene, versions, hashes of the inputs),
// camera, coordinate system, sun.
FileNotes make_world_notes(const LoadedScene& loaded, const World& world);

// The mist of a scene over its terrain; empty where it has none. Throws Error(usage) for invalid
// positions.
MistAir make_scene_mist(const Scene& scene, const View& view, const TerrainModel& terrain,
                        const Deformation& deformation, const Camera& camera);

// A scene's ground and view without colour, light and land cover: enough to locate things, and
// ready in seconds.
struct BareView {
  View view;
  std::shared_ptr<const Dem> dem;
  std::shared_ptr<const Grid<float>> generalized_m;
  std::shared_ptr<const Grid<glm::vec2>> goes_to;  // as GeneralizedTerrain has it
  Deformation deformation;
  std::shared_ptr<const DeformedSurface> surface;  // keeps its address: the tracer reads it
  std::unique_ptr<const Camera> camera;
  std::shared_ptr<const Tracer> tracer;

  GeoMap geo_map() const {
    return {dem->altitude_m, *goes_to, dem->transform, deformation, *surface, *camera, *tracer};
  }
};
// The bare view of a world whose ground has no finer windows; the world may be destroyed
// afterwards.
BareView bare_view_of(const World& world);
BareView make_bare_view(const LoadedScene& loaded, Progress& progress,
                        const Cache& cache = no_cache());
// Bends the same ground by another curve.
void bend_again(BareView& bare, const BendCurve& bend);

// The directions in which a camera looks over the land, evenly spaced, and how far down and up it
// shows in each. Throws Error(usage) for parallel projections, whose lines of sight do not meet in
// a point.
std::vector<SightLine> sight_lines(const CameraParameters& camera, int count);
// The DEM without filled cells: voids are not valley floor.
Grid<float> known_altitude(const Dem& dem);
ValleySight make_valley_sight(const BareView& bare);

}  // namespace belvedere
