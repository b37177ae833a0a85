#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "base/guidance_buffers.h"
#include "base/parallel.h"
#include "base/random.h"
#include "base/random_streams.h"
#include "texture/strokes/base_picture.h"
#include "texture/strokes/stroke.h"

namespace belvedere {

// Everything a kind of stroke asks its surroundings, and the random numbers of one seed: draw k of a seed is a pure function of
// the painter's seed, the kind's stream and the cell the seed stands in, so canvas size and threads change nothing.
// Two draws never stand among the arguments of one call or the terms of one sum: C++ leaves open which comes first, and the picture
// would be the compiler's.
class StrokeSeed {
 public:
  StrokeSeed(std::uint64_t key, int cell_x, int cell_y) : key_(key), cell_x_(cell_x), cell_y_(cell_y) {}
  float uniform() { return static_cast<float>(random_uniform(key_, cell_x_, cell_y_, draw_++)); }
  float normal() { return static_cast<float>(random_normal(key_, cell_x_, cell_y_, draw_++)); }
  // lowest + span · uniform
  float between(float low, float high) { return low + (high - low) * uniform(); }
  std::uint32_t bits() { return static_cast<std::uint32_t>(random_bits(key_, cell_x_, cell_y_, draw_++)); }

 private:
  std::uint64_t key_;
  int cell_x_;
  int cell_y_;
  std::uint64_t draw_ = 0;
};

// The picture strokes are laid on, with what they are steered by.
struct StrokeScene {
  const GuidanceBuffers& guidance;
  const BasePicture& base;
  const StrokeParameters& parameters;

  float scale() const { return static_cast<float>(parameters.pixels_per_unit); }
  LandCoverClass class_at(std::size_t i) const { return guidance.land_cover[i]; }
  // Index of the pixel under a place; the place must be on the canvas.
  std::size_t pixel(glm::vec2 place) const { return guidance.depth_m.index(static_cast<int>(place.x), static_cast<int>(place.y)); }
  bool on_canvas(glm::vec2 place) const {
    return place.x >= 0.F && place.y >= 0.F && place.x < static_cast<float>(guidance.width()) &&
           place.y < static_cast<float>(guidance.height());
  }
  float slope_deg(std::size_t i) const { return guidance.slope_deg[i]; }
  // Height above the ground within 180 m, m.
  float relief_m(std::size_t i) const { return guidance.relief_s_m[i]; }
  // Altitude, m.
  float altitude_m(std::size_t i) const { return guidance.position_m[i].z + static_cast<float>(guidance.origin_m.z); }
  // Metres of ground that a unit of the sheet shows.
  float metres_per_unit(std::size_t i) const { return guidance.footprint_m[i] * scale(); }
  // Unit direction of the fall line, straight down where the ground is flat. Places outside take the border's.
  glm::vec2 fall_line(glm::vec2 place) const;
  // Paint for a stroke: the base colour moved by m towards the darker (m < 0) or lighter (m > 0) picture, |m| ≤ 1.5, and jittered.
  glm::vec3 colour(std::size_t i, float m, float jitter, StrokeSeed& seed) const;
};

// Cosine and sine of an angle, and a vector turned by them (clockwise in the picture, whose y runs down); the same on every machine.
glm::vec2 turn_by(float angle_rad);
inline glm::vec2 turned(glm::vec2 v, glm::vec2 turn) { return {v.x * turn.x - v.y * turn.y, v.x * turn.y + v.y * turn.x}; }

// "mix a/b": with probability dark -.5…-1.1, with probability light +.4…+1.0, else about 0.
float mixed_tone(float dark, float light, StrokeSeed& seed);

// Lays the polyline of a stroke centred at `place`, turned by `angle_rad` from the fall line (follow) or from the horizontal, bending by
// about `wobble_rad`.
void lay_line(Stroke& stroke, const StrokeScene& scene, glm::vec2 place, float length_units, float angle_rad, float wobble_rad, bool follow,
              StrokeSeed& seed);

// One seed in every cell of spacing_units, jittered; make(seed, place, pixel index, strokes) appends what grows there. Rows of cells
// run in parallel and are joined in order.
template <class Make>
std::vector<Stroke> sow(const StrokeScene& scene, float spacing_units, Stream stream, Make&& make) {
  const float spacing = spacing_units * scene.scale();
  const int across = static_cast<int>(static_cast<float>(scene.guidance.width()) / spacing) + 1;
  const int down = static_cast<int>(static_cast<float>(scene.guidance.height()) / spacing) + 1;
  std::vector<std::vector<Stroke>> rows(static_cast<std::size_t>(down));
  const std::uint64_t key = stream_seed(scene.parameters.seed, stream);
  parallel_rows(down, [&](int j) {
    for (int i = 0; i < across; ++i) {
      StrokeSeed seed(key, i, j);
      const float x = (static_cast<float>(i) + seed.uniform()) * spacing;
      const float y = (static_cast<float>(j) + seed.uniform()) * spacing;
      const glm::vec2 place{x, y};
      if (scene.on_canvas(place)) make(seed, place, scene.pixel(place), rows[static_cast<std::size_t>(j)]);
    }
  });
  std::size_t total = 0;
  for (const auto& row : rows) total += row.size();
  std::vector<Stroke> strokes;
  strokes.reserve(total);
  for (const auto& row : rows) strokes.insert(strokes.end(), row.begin(), row.end());
  return strokes;
}

}  // namespace belvedere
