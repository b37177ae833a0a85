#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "base/grid.h"
#include "renderer/mist/mist_parameters.h"
#include "renderer/paint/picture_noise.h"
#include "terrain/io/raster.h"

namespace belvedere {

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

}  // namespace belvedere
