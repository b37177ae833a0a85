#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "base/progress.h"
#include "renderer/scene/scene.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/guidance.h"
#include "renderer/trace/tracer.h"
#include "terrain/deform/deform.h"
#include "terrain/io/dem.h"
#include "terrain/io/features.h"

namespace belvedere {

// Checks of the viewer's position relative to the data: a picture may be seen from outside of them,
// but must not show nothing but sky, nor come from mistaken coordinates.

// Extent of data in a CRS, which may be empty.
struct DataExtent {
  MapBox box;
  std::string crs;

  double diagonal_m() const;
  // 0 inside.
  double distance_outside_m(glm::dvec2 position) const;
};
DataExtent extent_of(const Dem& dem);

// A position as the user wrote it.
struct GivenPosition {
  std::string key;  // or option
  glm::dvec2 numbers{0.0};
  bool lonlat = false;  // else of the CRS
};
// The position in the data's CRS. Error(usage) with the position, the extent of the data and the
// reading of the numbers that would lie in or near them (swapped, or degrees for metres), if it is
// farther outside than `max_m`. Error(usage) for longitude and latitude of data without CRS.
glm::dvec2 place_near_data(const GivenPosition& given, const DataExtent& data, double max_m);

// The viewer's position, and the point looked at, if there is one, whose numbers are refused only
// where another reading of them lies in or near the data.
glm::dvec2 place_viewer(const SceneCamera& camera, const Dem& dem);
std::optional<glm::dvec2> place_target(const SceneCamera& camera, const Dem& dem);

// Refuses a picture without any ground by Error(usage); notes a viewer far outside the data.
void check_ground_in_view(const Dem& dem, const Camera& camera, const Tracer& tracer,
                          Progress& progress);

// Checks whether handles fold the ground: Error(usage) naming the handle, the position and a remedy
// if that is in the picture, unless the scene allows it; a note otherwise.
void check_folds(const SceneDeform& scene, const TerrainModel& terrain,
                 const Deformation& deformation, const Camera& camera, Progress& progress);

}  // namespace belvedere
