#pragma once

#include <memory>
#include <vector>

#include "base/cache/cache.h"
#include "base/progress.h"
#include "renderer/scene/scene_file.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/geo_map.h"
#include "renderer/world/view.h"
#include "terrain/deform/bend_search.h"
#include "terrain/deform/fold.h"

namespace belvedere {

struct World;

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
// Of a world whose ground has no finer windows; it may be gone afterwards.
BareView bare_view_of(const World& world);
BareView make_bare_view(const LoadedScene& loaded, Progress& progress,
                        const Cache& cache = no_cache());
// The same ground under another bend.
void bend_again(BareView& bare, const BendCurve& bend);

// The directions in which a camera looks over the land, evenly spaced, and how far down and up it
// shows in each. Throws Error(usage) for parallel projections, whose lines of sight do not meet in
// a point.
std::vector<SightLine> sight_lines(const CameraParameters& camera, int count);
// The DEM without filled cells: voids are not valley floor.
Grid<float> known_altitude(const Dem& dem);
ValleySight make_valley_sight(const BareView& bare);

}  // namespace belvedere
