#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "renderer/compose/coarse_ground.h"
#include "renderer/scene/scene.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/light_field.h"
#include "renderer/world/resolve_view.h"
#include "terrain/deform/deform.h"
#include "terrain/io/dem.h"

namespace belvedere {

// A scene's camera and sun, resolved on its terrain, and values derived from the distance of its
// horizon.
struct View {
  CameraParameters camera;        // eye in the deformed world
  glm::dvec2 viewer_xy{0.0};      // origin of distances, bend and generalization, scene CRS
  DeformParameters deform;        // with summits and handles, scene CRS
  SunPosition sun;                // azimuth from the grid's north
  glm::dvec3 sun_direction{0.0};  // unit, towards the sun
  double sun_image_x = 1.0;       // direction of the light in the picture: -1 left … +1 right
  AirParameters air;
  GeneralizeDistances generalize;
  std::optional<double> target_altitude_m;  // of the point looked at, where there is one
  std::vector<DerivedValue> derived;        // of all these; empty where the scene sets all
};

// The deformation of a scene, with the positions of summits and handles in the DEM's CRS. Throws
// Error(usage) for invalid positions.
DeformParameters resolve_deform(const SceneDeform& deform, const Dem& dem);

// Resolves longitude and latitude, heights above ground, look-at points and the time of day. Throws
// Error(usage) where the viewer would be below the ground, naming the height, or outside the
// terrain if the height is measured from the ground; a sun below the horizon is noted, and then
// only the sky gives light. `ground_m` has more precise altitudes than the DEM, if that is a coarse
// one of a larger whole; empty: the DEM's.
using GroundAltitude = std::function<double(glm::dvec2 position)>;
// `region`: the reduced data, from which open values are derived; null: a copy of the DEM.
View make_view(const Scene& scene, const Dem& dem, Progress& progress,
               const GroundAltitude& ground_m = {}, const CoarseAltitudes* region = nullptr);

// Positions of a scene, in the DEM's CRS. `key` is the scene's, for messages. Throw Error(usage)
// where a terrain has no CRS.
glm::dvec2 position_of_lonlat(const Dem& dem, glm::dvec2 lonlat, const std::string& key);
// The position in whichever of the two forms is given; `key` names the table that holds both.
// Error(usage) where it has neither.
glm::dvec2 resolve_place(const Dem& dem, const std::optional<glm::dvec2>& position,
                         const std::optional<glm::dvec2>& position_lonlat, const std::string& key);

}  // namespace belvedere
