#pragma once

#include <vector>

#include "base/land_cover_class.h"
#include "terrain/cover/land_cover.h"

namespace belvedere {

// Generalization of land cover before it guides paint: what is too small to be read goes, what matters however small it is stays and is
// made large enough to be seen.
struct PatchParameters {
  double smallest_m2 = 0.0;  // patches (cells of a class that touch by a side) below it are too small; 0: nothing changes
  std::vector<LandCoverClass> keep = {LandCoverClass::water, LandCoverClass::settlement};  // what matters
};

// What became of a class.
struct ClassArea {
  LandCoverClass id;
  double before_m2 = 0.0, after_m2 = 0.0;
  int patches_before = 0, patches_after = 0;
};

struct PatchResult {
  LandCover cover;
  std::vector<ClassArea> areas;  // by rising id; classes that were or are there
};

// Small patches take the class of the nearest larger one that is not kept (ties to the upper, then the left). Small patches of kept classes
// grow cell by cell around their rim, at most three cells wide and never over another kept class, until they are large enough. Lines one
// cell wide, such as rivers, are one patch as long as their cells touch by a side or a corner. Metric CRS.
PatchResult remove_small_patches(LandCover cover, const PatchParameters& parameters);

}  // namespace belvedere
