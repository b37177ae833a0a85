#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "base/random_streams.h"
#include "texture/strokes/stroke.h"
#include "texture/strokes/stroke_seeds.h"

namespace belvedere {

// Which kinds of stroke to paint.
struct StrokeLayers {
  bool sky = true;      // on sky pixels
  bool ground = true;   // wash, rock, meadow, scree, snow, water
  bool accents = true;  // light on edges, dark in hollows
  bool breaks = true;   // what is drawn over copied ground: streaks, foam and surf of water; how ice runs, breaks and ends: flow lines,
                        // moraines, crevasses, edges of glaciers, ribs bare of snow
  bool upright = true;  // what stands on the ground: trees, dwarf pines, houses
};

// How far a painted pixel may lie from what it is made of, in units of the sheet.
struct StrokeReach {
  double source_units;  // from the pixel its stroke grew from …
  double seen_units;    // … and from any place that was looked at for that stroke to come about
};

// A kind of stroke.
struct StrokeKind {
  std::string_view name;
  bool StrokeLayers::*layer;
  Stream stream;  // of its random numbers, its own
  std::vector<Stroke> (*grow)(const StrokeScene& scene, Stream stream);
  StrokeReach reach;
  bool on_ice = false;  // asks the plan of the sheet's ice
  bool wet = false;     // on water, among what is drawn over copied ground
  bool built = false;   // houses, among what stands upright
  bool alone = false;   // painted whole before what follows; else far to near in one list with its neighbours
};

// All kinds, in the order of painting.
std::span<const StrokeKind> stroke_kinds();
// By name; throws Error(bug) where there is none.
const StrokeKind& find_stroke_kind(std::string_view name);
// Whether a kind is among those asked for.
bool is_painted(const StrokeKind& kind, const StrokeLayers& layers);
// What its strokes are part of.
PaintPart part_of(const StrokeKind& kind);

}  // namespace belvedere
