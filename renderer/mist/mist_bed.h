#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "base/grid.h"
#include "renderer/mist/mist_parameters.h"
#include "renderer/paint/picture_noise.h"
#include "terrain/io/raster.h"

namespace belvedere {

// What mist asks of the ground: grids in wide cells, before deformation.
struct MistGround {
  GeoTransform transform;
  Grid<float> floor_m;  // altitude of the floors of valleys, carried on under the slopes; empty where no mist asks for it
  Grid<float> level;    // 0…1: how much a place lies on such a floor; the same
  Grid<float> rim_m;    // distance to where the known terrain ends

  // Values at a place, those of the border beyond it.
  double floor_at(glm::dvec2 place) const;
  double level_at(glm::dvec2 place) const;
  double rim_at(glm::dvec2 place) const;
};
// altitude_m and rim_m of the terrain's cells.
MistGround make_mist_ground(const Grid<float>& altitude_m, const Grid<float>& rim_m, const GeoTransform& transform, bool floors);

// Where one layer of mist lies: how high its smooth surface is over a place and how dense it is below. One for each thread.
class MistBed {
 public:
  // `ground` must outlive it. rim_fade_m: over this distance it thins out towards the end of the terrain.
  MistBed(const MistParameters& parameters, const MistGround& ground, double rim_fade_m, std::uint64_t seed);
  struct Column {
    double top_m;  // altitude
    double cover;  // 0…1, of its full density
  };
  Column at(glm::dvec2 place);
  // No place has it higher, m.
  double highest_m() const { return highest_m_; }

 private:
  const MistParameters parameters_;
  const MistGround& ground_;
  double rim_fade_m_;
  double highest_m_;
  GroundNoise broad_, narrow_;
};

}  // namespace belvedere
