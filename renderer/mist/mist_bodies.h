#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "base/grid.h"
#include "renderer/paint/picture_noise.h"
#include "renderer/trace/camera.h"
#include "terrain/deform/deform.h"
#include "terrain/io/raster.h"

namespace belvedere {

enum class MistKind : std::uint8_t {
  sea,     // everything up to an altitude: summits rise from it as islands
  valley,  // a thin layer on the floors of valleys, in banks
  lee      // a cloud attached to a summit, drawn out by the wind
};

// One mist of a picture. Altitudes and heights are those of the undeformed ground, before
// exaggeration and bending: mist follows the ground.
struct MistParameters {
  MistKind kind = MistKind::sea;
  double to_m = 1500.0;         // of a sea: altitude of its surface
  double height_m = 160.0;      // in valleys: above their floor; > 0
  double visibility_m = 450.0;  // visibility in it (remaining contrast .02): > 0
  double edge_m = 170.0;  // height below its surface over which it reaches full density, 0…1000
  double billows = 1.0;   // strength of the heaps of its surface, 0…3
  double patches = 0.0;   // gaps: 0 closed … 1 a few banks
  std::optional<glm::dvec2> position;  // scene CRS: centre of the misty area, or the summit
  double radius_m = 0.0;               // around that position; 0: unbounded
  double size_m = 3000.0;              // of a lee cloud: length, > 0
  double wind_from_deg = 270.0;        // of a lee cloud: clockwise from north
};

// Ground values for mist: grids in wide cells, before deformation.
struct MistGround {
  GeoTransform transform;
  Grid<float> floor_m;  // altitude of valley floors, continued under the slopes; empty
                        // if no mist needs it
  Grid<float> level;    // 0…1: how far a position lies on such a floor; the same
  Grid<float> rim_m;    // distance to the edge of the known terrain

  // Values at a position; beyond the border, those of the border.
  double floor_at(glm::dvec2 position) const;
  double level_at(glm::dvec2 position) const;
  double rim_at(glm::dvec2 position) const;
};
// altitude_m and rim_m of the terrain's cells.
MistGround make_mist_ground(const Grid<float>& altitude_m, const Grid<float>& rim_m,
                            const GeoTransform& transform, bool floors);

// The shape of one layer of mist: altitude of its smooth surface at a position and its density
// below. Use one per thread.
class MistBed {
 public:
  // `ground` must outlive it. rim_fade_m: distance over which it thins out towards the end of the
  // terrain.
  MistBed(const MistParameters& parameters, const MistGround& ground, double rim_fade_m,
          std::uint64_t seed);
  struct Column {
    double top_m;  // altitude
    double cover;  // 0…1, share of its full density
  };
  Column at(glm::dvec2 position);
  // Upper bound of the surface, m.
  double highest_m() const { return highest_m_; }

 private:
  const MistParameters parameters_;
  const MistGround& ground_;
  double rim_fade_m_;
  double highest_m_;
  GroundNoise broad_, narrow_;
};

// A cloud attached to a summit and drawn out by the wind: puffs in the deformed world, so that
// terrain is in front of and behind it.
struct LeePuff {
  glm::dvec3 centre;
  double radius_m;  // horizontal; its height is .7 of it
  float opacity;    // 0…1
};
struct LeeCloud {
  std::vector<LeePuff> puffs;  // far to near
  double altitude_m = 0.0;     // of its summit, undeformed
  glm::dvec2 from_px{0.0};     // bounding box in the picture
  glm::dvec2 to_px{0.0};
  double length_px = 1.0;  // length of the cloud if perpendicular to the view
  std::uint64_t seed = 1;
};
// Nothing if the summit is behind the eye. ground_m: the summit's altitude.
std::optional<LeeCloud> make_lee_cloud(const MistParameters& parameters, double ground_m,
                                       const Deformation& deformation, const Camera& camera,
                                       std::uint64_t seed);

// The ragged edges of its puffs; use one per thread.
class LeeEdges {
 public:
  explicit LeeEdges(const LeeCloud& cloud);
  // Shares of a puff's radius, at a position of the picture.
  glm::vec2 at(glm::dvec2 pixel);

 private:
  double per_px_;
  std::array<GroundNoise, 4> noises_;
};

// The cloud along one line of sight that ends after depth_m (infinite: sky).
struct LeeSight {
  float share = 0.F;  // share of the background that it hides, 0…1
  float light = 0.F;  // 0…1
  double depth_m = 0.0;
};
// towards_sun: unit.
LeeSight see_lee_cloud(const LeeCloud& cloud, LeeEdges& edges, const Ray& ray, glm::dvec2 pixel,
                       double depth_m, glm::dvec3 towards_sun);

}  // namespace belvedere
