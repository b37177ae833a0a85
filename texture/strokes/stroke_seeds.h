#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "base/guidance_buffers.h"
#include "base/parallel.h"
#include "base/random.h"
#include "texture/strokes/base_picture.h"
#include "texture/strokes/brush.h"

namespace belvedere {

// The random numbers of one seed: draw k is a pure function of the painter's seed, the kind's
// stream and the cell of the sheet that contains the seed, so canvas size, window and threads do
// not change it. Never use two draws as arguments of one call or terms of one sum: C++ leaves their
// order open, and the picture would depend on the compiler.
class StrokeSeed {
 public:
  StrokeSeed(std::uint64_t key, int cell_x, int cell_y)
      : key_(key), cell_x_(cell_x), cell_y_(cell_y) {}
  float uniform() { return static_cast<float>(random_uniform(key_, cell_x_, cell_y_, draw_++)); }
  float normal() { return static_cast<float>(random_normal(key_, cell_x_, cell_y_, draw_++)); }
  // lowest + span · uniform
  float between(float low, float high) { return low + (high - low) * uniform(); }
  glm::ivec2 cell() const { return {cell_x_, cell_y_}; }
  std::uint32_t bits() {
    return static_cast<std::uint32_t>(random_bits(key_, cell_x_, cell_y_, draw_++));
  }

 private:
  std::uint64_t key_;
  int cell_x_;
  int cell_y_;
  std::uint64_t draw_ = 0;
};

// Cells of a lattice of the sheet: first … last along each axis.
struct CellRange {
  int first = 0;
  int last = -1;
};
struct SeededCells {
  CellRange columns, lines;
};

// The picture under the strokes, with everything that steers them. A position is in px of the
// sheet; an index refers to the buffers, which contain a window of the sheet.
struct StrokeScene {
  const GuidanceBuffers& guidance;
  const BasePicture& base;
  const StrokeParameters& parameters;
  SheetWindow window{};
  int seed_reach_px =
      -1;  // no seed farther from the requested pixels is needed; -1: all of the buffers

  // Width and height of the sheet, px.
  glm::ivec2 sheet_px() const {
    return window.sheet_px.x > 0 && window.sheet_px.y > 0
               ? window.sheet_px
               : glm::ivec2(guidance.width(), guidance.height());
  }
  // Where seeds are needed, px of the sheet.
  PixelRect seeded() const;
  // Cells of spacing_px that touch it, and one more on each side; none beyond the sheet but,
  // where it is asked for, the last one that its edge cuts.
  SeededCells seeded_cells(float spacing_px, bool with_cut = true) const;
  // Row-major index on the sheet of a pixel of the buffers.
  std::uint64_t sheet_index(std::size_t i) const;

  // Direction of the light at a pixel: -1 left … 1 right.
  float sun_side(std::size_t i) const {
    if (!parameters.local_side) return static_cast<float>(parameters.sun_side);
    return parameters.local_side(glm::dvec2(guidance.position_m[i]) +
                                 glm::dvec2(guidance.origin_m));
  }
  float scale() const { return static_cast<float>(parameters.pixels_per_unit); }
  LandCoverClass class_at(std::size_t i) const { return guidance.land_cover[i]; }
  // Index of the pixel under a position, which must be on the canvas. Positions are rounded to
  // whole pixels before the origin is subtracted, so that rounding does not depend on the window.
  std::size_t pixel(glm::vec2 position) const {
    return guidance.depth_m.index(static_cast<int>(position.x) - window.origin_px.x,
                                  static_cast<int>(position.y) - window.origin_px.y);
  }
  // Whether the buffers contain a position. They end where the sheet ends, or farther from the
  // requested pixels than a stroke reads.
  bool on_canvas(glm::vec2 position) const {
    return position.x >= static_cast<float>(window.origin_px.x) &&
           position.y >= static_cast<float>(window.origin_px.y) &&
           position.x < static_cast<float>(window.origin_px.x + guidance.width()) &&
           position.y < static_cast<float>(window.origin_px.y + guidance.height());
  }
  float slope_deg(std::size_t i) const { return guidance.slope_deg[i]; }
  // Height above the mean of the ground within 180 m, m.
  float relief_m(std::size_t i) const { return guidance.relief_s_m[i]; }
  // Altitude, m.
  float altitude_m(std::size_t i) const {
    return guidance.position_m[i].z + static_cast<float>(guidance.origin_m.z);
  }
  // Metres of ground in a unit of the sheet.
  float metres_per_unit(std::size_t i) const { return guidance.footprint_m[i] * scale(); }
  // Unit direction of the fall line, straight down where the ground is flat. Positions outside get
  // the border's value.
  glm::vec2 fall_line(glm::vec2 position) const;
  // Paint for a stroke: the base colour shifted by m towards the darker (m < 0) or lighter (m > 0)
  // picture, |m| ≤ 1.5, and jittered.
  glm::vec3 colour(std::size_t i, float m, float jitter, StrokeSeed& seed) const;
};

// Cosine and sine of an angle, and a vector rotated by them (clockwise in the picture, whose y
// points down); the same on every machine.
glm::vec2 turn_by(float angle_rad);
inline glm::vec2 turned(glm::vec2 v, glm::vec2 turn) {
  return {v.x * turn.x - v.y * turn.y, v.x * turn.y + v.y * turn.x};
}

// "mix a/b": with probability dark -.5…-1.1, with probability light +.4…+1.0, else about 0.
float mixed_tone(float dark, float light, StrokeSeed& seed);

// Lays the polyline of a stroke centred at `position`, turned by `angle_rad` from the fall line
// (follow) or from the horizontal, bending by about `wobble_rad`.
void lay_line(Stroke& stroke, const StrokeScene& scene, glm::vec2 position, float length_units,
              float angle_rad, float wobble_rad, bool follow, StrokeSeed& seed);

// One seed in every cell of spacing_units, jittered; make(seed, position, pixel index, strokes)
// appends its strokes. Cells are counted from the sheet's corner, and only those near the requested
// pixels are visited. Rows of cells run in parallel and are joined in order. The results are
// strokes, or for a plan the paths that strokes will follow.
template <class Grown = Stroke, class Make>
std::vector<Grown> sow(const StrokeScene& scene, float spacing_units, Stream stream, Make&& make) {
  const float spacing = spacing_units * scene.scale();
  const SeededCells cells = scene.seeded_cells(spacing);
  const int down = std::max(0, cells.lines.last - cells.lines.first + 1);
  std::vector<std::vector<Grown>> rows(static_cast<std::size_t>(down));
  const std::uint64_t key = stream_seed(scene.parameters.seed, stream);
  parallel_rows(down, [&](int row) {
    const int j = cells.lines.first + row;
    for (int i = cells.columns.first; i <= cells.columns.last; ++i) {
      StrokeSeed seed(key, i, j);
      const float x = (static_cast<float>(i) + seed.uniform()) * spacing;
      const float y = (static_cast<float>(j) + seed.uniform()) * spacing;
      const glm::vec2 position{x, y};
      if (scene.on_canvas(position))
        make(seed, position, scene.pixel(position), rows[static_cast<std::size_t>(row)]);
    }
  });
  std::size_t total = 0;
  for (const auto& row : rows) total += row.size();
  std::vector<Grown> all;
  all.reserve(total);
  for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
  return all;
}

}  // namespace belvedere
