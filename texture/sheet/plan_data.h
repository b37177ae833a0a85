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
    return texels[static_cast<std::size_t>(y - rect.y0) * static_cast<std::size_t>(rect.width()) +
                  static_cast<std::size_t>(x - rect.x0)];
  }
  bool contains(int x, int y) const {
    return x >= rect.x0 && y >= rect.y0 && x < rect.x1 && y < rect.y1;
  }
};

// An area that is made in one go: a corner, a line between corners or a tile. Its rectangle is
// empty where it has no width.
struct SynthesisArea {
  PixelRect rect;  // of the sheet
  bool across_x =
      false;  // a vertical line, or a corner: made with neighbours to the left and right
  bool across_y = false;
};
struct MadeArea {
  SynthesisArea area;
  std::uint64_t guides = 0;  // digest of those it was made with
  std::vector<LevelMatches> levels;
};

// Some of the corners and lines that were made last: neighbouring tiles begin with the same ones. A
// line of three levels takes 230 KB.
class MadeBetweenTiles {
 public:
  std::shared_ptr<const MadeArea> find(const PixelRect& rect, std::uint64_t guides) const;
  void keep(std::shared_ptr<const MadeArea> made);
  std::size_t count() const { return made_.size(); }

 private:
  std::deque<std::shared_ptr<const MadeArea>> made_;  // oldest first
};

// The content of a plan; only for code that makes, packs and uses plans.
struct SynthesisPlanData {
  SynthesisSheet sheet;
  synth::Setup setup;
  std::vector<std::uint32_t>
      matches;  // of the plan's level, row by row: texel of exemplars[level], or its nowhere
  synth::TexelDemand demand;                            // of the plan's level
  std::vector<std::vector<std::uint8_t>> usual_errors;  // by finer level
  std::vector<synth::Plane>
      exemplars;  // levels 0 … plan; of finer levels the pictures, of the plan's the positions only
  std::vector<std::shared_ptr<synth::LevelSource>> sources;  // by finer level
  std::uint64_t digest = 0;                                  // of the exemplars
  MadeBetweenTiles between_tiles;  // not part of the plan: derived from it
};

// Hash of everything that synthesis reads from the exemplars.
std::uint64_t digest_of(const synth::Plane& exemplars);
// The part of the plan that is made from the exemplars and the counts of the small view. planes: at
// least levels 0 … the plan's.
void make_sources(SynthesisPlanData& data, std::vector<synth::Plane> planes);

}  // namespace belvedere
