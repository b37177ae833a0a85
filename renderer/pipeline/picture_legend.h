#pragma once

#include <string>
#include <vector>

#include "base/run.h"
#include "renderer/features/drawn_features.h"
#include "renderer/labels/margin.h"
#include "renderer/paint/palette.h"
#include "renderer/world/world.h"

namespace belvedere {

// A small copy of the whole sheet, lit and in its colours, without strokes.
struct PictureOverview {
  glm::ivec2 sheet_px{0};
  int factor = 1;  // pixels of the sheet per pixel, on each side
  Grid<LandCoverClass> classes;
  Grid<glm::vec3> colours;  // encoded sRGB
};
PictureOverview make_overview(const World& world, const Palette& palette, const Run& run);

// The luminance of an overview, 0…1, as stored in the work folder: width, height and a byte per
// pixel.
std::string luminance_to_bytes(const PictureOverview& overview);
Grid<float> luminance_from_bytes(const std::string& bytes);

// Finds the classes of a picture, in the order of their table: those that cover a thousandth of its
// ground or more. Each has its mean colour and its best piece of the sheet, which shows only the
// class, as light as it mostly is, and near. A piece has swatch_px, or half of it on each side
// where the class has no place that wide; none where the class fills no piece by 40 %.
std::vector<LegendEntry> find_legend(const PictureOverview& overview, glm::dvec2 swatch_px);

// The kinds of lines, lifts and houses that are drawn somewhere in the picture, in the order of
// their style, on open ground of the palette. Rivers, areas and towns become classes of ground and
// are not included.
std::vector<FeatureSwatch> find_feature_legend(const DrawnFeatures& drawn, const Palette& palette);

// Both legends as stored in the work folder: "#a0a0a0 10 20 34 35 rock" per line; numbers and
// colours of a swatch, then its name.
std::string legend_to_text(const std::vector<LegendEntry>& legend);
std::vector<LegendEntry> legend_from_text(const std::string& text);
std::string swatches_to_text(const std::vector<FeatureSwatch>& swatches);
std::vector<FeatureSwatch> swatches_from_text(const std::string& text);

}  // namespace belvedere
