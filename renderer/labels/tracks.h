#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "renderer/labels/drawing.h"
#include "renderer/labels/label_points.h"
#include "terrain/io/points.h"

namespace belvedere {

// A visible or hidden piece of a track in the picture; pixels as of LabelMark.
struct TrackRun {
  bool seen = false;
  std::vector<glm::dvec2> pixels;  // 2 or more
};

// A track through the picture.
struct Track {
  std::string name;
  std::string where;
  double length_m = 0.0;  // horizontal length
  double climb_m = 0.0;   // all ascents of climb_step_m and more
  double seen_m = 0.0;    // of the length
  std::vector<TrackRun> runs;
  std::vector<glm::dvec2>
      profile;  // distance from the start and altitude in the DEM, m; one per sample
};

inline constexpr double climb_step_m = 10.0;  // more than the noise of a DEM

// Lays tracks on the drawn ground, sampled twice per cell. A run ends where a track leaves the
// picture or the terrain. Gaps of less than 3 px do not split a visible run: a track along a ridge
// would be all dashes. In parallel; the same for any number of threads.
std::vector<Track> find_tracks(const LocatedGround& ground, const std::vector<MapLine>& lines);

// Elevation profile of a track: 180 × 50 mm, with round numbers on both axes. A track with fewer
// than two positions on the terrain has an empty one.
Drawing profile_drawing(const Track& track, const std::string& colour, double px_per_mm);

}  // namespace belvedere
