#pragma once

#include <span>

#include "renderer/style/fit/style_painting.h"

namespace belvedere {

// Two classes that border each other in panoramas and must be distinguishable, with the required
// OKLab distance at tones .34 and .66.
struct ClassPair {
  LandCoverClass a;
  LandCoverClass b;
  double distance;
};
std::span<const ClassPair> bordering_classes();

struct SeparateParameters {
  double max_strengthening = 1.3;  // max factor on all chroma
  double lacking = 0.10;           // mean shortfall of distances that is tolerated
  double reference_share = 0.85;   // of the reference's distance, which always suffices
  int passes = 40;
  double step = 0.3;  // share of the shortfall corrected in one pass
  // Limits of change: rotation of hue, for classes that were seen and derived (rock and scree turn
  // as if seen: they become greyer instead); factors on chroma.
  double turn_seen_deg = 8.0;
  double turn_derived_deg = 22.0;
  double min_chroma = 0.9;
  double min_chroma_derived = 0.6;
  double max_chroma = 1.2;
  // Share of a pair's shift that a derived class takes if the other was seen.
  double derived_share = 0.8;
};

// Mean relative shortfall of the distances between bordering classes, 0…1.
double lacking_distance(const ClassRamps& ramps, const ClassRamps& reference,
                        const SeparateParameters& parameters = {});

// Multiplies all chroma by one factor until the shortfall is tolerated or the ground is as
// colourful as the painting's colourful parts; chroma above that of the painting's strong colours
// of the same lightness is compressed (recipe A7 i).
ClassRamps strengthen_chroma(const ClassRamps& ramps, const ClassRamps& reference,
                             const StylePainting& painting,
                             const SeparateParameters& parameters = {});

// Moves pairs that are too similar apart, along 3 · lightness : 1 · hue; the order of lightness is
// the reference's (A7 ii). Hue and chroma change within the limits.
ClassRamps separate_classes(const ClassRamps& ramps, const ClassFlags& seen,
                            const ClassRamps& reference, const SeparateParameters& parameters = {});

}  // namespace belvedere
