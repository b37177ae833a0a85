#pragma once

#include <string>
#include <vector>

#include "renderer/style/fit/class_ramps.h"
#include "renderer/style/fit/light_law.h"
#include "renderer/style/fit/style_colours.h"
#include "renderer/style/fit/style_painting.h"

namespace belvedere {

struct DerivedRamps {
  ClassRamps ramps{};              // of all classes: those seen as they were
  std::vector<std::string> notes;  // of each class that was not seen, where its colours are from
};

// The ramps of classes that the painting does not show (recipe A5): water from the bluest of the
// sky; others from a relative that was seen, by the difference that the reference has between the
// two; the rest by the least-moving map of the reference's colours to the ground's. Then all are
// drawn towards paint that the painter used.
DerivedRamps derive_missing_classes(const SeenRamps& seen, const StylePainting& painting,
                                    const LightLaw& law, const ClassRamps& reference);

// The classes whose colours serve for another, the nearest first. Strokes too.
const std::vector<LandCoverClass>& relatives_of(LandCoverClass id);

}  // namespace belvedere
