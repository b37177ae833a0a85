#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "renderer/labels/drawing.h"
#include "renderer/labels/label_marks.h"
#include "terrain/io/lines.h"

namespace belvedere {

// A piece of a way that the picture shows, or that ground hides; pixels as of LabelMark.
struct TrackRun {
  bool seen = false;
  std::vector<glm::dvec2> pixels;  // 2 or more
};

// A way through the picture.
struct Track {
  std::string name;
  std::string where;
  double length_m = 0.0;  // on the level
  double climb_m = 0.0;   // all ascents of climb_step_m and more
  double seen_m = 0.0;    // of the length
  std::vector<TrackRun> runs;
  std::vector<glm::dvec2> profile;  // distance from the start and altitude in the DEM, m; one a sample
};

inline constexpr double climb_step_m = 10.0;  // what noise of a DEM does not reach

// Lays ways over the drawn ground, sampled twice a cell. Where one leaves the picture, or the terrain, a run ends. Gaps of fewer than 3 px
// do not part what is seen: a way along a ridge would be all dashes. In parallel; the same for any number of threads.
std::vector<Track> find_tracks(const DrawnGround& ground, const std::vector<MapLine>& lines);

// A way's altitude over its length: 180 × 50 mm, with round numbers on both axes. A way with fewer than two places on the terrain has an
// empty one.
Drawing profile_drawing(const Track& track, const std::string& colour, double px_per_mm);

}  // namespace belvedere
