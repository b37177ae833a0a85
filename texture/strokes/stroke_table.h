#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "base/random.h"
#include "texture/strokes/brush.h"
#include "texture/strokes/stroke_seeds.h"

namespace belvedere {

// Which kinds of stroke to paint.
struct StrokeLayers {
  bool sky = true;      // on sky pixels
  bool ground = true;   // wash, rock, meadow, scree, snow, water
  bool accents = true;  // light on edges, dark in hollows
  bool breaks = true;   // drawn over copied ground: streaks, foam and surf of water; flow lines,
                        // moraines, crevasses and edges of glaciers, ribs bare of snow
  bool upright = true;  // objects on the ground: trees, dwarf pines, houses
};

// Max distance of a painted pixel from its inputs, in units of the sheet.
struct StrokeReach {
  double source_units;  // from the pixel its stroke starts at …
  double seen_units;    // … and from any position that was read to make that stroke
};

// A kind of stroke.
struct StrokeKind {
  std::string_view name;
  bool StrokeLayers::*layer;
  Stream stream;  // of its random numbers; unique
  std::vector<Stroke> (*grow)(const StrokeScene& scene, Stream stream);
  StrokeReach reach;
  bool on_ice = false;  // uses the plan of the sheet's ice
  bool wet = false;     // on water, among those drawn over copied ground
  bool built = false;   // houses, among standing objects
  bool alone = false;   // painted completely before the following kinds; else far to near in one
                        // list with its neighbours
};

// All kinds, in the order of painting.
std::span<const StrokeKind> stroke_kinds();
// Whether a kind is among the requested layers.
bool is_painted(const StrokeKind& kind, const StrokeLayers& layers);
// The layer of its strokes.
PaintPart part_of(const StrokeKind& kind);

}  // namespace belvedere
