#pragma once

#include <vector>

#include "base/progress.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {

// Guided texture synthesis (measured in docs/synthesis.md): computes the match field of the target.
// Coherent candidates and picks by guides, filtered by label, coarse to fine, with integer costs
// and double-buffered parity passes: the same for any threads and tiles.
// Guides are paired by name; one that the target or every exemplar lacks is unused. Texels of an
// exemplar that alone lacks a guide cost what random texels of their class would in it, whatever is
// asked for. progress.note reports both once. The two with the largest weights order the lists of
// picks (synth_lists.h): give the largest weights to the guides that must be met exactly. A class
// without texels takes its fallback, or Match::none; a note reports it. Pixels labelled 255 get
// Match::none. If the target has depths, patches end at a jump of more than 4 % from one pixel to
// the next, and no two neighbours across a jump copy with the same offset. No piece is larger than
// copy_cap. If reuse is priced, no texel is used more than 6 + 3 × (pixels per texel of its class)
// times, as far as a dozen rounds of moving pixels can achieve. Throws Error(usage) if there is no
// exemplar, sizes differ or a parameter is out of range; Error(limit) for more than 2^31 pixels or
// texels in total or an exemplar over 32767 texels on a side.
MatchField synthesize(const std::vector<Exemplar>& exemplars, const GuideStack& target,
                      const SynthesisParameters& parameters, Progress& progress);

}  // namespace belvedere
