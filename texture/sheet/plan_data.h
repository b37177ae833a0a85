#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "texture/sheet/synthesis_sheet.h"
#include "texture/synthesis/synth_setup.h"

namespace belvedere {

// Matches of a level in a rectangle of its picture.
struct LevelMatches {
  PixelRect rect;
  std::vector<std::uint32_t> texels;
  std::uint32_t at(int x, int y) const {
    return texels[static_cast<std::size_t>(y - rect.y0) * static_cast<std::size_t>(rect.width()) + static_cast<std::size_t>(x - rect.x0)];
  }
  bool contains(int x, int y) const { return x >= rect.x0 && y >= rect.y0 && x < rect.x1 && y < rect.y1; }
};

// What was made in one go: a corner, a line between corners or a tile. Its rectangle is empty where it has no breadth.
struct SynthesisArea {
  PixelRect rect;         // of the sheet
  bool across_x = false;  // is a line that goes down, or a corner: made with neighbours to the left and right
  bool across_y = false;
};
struct MadeArea {
  SynthesisArea area;
  std::uint64_t guides = 0;  // digest of those it was made with
  std::vector<LevelMatches> levels;
};

// Corners and lines, some of the last that were made: tiles beside each other begin with the same. A line of three levels takes 230 KB.
class MadeBetweenTiles {
 public:
  std::shared_ptr<const MadeArea> find(const PixelRect& rect, std::uint64_t guides) const;
  void keep(std::shared_ptr<const MadeArea> made);
  std::size_t count() const { return made_.size(); }

 private:
  std::deque<std::shared_ptr<const MadeArea>> made_;  // the oldest first
};

// What a plan holds; for who makes, packs and uses plans alone.
struct SynthesisPlanData {
  SynthesisSheet sheet;
  synth::Setup setup;
  std::vector<std::uint32_t> matches;                   // of the plan's level, row by row: texel of exemplars[level], or its nowhere
  synth::Demand demand;                                 // of the plan's level
  std::vector<std::vector<std::uint8_t>> usual_errors;  // by finer level
  std::vector<synth::Plane> exemplars;                  // levels 0 … plan; of the finer ones the pictures, of the plan's the places alone
  std::vector<std::shared_ptr<synth::LevelSource>> sources;  // by finer level
  std::uint64_t digest = 0;                                  // of the exemplars
  MadeBetweenTiles between_tiles;                            // no part of the plan: what it led to
};

// Of all that synthesis reads of the exemplars.
std::uint64_t digest_of(const synth::Plane& exemplars);
// The part of the plan that is made from the exemplars and what was counted in the small view. planes: levels 0 … the plan's at least.
void make_sources(SynthesisPlanData& data, std::vector<synth::Plane> planes);

}  // namespace belvedere
