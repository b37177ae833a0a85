#pragma once

#include <string>
#include <vector>

#include "renderer/features/drawn_features.h"
#include "renderer/labels/margin.h"
#include "renderer/paint/palette.h"
#include "renderer/world/world.h"

namespace belvedere {

// The classes that a picture shows, in the order of their table: what covers a thousandth of its ground or more, in the colour that the
// palette gives it in good light at the mean altitude at which it grows on this terrain. Looks at a small picture of the whole sheet.
std::vector<LegendEntry> find_legend(const World& world, const Palette& palette);

// The kinds of lines, lifts and houses that are drawn somewhere in the picture, in the order of their style, on open ground of the palette.
// Rivers, areas and towns become classes of ground and are not among them.
std::vector<FeatureSwatch> find_feature_legend(const DrawnFeatures& drawn, const Palette& palette);

// Both as the work folder keeps them: "#a0a0a0 rock" a line; numbers and colours of a swatch, then its name.
std::string legend_to_text(const std::vector<LegendEntry>& legend);
std::vector<LegendEntry> legend_from_text(const std::string& text);
std::string swatches_to_text(const std::vector<FeatureSwatch>& swatches);
std::vector<FeatureSwatch> swatches_from_text(const std::string& text);

}  // namespace belvedere
