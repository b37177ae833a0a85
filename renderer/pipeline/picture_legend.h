#pragma once

#include <string>
#include <vector>

#include "renderer/features/drawn_features.h"
#include "renderer/labels/margin.h"
#include "renderer/paint/palette.h"
#include "renderer/world/world.h"

namespace belvedere {

// The classes of a picture, in the order of their table: those that cover a thousandth of its
// ground or more, in the palette's colour in good light at the mean altitude of the class on this
// terrain. From a small picture of the whole sheet.
std::vector<LegendEntry> find_legend(const World& world, const Palette& palette);

// The kinds of lines, lifts and houses that are drawn somewhere in the picture, in the order of
// their style, on open ground of the palette. Rivers, areas and towns become classes of ground and
// are not included.
std::vector<FeatureSwatch> find_feature_legend(const DrawnFeatures& drawn, const Palette& palette);

// Both as stored in the work folder: "#a0a0a0 rock" per line; numbers and colours of a swatch, then
// its name.
std::string legend_to_text(const std::vector<LegendEntry>& legend);
std::vector<LegendEntry> legend_from_text(const std::string& text);
std::string swatches_to_text(const std::vector<FeatureSwatch>& swatches);
std::vector<FeatureSwatch> swatches_from_text(const std::string& text);

}  // namespace belvedere
