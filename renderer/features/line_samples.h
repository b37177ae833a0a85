#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "renderer/features/feature_style.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/tracer.h"
#include "terrain/deform/deform.h"
#include "terrain/io/raster.h"

namespace belvedere {

// Position and visibility of map positions on the drawn ground and in the picture: generalized,
// exaggerated, bent, in the finest window that contains them. All calls are safe from any thread;
// the parts must outlive it.
class GroundSight {
 public:
  // goes_to: where each cell's content of the whole surface is drawn after valleys were widened
  // (moved_ground.h); empty: nothing moved.
  GroundSight(const GeoTransform& transform, const DeformedSurface& surface, const Camera& camera,
              const Tracer& tracer, const Grid<glm::vec2>& goes_to);

  // The drawn ground in the deformed world; nothing outside the terrain.
  std::optional<glm::dvec3> ground(glm::dvec2 position) const;
  std::optional<glm::dvec2> pixel(glm::dvec3 point) const { return camera_.project(point); }
  // Distance from the eye, along the line of sight of its pixel.
  double distance_m(glm::dvec3 point, glm::dvec2 pixel) const;
  // The view direction of a pixel.
  glm::dvec3 sight_at(glm::dvec2 pixel) const { return camera_.ray(pixel).direction; }
  // Metres per pixel there, across the line of sight.
  double metres_per_px(glm::dvec3 point, glm::dvec2 pixel) const;

  struct Target {
    glm::dvec3 point;
    glm::dvec2 pixel;
    double distance_m;
  };
  // Distance between each point and the ground in front of it, m; 0 if there is none.
  std::vector<double> hidden_by_m(const std::vector<Target>& targets) const;

  glm::ivec2 size() const { return camera_.size(); }
  // Side of the finest cells, m of the ground.
  double cell_m() const { return cell_m_; }
  // Ground metres per pixel at the picture's lower edge: the median of the ground pixels in the
  // lowest row that has enough of them.
  double nearest_metres_per_px() const;
  // One unit of the CRS is taken as one metre: terrain is metric.
  const GeoTransform& transform() const { return transform_; }
  glm::dvec2 cells() const { return {surface_.vertices_m.width(), surface_.vertices_m.height()}; }

 private:
  GeoTransform transform_;
  const DeformedSurface& surface_;
  const Camera& camera_;
  const Tracer& tracer_;
  const Grid<glm::vec2>& goes_to_;
  double cell_m_;
};

// A point of a line on the drawn ground.
struct LineSample {
  glm::dvec2 map{0.0};    // in the terrain's CRS
  glm::dvec3 point{0.0};  // in the deformed world
  glm::dvec2 pixel{0.0};
  double distance_m = 0.0;
  double hidden_by_m = 0.0;  // distance to the ground in front of it; 0: none
  bool on_terrain = false;
  bool projected = false;   // on the terrain and in front of the eye
  bool in_picture = false;  // or slightly outside
  bool seen = false;
};

// Samples of a line, at most half a cell of the ground or a pixel of the picture apart, whichever
// is longer, and closer where the ground bends between them by a third of a pixel. Where it
// disappears behind ground, or reappears, samples lie within half a pixel of that position.
std::vector<LineSample> sample_line(const GroundSight& sight, const std::vector<glm::dvec2>& line,
                                    double px_per_mm);

// Whether each sample is visible.
void find_seen(const GroundSight& sight, std::vector<LineSample>& samples, double px_per_mm);

// The scale of a kind's lengths at a position of the picture.
struct PointLook {
  double share = 1.0;    // relative to the foreground
  double half_px = 0.5;  // half of the fill's width
  bool too_far = false;  // the scale there is too small for the kind
};
PointLook look_at(const GroundSight& sight, glm::dvec3 point, glm::dvec2 pixel,
                  const FeatureKind& kind, double width_mm, double real_m, double px_per_mm,
                  double foreground_m_per_px);

// A point of a drawn line; pixels of the sheet.
struct DrawnPoint {
  glm::vec2 position{0.F};
  float distance_m = 0.F;
  float half_px = 0.F;  // half of the fill's width
  float share = 1.F;    // of the style's foreground lengths
  float along_mm =
      0.F;  // from the line's start, in foreground lengths: dashes shrink with the line
};

enum class LinePart : std::uint8_t {
  way,    // on the ground
  rope,   // in the air
  pylon,  // upright below a rope
  station,
  lane  // not painted: ground that a rope above it or a river needs free of trees
};

// A visible piece of a line.
struct DrawnLine {
  int kind = 0;
  LinePart part = LinePart::way;
  std::vector<DrawnPoint> points;  // 2 or more
};

// A wall of a house or a side of its roof: its lower edge from left to right, then its upper one
// from right to left, px of the sheet.
struct HouseFace {
  std::array<glm::vec2, 4> corners{};
  float light = 1.F;  // 0 facing away from the sun … 1 facing it
  bool roof = false;
};
// The shadow of a house, or of one of its wings, on the ground.
struct HouseShade {
  glm::vec2 from{0.F}, to{0.F};  // px of the sheet
  float width = 0.F;
};
struct DrawnHouse {
  int kind = 0;
  glm::vec2 foot{0.F};  // centre of the footprint, px of the sheet
  float distance_m = 0.F;
  float reach_px = 0.F;  // from the foot to its farthest paint
  std::vector<HouseShade> shades;
  std::vector<HouseFace> faces;  // in painting order
};

// Statistics of the features of one kind and source.
struct DrawnCount {
  std::size_t features = 0;
  std::size_t outside_terrain = 0;  // wholly
  std::size_t outside_picture = 0;
  std::size_t hidden = 0;  // in the picture, but entirely hidden by ground
  std::size_t too_far = 0;
  std::size_t drawn = 0;
  double length_m = 0.0;  // of lines, horizontal
  double seen_m = 0.0;    // visible part of it
};

}  // namespace belvedere
