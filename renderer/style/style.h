#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/land_cover_class.h"
#include "renderer/paint/palette.h"

namespace belvedere {

// The look of a painting as numbers: colours, brushwork and sky. Colours here are OKLab (L, a, b);
// those of the palette are encoded sRGB. Lengths of strokes are pixels of the painting's file;
// units_per_px converts them to units of the sheet (0.5 mm).

// Strokes of one class.
struct StyleBrushwork {
  double length_px = 0.0;            // of a stroke, 1…20; 0: the class has no strokes of its own
  double width_px = 0.0;             // 0.5…5
  double level = 0.0;                // mean of cos 2θ over strokes: 1 level, -1 upright
  double form = 0.0;                 // mean of cos 2(θ - direction of larger forms): 1 along them
  double coherence = 0.0;            // 0…1: how much neighbouring strokes agree in direction
  double lightness_deviation = 0.0;  // of the residuals' L
  // Steadiness of the sky's strokes: share of their direction left in its mean within Gaussians of
  // sigma 8, 16, 32 and 64 px of the painting, 0…1, descending: what is lost from one to the next
  // turns on that scale, what is left at the last is a steady flow. Zeros: not measured.
  std::array<double, 4> steadiness{};
  // Colour of a stroke minus the local mean: a list for each third of lightness, dark to light.
  std::array<std::vector<glm::vec3>, 3> residuals;
  std::vector<glm::vec3> accents;  // colours of the most colourful strokes
};

// A principal component of the sky's colour: `axis` (OKLab, one standard deviation, towards light)
// times an amount. The lengths are the horizontal and vertical lags at which the autocorrelation of
// the amount has fallen to one half.
struct StyleSkyChange {
  glm::vec3 axis{0.0F};
  double length_x = 0.3;  // shares of the sky's width and height, > 0
  double length_y = 0.3;
  // Deviations of the amount, whose own is 1, between Gaussians of sigma 1/90 and 1/45, 1/45 and
  // 2/45, 2/45 and 4/45 of the root of the sky's area: its streaks. 0…1.
  std::array<double, 3> streaks{};
  std::array<double, 7>
      quantiles{};  // of the change's amount, at shares 0.02 0.1 0.25 0.5 0.75 0.9 0.98
};

struct StyleSky {
  // 5 rows from the top to the horizon, of 3 from left to right; empty: the painting has no sky.
  Grid<glm::vec3> medians;
  std::vector<StyleSkyChange> changes;  // at most 2
  double aspect = 3.0;                  // width of the painting's sky over its height, 0.1…20
  // How much steeper the first change is on the upper side of light than below, -1…1: skewness of
  // its vertical gradient in the sky's upper half. Cumulus clouds have about 0.35, calm skies
  // -0.05…0.12.
  double upper_edges = 0.0;
  glm::vec3 clear{0.0F};     // clear sky between the clouds, minus the medians, OKLab …
  double clear_share = 0.0;  // … and its share of the sky's upper half, 0…1
};

struct Style {
  std::string name;
  std::string origin;  // painter, title, year and where the picture comes from
  std::string licence;
  Palette palette;
  std::array<StyleBrushwork, land_cover_class_count> brushwork;  // [sky] as well
  StyleSky sky;
  double units_per_px = 1.2;    // units of the sheet per pixel of the painting, 1…2.6
  double broken = 0.0;          // deviation of lightness of strokes over that of large forms, 0…2
  double vapour = 0.0;          // 0…1: how far air removes medium-scale forms
  double form_deviation = 0.0;  // of lightness between sigma 2 and 12 px, on the ground: contrast
                                // of medium-scale forms
  // Deviation of log2 of the contrast of strokes between regions of the ground, 0…2.
  double unevenness = 0.0;
  double contour_lines = 0.0;  // 0…1: strength of dark lines along borders
  glm::vec3 trend{0.0F};       // change of colour from the bottom to the top of the ground
  double hue_by_light = 0.0;   // 0…1: share of the hue's variance that lightness alone explains
  std::vector<std::string> notes;  // what was derived and from what
};

// Parameters of painting a picture in a style. Sizes on the sheet are units of 0.5 mm.
struct StylePaintParameters {
  double pixels_per_unit = 1.0;
  glm::ivec2 sheet_px{0};  // the whole picture, px
  int sky_rows = 0;        // from the sheet's top down to its lowest sky, px; 0: no sky is painted
  std::uint64_t seed = 1;
  double palette = 1.0;        // share of the style's trend and vapour, 0…1
  double brushwork = 1.0;      // share of its strokes, 0…1; 0: no strokes
  double sky = 1.0;            // share of its sky, 0…1
  double scale = 0.0;          // units per pixel of the painting, 0.2…8; 0: the style's
  double contour_lines = 1.0;  // share of its dark lines on silhouettes, 0…1
  double near_m = 8000.0;      // start of the trend with distance …
  double far_m = 60000.0;      // … and its end: distances along the ray, 0 < near < far
  double form_contrast = 0.0;  // factor on forms of about 14 units, 0.5…2; 0: from the style
  double unevenness = 1.0;     // share of the style's regional variation of contrast, 0…1
  double paint_relief = 0.03;  // shading of the paint's relief, in L, 0…0.1
  double weave = 0.008;        // of the canvas, in L, 0…0.05
};

// Pixels of the sheet per pixel of the painting.
inline double sheet_px_per_painting_px(const Style& style, const StylePaintParameters& parameters) {
  return (parameters.scale > 0.0 ? parameters.scale : style.units_per_px) *
         parameters.pixels_per_unit;
}

// Strength of dark lines on silhouettes, 0…1.
inline double contour_strength(const Style& style, const StylePaintParameters& parameters) {
  return style.contour_lines * parameters.contour_lines;
}

// Deviation of log2 of contrast between regions that is missing in the program's pictures.
double missing_unevenness(const Style& style, const StylePaintParameters& parameters);

// Sigma of these regions, units.
inline constexpr double style_region_units = 110.0;

}  // namespace belvedere
