#pragma once

#include <string>
#include <vector>

#include "renderer/style/fit/class_ramps.h"
#include "renderer/style/fit/style_painting.h"

namespace belvedere {

struct DerivedRamps {
  ClassRamps ramps{};              // of all classes; those seen are unchanged
  std::vector<std::string> notes;  // of each class that was not seen, the source of its colours
};

// Ramps of the classes that the painting does not show (recipe A5): water from the bluest part of
// the sky; others from a related class that was seen plus the reference's difference between the
// two; the rest by optimal linear transport (Monge–Kantorovich) of the reference's colours to the
// ground's. All are then moved towards colours of the painting.
DerivedRamps derive_missing_classes(const SeenRamps& seen, const StylePainting& painting,
                                    const LightLaw& law, const ClassRamps& reference);

// The classes whose colours serve for another, the nearest first. Strokes too.
const std::vector<LandCoverClass>& relatives_of(LandCoverClass id);

}  // namespace belvedere
