#pragma once

#include <array>
#include <span>

#include "renderer/style/fit/style_colours.h"
#include "renderer/style/fit/style_painting.h"

namespace belvedere {

// Classes that border each other in panoramas and must be told apart, and how far: OKLab at tones
// .34 and .66.
struct ClassPair {
  LandCoverClass a;
  LandCoverClass b;
  double distance;
};
std::span<const ClassPair> bordering_classes();

struct SeparateParameters {
  double max_strengthening = 1.3;  // of all chroma
  double lacking = 0.10;           // share of the distances that may lack before pairs give way
  double reference_share = 0.85;   // of the reference's distance, which is always enough
  int passes = 40;
  double step = 0.3;  // of what lacks, a pass
  // What a colour may change: hue turns, of a class that was seen and one that was derived; chroma.
  double turn_seen_deg = 8.0;
  double turn_derived_deg = 22.0;
  double min_chroma = 0.9;
  double max_chroma = 1.2;
  // Of a pair, the share that a derived class gives way beside one that was seen.
  double derived_share = 0.8;
};

// How far bordering classes lack their distances, mean 0…1.
double lacking_distance(const ClassRamps& ramps, const ClassRamps& reference,
                        const SeparateParameters& parameters = {});

// All chroma stronger by one factor, until little distance lacks or the ground is as colourful as
// the painting's colourful parts; no colour stronger than the painter's strong ones of that
// lightness (recipe A7 i).
ClassRamps strengthen_chroma(const ClassRamps& ramps, const ClassRamps& reference,
                             const StylePainting& painting,
                             const SeparateParameters& parameters = {});

// Pairs that are too near give way, along 3 · lightness : 1 · hue; which of two is lighter, the
// reference says (A7 ii). Hues stay the painter's within the limits.
ClassRamps separate_classes(const ClassRamps& ramps, const ClassFlags& seen,
                            const ClassRamps& reference, const SeparateParameters& parameters = {});

}  // namespace belvedere
