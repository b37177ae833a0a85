#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/land_cover_class.h"
#include "terrain/cover/land_cover.h"

namespace belvedere {

// Generalization of land cover before it guides paint: patches too small to be legible are removed;
// patches of important classes are kept and enlarged until they are visible.
struct PatchParameters {
  double smallest_m2 = 0.0;  // patches (cells of a class connected by sides) below it are too
                             // small; 0: nothing changes
  std::vector<LandCoverClass> keep = {LandCoverClass::water,
                                      LandCoverClass::settlement};  // kept classes
};

// Change of a class's area.
struct ClassArea {
  LandCoverClass id;
  double before_m2 = 0.0, after_m2 = 0.0;
  int patches_before = 0, patches_after = 0;
};

struct PatchResult {
  LandCover cover;
  std::vector<ClassArea> areas;  // by ascending id; classes present before or after
};

// Small patches take the class of the nearest larger one that is not kept (ties to the upper, then
// the left). Small patches of kept classes grow cell by cell around their border, at most three
// cells wide and never over another kept class, until they are large enough. Lines one cell wide,
// such as rivers, are one patch if their cells touch by a side or a corner. Metric CRS.
PatchResult remove_small_patches(LandCover cover, const PatchParameters& parameters);

// Average distance that a step moves the border of a class back.
inline constexpr double cover_erosion_step_m = 50.0;

// Classes to erode and by how many steps: melted snow, cut forest. In this order, each from the
// result of the previous one.
using CoverErosion = std::vector<std::pair<LandCoverClass, int>>;

// Land cover with eroded classes (base/masks/erosion.h), layer by layer, with ragged borders that
// depend on the position on the ground and not on cells. The surrounding class takes their place.
// Water, settlements and unknown cells neither spread nor start erosion, so shores and the edges of
// villages stay. Cells larger than 100 m lose at least half a cell per step. Metric CRS.
LandCover erode_land_cover(LandCover cover, const CoverErosion& erosion, std::uint64_t seed);

}  // namespace belvedere
